// SPDX-License-Identifier: MIT
#include "daemon/posix_clock.hpp"

#include <gtest/gtest.h>

namespace cornerd::daemon {
namespace {

constexpr std::int64_t kMs = 1'000'000;

TEST(ClockStepDetector, EqualRates_NoStep) {
  ClockStepDetector detector;
  EXPECT_EQ(detector.step_ns(5000 * kMs, 10 * kMs), std::nullopt);
  EXPECT_EQ(detector.step_ns(5100 * kMs, 110 * kMs), std::nullopt);
}

TEST(ClockStepDetector, Slewing_NoStep) {
  ClockStepDetector detector;
  for (std::int64_t i = 0; i < 100; ++i) {
    EXPECT_EQ(detector.step_ns(i * 110 * kMs, i * 100 * kMs), std::nullopt);
  }
}

TEST(ClockStepDetector, StepInEitherDirection_ReportedOnce) {
  ClockStepDetector detector;
  detector.step_ns(0, 0);
  EXPECT_EQ(detector.step_ns(3700 * kMs, 100 * kMs), 3600 * kMs);
  EXPECT_EQ(detector.step_ns(3800 * kMs, 200 * kMs), std::nullopt);
  EXPECT_EQ(detector.step_ns(300 * kMs, 300 * kMs), -3600 * kMs);
}

}  // namespace
}  // namespace cornerd::daemon
