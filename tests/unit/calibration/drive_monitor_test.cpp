// SPDX-License-Identifier: MIT
#include "calibration/drive_monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "calibration/drive_fault_text.hpp"

namespace cornerd::calibration {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A robot in circles of alternating sense, whose left and right counts may be exchanged.
class CirclingDrive {
 public:
  explicit CirclingDrive(bool is_swapped) : is_swapped_(is_swapped) {}

  /// 50 readings and 10 poses a second, up to `end_s`.
  void run(double end_s, bool sends, core::TimeNs clock_ns = 0) {
    for (; step_ * 0.02 < end_s; ++step_) {
      const core::TimeNs t_ns = step_ * core::TimeNs{20'000'000};
      const double rotation_rad = 0.02 * std::sin(step_ * 0.02);
      T_map_base_ = T_map_base_ * core::arc(0.008, rotation_rad);
      const double half_m = rotation_rad * config_.geometry.track_m / 2;
      left_m_ += 0.008 - half_m;
      right_m_ += 0.008 + half_m;
      if (sends) {
        core::OdometryReading reading;
        reading.t_ns = t_ns + clock_ns;
        reading.left = std::llround(left_m_ / config_.geometry.metres_per_count());
        reading.right = std::llround(right_m_ / config_.geometry.metres_per_count());
        if (is_swapped_) std::swap(reading.left, reading.right);
        monitor_.add(reading);
      }
      if (step_ % 5 == 0) monitor_.add(t_ns, place(step_ / 5));
    }
  }
  auto names() { return names_of(monitor_.faults()); }

  /// From now on somebody names a wrong place every few seconds, and scans are found near it for a
  /// while.
  void be_told_wrong_places() { is_told_ = true; }

 private:
  core::Pose2 place(int scan) {
    const int since = scan % 25;
    if (!is_told_ || since > 3) return T_map_base_;
    if (since == 0) monitor_.interrupt();
    return core::Pose2{0.2, 0.1, 0.6} * T_map_base_;
  }

  bool is_swapped_;
  bool is_told_ = false;
  core::OdometryConfig config_;
  DriveMonitor monitor_{config_, {}};
  core::Pose2 T_map_base_;
  double left_m_ = 0;
  double right_m_ = 0;
  int step_ = 0;
};

TEST(DriveMonitor, ReadingsThatEnd_HaveNoFaultAnyMore) {
  CirclingDrive drive(/*is_swapped=*/true);
  drive.run(20, true);
  EXPECT_THAT(drive.names(), ElementsAre("wheels-swapped"));
  drive.run(21, false);
  EXPECT_THAT(drive.names(), ElementsAre("wheels-swapped"));
  drive.run(25, false);
  EXPECT_THAT(drive.names(), IsEmpty());
}

TEST(DriveMonitor, WrongInitialPoses_AreNoFaultOfTheWheels) {
  CirclingDrive drive(/*is_swapped=*/false);
  drive.be_told_wrong_places();
  drive.run(60, true);
  EXPECT_THAT(drive.names(), IsEmpty());
}

TEST(DriveMonitor, ReadingsOfAnotherClock_HaveNoFault) {
  CirclingDrive drive(/*is_swapped=*/true);
  drive.run(20, true, 5 * core::kNsPerSecond);
  EXPECT_THAT(drive.names(), IsEmpty());
}

}  // namespace
}  // namespace cornerd::calibration
