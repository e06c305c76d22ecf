// SPDX-License-Identifier: MIT
#include "daemon/latency_window.hpp"

#include <gtest/gtest.h>

namespace cornerd::daemon {
namespace {

TEST(LatencyWindow, HundredValues_NearestRankPercentiles) {
  LatencyWindow window;
  for (int i = 100; i >= 1; --i) window.add(i);
  EXPECT_EQ(window.percentile(0.50), 50);
  EXPECT_EQ(window.percentile(0.95), 95);
  EXPECT_EQ(window.percentile(0.99), 99);
  EXPECT_EQ(window.percentile(1), 100);
  EXPECT_EQ(window.percentile(0), 1);
}

TEST(LatencyWindow, OneValue_EveryPercentile) {
  LatencyWindow window;
  EXPECT_TRUE(window.empty());
  EXPECT_EQ(window.percentile(0.5), 0);
  window.add(3);
  EXPECT_FALSE(window.empty());
  EXPECT_EQ(window.percentile(0.5), 3);
  EXPECT_EQ(window.percentile(0.99), 3);
}

TEST(LatencyWindow, FullWindow_OldValuesDropped) {
  LatencyWindow window;
  for (std::size_t i = 0; i < LatencyWindow::kSize; ++i) window.add(1000);
  for (std::size_t i = 0; i < LatencyWindow::kSize; ++i) window.add(1);
  EXPECT_EQ(window.percentile(1), 1);
}

}  // namespace
}  // namespace cornerd::daemon
