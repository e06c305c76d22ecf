// SPDX-License-Identifier: MIT
#include "bench/floors_experiment.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "bench/building.hpp"
#include "bench/drawn_plan.hpp"
#include "bench/partitioned_flat.hpp"
#include "bench/simulated_drive.hpp"
#include "core/map_choice.hpp"
#include "replay/pose_error.hpp"
#include "replay/simulator/clutter.hpp"
#include "replay/simulator/random_poses.hpp"
#include "replay/simulator/scan_simulator.hpp"

namespace cornerd::bench {

namespace {

using core::FloorPlan;
using core::Vec2;
using core::WallMap;

constexpr std::size_t kMaps = 10;
constexpr std::size_t kFloorCorners = 200;
constexpr std::size_t kSamplesOfAScan = 800;
constexpr double kDriveSpeed_m_s = 0.4;
constexpr double kDrive_s = 25;
constexpr double kDrive_m = kDriveSpeed_m_s * kDrive_s;
constexpr std::size_t kScansAfterNaming = 7;
constexpr double kFurnished = 0.15;
/// Each with furniture of its own.
constexpr std::size_t kDrivesPerWorld = 20;
constexpr std::size_t kPosesOfFurniture = 100;
constexpr double kFurnitureClearance_m = 0.3;
/// Of the walls of a floor: gone, or elsewhere by half a metre.
constexpr double kShareOfChanges = 0.03;

std::shared_ptr<const WallMap> made(FloorPlan plan) {
  return std::make_shared<const WallMap>(std::move(plan));
}

/// The same plan with some walls gone and some moved along their normal.
FloorPlan changed_floor(FloorPlan plan, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<core::Wall> kept;
  for (core::Wall wall : plan.walls) {
    const double draw = share(random);
    if (draw < kShareOfChanges / 2) continue;
    if (draw < kShareOfChanges) {
      const Vec2 aside = 0.5 * core::rotate_left(wall.to - wall.from).normalized();
      if (aside.allFinite()) wall.from += aside;
      if (aside.allFinite()) wall.to += aside;
    }
    kept.push_back(wall);
  }
  plan.walls = std::move(kept);
  return plan;
}

/// The building that is driven in: with what stands in no map.
std::shared_ptr<const WallMap> furnished(const std::shared_ptr<const WallMap>& map, double share,
                                         std::uint64_t seed) {
  if (share == 0) return map;
  replay::ScannedPath path;
  path.T_map_lidar = replay::random_poses(*map, kPosesOfFurniture, kFurnitureClearance_m, seed);
  FloorPlan plan = map->plan();
  const replay::Clutter clutter = replay::place_clutter(*map, path, {}, share, seed);
  plan.walls.insert(plan.walls.end(), clutter.walls.begin(), clutter.walls.end());
  return made(std::move(plan));
}

struct StartedRobot {
  core::MapChoice choice;
  replay::ScanSimulator lidar;
  core::TimeNs now_ns = 0;
};

/// One drive, until a second after a map is named.
void drive(StartedRobot& robot, const WallMap& world, std::uint64_t seed,
           const std::function<bool(std::size_t map)>& is_true, FloorScore& score) {
  const std::vector<Vec2> path = random_drive(world, kDrive_m, seed);
  const replay::DriveConfig config = gentle_drive(kDriveSpeed_m_s);
  const replay::Motion motion = replay::drive_path(path, config);
  const auto count = static_cast<std::size_t>(core::from_seconds(kDrive_s) / robot.lidar.scan_ns());
  robot.choice.relocalize();
  robot.choice.forget_lidar();
  double driven_m = 0;
  std::size_t after = 0;
  core::Vec2 last = path.front();
  const core::PoseEstimate* pose = nullptr;
  for (std::size_t k = 0; k < count && after < kScansAfterNaming; ++k) {
    const core::TimeNs start_ns = robot.now_ns;
    const auto here = [&](core::TimeNs t_ns, std::int64_t scan) {
      return motion(t_ns - start_ns + static_cast<core::TimeNs>(k) * robot.lidar.scan_ns(), scan);
    };
    pose = &robot.choice.step(robot.lidar.take(world, start_ns, here)).pose;
    robot.now_ns += robot.lidar.scan_ns();
    const core::Pose2 truth = here(pose->t_ns, 0);
    driven_m += (truth.translation() - last).norm();
    last = truth.translation();
    if (!robot.choice.map()) continue;
    if (!is_true(*robot.choice.map())) break;
    if (after++ == 0) {
      score.scans.push_back(static_cast<double>(k + 1));
      score.driven_m.push_back(driven_m);
    }
    ++score.poses;
    score.lost_poses += has_pose(pose->state) ? 0 : 1;
    score.wrong_poses +=
        has_pose(pose->state) && !replay::is_right(pose->T_map_base, truth) ? 1 : 0;
  }
  ++score.starts;
  if (robot.choice.map()) {
    ++(is_true(*robot.choice.map()) ? score.right : score.wrong);
    return;
  }
  const auto in_doubt = robot.choice.filter().in_doubt();
  if (in_doubt.empty()) {
    ++score.none;
  } else {
    ++(std::any_of(in_doubt.begin(), in_doubt.end(), is_true) ? score.ambiguous
                                                              : score.without_truth);
  }
}

}  // namespace

std::vector<MapSet> map_sets(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const FloorPlan floor = office_building(kFloorCorners, seed);
  std::vector<MapSet> sets(5);
  sets[0] = {"ten floors", {}, kMaps};
  sets[2] = {"a floor twice, eight others", {}, 2};
  sets[3] = {"ten flats", {}, kMaps};
  sets[4] = {"a flat that is in no map", {}, 0};
  for (std::size_t i = 0; i < kMaps; ++i) {
    sets[0].maps.push_back(made(changed_floor(floor, random)));
    sets[3].maps.push_back(made(partitioned_flat(seed + i)));
    sets[4].maps.push_back(made(partitioned_flat(seed + kMaps + i)));
  }
  sets[1] = {"ten furnished floors", sets[0].maps, kMaps, kFurnished};
  sets[2].maps = {made(floor), made(floor)};
  sets[2].maps.insert(sets[2].maps.end(), sets[0].maps.begin() + 2, sets[0].maps.end());
  return sets;
}

FloorScore run_map_set(const MapSet& set, std::size_t starts, std::uint64_t seed,
                       const std::function<void(std::size_t done)>& done) {
  // A world that is in none of the maps.
  const auto elsewhere = made(partitioned_flat(seed + 1000));
  StartedRobot robot{core::MapChoice(set.maps, {}),
                     replay::ScanSimulator({}, kSamplesOfAScan, seed + 1)};
  const std::size_t worlds = std::max<std::size_t>(1, set.taken_in);
  FloorScore score;
  std::shared_ptr<const WallMap> world;
  for (std::size_t k = 0; k < starts; ++k) {
    const std::size_t floor = k / kDrivesPerWorld % worlds;
    const std::uint64_t seed_of_drive = seed + 2 + k;
    if (k % kDrivesPerWorld == 0) {
      world =
          furnished(set.taken_in > 0 ? set.maps[floor] : elsewhere, set.furnished, seed_of_drive);
    }
    const auto is_true = [&](std::size_t map) {
      return set.taken_in == kMaps ? map == floor : map < set.taken_in;
    };
    drive(robot, *world, seed_of_drive, is_true, score);
    done(score.starts);
  }
  return score;
}

}  // namespace cornerd::bench
