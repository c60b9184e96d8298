// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LANES_H
#define GRAINSCOPE_LANES_H

#include <cmath>

// The widest vectors of the processor that the program finds itself on.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__GLIBC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define GRAINSCOPE_CLONES __attribute__((flatten, target_clones("avx512f", "avx2", "default")))
#else
#define GRAINSCOPE_CLONES
#endif

namespace grainscope {

/** Several numbers side by side, worked on at once: what a kernel written for `Real` becomes with Real = Lanes. Every
 *  lane goes through the same IEEE operations as a double would, so results are equal to the last bit, whatever vectors
 *  the processor has. */
constexpr int LANES = 8;
typedef double Lanes __attribute__((vector_size(8 * LANES)));
typedef long long LaneMask __attribute__((vector_size(8 * LANES)));

#define GRAINSCOPE_INLINE inline __attribute__((always_inline))

GRAINSCOPE_INLINE double root(double x) { return std::sqrt(x); }
GRAINSCOPE_INLINE Lanes root(Lanes x) {
  Lanes r;
  for (int k = 0; k < LANES; k++) r[k] = std::sqrt(x[k]);
  return r;
}

GRAINSCOPE_INLINE double pick(bool condition, double yes, double no) { return condition ? yes : no; }
GRAINSCOPE_INLINE Lanes pick(LaneMask condition, Lanes yes, Lanes no) { return condition ? yes : no; }

GRAINSCOPE_INLINE bool any(bool condition) { return condition; }
GRAINSCOPE_INLINE bool any(LaneMask condition) {
  long long some = 0;
  for (int k = 0; k < LANES; k++) some |= condition[k];
  return some != 0;
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

}

#endif
