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
#include <unistd.h>

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

std::string tilted(const std::string &file) {
  return "'" + file +
         "' needs a grid along x, y and z, and this one is tilted: use .vts, or compute field ... frame lab";
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
  for (const std::string &file : files_)
    if (std::count(files_.begin(), files_.end(), file) > 1) arguments.fail("'file' names '" + file + "' twice");
  find_source();
  begin_window();
}

int FixFieldWrite::setmask() { return FixConst::END_OF_STEP; }

/** True when it is another than before. */
bool FixFieldWrite::find_source() {
  const long before = source_number_;
  const int found = modify->find_compute(compute_id_.c_str());
  compute_ = found < 0 ? nullptr : modify->compute[found];
  source_ = dynamic_cast<grainscope::FieldSource *>(compute_);
  if (!source_) Arguments(lmp, name).fail("source", "c_ID of a compute field that is defined", "c_" + compute_id_);
  source_number_ = source_->number();
  return source_number_ != before;
}

void FixFieldWrite::begin_window() {
  taken_ = 0;
  next_ = next_sample(update->ntimestep);
}

/** Samples of another compute, or of steps that were renumbered, do not count. */
void FixFieldWrite::init() {
  if (find_source() || next_ < update->ntimestep) begin_window();
  modify->addstep_compute_all(next_);
}

void FixFieldWrite::reset_timestep(bigint) {
  begin_window();
  modify->addstep_compute_all(next_);
}

/** The first samples may be of the step that the run begins with. */
void FixFieldWrite::setup(int) {
  fail_on_all_ranks(comm->me == 0 ? not_writable() : "");
  end_of_step();
}

/** Why files could not be written, or "". */
std::string FixFieldWrite::not_writable() const {
  for (const std::string &file : files_) {
    if (ends_with(file, ".vti") && domain->triclinic && source_->moves_with_box()) return tilted(file);
    const std::size_t slash = file.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : file.substr(0, slash + 1);
    if (access(folder.c_str(), W_OK | X_OK) != 0) return "cannot write '" + file + "': " + std::strerror(errno);
  }
  return "";
}

bigint FixFieldWrite::next_sample(bigint after) const {
  bigint next = after / frequency_ * frequency_ + frequency_;
  if (next - frequency_ == after && repeats_ == 1) return after;
  next -= (repeats_ - 1) * nevery;
  return next < after ? next + frequency_ : next;
}

void FixFieldWrite::end_of_step() {
  if (update->ntimestep != next_) return;
  if (find_source()) {  // between runs of which the later one was not set up
    begin_window();
    if (update->ntimestep != next_) return;
  }
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
  const bigint at = taken_++;
  if (comm->me != 0) return;
  const FieldSums &now = source_->sums();
  if (at == 0) averaged_.assign(parts, now.zero());
  averaged_[at * parts / repeats_].add(now);
}

FieldTable FixFieldWrite::table() const {
  const grainscope::FieldCells &cells = source_->cells();
  FieldTable table;
  table.cells = cells.numbers();
  table.corner = cells.first_corner();
  table.edges = cells.numbered_edges();
  table.step = update->ntimestep;
  table.time = update->get_cur_time();
  for (const grainscope::NamedOutput &column : dynamic_cast<grainscope::DeclaresOutputs *>(compute_)->outputs().columns)
    table.names.push_back(column.name);
  return table;
}

void FixFieldWrite::write_files() {
  std::string trouble;
  if (comm->me == 0) {
    FieldTable all = table();
    FieldSums sum = averaged_[0];
    for (std::size_t part = 1; part < averaged_.size(); part++) sum.add(averaged_[part]);
    all.values = rows(sum);
    for (const std::string &file : files_)
      if (trouble.empty()) trouble = write(file, all);
  }
  fail_on_all_ranks(trouble);
}

/** Of all cells, with their errors behind them. */
std::vector<double> FixFieldWrite::rows(const FieldSums &all) const {
  std::vector<double> rows;
  for (int cell = 0; cell < all.cells(); cell++)
    for (double value : row_of(cell, all, repeats_)) rows.push_back(value);
  if (blocks_ == 0) return rows;
  const std::vector<double> beside = errors(all, rows);
  std::vector<double> both;
  const std::size_t width = compute_->size_array_cols;
  for (std::size_t first = 0; first < rows.size(); first += width) {
    both.insert(both.end(), rows.begin() + first, rows.begin() + first + width);
    both.insert(both.end(), beside.begin() + first, beside.begin() + first + width);
  }
  return both;
}

std::vector<double> FixFieldWrite::row_of(int cell, const FieldSums &sums, double samples) const {
  const Eigen::Vector3d middle = source_->cells().middle(cell);
  std::vector<double> row(compute_->size_array_cols);
  source_->quantities().write(sums, cell, samples, source_->units(), std::copy_n(middle.data(), 3, row.data()));
  return row;
}

/** The jackknife, of all cells: of the n values without one block each, sqrt((n - 1)/n sum (r - <r>)^2). No number
 *  where fewer than two blocks have what the column is per. */
std::vector<double> FixFieldWrite::errors(const FieldSums &all, const std::vector<double> &rows) const {
  const double n = averaged_.size();
  const std::size_t width = compute_->size_array_cols;
  std::vector<double> shift(rows.size(), 0.0), square(rows.size(), 0.0), filled(rows.size(), 0.0);
  for (const FieldSums &part : averaged_) {
    FieldSums rest = all;
    rest.add(part, -1.0);
    for (int cell = 0; cell < all.cells(); cell++) {
      const std::size_t first = cell * width;
      const std::vector<double> row = row_of(cell, rest, repeats_ * (n - 1.0) / n);
      const std::vector<double> below = source_->quantities().below(part, cell);
      for (std::size_t k = 3; k < width; k++) {
        const double d = row[k] - rows[first + k];
        shift[first + k] += d;
        square[first + k] += d * d;
        filled[first + k] += below[k - 3] > 0.0 ? 1.0 : 0.0;
      }
    }
  }
  std::vector<double> errors(rows.size(), 0.0);
  for (std::size_t k = 0; k < errors.size(); k++) {
    const double spread = std::max(0.0, square[k] - shift[k] * shift[k] / n);
    errors[k] = filled[k] < 2.0 && k % width >= 3 ? std::nan("") : std::sqrt((n - 1.0) / n * spread);
  }
  return errors;
}

/** What went wrong, or "". */
std::string FixFieldWrite::write(const std::string &pattern, const FieldTable &table) const {
  std::string file = pattern;
  for (std::size_t star = file.find('*'); star != std::string::npos; star = file.find('*'))
    file.replace(star, 1, std::to_string(table.step));
  if (ends_with(file, ".vti") && !grainscope::is_orthogonal(table)) return tilted(file);
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << (ends_with(file, ".csv")   ? grainscope::field_csv(table)
          : ends_with(file, ".vti") ? grainscope::field_vti(table)
                                    : grainscope::field_vts(table));
  out.close();
  return out ? "" : "cannot write '" + file + "': " + std::strerror(errno);
}

/** Of rank 0. Collective. */
void FixFieldWrite::fail_on_all_ranks(std::string trouble) const {
  int size = static_cast<int>(trouble.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, world);
  if (size == 0) return;
  trouble.resize(size);
  MPI_Bcast(&trouble[0], size, MPI_CHAR, 0, world);
  Arguments(lmp, name).fail(trouble);
}

double FixFieldWrite::memory_usage() {
  double bytes = 0.0;
  for (FieldSums &part : averaged_) bytes += sizeof(double) * part.numbers().capacity();
  return bytes;
}
