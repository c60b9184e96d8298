// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FITTED_H
#define GRAINSCOPE_FITTED_H

#include <cstddef>
#include <vector>

namespace grainscope {

/** `count` elements, with room for a few more. What was in them may be lost: vectors that are refilled with each
 *  neighbour list grow by little, and would double, and hold the old and the new at once while they do. */
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
