// SPDX-License-Identifier: GPL-2.0-or-later
#include "past_lanes.h"

namespace grainscope {

namespace {

GRAINSCOPE_INLINE Lanes dot(const Lanes *a, const Lanes *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/** Two numbers of each lane, which for lane k begin at row(k). */
template <class Row>
GRAINSCOPE_INLINE void load_pairs(Row row, Lanes *column) {
  for (int k = 0; k < LANES; k++)
    for (int n = 0; n < 2; n++) column[n][k] = row(k)[n];
}

}

GRAINSCOPE_CLONES
void renew_past(const PairGroup &group, const LaneMask &touching, const GroupForces &f, const PastColumns &columns,
                PastLanes &past) {
  const auto row = [&](int k) { return group.history[k] + columns.first; };
  Lanes four[4], two[2];
  load_rows(row, four);
  load_pairs([&](int k) { return row(k) + 4; }, two);
  past.known = touching & (four[0] == columns.stamp_before);
  const auto known = [&past](const Lanes &x) { return pick(past.known, x, Lanes{}); };
  past.overlap = known(four[1]);
  past.elastic_force = known(four[2]);
  past.tangential_stiffness = known(four[3]);
  past.elastic_work = known(two[0]);
  past.spring_work = known(two[1]);

  const Lanes elastic_force = f.kn * f.overlap;
  const Lanes now[4] = {columns.stamp + Lanes{}, f.overlap, elastic_force, f.kt};
  const Lanes elastic_work = -columns.half_step * elastic_force * f.working_normal(),
              spring_work = columns.half_step * f.kt * dot(f.after, f.working_tangential());
  Lanes rows[LANES];
  transpose(now, rows);
  for (int k = 0; k < LANES; k++) {
    if (!touching[k]) continue;
    double *const at = row(k);
    store(rows[k], at);
    at[4] = elastic_work[k];
    at[5] = spring_work[k];
  }
}

}
