// SPDX-License-Identifier: GPL-2.0-or-later
#include "packed_grain.h"
#include "ellipsoid_contact.h"
#include "lanes.h"

namespace grainscope {

namespace {

/** Three numbers and a fourth. What follows them in memory is looked at, too. */
GRAINSCOPE_INLINE void put_row(const double *three, double fourth, double *row) {
  const Lanes four = load(three), last = fourth + Lanes{};
  store(__builtin_shufflevector(four, last, 0, 1, 2, 4), row);
}

GRAINSCOPE_INLINE void put_last(const double *three, double fourth, double *row) {
  for (int k = 0; k < 3; k++) row[k] = three[k];
  row[3] = fourth;
}

GRAINSCOPE_INLINE void turn_axis(const double *quaternion, unsigned char symmetry, PackedGrain &grain) {
  if (symmetry < KEPT) rotated_axis(quaternion, symmetry, grain.axis);
  if (symmetry != QUATERNION) return;
  for (int k = 0; k < 3; k++) grain.axis[k] = quaternion[k];
  grain.inverse_product = quaternion[3];
}

}

GRAINSCOPE_CLONES
void pack_motion(const GrainRows &rows, PackedGrain *grains) {
  const int last = rows.count - 1;
  for (int i = 0; i < last; i++) {
    PackedGrain &grain = grains[i];
    put_row(rows.x + 3 * i, rows.radius[i], grain.x);
    put_row(rows.velocity + 3 * i, rows.mass[i], grain.velocity);
    put_row(rows.spin + 3 * i, rows.size ? rows.size[i] : grain.size, grain.spin);
  }
  if (last < 0) return;
  PackedGrain &grain = grains[last];
  put_last(rows.x + 3 * last, rows.radius[last], grain.x);
  put_last(rows.velocity + 3 * last, rows.mass[last], grain.velocity);
  put_last(rows.spin + 3 * last, rows.size ? rows.size[last] : grain.size, grain.spin);
}

GRAINSCOPE_CLONES
void pack_axes(const GrainRows &rows, const unsigned char *symmetry, PackedGrain *grains) {
  int i = 0;
  for (; i + LANES <= rows.count; i += LANES) {
    const double *q = rows.quaternion + 4 * i;
    const unsigned char k = symmetry[i];
    if (k < KEPT && symmetry[i + 1] == k && symmetry[i + 2] == k && symmetry[i + 3] == k) {
      Lanes turn[4], axis[4], row[4];
      load_rows([q](int n) { return q + 4 * n; }, turn);
      rotated_axis(turn, k, axis);
      for (int n = 0; n < LANES; n++) axis[3][n] = grains[i + n].inverse_product;
      transpose(axis, row);
      for (int n = 0; n < LANES; n++) store(row[n], grains[i + n].axis);
    } else {
      for (int n = 0; n < LANES; n++) turn_axis(q + 4 * n, symmetry[i + n], grains[i + n]);
    }
  }
  for (; i < rows.count; i++) turn_axis(rows.quaternion + 4 * i, symmetry[i], grains[i]);
}

}
