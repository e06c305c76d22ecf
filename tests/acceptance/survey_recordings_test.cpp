// SPDX-License-Identifier: MIT
// A survey of a real room, where somebody has its recordings: $CORNERD_RECORDINGS/room. They were
// recorded by others and are not part of the project.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/localizer.hpp"
#include "survey/survey.hpp"
#include "tool/survey_files.hpp"

namespace cornerd {
namespace {

namespace fs = std::filesystem;

/// Registration of the same recordings (2 to 7 mm), in the frame of place 5.
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

  /// Poses of the turns that name one.
  static std::vector<core::Pose2> localize(const std::shared_ptr<const core::WallMap>& map,
                                           const survey::RecordedDrive& drive) {
    core::Localizer localizer(map, {});
    std::vector<core::Pose2> poses;
    core::Scan turn;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      drive.load(i, turn);
      const core::PoseEstimate& pose = localizer.step(turn).pose;
      if (core::names_a_place(pose.state)) {
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

TEST_F(RealRoom, MapOfOnePlace_LocalizesTheOthersWithin3cm) {
  const survey::RecordedDrive drive = load(5);
  const auto map = std::make_shared<const core::WallMap>(survey::survey(drive, {}).plan);
  // The lidar moved in its first second: its usual place is the frame of the registration.
  const auto own = localize(map, drive);
  ASSERT_FALSE(own.empty());
  const core::Pose2 T_place_map = median(own).inverse();
  for (int place = 1; place <= 4; ++place) {
    const survey::RecordedDrive turns = load(place);
    const auto poses = localize(map, turns);
    EXPECT_GE(poses.size(), turns.size() * 98 / 100) << "place " << place;
    for (const core::Pose2& pose : poses) {
      const core::Pose2 found = T_place_map * pose;
      const core::Pose2& known = kRegisteredPlaces[static_cast<std::size_t>(place - 1)];
      ASSERT_LT((found.translation() - known.translation()).norm(), 0.03) << "place " << place;
    }
  }
}

}  // namespace
}  // namespace cornerd
