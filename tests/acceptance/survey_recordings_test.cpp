// SPDX-License-Identifier: MIT
// Surveys of a real room and corridor in $CORNERD_RECORDINGS/room and /drive, recordings by others
// that are not part of the project. Skipped without them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/localizer.hpp"
#include "survey/survey.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/survey/survey_files.hpp"

namespace cornerd {
namespace {

namespace fs = std::filesystem;

/// Poses by registration of the same recordings (2 to 7 mm), in the frame of place 5.
constexpr std::array<core::Pose2, 5> kRegisteredPlaces = {{{0.0583, -1.2050, -0.50980},
                                                           {0.0626, -0.8514, -0.17760},
                                                           {0.0492, -0.7280, -0.01997},
                                                           {0.0103, -0.3480, 0.02060},
                                                           {0, 0, 0}}};

class RealRoom : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("CORNERD_RECORDINGS");
    if (folder == nullptr || !fs::exists(fs::path(folder) / "room")) {
      GTEST_SKIP() << "CORNERD_RECORDINGS names no folder with room in it";
    }
    folder_ = fs::path(folder) / "room";
  }

  survey::RecordedDrive load(int place) const {
    const std::vector<fs::path> files = {folder_ /
                                         ("pleum_00" + std::to_string(place) + ".ndjson")};
    return tool::load_drive(files, {}, {});
  }

  /// Poses of the scans with a fix or tracking.
  static std::vector<core::Pose2> localize(const std::shared_ptr<const core::WallMap>& map,
                                           const survey::RecordedDrive& drive) {
    core::Localizer localizer(map, {});
    std::vector<core::Pose2> poses;
    core::Scan scan;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      drive.load(i, scan);
      const core::PoseEstimate& pose = localizer.step(scan).pose;
      if (core::has_pose(pose.state)) {
        poses.push_back(pose.T_map_base);
      }
    }
    return poses;
  }

  static core::Pose2 median(const std::vector<core::Pose2>& poses) {
    const auto middle = [&](auto member) {
      std::vector<double> values;
      for (const core::Pose2& pose : poses) values.push_back(pose.*member);
      std::nth_element(values.begin(),
                       values.begin() + static_cast<std::ptrdiff_t>(poses.size() / 2),
                       values.end());
      return values[poses.size() / 2];
    };
    return {middle(&core::Pose2::x_m), middle(&core::Pose2::y_m), middle(&core::Pose2::theta_rad)};
  }

  fs::path folder_;
};

TEST_F(RealRoom, MapOfOneRecording_LocalizesOthersWithin3cm) {
  const survey::RecordedDrive drive = load(5);
  const auto map = std::make_shared<const core::WallMap>(survey::survey(drive, {}).plan);
  // The lidar moved in its first second: the registration's frame is its median pose.
  const auto own = localize(map, drive);
  ASSERT_FALSE(own.empty());
  const core::Pose2 T_place_map = median(own).inverse();
  for (int place = 1; place <= 4; ++place) {
    const survey::RecordedDrive scans = load(place);
    const auto poses = localize(map, scans);
    EXPECT_GE(poses.size(), scans.size() * 98 / 100) << "place " << place;
    for (const core::Pose2& pose : poses) {
      const core::Pose2 found = T_place_map * pose;
      const core::Pose2& known = kRegisteredPlaces[static_cast<std::size_t>(place - 1)];
      ASSERT_LT((found.translation() - known.translation()).norm(), 0.03) << "place " << place;
    }
  }
}

/// Walls of a metre and more along a corridor whose axis is nearly the map's x.
struct CorridorSide {
  core::Vec2 from;
  core::Vec2 to;
  double direction_rad = 0;
};

class RealCorridor : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const char* folder = std::getenv("CORNERD_RECORDINGS");
    if (folder == nullptr) return;
    const fs::path packed = fs::path(folder) / "drive/drive.ndjson.gz";
    if (!fs::exists(packed)) return;
    const test::TemporaryFolder unpacked;
    const fs::path recording = unpacked.path() / "drive.ndjson";
    const std::string unpack = "gunzip -c '" + packed.string() + "' > '" + recording.string() + "'";
    ASSERT_EQ(std::system(unpack.c_str()), 0);
    survey::SurveyConfig config;
    config.sensor.T_base_lidar = {-0.035, 0, 0};
    config.sensor.noise.bearing_rad = 0.005;  // bearings are rounded to a degree
    config.sensor.odometry.geometry = {0.0291, 0.19, 333.33, 65535};
    const std::vector<fs::path> files = {recording};
    result_ = std::make_unique<survey::SurveyResult>(
        survey::survey(tool::load_drive(files, {}, {}), config));
  }
  static void TearDownTestSuite() { result_.reset(); }
  void SetUp() override {
    if (!result_) GTEST_SKIP() << "CORNERD_RECORDINGS names no folder with drive in it";
  }

  /// Ordered from left to right.
  static std::vector<CorridorSide> sides(double least_y_m, double most_y_m) {
    std::vector<CorridorSide> found;
    for (const core::Wall& wall : result_->plan.walls) {
      CorridorSide side{wall.from, wall.to};
      if (side.from.x() > side.to.x()) std::swap(side.from, side.to);
      side.direction_rad = core::angle_of(side.to - side.from);
      const double y_m = (side.from.y() + side.to.y()) / 2;
      if ((side.to - side.from).norm() < 1 || std::abs(side.direction_rad) > core::radians(10)) {
        continue;
      }
      if (y_m > least_y_m && y_m < most_y_m) found.push_back(side);
    }
    return found;
  }
  static std::vector<CorridorSide> right_sides() { return sides(-0.8, -0.2); }
  static std::vector<CorridorSide> left_sides() { return sides(0.1, 1.1); }

  static std::unique_ptr<survey::SurveyResult> result_;
};
std::unique_ptr<survey::SurveyResult> RealCorridor::result_;

TEST_F(RealCorridor, Walls_AreStraightToHalfADegree) {
  std::vector<CorridorSide> walls = right_sides();
  for (const CorridorSide& side : left_sides()) walls.push_back(side);
  ASSERT_GE(walls.size(), 5U);
  const auto [least, most] = std::minmax_element(
      walls.begin(), walls.end(), [](const CorridorSide& one, const CorridorSide& other) {
        return one.direction_rad < other.direction_rad;
      });
  EXPECT_LT(most->direction_rad - least->direction_rad, core::radians(0.5));
}

TEST_F(RealCorridor, RightSideBetweenDoors_IsStraightTo2cm) {
  const std::vector<CorridorSide> walls = right_sides();
  core::Vec2 first = walls.front().from;
  core::Vec2 last = walls.front().to;
  for (const CorridorSide& side : walls) {
    if (side.from.x() < first.x()) first = side.from;
    if (side.to.x() > last.x()) last = side.to;
  }
  EXPECT_GT((last - first).norm(), 8.5);
  const core::Vec2 across = core::rotate_left((last - first).normalized());
  for (const CorridorSide& side : walls) {
    EXPECT_LT(std::abs(across.dot(side.from - first)), 0.02);
    EXPECT_LT(std::abs(across.dot(side.to - first)), 0.02);
  }
}

TEST_F(RealCorridor, Walls_HaveNoDuplicates) {
  for (const std::vector<CorridorSide>& walls : {right_sides(), left_sides()}) {
    double length_m = 0;
    for (std::size_t i = 0; i < walls.size(); ++i) {
      length_m += (walls[i].to - walls[i].from).norm();
      for (std::size_t j = 0; j < i; ++j) {
        const double both_m = std::min(walls[i].to.x(), walls[j].to.x()) -
                              std::max(walls[i].from.x(), walls[j].from.x());
        EXPECT_LT(both_m, 0.05) << walls[i].from.x() << " and " << walls[j].from.x();
      }
    }
    EXPECT_GT(length_m, 4);
  }
}

TEST_F(RealCorridor, SlippingTracks_OdometryIsAccepted) {
  EXPECT_TRUE(result_->has_odometry);
  EXPECT_FALSE(result_->rejected_odometry.has_value());
}

}  // namespace
}  // namespace cornerd
