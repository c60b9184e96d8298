// SPDX-License-Identifier: GPL-2.0-or-later
#include "state_block.h"
#include <gtest/gtest.h>
#include <cstring>

using namespace grainscope;

namespace {

struct Numbers {
  double strain, steps;
};

const Numbers numbers{0.25, 100.0};
const double behind[3] = {1.0, -2.0, 3.5};

std::vector<char> block() { return state_block::pack(3, &numbers, sizeof numbers, behind, sizeof behind); }

TEST(StateBlock, GivesBackWhatWasPacked) {
  const std::vector<char> packed = block();
  EXPECT_EQ(state_block::what_differs(packed.data(), 3, sizeof numbers), "");
  EXPECT_EQ(std::memcmp(state_block::state(packed.data()), &numbers, sizeof numbers), 0);
  EXPECT_EQ(std::memcmp(state_block::tail(packed.data()), behind, sizeof behind), 0);
  EXPECT_EQ(state_block::tail(packed.data()) + sizeof behind, packed.data() + packed.size());
}

TEST(StateBlock, NeedsNoTail) {
  const std::vector<char> packed = state_block::pack(3, &numbers, sizeof numbers, nullptr, 0);
  EXPECT_EQ(state_block::what_differs(packed.data(), 3, sizeof numbers), "");
  EXPECT_EQ(state_block::tail(packed.data()), packed.data() + packed.size());
}

TEST(StateBlock, RefusesAnotherVersion) {
  EXPECT_EQ(state_block::what_differs(block().data(), 4, sizeof numbers),
            "the restart file was written by another version of grainscope: it holds version 3 of its state, and this "
            "program reads version 4");
}

TEST(StateBlock, RefusesAnotherSize) {
  EXPECT_EQ(state_block::what_differs(block().data(), 3, sizeof numbers + 8),
            "the restart file was written by another version of grainscope: it holds 16 bytes of its state, and this "
            "program reads version 3, "
            "which has 24");
}

/** What earlier programs wrote: numbers, or words that may be shorter than a mark. The sanitizers see that no byte
 *  behind them is read. */
TEST(StateBlock, RefusesAStateWithoutAVersion) {
  const std::string words = "the restart file holds its state without a version, as earlier versions of grainscope "
                            "wrote it, and this program "
                            "reads version 1";
  std::vector<char> old(sizeof numbers);
  std::memcpy(old.data(), &numbers, sizeof numbers);
  EXPECT_EQ(state_block::what_differs(old.data(), 1, sizeof numbers), words);
  for (const char *name : {"", "g", "grs", "model hooke"}) {
    const std::vector<char> copy(name, name + std::strlen(name) + 1);
    EXPECT_EQ(state_block::what_differs(copy.data(), 1, sizeof numbers), words) << name;
  }
}

}
