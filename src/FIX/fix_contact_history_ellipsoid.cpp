// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_contact_history_ellipsoid.h"
#include "checksum.h"
#include "superquadric_columns.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using grainscope::SuperquadricColumns;

int FixContactHistoryEllipsoid::more() const {
  return dnum_ > 0 && !strcmp(history_id_[0], SuperquadricColumns::kept) ? SuperquadricColumns::left_out : 0;
}

/** In [2^-24, 1): by the names of the columns that are not the surface's. */
double FixContactHistoryEllipsoid::mark() const {
  const bool whole = dnum_ > 0 && !strcmp(history_id_[0], SuperquadricColumns::first);
  std::string names;
  for (int k = whole ? SuperquadricColumns::count : more() > 0 ? 1 : 0; k < dnum_; k++)
    names += std::string(history_id_[k]) + ' ';
  const std::uint64_t marks = 1u << 24;
  return static_cast<double>(grainscope::checksum(names.data(), names.size()) % (marks - 1) + 1) / marks;
}

/** LIGGGHTS reads only the first number. The second ends with the mark of the columns; files of LIGGGHTS and of earlier
 *  versions of grainscope have no mark. */
void FixContactHistoryEllipsoid::write_restart(FILE *file) {
  if (comm->me != 0) return;
  const double state[] = {static_cast<double>(dnum_ + more()), maxtouch_ + mark()};
  const int size = sizeof state;
  fwrite(&size, sizeof size, 1, file);
  fwrite(state, sizeof state, 1, file);
}

void FixContactHistoryEllipsoid::restart(char *buffer) {
  double state[2];
  memcpy(state, buffer, sizeof state);
  state[0] -= more();
  FixContactHistory::restart(reinterpret_cast<char *>(state));
  const double marked = state[1] - std::floor(state[1]);
  if (marked != 0.0 && marked != mark())
    error->all(FLERR, ("the restart file holds " + std::to_string(dnum_ + more()) +
                       " numbers per contact, as many as this pair_style, but with other meanings: use the contact "
                       "models, 'ledger' and 'time_level' that it was written with")
                          .c_str());
}

int FixContactHistoryEllipsoid::size_restart(int i) {
  return FixContactHistory::size_restart(i) + more() * npartner_[i];
}

int FixContactHistoryEllipsoid::maxsize_restart() {
  int most = 0;
  MPI_Allreduce(&maxtouch_, &most, 1, MPI_INT, MPI_MAX, world);
  return FixContactHistory::maxsize_restart() + more() * most;
}

/** Size, number of partners; of each partner its ID and columns. */
int FixContactHistoryEllipsoid::pack_restart(int i, double *buffer) {
  FixContactHistory::pack_restart(i, buffer);
  const int stored = dnum_ + 1;
  for (int n = npartner_[i] - 1; n >= 0; n--) {
    const double *const from = buffer + 2 + n * stored;
    double *const to = buffer + 2 + n * (stored + more());
    std::copy_backward(from + 1, from + stored, to + stored + more());
    to[0] = from[0];
    std::fill_n(to + 1, more(), 0.0);
  }
  buffer[0] = size_restart(i);
  return size_restart(i);
}

void FixContactHistoryEllipsoid::unpack_restart(int i, int nth) {
  if (!ipage_) allocate_pages();
  const double *from = atom->extra[i];
  for (int k = 0; k < nth; k++) from += static_cast<int>(*from);
  from++;
  const int partners = ubuf(*from).i;
  std::vector<double> exchanged = {*from++};  // as between ranks
  for (int n = 0; n < partners; n++) {
    exchanged.push_back(*from);
    from += 1 + more();
    exchanged.insert(exchanged.end(), from, from + dnum_);
    from += dnum_;
  }
  unpack_exchange(i, exchanged.data());
}
