// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_grain_record.h"
#include "checksum.h"
#include "restart_numbers.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;

namespace {

// The host's buffers for grains that change ranks have room for 1000 numbers beyond what they are sized for.
const int most_numbers = 800;

// A line of an input script would replace the memory of a compute behind its back.
bool making = false;

}

FixGrainRecord::FixGrainRecord(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (!making) error->all(FLERR, "fix grain/record: is made by the computes that need it, not by an input script");
  width_ = atoi(arg[3]);
  shared_.assign(atoi(arg[4]), 0.0);
  meaning_ = atof(arg[5]);
  restart_global = restart_peratom = create_attribute = 1;
  std::copy(domain->h, domain->h + 6, edges_);
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixGrainRecord::~FixGrainRecord() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

int FixGrainRecord::setmask() { return FixConst::PRE_FORCE; }

void FixGrainRecord::reset_timestep(bigint now, bigint before) {
  if (step_at_ < 0) return;
  double &step = shared_[step_at_];
  step = step == before ? now : -1.0;
}

/** A tilt that changes by more than half an edge between two force evaluations was turned back. */
void FixGrainRecord::note_box() {
  const double *h = domain->h;
  const double yz = std::round((h[3] - edges_[3]) / h[1]);
  turns_[0] += yz;
  turns_[1] += std::round((h[4] - edges_[4] - yz * h[5]) / h[0]);
  turns_[2] += std::round((h[5] - edges_[5]) / h[0]);
  std::copy(h, h + 6, edges_);
}

void FixGrainRecord::take_turns(double turns[3]) {
  std::copy(turns_, turns_ + 3, turns);
  std::fill(turns_, turns_ + 3, 0.0);
}

void FixGrainRecord::take_box() {
  std::copy(domain->h, domain->h + 6, edges_);
  std::fill(turns_, turns_ + 3, 0.0);
}

std::string FixGrainRecord::id_for(const char *compute) { return std::string(compute) + "_record"; }

FixGrainRecord *FixGrainRecord::make(LAMMPS *lmp, const char *id, int igroup, int width, int shared, const std::string &meaning, int step_at) {
  const std::string record = id_for(id);
  if (lmp->modify->find_fix(record.c_str()) >= 0)
    lmp->error->all(FLERR, ("compute " + std::string(id) + " needs the fix ID '" + record + "' for its memory, but it is taken").c_str());
  const std::string words[6] = {record, lmp->group->names[igroup], "grain/record", std::to_string(width), std::to_string(shared),
                                std::to_string(grainscope::checksum_as_double(meaning))};
  char *arg[6];
  for (int k = 0; k < 6; k++) arg[k] = const_cast<char *>(words[k].c_str());
  making = true;
  lmp->modify->add_fix(6, arg);
  making = false;
  FixGrainRecord *made = find(lmp, id);
  made->step_at_ = step_at;
  made->require_room();
  return made;
}

FixGrainRecord *FixGrainRecord::find(LAMMPS *lmp, const char *id) {
  const std::string record = id_for(id);
  const int found = lmp->modify->find_fix(record.c_str());
  FixGrainRecord *fix = found < 0 ? nullptr : dynamic_cast<FixGrainRecord *>(lmp->modify->fix[found]);
  if (!fix)
    lmp->error->all(FLERR, ("fix " + record + ", which holds the memory of compute " + id + ", is gone: uncompute it and compute again").c_str());
  return fix;
}

void FixGrainRecord::require_room() const {
  int numbers = 0;
  for (int k = 0; k < modify->nfix; k++)
    if (const FixGrainRecord *one = dynamic_cast<const FixGrainRecord *>(modify->fix[k])) numbers += one->width_;
  if (numbers > most_numbers)
    error->all(FLERR, ("all computes together must remember at most " + std::to_string(most_numbers) + " numbers per grain, got " +
                       std::to_string(numbers) + ": take fewer 'lags'").c_str());
}

void FixGrainRecord::forget(LAMMPS *lmp, const char *compute) {
  const std::string id = id_for(compute);
  const int found = lmp->modify->nfix ? lmp->modify->find_fix(id.c_str()) : -1;
  if (found >= 0 && dynamic_cast<FixGrainRecord *>(lmp->modify->fix[found])) lmp->modify->delete_fix(id.c_str());
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
  const double *numbers = grainscope::restart_numbers(atom, i, nth, width_);
  if (!numbers)
    error->one(FLERR, (std::string(id) + ": the restart file does not hold the " + std::to_string(width_) +
                       " numbers of each grain").c_str());
  std::copy(numbers, numbers + width_, of(i));
}

void FixGrainRecord::write_restart(FILE *file) {
  if (comm->me != 0) return;
  std::vector<double> state = {meaning_, turns_[0], turns_[1], turns_[2]};
  state.insert(state.end(), shared_.begin(), shared_.end());
  const int size = state.size() * sizeof(double);
  fwrite(&size, sizeof size, 1, file);
  fwrite(state.data(), 1, size, file);
}

/** The host does not tell how many numbers there are; the first says whether they are those of the same measurement. */
void FixGrainRecord::restart(char *buffer) {
  double head[4];
  memcpy(head, buffer, sizeof head);
  if (head[0] != meaning_) {
    const std::string message = std::string(id) + ": the restart file holds the memory of another compute: give the compute the style, group and "
                                "keywords that it had, or another ID";
    error->all(FLERR, message.c_str());
  }
  std::copy(head + 1, head + 4, turns_);
  memcpy(shared_.data(), buffer + sizeof head, shared_.size() * sizeof(double));
}
