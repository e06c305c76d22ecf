// SPDX-License-Identifier: MIT
#include "core/odometry/wrapping_counter.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace cornerd::core {
namespace {

TEST(CountDifference, AcrossCounterMax_TakesShorterDifference) {
  EXPECT_EQ(count_difference(65530, 5, 65535), 11);
  EXPECT_EQ(count_difference(5, 65530, 65535), -11);
  EXPECT_EQ(count_difference(4294967295, 0, 4294967295), 1);
  EXPECT_EQ(count_difference(0, 999, 999), -1);
  EXPECT_EQ(count_difference(998, 1, 999), 3);
}

TEST(CountDifference, SignedReadings_SameCounter) {
  EXPECT_EQ(count_difference(32760, -32760, 65535), 16);
  EXPECT_EQ(count_difference(-3, 4, 4294967295), 7);
}

TEST(CountDifference, WithoutCounterMax_IsPlainDifference) {
  EXPECT_EQ(count_difference(-7, 4294967400, 0), 4294967407);
}

TEST(CountDifference, AnyCounterMax_DifferencesAddUp) {
  std::mt19937_64 random(5);
  for (const std::int64_t counter_max : {9LL, 999LL, 65535LL, 4294967295LL, (1LL << 62) - 1}) {
    const std::int64_t span = counter_max + 1;
    const std::int64_t longest = span / 2 - 1;
    std::int64_t count = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto way =
          static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * longest + 1)) -
          longest;
      const std::int64_t next = ((count + way) % span + span) % span;
      ASSERT_EQ(count_difference(count, next, counter_max), way) << counter_max;
      count = next;
    }
  }
}

TEST(CountDifference, ExtremesOfType_NoOverflow) {
  constexpr auto kLow = std::numeric_limits<std::int64_t>::min();
  constexpr auto kHigh = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(count_difference(kHigh, kLow, 0), 1);
  for (const std::int64_t counter_max : {1LL, 65535LL, 4294967295LL}) {
    const std::int64_t way = count_difference(kLow, kHigh, counter_max);
    EXPECT_LE(std::abs(way), (counter_max + 1) / 2);
  }
}

}  // namespace
}  // namespace cornerd::core
