// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FITTED_H
#define GRAINSCOPE_FITTED_H

#include <cstddef>
#include <vector>

namespace grainscope {

/** Gives a vector `count` elements, with room for a few more; its contents may be lost. For vectors that are refilled
 *  with each neighbour list and grow little: resize() would double them, and hold old and new memory at once. */
template <class Element>
void fit(std::vector<Element> &elements, std::size_t count) {
  if (elements.capacity() < count || elements.capacity() / 2 > count) {
    std::vector<Element>().swap(elements);
    elements.reserve(count + count / 16);
  }
  elements.resize(count);
}

}

#endif
