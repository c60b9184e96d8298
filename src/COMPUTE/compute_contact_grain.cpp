// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_grain.h"
#include "arguments.h"
#include "contact_measures.h"
#include "contact_sums.h"
#include "grain_shape.h"
#include "nematic.h"
#include "rows.h"
#include "atom.h"
#include "update.h"
#include <algorithm>
#include <vector>

using namespace LAMMPS_NS;
using grainscope::Contact;

namespace {

constexpr auto intensive = grainscope::Extent::intensive;

enum { CONTACTS, SLIDING, NORMAL_POWER, FRICTION_POWER, MOBILISATION, ANGLE, WALL_CONTACTS, WIDTH };

grainscope::Outputs declared() {
  grainscope::Outputs outputs;
  outputs.per_grain = {
      {"N_c", "-", intensive, "contacts of the grain, with grains and with walls"},
      {"N_sliding", "-", intensive, "its contacts that slide"},
      {"P_n", "energy/time", intensive, "power lost by normal damping, half of it for contacts between grains"},
      {"P_t", "energy/time", intensive, "power lost by friction, half of it for contacts between grains"},
      {"mobilisation", "-", intensive, "|F_t| over its friction limit, mean over its contacts"},
      {"theta", "rad", intensive, "angle of the major axis to the flow in the plane, xy by default"},
      {"N_w", "-", intensive, "contacts of the grain with walls"}};
  return outputs;
}

}

struct ComputeContactGrain::Impl {
  grainscope::Rows rows;
  bool finished = false;  // sums are means already
  std::vector<int> tags;  // of the grains in the order of the evaluation
};

ComputeContactGrain::ComputeContactGrain(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg,
                     grainscope::Scope::region | grainscope::Scope::types | grainscope::Scope::walls |
                         grainscope::Scope::plane),
      impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(scope_.with({}));
    scope_.read(arguments, keyword);
  }
  declare(this, declared());
  require_count(WIDTH, outputs().per_grain, "columns");
}

ComputeContactGrain::~ComputeContactGrain() {}

void ComputeContactGrain::init() {
  ContactCompute::init();
  require_known_losses();
}

void ComputeContactGrain::begin_contacts() {
  ContactCompute::begin_contacts();
  array_atom = impl_->rows.resize(atom->nmax, WIDTH);
  impl_->finished = false;
  impl_->tags.assign(atom->tag, atom->tag + atom->nlocal);
}

void ComputeContactGrain::add_contacts(grainscope::ContactSpan contacts) {
  grainscope::for_each_contact(contacts, selection(), [this](const Contact &c) {
    const double share = c.with_wall() ? 1.0 : 0.5;
    const double contribution[ANGLE] = {1.0, c.sliding ? 1.0 : 0.0, share * grainscope::damping_loss(c),
                                        share * grainscope::friction_loss(c), grainscope::mobilisation(c)};
    if (c.with_wall()) array_atom[c.i][WALL_CONTACTS] += 1.0;
    for (int k = 0; k < ANGLE; k++) {
      array_atom[c.i][k] += contribution[k];
      if (c.with_own_grain()) array_atom[c.j()][k] += contribution[k];  // a ghost's owner counts it
    }
  });
}

/** Angle of the major axis, as compute nematic averages it. */
double ComputeContactGrain::angle_to_flow(int i) const {
  if (!atom->superquadric_flag) return 0.0;
  const grainscope::SymmetryAxis axis = grainscope::symmetry_axis(atom->shape[i]);
  if (axis.shape == grainscope::Shape::sphere) return 0.0;
  const Eigen::Vector3d p = grainscope::orientation(*atom, i) * Eigen::Vector3d::Unit(axis.index);
  return grainscope::major_axis_angle(scope_.shear_plane().of(p), axis.shape);
}

/** Collective. An error if grains were sorted, added or removed after their contacts were seen. */
void ComputeContactGrain::require_same_grains() const {
  const std::vector<int> &tags = impl_->tags;
  int changed = static_cast<int>(tags.size()) != atom->nlocal || !std::equal(tags.begin(), tags.end(), atom->tag);
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, world);
  if (changed)
    grainscope::Arguments(lmp, name_ + " " + id)
        .fail("grains were sorted, added or removed after the last step of the run: use it during a run");
}

void ComputeContactGrain::compute_peratom() {
  require_tally();
  require_same_grains();
  invoked_peratom = update->ntimestep;
  if (impl_->finished) return;
  impl_->finished = true;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i)) continue;
    double *row = array_atom[i];
    if (row[CONTACTS] > 0.0) row[MOBILISATION] /= row[CONTACTS];
    row[ANGLE] = angle_to_flow(i);
  }
}

double ComputeContactGrain::memory_usage() { return impl_->rows.bytes(); }
