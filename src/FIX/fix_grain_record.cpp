// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_grain_record.h"
#include "checksum.h"
#include "restart_numbers.h"
#include "restart_state.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;

namespace {

// The buffers in which LIGGGHTS sends grains to other ranks have room for 1000 numbers beyond their size.
const int most_numbers = 800;

const grainscope::ComputeFix record{"grain/record", "_record", "memory", "holds the memory"};

/** In restart files, with the shared numbers behind it. */
struct SavedRecord {
  static constexpr std::uint32_t version = 2;
  double meaning, flips[3], shared_numbers;
  grainscope::PassedTime::State time;
};

}

FixGrainRecord::FixGrainRecord(LAMMPS *lmp, int narg, char **arg)
    : InternalFix(lmp, narg, arg, "the computes that need it"), time_(update->ntimestep, update->dt) {
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
  time_.renumber(now, before);
  if (step_at_ < 0) return;
  double &step = shared_[step_at_];
  step = step == before ? now : -1.0;
}

void FixGrainRecord::setup_pre_force(int) {
  time_.set_length(update->dt, update->ntimestep);
  note_box();
}

void FixGrainRecord::pre_force(int) {
  time_.set_length(update->dt, update->ntimestep - 1);
  note_box();
}

double FixGrainRecord::passed_time() const { return time_.at(update->ntimestep); }

/** Where a tilt changes by more than half an edge between two force evaluations, the box was flipped. */
void FixGrainRecord::note_box() {
  const double *h = domain->h;
  const double yz = std::round((h[3] - edges_[3]) / h[1]);
  flips_[0] += yz;
  flips_[1] += std::round((h[4] - edges_[4] - yz * h[5]) / h[0]);
  flips_[2] += std::round((h[5] - edges_[5]) / h[0]);
  std::copy(h, h + 6, edges_);
}

void FixGrainRecord::take_box_flips(double flips[3]) {
  std::copy(flips_, flips_ + 3, flips);
  std::fill(flips_, flips_ + 3, 0.0);
}

void FixGrainRecord::note_changed_box() {
  std::copy(domain->h, domain->h + 6, edges_);
  std::fill(flips_, flips_ + 3, 0.0);
}

FixGrainRecord *FixGrainRecord::make(LAMMPS *lmp, const char *id, int igroup, int width, int shared,
                                     const std::string &meaning, int step_at) {
  FixGrainRecord *made = static_cast<FixGrainRecord *>(record.make(
      lmp, id, igroup,
      {std::to_string(width), std::to_string(shared), std::to_string(grainscope::checksum_as_double(meaning))}));
  made->step_at_ = step_at;
  made->require_room();
  return made;
}

FixGrainRecord *FixGrainRecord::find(LAMMPS *lmp, const char *id) {
  return static_cast<FixGrainRecord *>(record.find(lmp, id));
}

void FixGrainRecord::forget(LAMMPS *lmp, const char *id) { record.remove(lmp, id); }

void FixGrainRecord::require_room() const {
  int numbers = 0;
  for (int k = 0; k < modify->nfix; k++)
    if (const FixGrainRecord *one = dynamic_cast<const FixGrainRecord *>(modify->fix[k])) numbers += one->width_;
  if (numbers > most_numbers)
    error->all(FLERR, ("all computes together must remember at most " + std::to_string(most_numbers) +
                       " numbers per grain, got " + std::to_string(numbers) + ": use fewer 'lags'")
                          .c_str());
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
                       " numbers of each grain")
                          .c_str());
  std::copy(numbers, numbers + width_, of(i));
}

void FixGrainRecord::write_restart(FILE *file) {
  if (comm->me != 0) return;
  const SavedRecord saved{
      meaning_, {flips_[0], flips_[1], flips_[2]}, static_cast<double>(shared_.size()), time_.state(update->ntimestep)};
  grainscope::write_state(file, saved, shared_.data(), shared_.size() * sizeof(double));
}

/** A record with another meaning may have another number of numbers, too. */
void FixGrainRecord::restart(char *buffer) {
  const SavedRecord saved = grainscope::read_state<SavedRecord>(lmp, *this, style, buffer);
  if (saved.meaning != meaning_ || saved.shared_numbers != shared_.size()) {
    const std::string message =
        std::string(id) +
        ": the restart file holds the memory of another compute: give the compute the style, group and "
        "keywords that it had, or another ID";
    error->all(FLERR, message.c_str());
  }
  time_.restore(saved.time, update->ntimestep);
  std::copy(saved.flips, saved.flips + 3, flips_);
  memcpy(shared_.data(), grainscope::state_block::tail(buffer), shared_.size() * sizeof(double));
}
