// SPDX-License-Identifier: GPL-2.0-or-later
#include "state_block.h"
#include <algorithm>
#include <cstring>

namespace grainscope { namespace state_block {

namespace {

const char mark[8] = {'g', 'r', 's', ' ', 's', 't', 'a', 't'};

Header header_of(const char *block) {
  Header header;
  memcpy(&header, block, sizeof header);
  return header;
}

}

std::vector<char> pack(std::uint32_t version, const void *state, std::size_t size, const void *tail,
                       std::size_t tail_size) {
  Header header;
  memcpy(header.mark, mark, sizeof mark);
  header.version = version;
  header.size = size;
  std::vector<char> block(sizeof header + size + tail_size);
  memcpy(block.data(), &header, sizeof header);
  memcpy(block.data() + sizeof header, state, size);
  if (tail_size > 0) memcpy(block.data() + sizeof header + size, tail, tail_size);
  return block;
}

/** Byte by byte: a state without a mark may be shorter than one. */
bool is_one(const char *block) { return std::mismatch(mark, mark + sizeof mark, block).first == mark + sizeof mark; }

std::string what_differs(const char *block, std::uint32_t version, std::size_t size) {
  const std::string reads = "and this program reads version " + std::to_string(version);
  if (!is_one(block))
    return "the restart file holds its state without a version, as earlier versions of grainscope wrote it, " + reads;
  const Header header = header_of(block);
  if (header.version != version)
    return "the restart file was written by another version of grainscope: it holds version " +
           std::to_string(header.version) + " of its state, " + reads;
  if (header.size != size)
    return "the restart file was written by another version of grainscope: it holds " + std::to_string(header.size) +
           " bytes of its state, " + reads + ", which has " + std::to_string(size);
  return "";
}

const char *state(const char *block) { return block + sizeof(Header); }

const char *tail(const char *block) { return state(block) + header_of(block).size; }

}}
