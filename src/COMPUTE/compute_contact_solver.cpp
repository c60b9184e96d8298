// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_solver.h"
#include "arguments.h"
#include "ellipsoid_bodies.h"
#include "pair_gran_insitu.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared() {
  grainscope::Outputs outputs;
  outputs.vector = {{"pairs_listed", "-", whole, "pairs in neighbour lists, over all force evaluations"},
                    {"pairs_solved", "-", whole, "of these, pairs given to the solver"},
                    {"pairs_touching", "-", whole, "of these, pairs that touch"},
                    {"steps", "-", whole, "Newton steps"},
                    {"steps_max", "-", intensive, "most Newton steps in one pair"},
                    {"fallbacks", "-", whole, "contacts without a regular answer, 0 in a sound run"}};
  outputs.scalar = {outputs.vector.back()};
  return outputs;
}

}

ComputeContactSolver::ComputeContactSolver(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg) {
  grainscope::Arguments arguments(lmp, "compute contact/solver", iarg, narg, arg);
  arguments.require_none();
  if (igroup != 0)
    arguments.fail(std::string("the group must be 'all', because the pairs of all grains are counted, got '") + arg[1] +
                   "'");
  declare(this, declared());
}

void ComputeContactSolver::init() {
  PairGranInsitu *const pair = PairGranInsitu::required_by(lmp, "compute contact/solver");
  if (!pair->contact_match("surface", "ellipsoid"))
    grainscope::Arguments(lmp, "compute contact/solver")
        .fail("needs a pair_style with 'surface ellipsoid', got '" + pair->models() + "'");
}

void ComputeContactSolver::compute_vector() {
  invoked_vector = update->ntimestep;
  const grainscope::SolverCounts &c =
      PairGranInsitu::required_by(lmp, "compute contact/solver")->ellipsoid_bodies().counts;
  double sums[] = {c.listed, c.solved, c.touching, c.steps, c.fallbacks}, most_steps = c.most_steps;
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, &most_steps, 1, MPI_DOUBLE, MPI_MAX, world);
  scalar = sums[4];
  put_vector({sums[0], sums[1], sums[2], sums[3], most_steps, scalar});
}

double ComputeContactSolver::compute_scalar() {
  invoked_scalar = update->ntimestep;
  compute_vector();  // again: a run may have begun at this step since
  return scalar;
}
