// SPDX-License-Identifier: MIT
#include "bench/localization/trials.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bench/building.hpp"
#include "bench/localization/cramer_rao.hpp"
#include "bench/localization/world.hpp"
#include "core/localizer.hpp"
#include "replay/simulator/map_error.hpp"
#include "replay/simulator/scan_simulator.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {
namespace {

using Maps = std::vector<std::shared_ptr<const core::WallMap>>;

constexpr std::size_t kTrialSamples = 800;

MappedBuilding as_mapped(const std::shared_ptr<const core::WallMap>& map) { return {map, {map}}; }

std::vector<MappedBuilding> as_mapped(const Maps& maps) {
  std::vector<MappedBuilding> buildings;
  for (const auto& map : maps) buildings.push_back(as_mapped(map));
  return buildings;
}

template <typename Change>
std::vector<MappedBuilding> changed(const Maps& maps, Change&& change) {
  std::vector<MappedBuilding> buildings;
  for (const auto& map : maps) {
    MappedBuilding building{map, {}};
    for (core::FloorPlan& plan : change(*map)) {
      building.worlds.push_back(std::make_shared<const core::WallMap>(std::move(plan)));
    }
    if (!building.worlds.empty()) buildings.push_back(std::move(building));
  }
  return buildings;
}

/// Buildings whose walls, or whose walls' ends, are each moved by N(0, sigma_m) from where the map
/// has them.
std::vector<MappedBuilding> with_walls_off(
    const std::shared_ptr<const core::WallMap>& map, double sigma_m,
    const std::function<decltype(replay::with_map_error)>& moved = replay::with_map_error) {
  constexpr std::uint64_t kBuildings = 20;
  MappedBuilding building{map, {}};
  for (std::uint64_t seed = 1; seed <= kBuildings; ++seed) {
    building.worlds.push_back(
        std::make_shared<const core::WallMap>(moved(map->plan(), sigma_m, seed)));
  }
  return {std::move(building)};
}

/// Visits one start pose after another.
class Robot {
 public:
  Robot(const Trial& trial, std::shared_ptr<const core::WallMap> map, std::uint64_t seed)
      : trial_(trial),
        map_(std::move(map)),
        seed_(seed),
        random_(seed),
        lidar_(trial.sensor, kTrialSamples, seed, trial.scan_ns),
        localizer_(map_, config(trial)),
        bound_(trial.sensor.noise, core::LocalizerConfig().max_range_m, trial.map_sigma_m) {}

  void visit(const core::WallMap& world, const core::Pose2& start, PoseScore& score) {
    // The clock starts anew at each pose, so the odometry has to be reset.
    if (trial_.odometry) {
      localizer_.forget();
    } else {
      localizer_.relocalize();
    }
    const replay::Motion motion = circling(start, trial_.motion);
    replay::SimulatedOdometry odometry(motion, {}, seed_++);
    std::vector<RoundObstacle> obstacles;
    if (trial_.clutter > 0) {
      obstacles = clutter_around(world, start.translation(), trial_.clutter, random_);
    }
    for (std::size_t k = 0; k < trial_.scans_each; ++k) {
      const auto start_ns = static_cast<core::TimeNs>(k) * trial_.scan_ns;
      const core::Scan& scan = lidar_.take(start_ns, [&](core::TimeNs t_ns, double bearing_rad) {
        const core::Pose2 at = motion(t_ns, 0);
        const double angle_rad = at.theta_rad + bearing_rad;
        return range_with_obstacles(
            obstacles, at.translation(), angle_rad,
            world.range_along(at.translation(), angle_rad, replay::ScanSimulator::kMaxRange_m));
      });
      if (trial_.updates_per_scan > 1) {
        follow(scan, motion, odometry, score);
        localizer_.step(scan);
        continue;
      }
      while (trial_.odometry && odometry.next_ns() <= scan.end_ns()) {
        localizer_.add(odometry.next());
      }
      const core::PoseEstimate& pose = localizer_.step(scan).pose;
      const core::Pose2 truth = motion(pose.t_ns, 0);
      points_.assign(scan, core::LocalizerConfig().min_range_m,
                     core::LocalizerConfig().max_range_m);
      score.add(pose, truth, bound_.bound(*map_, truth, points_));
    }
  }

 private:
  void follow(const core::Scan& scan, const replay::Motion& motion,
              replay::SimulatedOdometry& odometry, PoseScore& score) {
    for (const core::Sample& sample : scan.samples()) {
      while (trial_.odometry && odometry.next_ns() <= sample.t_ns) {
        localizer_.add(odometry.next());
      }
      const core::PoseEstimate* pose = localizer_.follow(sample);
      if (pose != nullptr) score.add(*pose, motion(pose->t_ns, 0));
    }
  }
  static core::LocalizerConfig config(const Trial& trial) {
    core::LocalizerConfig config;
    config.odometry.enabled = trial.odometry;
    config.updates_per_scan = trial.updates_per_scan;
    return config;
  }

  const Trial& trial_;
  std::shared_ptr<const core::WallMap> map_;
  std::uint64_t seed_;
  replay::Random random_;
  replay::ScanSimulator lidar_;
  core::Localizer localizer_;
  CramerRao bound_;
  core::PolarScan points_;
};

}  // namespace

std::vector<Trial> default_trials(const Maps& arenas,
                                  const std::shared_ptr<const core::WallMap>& flat) {
  constexpr double kDisplaced_m = 0.03;
  constexpr core::TimeNs kSlowScan_ns = 181'818'182;  // 5.5 scans a second
  const CircularMotion brisk{0.5, 1.5};
  const replay::SensorModel nominal;
  const auto with = [&](auto&& change) {
    replay::SensorModel sensor = nominal;
    change(sensor);
    return sensor;
  };
  const replay::SensorModel sparse = with([](auto& sensor) { sensor.missing = 0.6; });
  const replay::SensorModel biased = with([](auto& sensor) {
    sensor.range_scale = 1.01;
    sensor.range_offset_m = 0.005;
    sensor.eccentricity_rad = core::radians(0.3);
  });
  const auto displaced = changed(
      arenas, [](const core::WallMap& map) { return with_a_wall_displaced(map, kDisplaced_m); });
  const auto closed = changed(arenas, with_a_door_closed);
  const std::vector<MappedBuilding> arena = as_mapped(arenas);
  const std::vector<MappedBuilding> home = {as_mapped(flat)};
  const auto rooms = std::make_shared<const core::WallMap>(equal_rooms(12));

  std::vector<Trial> trials;
  const auto add = [&](std::string title, const auto& buildings) -> Trial& {
    Trial& trial = trials.emplace_back();
    trial.title = std::move(title);
    trial.buildings = buildings;
    return trial;
  };
  add("arena", arena);
  add("flat", home);
  add("12 equal rooms", std::vector{as_mapped(rooms)});
  Trial& bias = add("biased lidar, 20 scans each", arena);
  bias.sensor = biased;
  bias.scans_each = 20;
  add("60 % missing", arena).sensor = sparse;
  add("30 % of the rays stopped", arena).clutter = 0.3;
  add("a wall displaced by 3 cm", displaced);
  add("a door closed", closed);
  const auto add_off = [&](std::string title, const auto& map, double sigma_m) -> Trial& {
    Trial& trial = add(std::move(title), with_walls_off(map, sigma_m));
    trial.map_sigma_m = sigma_m;
    return trial;
  };
  add_off("walls off by 1 cm, arena", arenas.front(), 0.01);
  add_off("walls off by 1 cm, flat", flat, 0.01);
  add_off("walls off by 3 cm, flat", flat, 0.03);
  add_off("walls off by 5 cm, flat", flat, 0.05);
  add("ends of walls off by 1 cm, arena",
      with_walls_off(arenas.front(), 0.01, replay::with_end_error));
  add("ends of walls off by 1 cm, flat", with_walls_off(flat, 0.01, replay::with_end_error));
  add("40 % of the rays stopped, flat", home).clutter = 0.4;
  Trial& half = add("180 degrees, flat", home);
  half.sensor.field_of_view.width_rad = core::kPi;
  Trial& narrow = add("90 degrees, 0.3 m/s, 0.9 rad/s, first scans", home);
  narrow.sensor.field_of_view.width_rad = core::kPi / 2;
  narrow.motion = {0.3, 0.9};
  Trial& hard = add_off("240 degrees, 25 % stopped, 3 cm", flat, 0.03);
  hard.sensor.field_of_view.width_rad = core::radians(240);
  hard.clutter = 0.25;
  add("mirror image of the flat's map",
      std::vector{
          MappedBuilding{flat, {std::make_shared<const core::WallMap>(mirrored(flat->plan()))}}});
  for (const std::size_t updates : {1, 4}) {
    for (const bool odometry : {false, true}) {
      Trial& moving = add(std::string("0.5 m/s, 1.5 rad/s") + (odometry ? ", odometry" : "") +
                              (updates > 1 ? ", quarters of a scan" : ""),
                          home);
      moving.motion = brisk;
      moving.scans_each = 30;
      moving.scan_ns = kSlowScan_ns;
      moving.odometry = odometry;
      moving.updates_per_scan = updates;
    }
  }
  return trials;
}

PoseScore run_trial(const Trial& trial, std::size_t poses, std::uint64_t seed,
                    const std::function<void(std::size_t done)>& progress) {
  PoseScore score;
  std::size_t done = 0;
  const std::size_t buildings = trial.buildings.size();
  for (std::size_t b = 0; b < buildings; ++b) {
    const MappedBuilding& building = trial.buildings[b];
    Robot robot(trial, building.map, seed + b);
    const std::size_t worlds = building.worlds.size();
    const std::size_t share = poses * (b + 1) / buildings - poses * b / buildings;
    for (std::size_t w = 0; w < worlds; ++w) {
      const core::WallMap& world = *building.worlds[w];
      const std::size_t count = share * (w + 1) / worlds - share * w / worlds;
      for (const core::Pose2& start :
           random_circles(world, trial.motion, count, seed + 100 * b + 10'000 * w)) {
        robot.visit(world, start, score);
        if (progress) progress(++done);
      }
    }
  }
  return score;
}

}  // namespace cornerd::bench
