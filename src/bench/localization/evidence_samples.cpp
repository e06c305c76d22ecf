// SPDX-License-Identifier: MIT
#include "bench/localization/evidence_samples.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "bench/building.hpp"
#include "bench/localization/world.hpp"
#include "bench/partitioned_flat.hpp"
#include "core/breakpoint/detector.hpp"
#include "core/recognition/beam_model.hpp"
#include "core/recognition/map_search.hpp"
#include "core/recognition/place_evidence.hpp"
#include "core/recognition/place_search.hpp"
#include "replay/simulator/clutter.hpp"
#include "replay/simulator/map_error.hpp"
#include "replay/simulator/random_poses.hpp"
#include "replay/simulator/scan_simulator.hpp"

namespace cornerd::bench {
namespace {

using MapPtr = std::shared_ptr<const core::WallMap>;

constexpr std::size_t kOffices = 10;
constexpr std::size_t kRandomFlats = 60;
/// Places of pairs of corners that are compared, as the localizer does.
constexpr std::size_t kMaxPairs = 8;
constexpr double kWrongMaps = 0.4;
/// A place is the right one within this, and the more the more the map is off.
constexpr double kRight_m = 0.12;
constexpr double kRightPerSigma = 1.5;
constexpr double kRight_rad = core::radians(5);

/// What is drawn for one scan.
struct ScanConditions {
  std::size_t world = 0;
  std::size_t map = 0;
  bool mirrored = false;
  double map_error_m = 0;
  double clutter = 0;
  std::size_t samples = 800;
  replay::SensorModel sensor;

  bool is_right() const { return map == world && !mirrored; }
};

ScanConditions draw_conditions(std::size_t maps, replay::Random& random) {
  const auto any_map = [&] { return static_cast<std::size_t>(random.uniform() * maps); };
  ScanConditions drawn;
  drawn.world = drawn.map = any_map();
  drawn.samples = static_cast<std::size_t>(std::exp(random.uniform(std::log(250), std::log(1450))));
  if (random.chance(kWrongMaps)) {
    drawn.mirrored = random.chance(0.6);
    while (!drawn.mirrored && drawn.map == drawn.world) drawn.map = any_map();
    if (random.chance(0.3)) drawn.map_error_m = random.uniform(0, 0.05);
    return drawn;
  }
  const double kind = random.uniform();
  if (kind > 0.1 && kind < 0.4) drawn.map_error_m = random.uniform(0.01, 0.05);
  if (kind >= 0.4 && kind < 0.75) drawn.clutter = random.uniform(0.2, 0.42);
  if (kind >= 0.75 && kind < 0.87) {
    drawn.map_error_m = random.uniform(0.01, 0.04);
    drawn.clutter = random.uniform(0.05, 0.3);
  }
  if (kind >= 0.87) {
    drawn.sensor.field_of_view.width_rad = core::radians(random.uniform(180, 260));
  }
  if (random.chance(0.15)) drawn.sensor.missing = 0.4;
  if (random.chance(0.2)) {
    drawn.sensor.noise.bearing_rad = core::radians(0.4);
    drawn.sensor.noise.share = 0.01;
  }
  return drawn;
}

}  // namespace

const char* const kEvidenceColumns =
    "scan,wrong_map,right,rays,hits,map_sigma,faces_log_ratio,faces,unseen_faces,weakest_view,"
    "obstacles_m,missing_walls,log_missing,wall_ends,wall_m,segments";

struct EvidenceSamples::State {
  /// What localizes in one map.
  struct Searcher {
    explicit Searcher(const core::WallMap& map)
        : catalog(map, config.max_range_m),
          recognition(catalog),
          map_search(map),
          place_search(map, recognition, config),
          beam_model(map, config.noise),
          detector(config.detector, config.noise) {}
    core::LocalizerConfig config;
    core::Catalog catalog;
    core::Recognition recognition;
    core::MapSearch map_search;
    core::PlaceSearch place_search;
    core::BeamModel beam_model;
    core::Detector detector;
  };

  State(std::vector<MapPtr> the_maps, std::uint64_t seed)
      : maps(std::move(the_maps)), random(seed) {}

  std::vector<MapPtr> maps;
  replay::Random random;
  std::vector<std::unique_ptr<Searcher>> searchers;  ///< by map
  core::RayCaster ray_caster{core::LocalizerConfig{}.max_range_m};
  std::size_t scans = 0;

  core::Scan take_scan(const ScanConditions& drawn, const core::WallMap& world,
                       const core::Pose2& at) {
    std::vector<RoundObstacle> obstacles;
    MapPtr cluttered;
    const core::WallMap* seen = &world;
    if (drawn.clutter > 0 && random.chance(0.5)) {
      obstacles = clutter_around(world, at.translation(), drawn.clutter, random);
    } else if (drawn.clutter > 0) {
      core::FloorPlan plan = world.plan();
      const replay::ScannedPath path{{at}, {at.translation()}};
      for (const core::Wall& wall :
           replay::place_clutter(world, path, drawn.sensor, drawn.clutter, random.bits()).walls) {
        plan.walls.push_back(wall);
      }
      cluttered = std::make_shared<const core::WallMap>(std::move(plan));
      seen = cluttered.get();
    }
    replay::ScanSimulator lidar(drawn.sensor, drawn.samples, random.bits());
    return lidar.take(0, [&](core::TimeNs, double bearing_rad) {
      const double angle_rad = at.theta_rad + bearing_rad;
      return range_with_obstacles(
          obstacles, at.translation(), angle_rad,
          seen->range_along(at.translation(), angle_rad, replay::ScanSimulator::kMaxRange_m));
    });
  }

  std::string lines(const ScanConditions& drawn, const core::Scan& scan, const core::Pose2& truth) {
    auto& searcher = searchers[drawn.map];
    const core::WallMap& map = *maps[drawn.map];
    if (!searcher) searcher = std::make_unique<Searcher>(map);
    core::PolarScan points;
    points.assign(scan, searcher->config.min_range_m, searcher->config.max_range_m);
    core::Detection detection;
    searcher->detector.forget();
    searcher->detector.detect(points, detection);
    const auto pairs = searcher->recognition.from_pairs(detection.breakpoints);
    core::PlaceSearch& search = searcher->place_search;
    search.begin(points, detection.segments, detection.breakpoints, detection.noise_scale, 1,
                 /*fits_motion=*/false);
    search.consider(pairs.first(std::min(pairs.size(), kMaxPairs)));
    search.consider(searcher->map_search.find(points.points(), detection.segments));
    const core::ScanStructure structure = core::scan_structure(detection.segments);
    std::ostringstream text;
    for (const core::VerifiedHypothesis& place : search.find()) {
      const core::Pose2& at = place.refined.T_map_lidar;
      const core::BeamStatistics s = searcher->beam_model.statistics(
          points.points(), ray_caster.cast(map, at, points.points()), at, points.spacing_rad(),
          detection.noise_scale, 1);
      const bool right =
          drawn.is_right() &&
          core::same_pose(at, truth, kRight_m + kRightPerSigma * drawn.map_error_m, kRight_rad);
      text << scans << ',' << !drawn.is_right() << ',' << right << ',' << s.rays << ',' << s.hits
           << ',' << s.map_sigma_m << ',' << s.faces_log_ratio << ',' << s.faces << ','
           << s.unseen_faces << ',' << s.weakest_view_rad << ',' << s.obstacles_m << ','
           << s.missing_walls << ',' << s.log_missing << ',' << search.wall_ends(at) << ','
           << structure.wall_m << ',' << structure.segments << '\n';
    }
    return text.str();
  }
};

EvidenceSamples::EvidenceSamples(std::vector<MapPtr> maps, std::uint64_t seed)
    : state_(std::make_unique<State>(std::move(maps), seed)) {
  for (std::uint64_t k = 1; k <= kOffices; ++k) {
    state_->maps.push_back(std::make_shared<const core::WallMap>(office_building(30 + 40 * k, k)));
  }
  for (std::uint64_t k = 1; k <= kRandomFlats; ++k) {
    state_->maps.push_back(std::make_shared<const core::WallMap>(partitioned_flat(k)));
  }
  state_->searchers.resize(state_->maps.size());
}

EvidenceSamples::~EvidenceSamples() = default;

std::string EvidenceSamples::take() {
  ++state_->scans;
  replay::Random& random = state_->random;
  const ScanConditions drawn = draw_conditions(state_->maps.size(), random);
  core::FloorPlan plan = state_->maps[drawn.world]->plan();
  if (drawn.mirrored) plan = mirrored(std::move(plan));
  if (drawn.map_error_m > 0) {
    plan = replay::with_map_error(plan, drawn.map_error_m, random.bits());
  }
  const core::WallMap world(std::move(plan));
  const core::Pose2 truth = replay::random_poses(world, 1, kRight_m, random.bits()).front();
  try {
    return state_->lines(drawn, state_->take_scan(drawn, world, truth), truth);
  } catch (const std::runtime_error&) {
    return {};  // no room for so much clutter
  }
}

}  // namespace cornerd::bench
