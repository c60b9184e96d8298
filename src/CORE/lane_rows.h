// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LANE_ROWS_H
#define GRAINSCOPE_LANE_ROWS_H

#include "lane_vectors.h"

/** Rows of an array, one for each grain, with Real = double one row, with Real = Lanes the four that begin there; as
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

GRAINSCOPE_INLINE void read_threes(const double *rows, double columns[3]) {
  for (int n = 0; n < 3; n++) columns[n] = rows[n];
}
GRAINSCOPE_INLINE void read_threes(const double *rows, Lanes columns[3]) {
  const Lanes a = load(rows), b = load(rows + 4), c = load(rows + 8);  // x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3
  const Lanes xy = __builtin_shufflevector(a, b, 0, 1, 6, 7), zx = __builtin_shufflevector(a, c, 2, 3, 4, 5),
              yz = __builtin_shufflevector(b, c, 0, 1, 6, 7);
  columns[0] = __builtin_shufflevector(xy, zx, 0, 5, 2, 7);
  columns[1] = __builtin_shufflevector(xy, yz, 1, 4, 3, 6);
  columns[2] = __builtin_shufflevector(zx, yz, 0, 5, 2, 7);
}
GRAINSCOPE_INLINE void write_threes(const double columns[3], double *rows) {
  for (int n = 0; n < 3; n++) rows[n] = columns[n];
}
GRAINSCOPE_INLINE void write_threes(const Lanes columns[3], double *rows) {
  const Lanes xy = __builtin_shufflevector(columns[0], columns[1], 0, 4, 2, 6),
              zx = __builtin_shufflevector(columns[2], columns[0], 0, 5, 2, 7),
              yz = __builtin_shufflevector(columns[1], columns[2], 1, 5, 3, 7);
  store(__builtin_shufflevector(xy, zx, 0, 1, 4, 5), rows);
  store(__builtin_shufflevector(yz, xy, 0, 1, 6, 7), rows + 4);
  store(__builtin_shufflevector(zx, yz, 2, 3, 6, 7), rows + 8);
}

GRAINSCOPE_INLINE void read_fours(const double *rows, double columns[4]) {
  for (int n = 0; n < 4; n++) columns[n] = rows[n];
}
GRAINSCOPE_INLINE void read_fours(const double *rows, Lanes columns[4]) {
  const Lanes read[4] = {load(rows), load(rows + 4), load(rows + 8), load(rows + 12)};
  transpose(read, columns);
}
GRAINSCOPE_INLINE void write_fours(const double columns[4], double *rows) {
  for (int n = 0; n < 4; n++) rows[n] = columns[n];
}
GRAINSCOPE_INLINE void write_fours(const Lanes columns[4], double *rows) {
  Lanes written[4];
  transpose(columns, written);
  store(written[0], rows);
  store(written[1], rows + 4);
  store(written[2], rows + 8);
  store(written[3], rows + 12);
}

/** How many of `n` rows of three numbers, from the first on, are as the first; at least 1. */
GRAINSCOPE_INLINE int threes_alike(const double *rows, int n) {
  const double x = rows[0], y = rows[1], z = rows[2];
  const Lanes a = {x, y, z, x}, b = {y, z, x, y}, c = {z, x, y, z};
  int same = 0;
  while (same + LANES <= n) {
    const double *at = rows + 3 * same;
    if (!all((load(at) == a) & (load(at + 4) == b) & (load(at + 8) == c))) break;
    same += LANES;
  }
  while (same < n && rows[3 * same] == x && rows[3 * same + 1] == y && rows[3 * same + 2] == z) same++;
  return same > 0 ? same : 1;  // of what is no number
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
GRAINSCOPE_INLINE void add_scaled_threes(Lanes factors, const double *more, double *rows) {
  add_to(rows, __builtin_shufflevector(factors, factors, 0, 0, 0, 1) * load(more));
  add_to(rows + 4, __builtin_shufflevector(factors, factors, 1, 1, 2, 2) * load(more + 4));
  add_to(rows + 8, __builtin_shufflevector(factors, factors, 2, 3, 3, 3) * load(more + 8));
}

}

#endif
