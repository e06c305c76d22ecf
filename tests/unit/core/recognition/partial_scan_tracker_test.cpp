// SPDX-License-Identifier: MIT
#include "core/recognition/partial_scan_tracker.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "../fixtures.hpp"
#include "core/pipeline.hpp"

namespace cornerd::core {
namespace {

constexpr double kPartScan_s = 0.14;
const Pose2 kStart{1.2, 1.0, 0.4};

/// A robot at constant velocity in the daemon's pipeline.
class FollowedRobot {
 public:
  explicit FollowedRobot(const Twist2& motion, std::size_t updates_per_scan = 4)
      : motion_(motion), pipeline_(map_, config(updates_per_scan)) {}

  struct Part {
    PoseEstimate pose;
    Pose2 truth;
  };

  /// The poses of the parts of this many scans. `from`: the building around the lidar.
  std::vector<Part> drive(int scans, const WallMap* seen = nullptr) {
    std::vector<Part> parts;
    for (int k = 0; k < scans; ++k, ++scan_) {
      testing::ScanOptions options;
      options.scan_s = kPartScan_s;
      options.start_ns = static_cast<TimeNs>(scan_ * kPartScan_s * 1e9);
      options.motion = motion_;
      const Pose2 middle = truth(options.start_ns + static_cast<TimeNs>(kPartScan_s / 2 * 1e9));
      const Scan scan = source_.take(seen != nullptr ? *seen : *map_, middle, options);
      for (const Sample& sample : scan.samples()) {
        if (pipeline_.add(sample) != nullptr) ++complete_scans_;
        if (const PoseEstimate* pose = pipeline_.partial_pose())
          parts.push_back({*pose, truth(pose->t_ns)});
      }
    }
    return parts;
  }
  int complete_scans() const { return complete_scans_; }

 private:
  static LocalizerConfig config(std::size_t updates_per_scan) {
    LocalizerConfig config;
    config.updates_per_scan = updates_per_scan;
    return config;
  }
  Pose2 truth(TimeNs t_ns) const { return kStart * motion_.over(to_seconds(t_ns)); }

  Twist2 motion_;
  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::l_shaped_room());
  Pipeline pipeline_;
  testing::ScanSource source_{31};
  int scan_ = 0;
  int complete_scans_ = 0;
};

double error_m(const FollowedRobot::Part& part) {
  return (part.pose.T_map_base.translation() - part.truth.translation()).norm();
}

TEST(PartialScanTracker, EveryQuarter_PoseAtItsOwnTime) {
  FollowedRobot robot({0.2, 0, 0.5});
  const auto parts = robot.drive(10);
  // The first scan may be incomplete; the second is complete and ends with a pose.
  ASSERT_GE(parts.size(), 3U * 7);
  ASSERT_LE(parts.size(), 3U * 9);
  TimeNs before_ns = 0;
  for (const auto& part : parts) {
    EXPECT_EQ(part.pose.state, PoseState::kTracking);
    EXPECT_GT(part.pose.t_ns, before_ns);
    EXPECT_LT(error_m(part), 0.01);
    const double x_error_m = part.pose.T_map_base.x_m - part.truth.x_m;
    EXPECT_LT(x_error_m * x_error_m, 16 * part.pose.covariance(0, 0));
    before_ns = part.pose.t_ns;
  }
}

TEST(PartialScanTracker, CornersOfPart_AreCounted) {
  FollowedRobot robot({});
  std::size_t corners = 0;
  for (const auto& part : robot.drive(5)) corners += part.pose.corners;
  EXPECT_GE(corners, 6U);
}

TEST(PartialScanTracker, OneUpdatePerScan_IsTheScansPose) {
  FollowedRobot robot({0.2, 0, 0.5}, 1);
  EXPECT_TRUE(robot.drive(5).empty());
  EXPECT_EQ(robot.complete_scans(), 4);
}

TEST(PartialScanTracker, KidnappedRobot_NoPoseFromParts) {
  FollowedRobot robot({});
  ASSERT_FALSE(robot.drive(4).empty());
  const auto elsewhere = testing::make_map(testing::rectangular_room(2.2, 1.7));
  for (const auto& part : robot.drive(4, elsewhere.get())) {
    EXPECT_LT(error_m(part), 0.03) << "a part of another building named a place";
  }
}

}  // namespace
}  // namespace cornerd::core
