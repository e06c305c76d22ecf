// SPDX-License-Identifier: MIT
#include "core/odometry/delay_finder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/odometry/odometry_increment.hpp"

namespace cornerd::core {
namespace {

constexpr double kFirst_s = 0;
constexpr double kUsual_s = 0.03;

/// Readings at 50 Hz and a fix every 0.14 s of a robot that starts, stops and turns, without noise.
class Rides {
 public:
  explicit Rides(double late_s) : late_s_(late_s) {}

  void go(double seconds, double speed_m_s, double rate_rad_s) {
    for (double end_s = t_s_ + seconds; t_s_ < end_s;) {
      const TimeNs from_ns = from_seconds(t_s_ + late_s_);
      t_s_ += kReading_s;
      const Pose2 motion = arc(speed_m_s * kReading_s, rate_rad_s * kReading_s);
      path.add(from_ns, from_seconds(t_s_ + late_s_), motion);
      T_map_base_ = T_map_base_ * motion;
      if (++readings_ % 7 == 0) {
        finder.fixed(from_seconds(t_s_), T_map_base_, Covariance3::Identity() * 1e-7, path);
      }
    }
  }
  /// Three seconds with a change of speed every half second.
  void go_about() {
    for (int i = 0; i < 3; ++i) {
      go(0.5, 0.4, i);
      go(0.5, 0.1, -1);
    }
  }

  DelayFinder finder;
  MotionPath path;

 private:
  static constexpr double kReading_s = 0.02;
  double late_s_;
  double t_s_ = 10;
  int readings_ = 0;
  Pose2 T_map_base_;
};

TEST(DelayFinder, AnyDelay_IsEstimatedToMilliseconds) {
  for (const double late_s : {-0.17, -0.1, -0.05, 0.04, 0.1, 0.17}) {
    Rides ride(late_s);
    ride.go_about();
    const auto found = ride.finder.instead_of(0);
    ASSERT_TRUE(found) << late_s;
    EXPECT_NEAR(*found, late_s, 0.006);
    EXPECT_LT(ride.finder.doubt_about(*found, kFirst_s, kUsual_s), 0.01 * 0.01);
    EXPECT_GT(ride.finder.doubt_about(0, kFirst_s, kUsual_s), 0.02 * 0.02);
  }
}

TEST(DelayFinder, CorrectDelay_IsUnchanged) {
  Rides ride(0.1);
  ride.go_about();
  EXPECT_FALSE(ride.finder.instead_of(0.1));
  EXPECT_FALSE(ride.finder.instead_of(0.11)) << "the filter's own to find";
}

TEST(DelayFinder, SteadyMotion_DelayIsUnobservable) {
  Rides ride(0.1);
  ride.go(10, 0.4, 0.8);
  EXPECT_FALSE(ride.finder.instead_of(0));
  EXPECT_NEAR(std::sqrt(ride.finder.doubt_about(0, kFirst_s, kUsual_s)), 0.03, 0.01);
}

TEST(DelayFinder, NoData_HasPriorSigma) {
  const DelayFinder finder;
  const double little_s2 = finder.doubt_about(0, kFirst_s, 0.01);
  EXPECT_LT(little_s2, finder.doubt_about(0, kFirst_s, 0.05));
  EXPECT_LT(finder.doubt_about(0.1, 0.1, 0.01), 0.025 * 0.025);
  EXPECT_GT(finder.doubt_about(0.1, 0, 0.01), 0.05 * 0.05);
}

TEST(DelayFinder, DelayJumps_IsEstimatedAgain) {
  DelayFinder finder;
  Rides before(0.02);
  Rides after(0.1);
  before.go_about();
  ASSERT_FALSE(before.finder.instead_of(0.02));
  after.finder = before.finder;
  after.finder.interrupt();
  after.go_about();
  after.go_about();
  const auto found = after.finder.instead_of(0.02);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 0.1, 0.01);
}

/// Exchanged wheel directions are no delay.
TEST(DelayFinder, UnexplainedResiduals_DelayIsUnchanged) {
  Rides ride(0);
  Rides mirrored(0);
  for (int i = 0; i < 6; ++i) {
    ride.go(0.5, 0.3, i % 2 == 0 ? 1.5 : -0.5);
    mirrored.go(0.5, 0.3, i % 2 == 0 ? -1.5 : 0.5);
  }
  DelayFinder finder;
  Pose2 T_map_base;
  for (TimeNs t_ns = from_seconds(10.3); t_ns < from_seconds(12.7); t_ns += 140'000'000) {
    const Pose2 T_then = ride.path.at(from_seconds(10.3)).inverse() * ride.path.at(t_ns);
    finder.fixed(t_ns, T_then, Covariance3::Identity() * 1e-7, mirrored.path);
  }
  EXPECT_FALSE(finder.instead_of(0));
}

}  // namespace
}  // namespace cornerd::core
