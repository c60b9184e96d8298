// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_grain_record.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include <algorithm>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;

FixGrainRecord::FixGrainRecord(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (narg != 5) error->all(FLERR, "fix grain/record: is made by the computes that need it, not by an input script");
  width_ = atoi(arg[3]);
  shared_.assign(atoi(arg[4]), 0.0);
  restart_global = restart_peratom = 1;
  note_box();
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixGrainRecord::~FixGrainRecord() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

int FixGrainRecord::setmask() { return FixConst::PRE_FORCE; }

void FixGrainRecord::note_box() { std::copy(domain->h, domain->h + 6, edges_); }

std::string FixGrainRecord::id_for(const char *compute) { return std::string(compute) + "_record"; }

FixGrainRecord *FixGrainRecord::of_compute(LAMMPS *lmp, const char *compute, int igroup, int width, int shared) {
  const std::string words[5] = {id_for(compute), lmp->group->names[igroup], "grain/record", std::to_string(width), std::to_string(shared)};
  if (lmp->modify->find_fix(words[0].c_str()) < 0) {
    char *arg[5];
    for (int k = 0; k < 5; k++) arg[k] = const_cast<char *>(words[k].c_str());
    lmp->modify->add_fix(5, arg);
  }
  return dynamic_cast<FixGrainRecord *>(lmp->modify->fix[lmp->modify->find_fix(words[0].c_str())]);
}

void FixGrainRecord::forget(LAMMPS *lmp, const char *compute) {
  const std::string id = id_for(compute);
  if (lmp->modify->nfix && lmp->modify->find_fix(id.c_str()) >= 0) lmp->modify->delete_fix(id.c_str());
}

double FixGrainRecord::memory_usage() { return (values_.capacity() + shared_.capacity()) * sizeof(double); }

void FixGrainRecord::grow_arrays(int nmax) { values_.resize(static_cast<std::size_t>(nmax) * width_, 0.0); }

void FixGrainRecord::copy_arrays(int from, int to, int) { std::copy(of(from), of(from) + width_, of(to)); }

void FixGrainRecord::set_arrays(int i) { std::fill(of(i), of(i) + width_, 0.0); }

int FixGrainRecord::pack_exchange(int i, double *buffer) {
  std::copy(of(i), of(i) + width_, buffer);
  return width_;
}

int FixGrainRecord::unpack_exchange(int i, double *buffer) {
  std::copy(buffer, buffer + width_, of(i));
  return width_;
}

int FixGrainRecord::pack_restart(int i, double *buffer) {
  buffer[0] = width_ + 1;
  std::copy(of(i), of(i) + width_, buffer + 1);
  return width_ + 1;
}

void FixGrainRecord::unpack_restart(int i, int nth) {
  const double *extra = atom->extra[i];
  for (int k = 0; k < nth; k++) extra += static_cast<int>(extra[0]);
  std::copy(extra + 1, extra + 1 + width_, of(i));
}

/** The host hands the numbers over without their count: it goes first. */
void FixGrainRecord::write_restart(FILE *file) {
  if (comm->me != 0) return;
  std::vector<double> state(1, shared_.size());
  state.insert(state.end(), shared_.begin(), shared_.end());
  const int size = state.size() * sizeof(double);
  fwrite(&size, sizeof size, 1, file);
  fwrite(state.data(), 1, size, file);
}

void FixGrainRecord::restart(char *buffer) {
  double count;
  memcpy(&count, buffer, sizeof count);
  require_size(static_cast<int>(count), shared_.size());
  memcpy(shared_.data(), buffer + sizeof count, shared_.size() * sizeof(double));
}

void FixGrainRecord::require_size(int found, int expected) const {
  if (found == expected) return;
  const std::string message = "the restart file holds " + std::to_string(found) + " numbers for " + id + ", but its compute needs " +
      std::to_string(expected) + ": give the compute the style and keywords that it had, or another ID";
  error->all(FLERR, message.c_str());
}
