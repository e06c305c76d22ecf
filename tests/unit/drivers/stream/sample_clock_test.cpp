// SPDX-License-Identifier: MIT
#include "drivers/stream/sample_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cornerd::drivers {
namespace {

constexpr double kPeriodS = 254e-6;
constexpr double kStartS = 100;

/// A device whose samples arrive with exponential delays of mean 2 ms.
class SimulatedArrivals {
 public:
  explicit SimulatedArrivals(double pace = 1) : period_s_(kPeriodS * pace) {}

  double true_s(std::uint64_t index) const {
    return kStartS + pause_s_ + static_cast<double>(index) * period_s_;
  }

  /// Feeds `count` samples in packets of 32; returns the largest error of their times.
  double run(SampleClock& clock, std::uint64_t count) {
    double worst_s = 0;
    for (const std::uint64_t end = index_ + count; index_ < end; ++index_) {
      if (index_ % 32 == 0) observe(clock);
      const double t_s = core::to_seconds(clock.time_of(index_));
      worst_s = std::max(worst_s, std::abs(t_s - true_s(index_)));
      EXPECT_GE(t_s, last_s_);
      last_s_ = t_s;
    }
    return worst_s;
  }

  /// The reader reads nothing for so long, then everything at once.
  void stall(double duration_s) { not_before_s_ = true_s(index_) + duration_s; }
  /// The device neither measures nor counts for so long.
  void pause(double duration_s) { pause_s_ += duration_s; }

 private:
  void observe(SampleClock& clock) {
    std::exponential_distribution<double> delay(1 / 2e-3);
    const double arrival_s = std::max(true_s(index_) + delay(random_), not_before_s_);
    clock.observe(index_, core::from_seconds(arrival_s));
  }

  double period_s_;
  double pause_s_ = 0;
  double not_before_s_ = 0;
  double last_s_ = 0;
  std::uint64_t index_ = 0;
  std::mt19937 random_{5};
};

TEST(SampleClock, JitteryArrivals_GiveTimesWithinHalfAMillisecond) {
  SampleClock clock(kPeriodS);
  SimulatedArrivals arrivals;
  arrivals.run(clock, 8000);
  EXPECT_LT(arrivals.run(clock, 40000), 0.5e-3);
  EXPECT_EQ(clock.resets(), 0U);
}

TEST(SampleClock, PeriodOnePercentOff_IsEstimated) {
  for (const double pace : {0.99, 1.01}) {
    SampleClock clock(kPeriodS);
    SimulatedArrivals arrivals(pace);
    EXPECT_LT(arrivals.run(clock, 4000), 15e-3) << "in the first second";
    arrivals.run(clock, 16000);
    EXPECT_LT(arrivals.run(clock, 40000), 0.5e-3);
    EXPECT_NEAR(clock.period_s() / (kPeriodS * pace), 1, 2e-4);
  }
}

TEST(SampleClock, StalledReader_ShiftsNoTimes) {
  for (const double stall_s : {0.1, 0.3, 1.0}) {
    SampleClock clock(kPeriodS);
    SimulatedArrivals arrivals;
    arrivals.run(clock, 20000);
    arrivals.stall(stall_s);
    EXPECT_LT(arrivals.run(clock, 20000), 1e-3) << stall_s;
    EXPECT_EQ(clock.resets(), 0U) << stall_s;
  }
}

TEST(SampleClock, StalledReader_IsUncertainUntilItHasCaughtUp) {
  SampleClock clock(kPeriodS);
  SimulatedArrivals arrivals;
  arrivals.run(clock, 20000);
  EXPECT_FALSE(clock.is_uncertain());
  arrivals.stall(2);
  arrivals.run(clock, 32);
  EXPECT_TRUE(clock.is_uncertain());
  arrivals.run(clock, 7000);
  EXPECT_TRUE(clock.is_uncertain()) << "of 7874 samples";
  arrivals.run(clock, 1000);
  EXPECT_FALSE(clock.is_uncertain());
  EXPECT_EQ(clock.resets(), 0U);
}

TEST(SampleClock, BacklogReadSlowly_IsNoPause) {
  SampleClock clock(kPeriodS);
  constexpr std::uint64_t kBefore = 16'000;
  constexpr std::uint64_t kBacklog = 8'000;
  const auto at = [](double index, double late_s) {
    return core::from_seconds(kStartS + index * kPeriodS + late_s);
  };
  std::uint64_t index = 0;
  for (; index < kBefore; index += 32) clock.observe(index, at(static_cast<double>(index), 0));
  // Read at the speed of measuring, so that the delay stays, as after a pause.
  for (; index < kBefore + kBacklog; index += 32) {
    clock.observe(index, at(static_cast<double>(index), 2), /*more_pending=*/true);
    ASSERT_TRUE(clock.is_uncertain()) << index;
  }
  clock.observe(index, at(static_cast<double>(index), 0.01));
  EXPECT_FALSE(clock.is_uncertain());
  EXPECT_NEAR(static_cast<double>(clock.time_of(kBefore) - at(kBefore, 0)), 0, 2e6);
}

TEST(SampleClock, PausedDevice_IsFollowedWithin300Ms) {
  SampleClock clock(kPeriodS);
  SimulatedArrivals arrivals;
  arrivals.run(clock, 20000);
  arrivals.pause(0.8);
  arrivals.run(clock, 32);
  EXPECT_TRUE(clock.is_uncertain());
  arrivals.run(clock, 1248);
  EXPECT_FALSE(clock.is_uncertain());
  EXPECT_EQ(clock.anchored_from(), 20000U);
  EXPECT_LT(arrivals.run(clock, 20000), 5e-3);
  EXPECT_EQ(clock.resets(), 1U);
}

TEST(SampleClock, Reanchor_KeepsThePeriod) {
  SampleClock clock(kPeriodS);
  SimulatedArrivals arrivals(1.01);
  arrivals.run(clock, 40000);
  clock.reanchor();
  EXPECT_NEAR(clock.period_s() / (kPeriodS * 1.01), 1, 2e-4);
  EXPECT_FALSE(clock.anchored());
  EXPECT_EQ(clock.resets(), 1U);
}

}  // namespace
}  // namespace cornerd::drivers
