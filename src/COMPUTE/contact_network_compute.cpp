// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_network_compute.h"
#include "contact.h"
#include "contact_network.h"
#include "contact_observer.h"
#include "atom.h"
#include "comm.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

ContactNetworkCompute::ContactNetworkCompute(LAMMPS_NS::LAMMPS *lmp, int &iarg, int narg, char **arg, unsigned keywords)
    : ContactCompute(lmp, iarg, narg, arg, keywords) {
  comm_forward = comm_reverse = 1;
}

/** The lower ID keeps it; between two images of one grain, the one whose partner lies toward the positive side. */
bool ContactNetworkCompute::is_mine(const Contact &c) const {
  if (!c.ghost()) return true;
  const int j = c.j();
  if (atom->tag[c.i] != atom->tag[j]) return atom->tag[c.i] < atom->tag[j];
  const double *shift = observer_->image_shift(j);
  for (int k = 0; k < 3; k++) {
    if (shift[k] != 0.0) return shift[k] > 0.0;
  }
  return false;
}

ContactNetworkCompute::Link ContactNetworkCompute::link(const Contact &c) { return {c.i, c.with_wall() ? -1 : c.j()}; }

int ContactNetworkCompute::number_of(int i) const {
  const Body *const body = bodies().of(i);
  return body ? local_and_ghosts() + body->tag : i;
}

int ContactNetworkCompute::numbers_of_grains() const {
  int tags = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (const Body *const body = bodies().of(i)) tags = std::max(tags, body->tag + 1);
  MPI_Allreduce(MPI_IN_PLACE, &tags, 1, MPI_INT, MPI_MAX, world);
  return local_and_ghosts() + tags;
}

/** Each rank knows the links that it keeps. The lowest numbers of their sets go from ghosts to owners, from owners to
 *  ghosts and, for clumps, to all ranks, until no rank finds a lower one. */
std::vector<double> ContactNetworkCompute::clusters(const std::vector<Link> &links) {
  const auto id = [this](int i) { return bodies().of(i) ? bodies().of(i)->first_id : atom->tag[i]; };
  const int numbers = numbers_of_grains(), clumps = numbers - local_and_ghosts();
  ConnectedSets sets(numbers);
  std::vector<double> lowest(numbers, HUGE_VAL);
  for (const Link &one : links) {
    lowest[number_of(one.i)] = id(one.i);
    if (one.j < 0) continue;
    lowest[number_of(one.j)] = id(one.j);
    sets.join(number_of(one.i), number_of(one.j));
  }
  sets.spread_lowest(lowest);
  do {
    lowest_to_owners(lowest);
    owners_to_ghosts(lowest);
    MPI_Allreduce(MPI_IN_PLACE, lowest.data() + local_and_ghosts(), clumps, MPI_DOUBLE, MPI_MIN, world);
  } while (on_any_rank(sets.spread_lowest(lowest)));
  std::replace(lowest.begin(), lowest.end(), HUGE_VAL, 0.0);
  return lowest;
}

int ContactNetworkCompute::local_and_ghosts() const { return atom->nlocal + atom->nghost; }

bool ContactNetworkCompute::on_any_rank(bool mine) const {
  int any = mine;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

void ContactNetworkCompute::owners_to_ghosts(std::vector<double> &numbers) {
  exchanged_ = numbers.data();
  comm->forward_comm_compute(this);
}

void ContactNetworkCompute::lowest_to_owners(std::vector<double> &numbers) {
  exchanged_ = numbers.data();
  comm->reverse_comm_compute(this);
}

int ContactNetworkCompute::pack_comm(int n, int *list, double *buf, int, int *) {
  for (int k = 0; k < n; k++) buf[k] = exchanged_[list[k]];
  return 1;
}

void ContactNetworkCompute::unpack_comm(int n, int first, double *buf) { std::copy_n(buf, n, exchanged_ + first); }

int ContactNetworkCompute::pack_reverse_comm(int n, int first, double *buf) {
  std::copy_n(exchanged_ + first, n, buf);
  return 1;
}

void ContactNetworkCompute::unpack_reverse_comm(int n, int *list, double *buf) {
  for (int k = 0; k < n; k++) exchanged_[list[k]] = std::min(exchanged_[list[k]], buf[k]);
}

}
