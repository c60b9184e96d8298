// SPDX-License-Identifier: GPL-2.0-or-later
#include "region_solid.h"
#include "arguments.h"
#include "private_member.h"
#include "domain.h"
#include "modify.h"
#include "region_block.h"
#include "region_cone.h"
#include "region_cylinder.h"
#include "region_intersect.h"
#include "region_plane.h"
#include "region_prism.h"
#include "region_sphere.h"
#include "region_union.h"
#include "update.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace LAMMPS_NS;

namespace {

const double infinite = 1e20;  // what INF is to the host

using Triple = double[3];
using Triples = double[3][3];

#define MEMBER GRAINSCOPE_PRIVATE_MEMBER
MEMBER(RegBlock, double, xlo)
MEMBER(RegBlock, double, xhi)
MEMBER(RegBlock, double, ylo)
MEMBER(RegBlock, double, yhi)
MEMBER(RegBlock, double, zlo)
MEMBER(RegBlock, double, zhi)
MEMBER(RegSphere, double, xc)
MEMBER(RegSphere, double, yc)
MEMBER(RegSphere, double, zc)
MEMBER(RegSphere, double, radius)
MEMBER(RegCylinder, char, axis)
MEMBER(RegCylinder, double, c1)
MEMBER(RegCylinder, double, c2)
MEMBER(RegCylinder, double, lo)
MEMBER(RegCylinder, double, hi)
MEMBER(RegCylinder, double, radius)
MEMBER(RegCone, char, axis)
MEMBER(RegCone, double, c1)
MEMBER(RegCone, double, c2)
MEMBER(RegCone, double, lo)
MEMBER(RegCone, double, hi)
MEMBER(RegCone, double, radiuslo)
MEMBER(RegCone, double, radiushi)
MEMBER(RegPlane, double, xp)
MEMBER(RegPlane, double, yp)
MEMBER(RegPlane, double, zp)
MEMBER(RegPlane, Triple, normal)
MEMBER(RegPrism, double, xlo)
MEMBER(RegPrism, double, xhi)
MEMBER(RegPrism, double, ylo)
MEMBER(RegPrism, double, yhi)
MEMBER(RegPrism, double, zlo)
MEMBER(RegPrism, double, zhi)
MEMBER(RegPrism, Triples, h)
MEMBER(RegUnion, int, nregion)
MEMBER(RegUnion, int *, list)
MEMBER(RegIntersect, int, nregion)
MEMBER(RegIntersect, int *, list)
MEMBER(Region, int, moveflag)
MEMBER(Region, int, rotateflag)
MEMBER(Region, Triple, point)
MEMBER(Region, Triple, runit)
MEMBER(Region, double, dx)
MEMBER(Region, double, dy)
MEMBER(Region, double, dz)
MEMBER(Region, double, theta)
#undef MEMBER

/** low <= normal . (x - corner) < high, of a normal of any length. */
void add_slab(std::vector<HalfSpace> &sides, const Vector3d &normal, double low, double high) {
  const double size = normal.norm();
  sides.push_back({-normal / size, -low / size});
  sides.push_back({normal / size, high / size, true});
}

Solid block(RegBlock *b) {
  std::vector<HalfSpace> sides;
  add_slab(sides, Vector3d::UnitX(), xlo_of(b), xhi_of(b));
  add_slab(sides, Vector3d::UnitY(), ylo_of(b), yhi_of(b));
  add_slab(sides, Vector3d::UnitZ(), zlo_of(b), zhi_of(b));
  return Solid::flat(sides);
}

/** The host gives no values to what is below the diagonal of the edges. */
Solid prism(RegPrism *p) {
  const Matrix3d edges =
                     Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(h_of(p)[0]).triangularView<Eigen::Upper>(),
                 inverse = edges.inverse();
  const Vector3d corner(xlo_of(p), ylo_of(p), zlo_of(p));
  std::vector<HalfSpace> sides;
  for (int k = 0; k < 3; k++) {
    const Vector3d normal = inverse.row(k);
    add_slab(sides, normal, normal.dot(corner), normal.dot(corner) + 1.0);
  }
  return Solid::flat(sides);
}

/** By its places along edges of length 1e20 the host cannot tell one end of an edge from the other. */
bool ends_on_one_side(RegPrism *p) {
  const double ends[3][2] = {{xlo_of(p), xhi_of(p)}, {ylo_of(p), yhi_of(p)}, {zlo_of(p), zhi_of(p)}};
  for (const double *end : ends)
    if ((end[0] == -infinite) != (end[1] == infinite)) return true;
  return false;
}

/** `first`, `second`: coordinates of the axis, in the order of x, y, z without its own. */
Solid round(char axis, double first, double second, double lo, double hi, double radius_lo, double radius_hi) {
  const int along = axis - 'x';
  Vector3d origin = Vector3d::Zero();
  origin[along == 0 ? 1 : 0] = first;
  origin[along == 2 ? 1 : 2] = second;
  return Solid::round(origin, Vector3d::Unit(along), lo, hi, radius_lo, radius_hi);
}

}

RegionSolid::RegionSolid(LAMMPS *lmp, const std::string &style, const std::string &id)
    : Pointers(lmp), style_(style), id_(id) {
  region_ = find(id);
}

Region *RegionSolid::find(const std::string &id) const {
  const int found = domain->find_region(const_cast<char *>(id.c_str()));
  if (found < 0) Arguments(lmp, style_).fail("region", "a region that is defined", id);
  return domain->regions[found];
}

void RegionSolid::init() {
  region_ = find(id_);
  region_->init();
  require_sound(region_);
}

/** Of a union or a common part. */
std::vector<Region *> RegionSolid::members_of(Region *region) const {
  std::vector<int> numbers;
  if (RegUnion *of = dynamic_cast<RegUnion *>(region)) numbers.assign(list_of(of), list_of(of) + nregion_of(of));
  if (RegIntersect *of = dynamic_cast<RegIntersect *>(region))
    numbers.assign(list_of(of), list_of(of) + nregion_of(of));
  std::vector<Region *> members;
  for (int number : numbers) members.push_back(domain->regions[number]);
  return members;
}

/** Errors where the host itself is wrong about what is inside. */
void RegionSolid::require_sound(Region *region) const {
  for (Region *member : members_of(region)) require_sound(member);
  RegPrism *p = dynamic_cast<RegPrism *>(region);
  if (p && ends_on_one_side(p))
    Arguments(lmp, style_)
        .fail("region '" + std::string(region->id) +
              "': LIGGGHTS does not see where a prism ends that is INF on one side alone: give it two bounds, or two "
              "INF");
}

/** The host asks a region's variables where it comes to need them, which may not be on all ranks: here they are asked. */
void RegionSolid::evaluate(Region *region) const {
  for (Region *member : members_of(region)) evaluate(member);
  region->match(0.0, 0.0, 0.0);
}

void RegionSolid::update(const BoxState &box) {
  if (Pointers::update->whichflag == 0) init();  // between runs regions may be deleted
  box_ = box;
  evaluate(region_);
  known_ = shape_of(region_, solid_, why_not_);
  Solid cut = solid_;
  std::string ignored;
  if (domain->dimension == 2 && known_ && solid_.section(0.0, cut, ignored)) solid_ = cut;
}

bool RegionSolid::shape_at_rest(Region *region, Solid &solid, std::string &why) const {
  if (RegBlock *b = dynamic_cast<RegBlock *>(region)) {
    solid = block(b);
  } else if (RegPrism *p = dynamic_cast<RegPrism *>(region)) {
    solid = prism(p);
  } else if (RegPlane *p = dynamic_cast<RegPlane *>(region)) {
    const Vector3d normal = Map<const Vector3d>(normal_of(p)).normalized();
    solid = Solid::flat({{-normal, -normal.dot(Vector3d(xp_of(p), yp_of(p), zp_of(p)))}});
  } else if (RegSphere *s = dynamic_cast<RegSphere *>(region)) {
    solid = Solid::ball({xc_of(s), yc_of(s), zc_of(s)}, radius_of(s));
  } else if (RegCylinder *c = dynamic_cast<RegCylinder *>(region)) {
    solid = round(axis_of(c), c1_of(c), c2_of(c), lo_of(c), hi_of(c), radius_of(c), radius_of(c));
  } else if (RegCone *c = dynamic_cast<RegCone *>(region)) {
    solid = round(axis_of(c), c1_of(c), c2_of(c), lo_of(c), hi_of(c), radiuslo_of(c), radiushi_of(c));
  } else {
    const bool all = dynamic_cast<RegUnion *>(region), shared = dynamic_cast<RegIntersect *>(region);
    if (!all && !shared) {
      why = "lines are cut by block, prism, plane, sphere, cylinder, cone, and unions and common parts of these, got "
            "style " +
            std::string(region->style);
      return false;
    }
    std::vector<Solid> members;
    for (Region *member : members_of(region)) {
      members.push_back(Solid::common({}));
      if (!shape_of(member, members.back(), why)) return false;
    }
    solid = all ? Solid::united(members) : Solid::common(members);
  }
  return true;
}

bool RegionSolid::shape_of(Region *region, Solid &solid, std::string &why) const {
  if (!shape_at_rest(region, solid, why)) return false;
  if (!region->interior) solid = solid.complement();
  if (!region->dynamic_check()) return true;
  const Vector3d about = Map<const Vector3d>(point_of(region));
  Matrix3d turn = Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();
  if (rotateflag_of(region)) {
    turn = Eigen::AngleAxisd(theta_of(region), Map<const Vector3d>(runit_of(region))).toRotationMatrix();
    shift = about - turn * about;
  }
  if (moveflag_of(region)) shift += Vector3d(dx_of(region), dy_of(region), dz_of(region));
  solid = solid.moved(turn, shift);
  return true;
}

bool RegionSolid::has(const Vector3d &x) const {
  const Vector3d s = box_.fraction(x);
  Vector3d shift = Vector3d::Zero();
  for (int k = 0; k < 3; k++)
    if (box_.periodic[k]) shift[k] = std::floor(s[k]);
  if (shift.isZero(0.0)) return region_->match(x[0], x[1], x[2]);
  const Vector3d inside = x - box_.edges * shift;
  return region_->match(inside[0], inside[1], inside[2]);
}

double RegionSolid::part(const Vector3d &from, const Vector3d &to) const {
  const Vector3d a = box_.fraction(from), b = box_.fraction(to);
  int low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++)
    if (box_.periodic[k]) {
      low[k] = static_cast<int>(std::floor(std::min(a[k], b[k])));
      high[k] = static_cast<int>(std::floor(std::max(a[k], b[k])));
    }
  double sum = 0.0;
  Vector3d image;
  for (image[0] = low[0]; image[0] <= high[0]; image[0]++)
    for (image[1] = low[1]; image[1] <= high[1]; image[1]++)
      for (image[2] = low[2]; image[2] <= high[2]; image[2]++) {
        double first = 0.0, last = 1.0;  // of the line, in this image of the box
        for (int k = 0; k < 3; k++) {
          if (low[k] == high[k]) continue;
          const double enters = (image[k] - a[k]) / (b[k] - a[k]), leaves = (image[k] + 1.0 - a[k]) / (b[k] - a[k]);
          first = std::max(first, std::min(enters, leaves));
          last = std::min(last, std::max(enters, leaves));
        }
        if (first >= last) continue;
        const Vector3d shift = box_.edges * image;
        sum += length_of(solid_.parts(from - shift, to - shift), first, last);
      }
  return sum;
}

void RegionSolid::require_parts() const {
  Solid ignored = Solid::common({});
  std::string why;
  if (!shape_of(region_, ignored, why)) Arguments(lmp, style_).fail("region '" + id_ + "': " + why);
}

bool RegionSolid::volume(double &value, std::string &why) const {
  if (!known_) {
    why = why_not_;
    return false;
  }
  const Vector3d corner = box_.centre - 0.5 * box_.edges.rowwise().sum();
  if (domain->dimension == 3) {
    if (!solid_.volume_within(Polyhedron(corner, box_.edges), value, why)) return false;
  } else {
    Solid cut = solid_;
    Matrix3d layer = box_.edges;
    layer.col(2) = Vector3d::UnitZ();
    if (!solid_.section(0.0, cut, why) ||
        !cut.volume_within(Polyhedron({corner[0], corner[1], -0.5}, layer), value, why))
      return false;
  }
  if (value > 0.0) return true;
  why = "nothing of it lies in the box";
  return false;
}

}
