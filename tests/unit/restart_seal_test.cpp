// SPDX-License-Identifier: GPL-2.0-or-later
#include "finite.h"
#include "restart_seal.h"
#include <gtest/gtest.h>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace {

using grainscope::restart_seal::examine;
using grainscope::restart_seal::seal;
using grainscope::restart_seal::Verdict;

template <class T>
void put(std::string &bytes, T value) {
  bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
}

void put_text(std::string &bytes, std::int32_t flag, const std::string &text) {
  put(bytes, flag);
  put(bytes, static_cast<std::int32_t>(text.size() + 1));
  bytes.append(text.c_str(), text.size() + 1);
}

/** What the host's files begin with, then the name of the fix that seals, then anything. */
std::string restart_of(std::int64_t step, bool guarded) {
  std::string bytes;
  put_text(bytes, 0, "Version LIGGGHTS 3.8.0");
  for (std::int32_t flag = 1; flag <= 3; flag++) {
    put(bytes, flag);
    put(bytes, std::int32_t(flag == 3 ? 8 : 4));
  }
  put_text(bytes, 4, "si");
  put(bytes, std::int32_t(5));
  put(bytes, step);
  for (std::int32_t flag = 6; flag <= 21; flag++) {
    put(bytes, flag);
    put(bytes, std::int32_t(1));
  }
  put_text(bytes, 22, "superquadric");
  put(bytes, std::int32_t(23));
  put(bytes, std::int64_t(200));
  if (guarded) bytes += "run/guard";
  for (int k = 0; k < 3000; k++) put(bytes, 0.1 * k);
  return bytes;
}

class RestartSeal : public testing::Test {
 protected:
  const std::string file =
      testing::TempDir() + "restart_seal_test_" + testing::UnitTest::GetInstance()->current_test_info()->name();
  ~RestartSeal() override { std::remove(file.c_str()); }

  void write(const std::string &bytes) { std::ofstream(file, std::ios::binary) << bytes; }
  std::string read() {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(RestartSeal, WholeFileHasItsStep) {
  write(restart_of(12345678901, true));
  EXPECT_EQ(seal(file), "");
  const Verdict verdict = examine(file);
  EXPECT_TRUE(verdict.whole && verdict.sealed);
  EXPECT_EQ(verdict.step, 12345678901);
  EXPECT_EQ(verdict.reason, "");
}

TEST_F(RestartSeal, CutAnywhereIsSeen) {
  write(restart_of(7, true));
  seal(file);
  const std::string all = read();
  for (std::size_t length = 0; length < all.size(); length += 1 + length / 50) {
    write(all.substr(0, length));
    EXPECT_FALSE(examine(file).whole) << "cut at " << length;
  }
}

TEST_F(RestartSeal, EveryFlippedByteIsSeen) {
  write(restart_of(7, true));
  seal(file);
  const std::string all = read();
  for (std::size_t at = 0; at < all.size(); at += 1 + at / 40)
    for (const char bits : {char(1), char(-128), char(-1)}) {
      std::string damaged = all;
      damaged[at] ^= bits;
      write(damaged);
      EXPECT_FALSE(examine(file).whole) << "byte " << at;
    }
}

TEST_F(RestartSeal, TheHostsOwnFileIsNotChecked) {
  write(restart_of(7, false));
  const Verdict verdict = examine(file);
  EXPECT_TRUE(verdict.whole);
  EXPECT_FALSE(verdict.sealed);
}

TEST_F(RestartSeal, SealedTwiceHoldsToo) {
  write(restart_of(7, true));
  seal(file);
  EXPECT_EQ(seal(file), "");
  EXPECT_TRUE(examine(file).whole);
}

TEST_F(RestartSeal, AnotherFormatIsNamed) {
  write(restart_of(7, true));
  seal(file);
  std::string all = read();
  all[all.size() - 4] = 99;
  write(all);
  EXPECT_NE(examine(file).reason.find("format 99"), std::string::npos) << examine(file).reason;
}

TEST_F(RestartSeal, OtherFilesAreTold) {
  EXPECT_NE(examine(file + "-missing").reason.find("cannot be opened"), std::string::npos);
  write("");
  EXPECT_EQ(examine(file).reason, "is empty");
  write("ITEM: TIMESTEP\n0\n");
  EXPECT_NE(examine(file).reason.find("is not a restart file"), std::string::npos);
  EXPECT_NE(seal("/nowhere/at/all").find("cannot seal"), std::string::npos);
}

TEST(Finite, FindsEveryKindAnywhere) {
  using Limits = std::numeric_limits<double>;
  std::vector<double> values(37);
  for (std::size_t k = 0; k < values.size(); k++) values[k] = k % 2 ? -1.0 * k : 1e-300 * k;
  values[5] = Limits::max();
  values[6] = -Limits::max();
  values[7] = Limits::denorm_min();
  EXPECT_TRUE(grainscope::all_finite(values.data(), values.size()));
  EXPECT_TRUE(grainscope::all_finite(values.data(), 0));
  for (const double bad :
       {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::signaling_NaN()})
    for (std::size_t k = 0; k < values.size(); k++) {
      const double kept = values[k];
      values[k] = bad;
      EXPECT_FALSE(grainscope::all_finite(values.data(), values.size())) << bad << " at " << k;
      values[k] = kept;
    }
}

}
