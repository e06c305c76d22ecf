// SPDX-License-Identifier: MIT
#include "daemon/slot_exchange.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace cornerd::daemon {
namespace {

TEST(SlotExchange, Values_Taken_InOrder) {
  SlotExchange<int> exchange(2);
  EXPECT_TRUE(exchange.put([](int& slot) { slot = 1; }));
  EXPECT_TRUE(exchange.put([](int& slot) { slot = 2; }));
  int value = 0;
  EXPECT_TRUE(exchange.take([&](const int& slot) { value = slot; }));
  EXPECT_EQ(value, 1);
  EXPECT_TRUE(exchange.take([&](const int& slot) { value = slot; }));
  EXPECT_EQ(value, 2);
  EXPECT_FALSE(exchange.take([&](const int&) { FAIL(); }));
}

TEST(SlotExchange, NoEmptySlot_RefusedUntilOneIsReturned) {
  SlotExchange<int> exchange(3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(exchange.put([](int&) {}));
  EXPECT_FALSE(exchange.put([](int&) { FAIL(); }));
  EXPECT_TRUE(exchange.take([](const int&) {}));
  EXPECT_TRUE(exchange.put([](int&) {}));
}

TEST(SlotExchange, TwoThreads_NoTornValue) {
  using Value = std::array<int, 64>;
  constexpr int kValues = 2'000;
  SlotExchange<Value> exchange(4);
  std::jthread producer([&exchange] {
    for (int i = 1; i <= kValues;) {
      if (exchange.put([i](Value& slot) { slot.fill(i); })) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  for (int expected = 1; expected <= kValues;) {
    const bool taken = exchange.take([&expected](const Value& slot) {
      for (const int element : slot) ASSERT_EQ(element, expected);
      ++expected;
    });
    if (!taken) std::this_thread::yield();
  }
}

}  // namespace
}  // namespace cornerd::daemon
