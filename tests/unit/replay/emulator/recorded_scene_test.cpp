// SPDX-License-Identifier: MIT
#include "replay/emulator/recorded_scene.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "replay/simulator/simulated_recording.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

class RecordedRoom : public ::testing::Test {
 protected:
  RecordedRoom() {
    SimulatedRecordingConfig config;
    config.scans = 2;
    config.simulator.sensor = SensorModel::perfect();
    RecordingWriter writer(file_);
    simulate_recording(make_room(), visit_poses({kFirst, kSecond}, 1), config, writer, nullptr);
  }

  static double true_range(const core::Pose2& pose, double bearing_rad) {
    return make_room()->range_along(pose.translation(), pose.theta_rad + bearing_rad, 100);
  }

  const core::Pose2 kFirst{0.8, 1.0, 0};
  const core::Pose2 kSecond{1.2, 2.0, 0};
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "a.ndjson";
};

TEST_F(RecordedRoom, Scans_RepeatEndlessly) {
  RecordedScene scene(file_, {});
  for (std::int64_t scan = -1; scan < 6; ++scan) {
    const core::Pose2& pose = scan <= 0 || scan % 2 == 0 ? kFirst : kSecond;
    for (const double bearing_rad : {0.1, 1.6, -1.5, 3.1}) {
      EXPECT_NEAR(scene.range_along(0, scan, core::Vec2::Zero(), bearing_rad),
                  true_range(pose, bearing_rad), 0.02)
          << scan << " " << bearing_rad;
    }
  }
}

TEST_F(RecordedRoom, RayOffsetFromTheAxis_HitsTheSameWall) {
  RecordedScene scene(file_, {});
  // The wall at x = 2 is 1.2 m ahead, also 5 cm beside the axis.
  for (const double left_m : {-0.05, 0.05}) {
    EXPECT_NEAR(scene.range_along(0, 0, {0, left_m}, 0), 1.2, 0.01);
  }
}

TEST_F(RecordedRoom, OtherFormat_GivesTheRecordedRanges) {
  for (const auto format : {rplidar::WireFormat::kStandard, rplidar::WireFormat::kUltra}) {
    SimulatorConfig config;
    config.wire = format;
    config.sensor = SensorModel::perfect();
    Simulator simulator(std::make_unique<RecordedScene>(file_, RecordingOptions{}), config);
    int checked = 0;
    while (checked < 200) {
      for (const SimulatedSample& sample : simulator.next().samples) {
        if (sample.scan != 0) continue;
        ++checked;
        const double bearing_rad = -core::radians(sample.device_angle_deg);
        EXPECT_NEAR(sample.dist_q2 / 4000.0, true_range(kFirst, bearing_rad), 0.04);
      }
    }
  }
}

TEST(RecordedScene, RecordingWithoutAScan_IsRefused) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.bin") << "no measurement";
  EXPECT_THROW(RecordedScene(folder.path() / "a.bin", {}), RecordingError);
}

}  // namespace
}  // namespace cornerd::replay
