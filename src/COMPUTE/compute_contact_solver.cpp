// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_solver.h"
#include "arguments.h"
#include "ellipsoid_bodies.h"
#include "pair_gran_insitu.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;

ComputeContactSolver::ComputeContactSolver(LAMMPS *lmp, int &iarg, int narg, char **arg) : Compute(lmp, iarg, narg, arg) {
  grainscope::Arguments arguments(lmp, "compute contact/solver", iarg, narg, arg);
  arguments.require_none();
  if (igroup != 0)
    arguments.fail(std::string("the group must be 'all', as the pairs of all grains are counted, got '") + arg[1] + "'");
  scalar_flag = vector_flag = 1;
  extscalar = extvector = 0;
  size_vector = 6;
  vector = new double[size_vector]();
}

ComputeContactSolver::~ComputeContactSolver() { delete[] vector; }

void ComputeContactSolver::init() {
  if (!PairGranInsitu::required_by(lmp, "compute contact/solver")->contact_match("surface", "ellipsoid"))
    error->all(FLERR, "compute contact/solver requires a pair_style with surface ellipsoid: other surfaces have other solvers");
}

void ComputeContactSolver::compute_vector() {
  invoked_vector = update->ntimestep;
  const grainscope::SolverCounts &c = PairGranInsitu::required_by(lmp, "compute contact/solver")->ellipsoid_bodies().counts;
  const double mine[6] = {c.listed, c.solved, c.touching, c.steps, c.most_steps, c.fallbacks};
  MPI_Allreduce(mine, vector, 6, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&mine[4], &vector[4], 1, MPI_DOUBLE, MPI_MAX, world);
}

double ComputeContactSolver::compute_scalar() {
  invoked_scalar = update->ntimestep;
  compute_vector();  // again: a run may have begun at this step since
  scalar = vector[5];
  return scalar;
}
