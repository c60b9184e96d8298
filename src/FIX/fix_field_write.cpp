// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_field_write.h"
#include "arguments.h"
#include "field_file.h"
#include "outputs.h"
#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "modify.h"
#include "update.h"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

using namespace LAMMPS_NS;
using grainscope::Arguments;
using grainscope::FieldSums;
using grainscope::FieldTable;

namespace {

const char *const name = "fix field/write";
const int most_steps = 2000000000;

bool ends_with(const std::string &text, const std::string &end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}

FixFieldWrite::FixFieldWrite(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  Arguments arguments(lmp, name, 3, narg, arg);
  nevery = arguments.whole_number("N_every", 1, most_steps);
  repeats_ = arguments.whole_number("N_repeat", 1, most_steps);
  frequency_ = arguments.whole_number("N_freq", 1, most_steps);
  if (frequency_ % nevery != 0 || (repeats_ - 1) * nevery >= frequency_)
    arguments.fail("N_freq", "a multiple of N_every, and more than (N_repeat - 1) N_every",
                   std::to_string(nevery) + " " + std::to_string(repeats_) + " " + std::to_string(frequency_));
  const std::string of = "c_ID, a compute field";
  compute_id_ = arguments.word(of);
  if (compute_id_.compare(0, 2, "c_") != 0 || compute_id_.size() == 2) arguments.fail("source", of, compute_id_);
  compute_id_.erase(0, 2);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"file", "blocks"});
    if (keyword == "file") files_ = arguments.words_before({"file", "blocks"}, "names of files");
    else blocks_ = arguments.whole_number(keyword, 2, 1000);
  }
  if (files_.empty()) arguments.fail("needs 'file name ...'");
  for (const std::string &file : files_)
    if (!ends_with(file, ".csv") && !ends_with(file, ".vti") && !ends_with(file, ".vts"))
      arguments.fail("file", "a name that ends with .csv, .vti or .vts", file);
  if (blocks_ > 0 && repeats_ % blocks_ != 0)
    arguments.fail("blocks", "a divisor of N_repeat, " + std::to_string(repeats_), std::to_string(blocks_));
  find_source();
  next_ = next_sample(update->ntimestep);
  modify->addstep_compute_all(next_);
}

int FixFieldWrite::setmask() { return FixConst::END_OF_STEP; }

void FixFieldWrite::find_source() {
  const int found = modify->find_compute(compute_id_.c_str());
  compute_ = found < 0 ? nullptr : modify->compute[found];
  source_ = dynamic_cast<grainscope::FieldSource *>(compute_);
  if (!source_) Arguments(lmp, name).fail("source", "c_ID of a compute field", "c_" + compute_id_);
}

void FixFieldWrite::init() {
  find_source();
  if (next_ < update->ntimestep) {  // steps were renumbered: begin again
    taken_ = 0;
    next_ = next_sample(update->ntimestep);
    modify->addstep_compute_all(next_);
  }
}

/** As fix ave/time does; the first samples may be of the step that the run begins with. */
void FixFieldWrite::setup(int) {
  const bool tilted =
      std::any_of(files_.begin(), files_.end(), [](const std::string &f) { return ends_with(f, ".vti"); });
  if (tilted && domain->triclinic && !grainscope::is_orthogonal(table()))
    Arguments(lmp, name).fail("a file .vti has a grid along x, y and z, and this one is tilted: .vts, or compute field "
                              "... frame lab");
  end_of_step();
}

bigint FixFieldWrite::next_sample(bigint after) const {
  bigint next = after / frequency_ * frequency_ + frequency_;
  if (next - frequency_ == after && repeats_ == 1) return after;
  next -= (repeats_ - 1) * nevery;
  return next < after ? next + frequency_ : next;
}

void FixFieldWrite::end_of_step() {
  if (update->ntimestep != next_) return;
  modify->clearstep_compute();
  if (!(compute_->invoked_flag & INVOKED_ARRAY)) {
    compute_->compute_array();
    compute_->invoked_flag |= INVOKED_ARRAY;
  }
  add_sample();
  next_ += nevery;
  if (taken_ == repeats_) {
    write_files();
    taken_ = 0;
    next_ = update->ntimestep + frequency_ - (repeats_ - 1) * nevery;
  }
  modify->addstep_compute(next_);
}

void FixFieldWrite::add_sample() {
  const std::size_t parts = std::max(1, blocks_);
  const FieldSums &now = source_->sums();
  if (taken_ == 0) averaged_.assign(parts, now.zero());
  averaged_[taken_ * parts / repeats_].add(now);
  taken_++;
}

FieldTable FixFieldWrite::table() const {
  const grainscope::FieldCells &cells = source_->cells();
  FieldTable table;
  table.cells = cells.numbers();
  table.corner = cells.first_corner();
  table.edges = cells.numbered_edges();
  table.step = update->ntimestep;
  table.time = update->get_cur_time();
  return table;
}

void FixFieldWrite::write_files() {
  std::string trouble;
  if (comm->me == 0) {
    FieldTable all = table();
    for (const grainscope::NamedOutput &column :
         dynamic_cast<grainscope::DeclaresOutputs *>(compute_)->outputs().columns)
      all.names.push_back(column.name);
    const std::size_t width = all.names.size(), parts = averaged_.size();
    FieldSums sum = averaged_[0].zero();
    for (const FieldSums &part : averaged_) sum.add(part);
    const grainscope::FieldUnits units = source_->units();
    std::vector<double> row(width), of_part(width), square(width);
    for (int cell = 0; cell < sum.cells(); cell++) {
      const Eigen::Vector3d middle = source_->cells().middle(cell);
      const auto write_row = [&](const FieldSums &sums, double samples, std::vector<double> &to) {
        std::copy_n(middle.data(), 3, to.begin());
        source_->quantities().write(sums, cell, samples, units, to.data() + 3);
      };
      write_row(sum, repeats_, row);
      all.values.insert(all.values.end(), row.begin(), row.end());
      if (parts == 1) continue;
      std::vector<double> mean(width, 0.0);
      std::fill(square.begin(), square.end(), 0.0);
      for (const FieldSums &part : averaged_) {
        write_row(part, static_cast<double>(repeats_) / parts, of_part);
        for (std::size_t k = 0; k < width; k++) {
          mean[k] += of_part[k] / parts;
          square[k] += (of_part[k] - row[k]) * (of_part[k] - row[k]);
        }
      }
      for (std::size_t k = 0; k < width; k++) {
        const double shift = mean[k] - row[k], spread = std::max(0.0, square[k] - parts * shift * shift);
        all.values.push_back(std::sqrt(spread / (parts * (parts - 1.0))));
      }
    }
    for (const std::string &file : files_)
      if (trouble.empty()) trouble = write(file, all);
  }
  int failed = trouble.empty() ? 0 : 1;
  MPI_Bcast(&failed, 1, MPI_INT, 0, world);
  if (!failed) return;
  int size = static_cast<int>(trouble.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, world);
  trouble.resize(size);
  MPI_Bcast(&trouble[0], size, MPI_CHAR, 0, world);
  Arguments(lmp, name).fail(trouble);
}

/** What went wrong, or "". */
std::string FixFieldWrite::write(const std::string &pattern, const FieldTable &table) const {
  std::string file = pattern;
  const std::size_t star = file.find('*');
  if (star != std::string::npos) file.replace(star, 1, std::to_string(table.step));
  if (ends_with(file, ".vti") && !grainscope::is_orthogonal(table))
    return "'" + file + "' has a grid along x, y and z, and this one is tilted: .vts, or compute field ... frame lab";
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << (ends_with(file, ".csv")   ? grainscope::field_csv(table)
          : ends_with(file, ".vti") ? grainscope::field_vti(table)
                                    : grainscope::field_vts(table));
  out.close();
  return out ? "" : "cannot write '" + file + "': " + std::strerror(errno);
}
