// SPDX-License-Identifier: GPL-2.0-or-later
#include "bodies.h"
#include "arguments.h"
#include "atom.h"
#include "domain.h"
#include "fix_multisphere.h"
#include "fix_multisphere_break.h"
#include "modify.h"
#include "multisphere.h"
#include <algorithm>
#include <cstring>
#include <limits>

namespace grainscope {

using Eigen::Map;
using Eigen::Vector3d;
using LAMMPS_NS::FixMultisphere;

namespace {

/** The data of a body that ranks exchange. */
enum {
  TAG,
  SPHERES,
  MASS,
  VOLUME,
  CENTRE,
  VELOCITY = CENTRE + 3,
  SPIN = VELOCITY + 3,
  BOXES = SPIN + 3,
  INERTIA = BOXES + 3,
  AXES = INERTIA + 3,
  NUMBERS = AXES + 9
};

const FixMultisphere *multisphere(const LAMMPS_NS::Fix *fix) { return dynamic_cast<const FixMultisphere *>(fix); }
bool is_rigid(const LAMMPS_NS::Fix *fix) { return !strncmp(fix->style, "rigid", 5); }

const LAMMPS_NS::Fix *fix_of_bodies(const LAMMPS_NS::LAMMPS *lmp) {
  for (int k = 0; k < lmp->modify->nfix; k++) {
    const LAMMPS_NS::Fix *const fix = lmp->modify->fix[k];
    if (is_rigid(fix) || multisphere(fix)) return fix;
  }
  return nullptr;
}

}

Bodies::Bodies(LAMMPS_NS::LAMMPS *lmp, const std::string &style) : Pointers(lmp), style_(style) {
  for (int k = 0; k < modify->nfix; k++) {
    LAMMPS_NS::Fix *const fix = modify->fix[k];
    if (is_rigid(fix))
      Arguments(lmp, style)
          .fail("works with clumps of fix multisphere, not with the bodies of fix " + std::string(fix->id) + " (" +
                fix->style + "): each of their spheres would count as a grain");
    if (!multisphere(fix)) continue;
    if (fix_) Arguments(lmp, style).fail("works with one fix multisphere, got a second one");
    fix_ = dynamic_cast<FixMultisphere *>(fix);
  }
  if (fix_ && domain->dimension == 2)
    Arguments(lmp, style).fail("works with clumps of fix multisphere in three dimensions only");
}

/** Of this rank's bodies. */
void Bodies::gather(std::vector<double> &numbers) const {
  LAMMPS_NS::Multisphere &data = fix_->data();
  int length, width;
  const auto vectors = [&](const char *name) { return static_cast<double **>(data.extract(name, length, width)); };
  double **const inertia = vectors("inertia"), **const ex = vectors("ex_space"), **const ey = vectors("ey_space"),
                 **const ez = vectors("ez_space");
  const tagint *const boxes = static_cast<tagint *>(data.extract("imagebody", length, width));
  numbers.assign(static_cast<std::size_t>(data.n_body()) * NUMBERS, 0.0);
  for (int b = 0; b < data.n_body(); b++) {
    double *at = &numbers[static_cast<std::size_t>(b) * NUMBERS];
    at[TAG] = data.tag(b);
    at[SPHERES] = data.nrigid(b);
    at[MASS] = data.mass(b);
    at[VOLUME] = data.volume(b);
    data.xcm(at + CENTRE, b);
    data.vcm(at + VELOCITY, b);
    data.omega(at + SPIN, b);
    at[BOXES] = (boxes[b] & IMGMASK) - IMGMAX;
    at[BOXES + 1] = (boxes[b] >> IMGBITS & IMGMASK) - IMGMAX;
    at[BOXES + 2] = (boxes[b] >> IMG2BITS) - IMGMAX;
    std::copy_n(inertia[b], 3, at + INERTIA);
    std::copy_n(ex[b], 3, at + AXES);
    std::copy_n(ey[b], 3, at + AXES + 3);
    std::copy_n(ez[b], 3, at + AXES + 6);
  }
}

void Bodies::update(const BoxState &box, int groupbit) {
  if (!fix_) return;
  box_ = box;
  std::vector<double> mine;
  gather(mine);
  int ranks = 0, count = static_cast<int>(mine.size());
  MPI_Comm_size(world, &ranks);
  std::vector<int> counts(ranks), starts(ranks, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int r = 1; r < ranks; r++) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<double> numbers(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, numbers.data(), counts.data(), starts.data(), MPI_DOUBLE, world);

  all_.resize(numbers.size() / NUMBERS);
  place_.clear();
  for (std::size_t b = 0; b < all_.size(); b++) {
    const double *at = &numbers[b * NUMBERS];
    Body &body = all_[b];
    body.tag = static_cast<int>(at[TAG]);
    body.spheres = at[SPHERES];
    body.mass = at[MASS];
    body.volume = at[VOLUME];
    body.centre = Map<const Vector3d>(at + CENTRE);
    body.velocity = Map<const Vector3d>(at + VELOCITY);
    body.spin = Map<const Vector3d>(at + SPIN);
    body.boxes = Map<const Vector3d>(at + BOXES);
    body.inertia = Map<const Vector3d>(at + INERTIA);
    body.axes = Map<const Eigen::Matrix3d>(at + AXES);
    if (body.tag >= static_cast<int>(place_.size())) place_.resize(body.tag + 1, -1);
    place_[body.tag] = static_cast<int>(b);
  }
  find_first_ids();
  require_small();
  require_whole(groupbit);
}

/** Then the nearest image of the centre of a clump is the right one for each of its spheres. */
void Bodies::require_small() const {
  const double diameter = 2.0 * fix_->max_r_bound();
  for (int k = 0; k < 3; k++)
    if (box_.periodic[k] && diameter > 0.5 * box_.height(k))
      Arguments(lmp, style_)
          .fail("clumps must be at most half as large as the box along periodic edges, " +
                Arguments::text(0.5 * box_.height(k)) + " along " + std::string(1, 'x' + k) + ", got one of " +
                Arguments::text(diameter));
}

void Bodies::require_lasting() const {
  if (dynamic_cast<LAMMPS_NS::FixMultisphereBreak *>(fix_))
    Arguments(lmp, style_)
        .fail("works with clumps that do not break, got those of fix " + std::string(fix_->id) + " (" + fix_->style +
              "), which may break");
}

void Bodies::require_whole(int groupbit) const {
  if (groupbit == 1) return;  // all
  std::vector<double> chosen(all_.size(), 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    if (const Body *body = of(i)) chosen[body - all_.data()] += atom->mask[i] & groupbit ? 1.0 : 0.0;
  MPI_Allreduce(MPI_IN_PLACE, chosen.data(), static_cast<int>(chosen.size()), MPI_DOUBLE, MPI_SUM, world);
  for (std::size_t b = 0; b < all_.size(); b++)
    if (chosen[b] > 0.0 && chosen[b] < all_[b].spheres)
      Arguments(lmp, style_)
          .fail("its group must hold all spheres of a clump or none, got " + Arguments::text(chosen[b]) + " of " +
                Arguments::text(all_[b].spheres) + " spheres of clump " + std::to_string(all_[b].tag));
}

void Bodies::find_first_ids() {
  std::vector<int> first(all_.size(), std::numeric_limits<int>::max());
  for (int i = 0; i < atom->nlocal; i++)
    if (const Body *body = of(i)) {
      int &id = first[body - all_.data()];
      id = std::min(id, atom->tag[i]);
    }
  MPI_Allreduce(MPI_IN_PLACE, first.data(), static_cast<int>(first.size()), MPI_INT, MPI_MIN, world);
  for (std::size_t b = 0; b < all_.size(); b++) all_[b].first_id = first[b];
}

const Body *Bodies::of(int i) const {
  if (!fix_) return nullptr;
  const int tag = fix_->belongs_to(i);
  const int place = tag >= 0 && tag < static_cast<int>(place_.size()) ? place_[tag] : -1;
  return place < 0 ? nullptr : &all_[place];
}

bool Bodies::stands_for_itself_or_clump(int i) const {
  const Body *body = of(i);
  return !body || body->first_id == atom->tag[i];
}

Vector3d Bodies::arm(int i) const {
  const Body *body = of(i);
  if (!body) return Vector3d::Zero();
  const Vector3d d = Map<const Vector3d>(atom->x[i]) - body->centre;
  const Vector3d s = box_.edges.triangularView<Eigen::Upper>().solve(d);
  Vector3d boxes = Vector3d::Zero();
  for (int k = 0; k < 3; k++)
    if (box_.periodic[k]) boxes[k] = std::round(s[k]);
  return d - box_.edges * boxes;
}

void require_known_bodies(LAMMPS_NS::LAMMPS *lmp, const std::string &style) { const Bodies known(lmp, style); }

bool has_bodies(LAMMPS_NS::LAMMPS *lmp) { return fix_of_bodies(lmp); }

void require_no_bodies(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, const std::string &why) {
  if (const LAMMPS_NS::Fix *const fix = fix_of_bodies(lmp))
    errors.fail("does not work with clumps (fix " + std::string(fix->id) + ", " + fix->style + "): " + why);
}

}
