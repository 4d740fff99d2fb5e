#include "solver/base/random.h"

#include <gtest/gtest.h>

#include <vector>

namespace seapile::base {
namespace {

// The generator's own known answers (Random123, kat_vectors, "philox4x32 10"): counter and key all zero, all ones.
TEST(Random, TheGeneratorIsPhilox4x32Of10Rounds) {
  const r123::Philox4x32::ctr_type zero = {{0, 0, 0, 0}}, ones = {{~0u, ~0u, ~0u, ~0u}};
  const r123::Philox4x32::key_type no_key = {{0, 0}}, full_key = {{~0u, ~0u}};
  const r123::Philox4x32::ctr_type of_zero = {{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}};
  const r123::Philox4x32::ctr_type of_ones = {{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}};
  EXPECT_EQ(r123::Philox4x32{}(zero, no_key), of_zero);
  EXPECT_EQ(r123::Philox4x32{}(ones, full_key), of_ones);
}

// The first number follows from the known answer by hand: 0x6627e8d5e169c58d >> 11, times 2^-53. The others are pinned:
// every bed that was ever drawn depends on them.
TEST(Random, NumbersNeverChange) {
  EXPECT_EQ(uniform(0, 0, 0), static_cast<double>(0x6627e8d5e169c58d >> 11) * 0x1p-53);
  EXPECT_EQ(uniform(1, 0, 0), 0x1.c7d00ce1ca141p-1);
  EXPECT_EQ(uniform(1, 0, 1), 0x1.58102837bf8b9p-1);
  EXPECT_EQ(uniform(1, 2, 11595), 0x1.3885c0784f4ap-5);
  EXPECT_EQ(uniform(9007199254740991, 1, std::uint64_t{1} << 40), 0x1.d6f85c8db5d78p-3);
}

TEST(Random, ANumberDependsOnSeedStreamAndIndexAndOnNothingElse) {
  std::vector<double> forward, backward;
  for (std::uint64_t k = 0; k < 100; ++k) forward.push_back(uniform(7, 3, k));
  for (std::uint64_t k = 100; k-- > 0;) {
    EXPECT_NE(uniform(8, 3, k), forward[k]);
    EXPECT_NE(uniform(7, 4, k), forward[k]);
    EXPECT_NE(uniform(7, 3, k + (std::uint64_t{1} << 32)), forward[k]);
    EXPECT_NE(uniform(7 + (std::uint64_t{1} << 32), 3, k), forward[k]);
    backward.insert(backward.begin(), uniform(7, 3, k));
  }
  EXPECT_EQ(forward, backward);
}

// Mean and variance of 10^5 numbers lie within 5 standard errors of 1/2 and 1/12: sqrt(1/12/n), sqrt(1/180/n).
TEST(Random, NumbersFillTheirIntervalEvenly) {
  constexpr int kCount = 100'000;
  double sum = 0, square = 0;
  for (int k = 0; k < kCount; ++k) {
    const double x = uniform(2, 5, 42, 0, static_cast<std::uint64_t>(k));
    ASSERT_GE(x, 2);
    ASSERT_LT(x, 5);
    const double share = (x - 2) / 3;
    sum += share;
    square += (share - 0.5) * (share - 0.5);
  }
  EXPECT_NEAR(sum / kCount, 0.5, 5 * 9.2e-4);
  EXPECT_NEAR(square / kCount, 1.0 / 12, 5 * 2.4e-4);
}

}  // namespace
}  // namespace seapile::base
