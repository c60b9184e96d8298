// SPDX-License-Identifier: GPL-2.0-or-later
#include "region_solid.h"
#include "arguments.h"
#include "region_shape.h"
#include "atom.h"
#include "domain.h"
#include "region.h"
#include "update.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace LAMMPS_NS;

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
  new_run_ = true;
  first_step_ = lmp->update->firststep;
}

/** Errors where LIGGGHTS itself is wrong about what is inside. */
void RegionSolid::require_sound(Region *region) const {
  for (Region *member : members_of(*domain, region)) require_sound(member);
  if (ends_are_unseen(region))
    Arguments(lmp, style_)
        .fail("region '" + std::string(region->id) +
              "': LIGGGHTS ignores the bound of a prism that is INF on the other side: give two bounds or two INF");
}

/** LIGGGHTS evaluates the variables of a region where it needs them, perhaps not on all ranks: here all ranks do. */
void RegionSolid::evaluate(Region *region) const {
  for (Region *member : members_of(*domain, region)) evaluate(member);
  if (new_run_) region->prematch();  // variables may be others since the last run, which ended in the same step
  region->match(0.0, 0.0, 0.0);
}

void RegionSolid::update(const BoxState &box) {
  box_ = box;
  if (find(id_) != region_ || lmp->update->firststep != first_step_) init();
  evaluate(region_);
  new_run_ = false;
  known_ = shape_of(*domain, region_, solid_, why_not_);
  if (needs_parts_) require_known(known_, why_not_);
  if (box.dimension == 2) height_ = height_of_grains();
  Solid cut = solid_;
  std::string ignored;
  if (box.dimension == 2 && known_ && solid_.section(height_, cut, ignored)) solid_ = cut;
}

/** z of the plane of the grains, the middle of the box without any. Collective. */
double RegionSolid::height_of_grains() const {
  double height = atom->nlocal > 0 ? atom->x[0][2] : -HUGE_VAL;
  MPI_Allreduce(MPI_IN_PLACE, &height, 1, MPI_DOUBLE, MPI_MAX, world);
  return std::isfinite(height) ? height : box_.centre[2];
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

void RegionSolid::require_parts() {
  needs_parts_ = true;
  Solid ignored = Solid::common({});
  std::string why;
  require_known(shape_of(*domain, region_, ignored, why), why);
}

void RegionSolid::require_known(bool known, const std::string &why) const {
  if (!known) Arguments(lmp, style_).fail("region '" + id_ + "': " + why);
}

/** Beyond a shrink-wrapped face the region continues, by `beyond` lengths of the box. */
bool RegionSolid::volume_within(double beyond, double &value, std::string &why) const {
  Vector3d corner = box_.centre - 0.5 * box_.edges.rowwise().sum();
  Matrix3d edges = box_.edges;
  for (int k = 0; k < 3; k++) {
    const double below = follows_grains(k, 0) ? beyond : 0.0, above = follows_grains(k, 1) ? beyond : 0.0;
    corner -= below * box_.edges.col(k);
    edges.col(k) *= 1.0 + below + above;
  }
  Solid cut = solid_;
  if (box_.dimension == 2 && !solid_.section(height_, cut, why)) return false;
  return cut.volume_within(Polyhedron(corner, edges), value, why);
}

/** Boundary s or m. */
bool RegionSolid::follows_grains(int k, int side) const { return domain->boundary[k][side] > 1; }

bool RegionSolid::volume(double &value, std::string &why) const {
  if (!known_) {
    why = why_not_;
    return false;
  }
  if (!volume_within(100.0, value, why)) return false;
  double further = value;
  if (domain->nonperiodic == 2 && (!volume_within(200.0, further, why) || std::fabs(further - value) > 1e-9 * value)) {
    why = "it has no end where the box is shrink-wrapped, boundary s or m: give bounds instead of INF and EDGE";
    return false;
  }
  if (!(value > 0.0)) Arguments(lmp, style_).fail("region '" + id_ + "': no part of it lies in the box");
  return true;
}

}
