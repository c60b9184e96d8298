// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TESTS_OFF_PLACE_H
#define GRAINSCOPE_TESTS_OFF_PLACE_H

/** A T that lies no better than its type asks for: where numbers in lanes are stored by an instruction that wants more,
 *  the test ends there, and not by the luck of what the heap gives. */
template <class T>
struct alignas(64) OffPlace {
  double before;
  T here{};
  static_assert(alignof(T) <= sizeof(double), "lanes lie wherever a double may");
};

#endif
