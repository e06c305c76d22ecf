// SPDX-License-Identifier: MIT
#include "progress_monitor.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/wait_until.hpp"

namespace cornerd::soak {
namespace {

constexpr bool kAsleep = true;
constexpr bool kProgress = true;

TEST(ProgressMonitor, BusyWithoutProgress_CountsCpuTime) {
  ProgressMonitor watch({.time_s = 100, .cpu_s = 7});
  watch.update({.time_s = 108, .cpu_s = 9}, !kProgress);
  watch.update({.time_s = 109, .cpu_s = 10}, !kProgress);
  EXPECT_DOUBLE_EQ(watch.stalled_s(), 3);
}

TEST(ProgressMonitor, AsleepWithoutProgress_CountsRealTime) {
  ProgressMonitor watch({.time_s = 100, .cpu_s = 7, .others_asleep = kAsleep});
  watch.update({.time_s = 106, .cpu_s = 7, .others_asleep = kAsleep}, !kProgress);
  EXPECT_DOUBLE_EQ(watch.stalled_s(), 6);
}

TEST(ProgressMonitor, WaitingForAProcessor_CountsNothing) {
  ProgressMonitor watch({.time_s = 100, .cpu_s = 7});
  watch.update({.time_s = 200, .cpu_s = 7}, !kProgress);
  watch.update({.time_s = 300, .cpu_s = 7, .others_asleep = kAsleep}, !kProgress);
  EXPECT_EQ(watch.max_stalled_s(), 0);
}

TEST(ProgressMonitor, Progress_ResetsTheTimeButNotTheMaximum) {
  ProgressMonitor watch({});
  watch.update({.time_s = 4, .cpu_s = 4}, kProgress);
  watch.update({.time_s = 5, .cpu_s = 5}, kProgress);
  EXPECT_EQ(watch.stalled_s(), 0);
  EXPECT_DOUBLE_EQ(watch.max_stalled_s(), 4);
}

TEST(Activity, OtherThread_IsAsleepWhileItWaits) {
  std::atomic<int> state{0};
  std::jthread other([&](const std::stop_token& stop) {
    state.wait(0);
    while (!stop.stop_requested()) {
    }
  });
  // Falling asleep takes a while.
  EXPECT_TRUE(test::wait_until([] { return Activity::now().others_asleep; }));
  const double before_s = Activity::now().cpu_s;
  state = 1;
  state.notify_one();
  EXPECT_TRUE(test::wait_until([] { return !Activity::now().others_asleep; }));
  EXPECT_TRUE(test::wait_until([&] { return Activity::now().cpu_s > before_s; }));
}

}  // namespace
}  // namespace cornerd::soak
