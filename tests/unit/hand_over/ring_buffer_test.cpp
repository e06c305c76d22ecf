// SPDX-License-Identifier: MIT
#include "core/ring_buffer.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

namespace cornerd::core {
namespace {

TEST(RingBuffer, Empty_PopReturnsFalse) {
  RingBuffer<int> ring(4);
  int element = 7;
  EXPECT_FALSE(ring.pop(element));
  EXPECT_EQ(element, 7);
}

TEST(RingBuffer, Full_RefusesAndCountsTheNewest) {
  RingBuffer<int> ring(4);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(i));
  EXPECT_FALSE(ring.push(4));
  EXPECT_FALSE(ring.push(5));
  EXPECT_EQ(ring.overflows(), 2U);
  int element = -1;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(ring.pop(element));
    EXPECT_EQ(element, i);
  }
  EXPECT_FALSE(ring.pop(element));
}

TEST(RingBuffer, OddCapacity_IsRoundedUpToAPowerOfTwo) {
  EXPECT_EQ(RingBuffer<int>(5).capacity(), 8U);
  EXPECT_EQ(RingBuffer<int>(0).capacity(), 2U);
}

TEST(RingBuffer, ManyWraps_KeepTheOrder) {
  RingBuffer<std::uint32_t> ring(8);
  std::uint32_t in = 0;
  std::uint32_t out = 0;
  for (int round = 0; round < 1000; ++round) {
    for (int i = 0; i < round % 9; ++i) in += ring.push(in) ? 1 : 0;
    std::uint32_t element = 0;
    while (ring.pop(element)) EXPECT_EQ(element, out++);
  }
  EXPECT_EQ(in, out);
}

TEST(RingBuffer, TwoThreads_LoseNothingAndKeepTheOrder) {
  constexpr std::uint32_t kCount = 200'000;
  RingBuffer<std::uint32_t> ring(64);
  std::thread producer([&] {
    for (std::uint32_t i = 0; i < kCount;) {
      if (ring.push(i)) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  std::uint32_t expected = 0;
  std::uint32_t element = 0;
  bool ordered = true;
  while (expected < kCount) {
    if (ring.pop(element)) {
      ordered = ordered && element == expected;
      ++expected;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
  EXPECT_TRUE(ordered);
}

}  // namespace
}  // namespace cornerd::core
