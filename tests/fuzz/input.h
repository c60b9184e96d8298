// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FUZZ_INPUT_H
#define GRAINSCOPE_FUZZ_INPUT_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace fuzz {

/** The fuzzer's bytes, taken as numbers from the front; 0 once there are none left. */
class Input {
 public:
  Input(const std::uint8_t *data, std::size_t size) : at_(data), end_(data + size) {}

  bool empty() const { return at_ == end_; }
  unsigned byte() { return at_ < end_ ? *at_++ : 0u; }
  int whole(int from, int to) { return from + static_cast<int>(bits(2) % static_cast<unsigned>(to - from + 1)); }
  bool flag() { return byte() & 1u; }

  /** Evenly from `from` to `to`, both ends and the middle included. */
  double uniform(double from, double to) {
    const double s = static_cast<double>(bits(4)) / 4294967295.0;
    return s == 0.0 ? from : s == 1.0 ? to : from + (to - from) * s;
  }
  double logarithmic(double from, double to) { return from * std::pow(to / from, uniform(0.0, 1.0)); }
  /** A small number, now and then exactly 0, 1 or -1: where special cases are. */
  double small() {
    const unsigned kind = byte();
    if (kind < 32) return kind % 3 - 1.0;
    return kind < 64 ? (kind & 1u ? 1.0 : -1.0) * logarithmic(1e-17, 1.0) : uniform(-1.0, 1.0);
  }
  /** Any double: NaN, infinite, denormal, huge. */
  double any() {
    const unsigned kind = byte();
    const double special[] = {0.0,
                              -0.0,
                              1.0,
                              -1.0,
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN(),
                              5e-324,
                              2.3e-308,
                              1.7e308,
                              1e150,
                              1e-160};
    if (kind < 24) return special[kind % 12];
    if (kind < 128) return small();
    const std::uint64_t raw = bits(8);
    double value;
    std::memcpy(&value, &raw, sizeof value);
    return value;
  }
  /** A unit vector of n components: by preference one that lies along an axis or nearly so. */
  void direction(double *v, int n) {
    double square = 0.0;
    for (int k = 0; k < n; k++) {
      v[k] = small();
      square += v[k] * v[k];
    }
    if (square < 1e-20) {
      for (int k = 0; k < n; k++) v[k] = k == 0;
      return;
    }
    for (int k = 0; k < n; k++) v[k] /= std::sqrt(square);
  }

 private:
  const std::uint8_t *at_, *end_;

  std::uint64_t bits(int bytes) {
    std::uint64_t sum = 0;
    for (int k = 0; k < bytes; k++) sum = sum << 8 | byte();
    return sum;
  }
};

/** Ends the program, as a crash, unless `holds`. */
inline void require(bool holds, const char *what, double value = 0.0, double limit = 0.0) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s (%.17g, limit %.3g)\n", what, value, limit);
  std::abort();
}
inline void require_below(double value, double limit, const char *what) { require(value <= limit, what, value, limit); }

inline bool finite(const double *v, int n) {
  for (int k = 0; k < n; k++)
    if (!std::isfinite(v[k])) return false;
  return true;
}

}

#endif
