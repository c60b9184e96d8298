// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FOUR_ROWS_H
#define GRAINSCOPE_FOUR_ROWS_H

#include "four.h"

/** Rows of an array, one for each grain, with Real = double one row, with Real = Four the four that begin there; as
 *  columns: one Real for each component. */
namespace grainscope {

template <class Real>
constexpr int ROWS = sizeof(Real) / sizeof(double);

/** One number for each row. */
template <class Real>
GRAINSCOPE_INLINE Real read_ones(const double *rows) {
  Real column;
  std::memcpy(&column, rows, sizeof column);
  return column;
}

template <class Real>
GRAINSCOPE_INLINE void write_ones(Real column, double *rows) {
  std::memcpy(rows, &column, sizeof column);
}

/** Of the numbers of a (0 to 3) and b (4 to 7) those four. */
template <int i, int j, int k, int l>
GRAINSCOPE_INLINE Four choose(Four a, Four b) {
#ifdef __clang__
  return __builtin_shufflevector(a, b, i, j, k, l);
#else
  return __builtin_shuffle(a, b, FourMask{i, j, k, l});
#endif
}

GRAINSCOPE_INLINE void transpose(const Four from[4], Four to[4]) {
  const Four a = choose<0, 4, 2, 6>(from[0], from[1]), b = choose<1, 5, 3, 7>(from[0], from[1]),
             c = choose<0, 4, 2, 6>(from[2], from[3]), d = choose<1, 5, 3, 7>(from[2], from[3]);
  to[0] = choose<0, 1, 4, 5>(a, c);
  to[1] = choose<0, 1, 4, 5>(b, d);
  to[2] = choose<2, 3, 6, 7>(a, c);
  to[3] = choose<2, 3, 6, 7>(b, d);
}

GRAINSCOPE_INLINE void read_threes(const double *rows, double columns[3]) {
  for (int n = 0; n < 3; n++) columns[n] = rows[n];
}
GRAINSCOPE_INLINE void read_threes(const double *rows, Four columns[3]) {
  const Four a = four_at(rows), b = four_at(rows + 4), c = four_at(rows + 8);  // x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3
  const Four xy = choose<0, 1, 6, 7>(a, b), zx = choose<2, 3, 4, 5>(a, c), yz = choose<0, 1, 6, 7>(b, c);
  columns[0] = choose<0, 5, 2, 7>(xy, zx);
  columns[1] = choose<1, 4, 3, 6>(xy, yz);
  columns[2] = choose<0, 5, 2, 7>(zx, yz);
}
GRAINSCOPE_INLINE void write_threes(const double columns[3], double *rows) {
  for (int n = 0; n < 3; n++) rows[n] = columns[n];
}
GRAINSCOPE_INLINE void write_threes(const Four columns[3], double *rows) {
  const Four xy = choose<0, 4, 2, 6>(columns[0], columns[1]), zx = choose<0, 5, 2, 7>(columns[2], columns[0]),
             yz = choose<1, 5, 3, 7>(columns[1], columns[2]);
  put(choose<0, 1, 4, 5>(xy, zx), rows);
  put(choose<0, 1, 6, 7>(yz, xy), rows + 4);
  put(choose<2, 3, 6, 7>(zx, yz), rows + 8);
}

GRAINSCOPE_INLINE void read_fours(const double *rows, double columns[4]) {
  for (int n = 0; n < 4; n++) columns[n] = rows[n];
}
GRAINSCOPE_INLINE void read_fours(const double *rows, Four columns[4]) {
  const Four read[4] = {four_at(rows), four_at(rows + 4), four_at(rows + 8), four_at(rows + 12)};
  transpose(read, columns);
}
GRAINSCOPE_INLINE void write_fours(const double columns[4], double *rows) {
  for (int n = 0; n < 4; n++) rows[n] = columns[n];
}
GRAINSCOPE_INLINE void write_fours(const Four columns[4], double *rows) {
  Four written[4];
  transpose(columns, written);
  put(written[0], rows);
  put(written[1], rows + 4);
  put(written[2], rows + 8);
  put(written[3], rows + 12);
}

/** rows += factor more. */
template <class Real>
GRAINSCOPE_INLINE void add_threes(double factor, const double *more, double *rows) {
  for (int n = 0; n < 3 * ROWS<Real>; n += ROWS<Real>)
    write_ones(read_ones<Real>(rows + n) + factor * read_ones<Real>(more + n), rows + n);
}
/** Likewise, with a factor for each row. */
GRAINSCOPE_INLINE void add_scaled_threes(double factor, const double *more, double *rows) {
  add_threes<double>(factor, more, rows);
}
GRAINSCOPE_INLINE void add_scaled_threes(Four factors, const double *more, double *rows) {
  add_to(rows, choose<0, 0, 0, 1>(factors, factors) * four_at(more));
  add_to(rows + 4, choose<1, 1, 2, 2>(factors, factors) * four_at(more + 4));
  add_to(rows + 8, choose<2, 3, 3, 3>(factors, factors) * four_at(more + 8));
}

}

#endif
