// SPDX-License-Identifier: GPL-2.0-or-later
#include "region_shape.h"
#include "private_member.h"
#include "domain.h"
#include "region_block.h"
#include "region_cone.h"
#include "region_cylinder.h"
#include "region_intersect.h"
#include "region_plane.h"
#include "region_prism.h"
#include "region_sphere.h"
#include "region_union.h"
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

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
  Matrix3d edges = Matrix3d::Zero();
  edges.triangularView<Eigen::Upper>() = Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(h_of(p)[0]);
  const Matrix3d inverse = edges.inverse();
  const Vector3d corner(xlo_of(p), ylo_of(p), zlo_of(p));
  std::vector<HalfSpace> sides;
  for (int k = 0; k < 3; k++) {
    const Vector3d normal = inverse.row(k);
    add_slab(sides, normal, normal.dot(corner), normal.dot(corner) + 1.0);
  }
  return Solid::flat(sides);
}

/** `first`, `second`: coordinates of the axis, in the order of x, y, z without its own. */
Solid round(char axis, double first, double second, double lo, double hi, double radius_lo, double radius_hi) {
  const int along = axis - 'x';
  Vector3d origin = Vector3d::Zero();
  origin[along == 0 ? 1 : 0] = first;
  origin[along == 2 ? 1 : 2] = second;
  return Solid::round(origin, Vector3d::Unit(along), lo, hi, radius_lo, radius_hi);
}

bool shape_at_rest(const Domain &domain, Region *region, Solid &solid, std::string &why) {
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
      why = "it must be a block, prism, plane, sphere, cylinder or cone, or a union or intersection of these, got "
            "style " +
            std::string(region->style);
      return false;
    }
    std::vector<Solid> members;
    for (Region *member : members_of(domain, region)) {
      members.push_back(Solid::common({}));
      if (!shape_of(domain, member, members.back(), why)) return false;
    }
    solid = all ? Solid::united(members) : Solid::common(members);
  }
  return true;
}

}

std::vector<Region *> members_of(const Domain &domain, Region *region) {
  std::vector<int> numbers;
  if (RegUnion *of = dynamic_cast<RegUnion *>(region)) numbers.assign(list_of(of), list_of(of) + nregion_of(of));
  if (RegIntersect *of = dynamic_cast<RegIntersect *>(region))
    numbers.assign(list_of(of), list_of(of) + nregion_of(of));
  std::vector<Region *> members;
  for (int number : numbers) members.push_back(domain.regions[number]);
  return members;
}

bool ends_are_unseen(Region *region) {
  RegPrism *p = dynamic_cast<RegPrism *>(region);
  if (!p) return false;
  const double ends[3][2] = {{xlo_of(p), xhi_of(p)}, {ylo_of(p), yhi_of(p)}, {zlo_of(p), zhi_of(p)}};
  return std::any_of(ends, ends + 3, [](const double *end) { return (end[0] == -infinite) != (end[1] == infinite); });
}

bool shape_of(const Domain &domain, Region *region, Solid &solid, std::string &why) {
  if (!shape_at_rest(domain, region, solid, why)) return false;
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

bool is_standing_block(Region *region, Vector3d &low, Vector3d &high) {
  RegBlock *const block = dynamic_cast<RegBlock *>(region);
  if (!block || !region->interior || moveflag_of(region) || rotateflag_of(region)) return false;
  low = {xlo_of(block), ylo_of(block), zlo_of(block)};
  high = {xhi_of(block), yhi_of(block), zhi_of(block)};
  return true;
}

}
