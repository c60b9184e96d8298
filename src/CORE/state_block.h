// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_STATE_BLOCK_H
#define GRAINSCOPE_STATE_BLOCK_H

#include <cstdint>
#include <string>
#include <vector>

namespace grainscope {

/** The bytes that a fix keeps in a restart file: a header, a struct of numbers, and what the struct says there is
 *  behind it. LIGGGHTS hands them back without saying how many there are: the header has the version and the size of
 *  the struct. */
namespace state_block {

struct Header {
  char mark[8];
  std::uint32_t version, size;
};

std::vector<char> pack(std::uint32_t version, const void *state, std::size_t size, const void *tail,
                       std::size_t tail_size);

/** Whether it has the mark of such a block. */
bool is_one(const char *block);

/** "" when `block` begins with a struct of this version and size; else what it holds instead. */
std::string what_differs(const char *block, std::uint32_t version, std::size_t size);

/** Of a block that does not differ: the struct, and what is behind it. */
const char *state(const char *block);
const char *tail(const char *block);

}

}

#endif
