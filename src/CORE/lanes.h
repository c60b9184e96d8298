// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LANES_H
#define GRAINSCOPE_LANES_H

#include <cmath>
#include <cstring>

// The vectors of the processor that the program runs on. Not AVX-512, which has fused multiply-adds: gcc uses some of
// them whatever -ffp-contract says, and results would not be the same to the last bit.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__GLIBC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define GRAINSCOPE_CLONES __attribute__((flatten, target_clones("avx2", "default")))
#else
#define GRAINSCOPE_CLONES
#endif

#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wpsabi"               // functions that pass vectors are inlined
#pragma GCC diagnostic ignored "-Wignored-attributes"  // templates of Lanes, which no processor keeps in memory
#endif

#define GRAINSCOPE_INLINE inline __attribute__((always_inline))

namespace grainscope {

/** Several numbers side by side, worked on at once: what a kernel written for `Real` becomes with Real = Lanes. Every
 *  lane goes through the same IEEE operations as a double would, so results are equal to the last bit, whatever vectors
 *  the processor has. Four, and not eight: comparisons of vectors that are wider than a register of AVX2 are taken
 *  apart by compilers, also where AVX-512 has wider ones. */
constexpr int LANES = 4;
// They may lie at any address that a double may have: gcc aligns vectors to 16 bytes where functions for any processor
// are compiled, and memory of `new` to no more, but clones for AVX2 would then expect 32.
typedef double Lanes __attribute__((vector_size(8 * LANES), aligned(8)));
typedef decltype(Lanes{} < Lanes{}) LaneMask __attribute__((aligned(8)));

GRAINSCOPE_INLINE double root(double x) { return std::sqrt(x); }
GRAINSCOPE_INLINE Lanes root(Lanes x) {
  Lanes r;
  for (int k = 0; k < LANES; k++) r[k] = std::sqrt(x[k]);
  return r;
}

GRAINSCOPE_INLINE double pick(bool condition, double yes, double no) { return condition ? yes : no; }
GRAINSCOPE_INLINE Lanes pick(LaneMask condition, Lanes yes, Lanes no) { return condition ? yes : no; }
GRAINSCOPE_INLINE LaneMask pick(LaneMask condition, LaneMask yes, LaneMask no) {
  return (condition & yes) | (~condition & no);
}

GRAINSCOPE_INLINE double absolute(double x) { return std::fabs(x); }
GRAINSCOPE_INLINE Lanes absolute(Lanes x) { return (Lanes)((LaneMask)x & 0x7fffffffffffffffL); }

/** The sum of all lanes, always in the same order. */
inline double sum_of(const Lanes &x) { return (x[0] + x[1]) + (x[2] + x[3]); }

template <class Real>
GRAINSCOPE_INLINE Real least(Real a, Real b) {
  return pick(a < b, a, b);
}

GRAINSCOPE_INLINE bool all(bool condition) { return condition; }
GRAINSCOPE_INLINE bool all(LaneMask condition) {
  return (condition[0] & condition[1] & condition[2] & condition[3]) != 0;
}
GRAINSCOPE_INLINE bool any(bool condition) { return condition; }
GRAINSCOPE_INLINE bool any(LaneMask condition) {
  return ((condition[0] | condition[1]) | (condition[2] | condition[3])) != 0;
}

template <class Real>
struct MaskOf;
template <>
struct MaskOf<double> {
  using type = bool;
};
template <>
struct MaskOf<Lanes> {
  using type = LaneMask;
};

/** Lanes that lie one after the other in memory, wherever they begin. */
GRAINSCOPE_INLINE Lanes load(const double *from) {
  Lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
GRAINSCOPE_INLINE void store(Lanes x, double *to) { std::memcpy(to, &x, sizeof x); }

/** Rows to columns, or columns to rows: as many as there are lanes. */
GRAINSCOPE_INLINE void transpose(const Lanes *in, Lanes *out) {
  const Lanes even1 = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6),
              odd1 = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7),
              even2 = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6),
              odd2 = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
  out[0] = __builtin_shufflevector(even1, even2, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(odd1, odd2, 0, 1, 4, 5);
  out[2] = __builtin_shufflevector(even1, even2, 2, 3, 6, 7);
  out[3] = __builtin_shufflevector(odd1, odd2, 2, 3, 6, 7);
}

/** Four numbers of each lane, which for lane k begin at row(k). */
template <class Row>
GRAINSCOPE_INLINE void load_rows(Row row, Lanes *column) {
  const Lanes rows[LANES] = {load(row(0)), load(row(1)), load(row(2)), load(row(3))};
  transpose(rows, column);
}

}

#endif
