// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluctuations.h"
#include "arguments.h"
#include "atom.h"
#include "lammps.h"
#include "update.h"
#include <cmath>
#include <mpi.h>

namespace grainscope {

using Eigen::Map;
using Eigen::Vector3d;

namespace {

void sum_over_ranks(LAMMPS_NS::LAMMPS *lmp, double *values, int n) {
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, lmp->world);
}

}

void require_layers(LAMMPS_NS::LAMMPS *lmp, const std::string &who, double grains) {
  if (grains == 0.0) return;
  const Arguments complaints(lmp, who, 0, 0, nullptr);
  complaints.fail("step " + std::to_string(lmp->update->ntimestep) + ": the positions of " + Arguments::text(grains) +
                  " grains are not finite, so that no layer holds them: look at what moves or pushes them");
}

void MeanFlow::read(Arguments &arguments) {
  const std::string name = arguments.choice("flow", {"box", "rate", "fit", "layers"});
  kind = name == "box" ? Kind::box : name == "rate" ? Kind::rate : name == "fit" ? Kind::fit : Kind::layers;
  if (kind == Kind::rate) rate = arguments.number("flow rate", "a shear rate", [](double) { return true; });
  if (kind == Kind::layers) layers = arguments.whole_number("flow layers", 1, 10000);
}

Fluctuations::Fluctuations(LAMMPS_NS::LAMMPS *lmp, int groupbit, const BoxState &box, const MeanFlow &flow) : lmp_(lmp) {
  const LAMMPS_NS::Atom *atom = lmp->atom;
  const int across = flow.plane.gradient;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const Map<const Vector3d> x(atom->x[i]);
    Vector3d v = Map<const Vector3d>(atom->v[i]);
    if (flow.kind == MeanFlow::Kind::box || flow.kind == MeanFlow::Kind::layers) v -= box.flow(x);
    if (flow.kind == MeanFlow::Kind::rate) v[flow.plane.flow] -= flow.rate * (x[across] - box.centre[across]);
    local_.push_back({i, atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]], v, Vector3d(Map<const Vector3d>(atom->omega[i]))});
  }
  if (flow.kind == MeanFlow::Kind::fit) subtract_line(across);
  if (flow.kind == MeanFlow::Kind::layers) subtract_layers(box, across, flow.layers);
  else subtract_means();
}

void Fluctuations::subtract_means() {
  double sums[8] = {};  // m v, m, omega, grains
  for (const Grain &g : local_) {
    Map<Vector3d>(sums + 0) += g.mass * g.velocity;
    sums[3] += g.mass;
    Map<Vector3d>(sums + 4) += g.spin;
    sums[7] += 1.0;
  }
  sum_over_ranks(lmp_, sums, 8);
  grains_ = sums[7];
  if (grains_ == 0.0) return;
  const Vector3d velocity = Map<Vector3d>(sums + 0) / sums[3], spin = Map<Vector3d>(sums + 4) / grains_;
  for (Grain &g : local_) {
    g.velocity -= velocity;
    g.spin -= spin;
  }
}

/** Takes the slope of the fitted line out; its height goes with the mean. */
void Fluctuations::subtract_line(int gradient) {
  const double *const *x = lmp_->atom->x;
  double first[5] = {};  // m y, m v, m
  for (const Grain &g : local_) {
    first[0] += g.mass * x[g.index][gradient];
    Map<Vector3d>(first + 1) += g.mass * g.velocity;
    first[4] += g.mass;
  }
  sum_over_ranks(lmp_, first, 5);
  if (first[4] == 0.0) return;
  const double middle = first[0] / first[4];
  const Vector3d mean = Map<Vector3d>(first + 1) / first[4];

  double second[4] = {};  // m (y - <y>)(v - <v>), m (y - <y>)^2
  for (const Grain &g : local_) {
    const double y = x[g.index][gradient] - middle;
    Map<Vector3d>(second + 0) += g.mass * y * (g.velocity - mean);
    second[3] += g.mass * y * y;
  }
  sum_over_ranks(lmp_, second, 4);
  if (second[3] == 0.0) return;
  slope_ = Map<Vector3d>(second + 0) / second[3];
  for (Grain &g : local_) g.velocity -= slope_ * (x[g.index][gradient] - middle);
}

void Fluctuations::subtract_layers(const BoxState &box, int gradient, int layers) {
  std::vector<int> layer(local_.size());
  std::vector<double> sums(8 * layers + 1, 0.0);  // per layer, as in subtract_means; then grains that no layer holds
  for (std::size_t k = 0; k < local_.size(); k++) {
    const Grain &g = local_[k];
    layer[k] = box.layer(Map<const Vector3d>(lmp_->atom->x[g.index]), gradient, layers);
    if (layer[k] < 0) {
      sums.back() += 1.0;
      continue;
    }
    double *at = &sums[8 * layer[k]];
    Map<Vector3d>(at + 0) += g.mass * g.velocity;
    at[3] += g.mass;
    Map<Vector3d>(at + 4) += g.spin;
    at[7] += 1.0;
  }
  sum_over_ranks(lmp_, sums.data(), sums.size());
  require_layers(lmp_, "flow layers", sums.back());
  for (int k = 0; k < layers; k++) grains_ += sums[8 * k + 7];
  for (std::size_t k = 0; k < local_.size(); k++) {
    const double *at = &sums[8 * layer[k]];
    local_[k].velocity -= Map<const Vector3d>(at + 0) / at[3];
    local_[k].spin -= Map<const Vector3d>(at + 4) / at[7];
  }
}

}
