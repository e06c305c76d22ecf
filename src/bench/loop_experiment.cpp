// SPDX-License-Identifier: MIT
#include "bench/loop_experiment.hpp"

#include <algorithm>
#include <vector>

#include "bench/building.hpp"
#include "bench/experiment_robot.hpp"

namespace cornerd::bench {
namespace {

using core::Vec2;

constexpr double kShortRange_m = 4;
constexpr std::size_t kRingScans = 850;
constexpr std::size_t kRoomsScans = 750;
constexpr std::size_t kRoomsInARow = 4;

SimulatedDrive slipping_drive(core::FloorPlan plan, const std::vector<Vec2>& path,
                              std::size_t scans, std::uint64_t seed, bool has_odometry) {
  SimulatedDriveConfig config;
  config.scans = scans;
  config.has_odometry = has_odometry;
  config.simulator.seed = seed;
  config.simulator.sensor.max_range_m = kShortRange_m;
  config.robot = wrong_robot();
  config.robot.slips_per_m = 0.3;
  config.robot.slip_share = 10;
  return simulate_drive(std::make_shared<const core::WallMap>(std::move(plan)),
                        replay::drive_path(path, gentle_drive(0.6)), config);
}

}  // namespace

SimulatedDrive ring_drive(std::uint64_t seed, bool has_odometry) {
  const std::vector<Vec2> around = {{0.8, 2}, {0.8, 0.8}, {19.2, 0.8}, {19.2, 7.2}, {0.8, 7.2}};
  return slipping_drive(ring_corridor(), around, kRingScans, seed, has_odometry);
}

SimulatedDrive equal_rooms_drive(std::uint64_t seed) {
  constexpr double kRoomWidth_m = 3.5;
  std::vector<Vec2> path;
  for (std::size_t room = 0; room < kRoomsInARow; ++room) {
    const Vec2 left(kRoomWidth_m * static_cast<double>(room), 0);
    for (const Vec2& point :
         {Vec2(1.2, 0.9), Vec2(1.2, 4), Vec2(2.2, 4.6), Vec2(1.2, 4.2), Vec2(1.2, 1.1)}) {
      path.push_back(left + point);
    }
  }
  return slipping_drive(equal_rooms(kRoomsInARow), path, kRoomsScans, seed, /*has_odometry=*/true);
}

LoopCase survey_loop(const core::WallMap& map, const SimulatedDrive& drive, bool close_loops) {
  survey::SurveyConfig config;
  config.close_loops = close_loops;
  LoopCase made;
  made.result = survey::survey(drive.drive, config);
  made.score = score_survey(map, drive.T_map_base, core::WallMap(made.result.plan),
                            drive.T_map_base.front());
  for (std::size_t i = 0; i < drive.T_map_base.size(); ++i) {
    const core::Pose2 truth = drive.T_map_base.front().inverse() * drive.T_map_base[i];
    made.worst_m = std::max(made.worst_m,
                            (truth.translation() - made.result.T_map_base[i].translation()).norm());
  }
  return made;
}

}  // namespace cornerd::bench
