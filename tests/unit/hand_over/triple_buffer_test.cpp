// SPDX-License-Identifier: MIT
#include "core/triple_buffer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace cornerd::core {
namespace {

TEST(TripleBuffer, BeforeTheFirstPublish_ReadsTheDefault) {
  TripleBuffer<int> latest;
  EXPECT_EQ(latest.read(), 0);
}

TEST(TripleBuffer, SeveralPublishes_ReadsTheNewest) {
  TripleBuffer<int> latest;
  latest.publish(1);
  latest.publish(2);
  EXPECT_EQ(latest.read(), 2);
  EXPECT_EQ(latest.read(), 2);
  latest.publish(3);
  EXPECT_EQ(latest.read(), 3);
}

TEST(TripleBuffer, TwoThreads_ReadWholeValuesInOrder) {
  using Block = std::array<std::uint32_t, 64>;
  TripleBuffer<Block> latest;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint32_t i = 1; i <= 20'000; ++i) {
      Block block;
      block.fill(i);
      latest.publish(block);
    }
    done = true;
  });
  std::uint32_t last = 0;
  bool whole = true;
  bool forward = true;
  for (bool end = false; !end;) {
    end = done;
    const Block& block = latest.read();
    for (const std::uint32_t word : block) whole = whole && word == block.front();
    forward = forward && block.front() >= last;
    last = block.front();
  }
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(forward);
  EXPECT_EQ(last, 20'000U);
}

}  // namespace
}  // namespace cornerd::core
