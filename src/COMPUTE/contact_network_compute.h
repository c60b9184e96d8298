// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_NETWORK_COMPUTE_H
#define GRAINSCOPE_CONTACT_NETWORK_COMPUTE_H

#include "contact_compute.h"
#include <utility>
#include <vector>

namespace grainscope {

/** A compute that follows contacts from grain to grain, over ranks too. Its numbers of grains, local grains and then
 *  ghosts, are those of the evaluation: use them before it ends, in end_contacts. */
class ContactNetworkCompute : public ContactCompute {
 public:
  ContactNetworkCompute(LAMMPS_NS::LAMMPS *lmp, int &iarg, int narg, char **arg, unsigned keywords);

  bool needs_images() const override { return true; }

  int pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc) override;
  void unpack_comm(int n, int first, double *buf) override;
  int pack_reverse_comm(int n, int first, double *buf) override;
  void unpack_reverse_comm(int n, int *list, double *buf) override;

 protected:
  /** Selects one of the two owners of a contact, so that each contact is kept once over all ranks. */
  bool is_mine(const Contact &contact) const;
  /** A contact that is kept: grains i and j, j < 0 for a wall. */
  struct Link {
    int i, j;
  };
  static Link link(const Contact &contact);
  /** Number of the grain that local grain or ghost i is, or as a sphere of a clump is part of: local grains, ghosts,
   *  then clumps, alike on all ranks. */
  int number_of(int i) const;
  /** How many numbers there are. Collective. */
  int numbers_of_grains() const;
  /** By these numbers: the lowest ID in the set of grains that `links` connect, 0 where none ends; a clump has the
   *  lowest ID of its spheres. A wall connects no grains. Collective. */
  std::vector<double> clusters(const std::vector<Link> &links);
  int local_and_ghosts() const;
  /** From the owners of grains to their ghosts. Collective. */
  void owners_to_ghosts(std::vector<double> &numbers);
  /** True when `mine` is on any rank. Collective. */
  bool on_any_rank(bool mine) const;

 private:
  double *exchanged_ = nullptr;

  void lowest_to_owners(std::vector<double> &numbers);
};

}

#endif
