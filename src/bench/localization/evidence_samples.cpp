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
constexpr std::size_t kRandomFlats = 60;  ///< of each kind
/// Places of pairs of corners that are compared, as the localizer does.
constexpr std::size_t kMaxPairs = 8;
constexpr double kWrongMaps = 0.4;
/// Places of the map that a scan is tried at beside its own.
constexpr std::size_t kGivenPlaces = 3;
/// Log odds of a given place that the scan does not fit.
constexpr double kNowhere = -99;
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
  double gone = 0;    ///< share of the map's walls
  double ends_m = 0;  ///< standard deviation of walls' ends along them
  std::size_t samples = 800;
  replay::SensorModel sensor;

  bool is_right() const { return map == world && !mirrored; }
};

double draw_log_uniform(double low, double high, replay::Random& random) {
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

ScanConditions draw_conditions(std::size_t maps, replay::Random& random) {
  const auto any_map = [&] { return static_cast<std::size_t>(random.uniform() * maps); };
  ScanConditions drawn;
  drawn.world = drawn.map = any_map();
  drawn.samples = static_cast<std::size_t>(draw_log_uniform(250, 1450, random));
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

/// As a building is some years after its plan was drawn: one thing is wrong, or any.
ScanConditions draw_aged_conditions(std::size_t maps, replay::Random& random) {
  ScanConditions drawn;
  drawn.world = drawn.map = static_cast<std::size_t>(random.uniform() * static_cast<double>(maps));
  drawn.samples = static_cast<std::size_t>(draw_log_uniform(150, 2000, random));
  const auto only = static_cast<int>(random.uniform(0, 12));
  const auto is_wrong = [&](int kind) { return only < 6 ? only == kind : random.chance(0.5); };
  if (is_wrong(0)) drawn.map_error_m = draw_log_uniform(0.003, 0.06, random);
  if (is_wrong(1) || is_wrong(2)) drawn.clutter = random.uniform(0.02, 0.5);
  if (is_wrong(3)) drawn.gone = random.uniform(0, 0.2);
  if (drawn.gone > 0) drawn.ends_m = random.uniform(0, 0.1);
  if (is_wrong(4)) drawn.sensor.field_of_view.width_rad = core::radians(random.uniform(90, 300));
  if (is_wrong(5)) {
    drawn.sensor.noise.bearing_rad = core::radians(random.uniform(0, 0.5));
    drawn.sensor.noise.share = draw_log_uniform(0.002, 0.015, random);
    drawn.sensor.missing = random.uniform(0, 0.6);
    drawn.sensor.missing_run = draw_log_uniform(1, 8, random);
    drawn.sensor.outliers = random.uniform(0, 0.03);
  }
  return drawn;
}

core::FloorPlan aged(core::FloorPlan plan, const ScanConditions& drawn, replay::Random& random) {
  std::erase_if(plan.walls, [&](const core::Wall&) { return random.chance(drawn.gone); });
  for (core::Wall& wall : plan.walls) {
    const core::Vec2 along = (wall.to - wall.from).normalized();
    const double half_m = 0.45 * (wall.to - wall.from).norm();
    wall.from += std::min(half_m, drawn.ends_m * random.normal()) * along;
    wall.to += std::max(-half_m, drawn.ends_m * random.normal()) * along;
  }
  return plan;
}

}  // namespace

const char* const kEvidenceColumns =
    "scan,given,wrong_map,right,log_odds,rays,hits,shorts,violations,map_sigma,faces_log_ratio,"
    "faces,unseen_faces,predicted,predicted_hits,obstacles_m,missing_walls,rays_through,wall_ends,"
    "wall_m,segments";

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

  /// `is_given`: at the scan's own place and at random ones, in place of those that a search finds.
  std::string lines(const ScanConditions& drawn, const core::Scan& scan, const core::Pose2& truth,
                    bool is_given) {
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
    const core::ScanStructure structure = core::scan_structure(detection.segments);
    std::ostringstream text;
    const auto begin = [&] {
      search.begin(points, detection.segments, detection.breakpoints,
                   {.noise_scale = detection.noise_scale});
    };
    const auto write = [&](const core::VerifiedHypothesis& place) {
      const core::Pose2& at = place.refined.T_map_lidar;
      searcher->beam_model.meet(points.points(), ray_caster.cast(map, at, points.points()), at,
                                points.spacing_rad(), detection.noise_scale);
      const core::BeamStatistics s = searcher->beam_model.statistics(/*max_map_sigma_m=*/1);
      const bool right =
          drawn.is_right() &&
          core::same_pose(at, truth, kRight_m + kRightPerSigma * drawn.map_error_m, kRight_rad);
      text << scans << ',' << is_given << ',' << !drawn.is_right() << ',' << right << ','
           << place.log_odds << ',' << s.rays << ',' << s.hits << ',' << s.shorts << ','
           << s.free_space_violations << ',' << s.map_sigma_m << ',' << s.faces_log_ratio << ','
           << s.faces << ',' << s.unseen_faces << ',' << s.predicted << ',' << s.predicted_hits
           << ',' << s.obstacles_m << ',' << s.missing_walls << ',' << s.rays_through << ','
           << search.wall_ends(at) << ',' << structure.wall_m << ',' << structure.segments << '\n';
    };
    if (!is_given) {
      begin();
      search.consider(pairs.first(std::min(pairs.size(), kMaxPairs)));
      search.consider(searcher->map_search.find(points.points(), detection.segments));
      for (const core::VerifiedHypothesis& place : search.find()) write(place);
      return text.str();
    }
    std::vector<core::Pose2> given =
        replay::random_poses(map, kGivenPlaces, kRight_m, random.bits());
    given.push_back(truth);
    for (const core::Pose2& there : given) {
      begin();
      const core::PoseHypothesis hypothesis{there, 0};
      search.consider(std::span(&hypothesis, 1));
      core::VerifiedHypothesis place;
      place.refined.T_map_lidar = there;
      place.log_odds = kNowhere;
      const auto found = search.find();
      write(found.empty() ? place : found.front());
    }
    return text.str();
  }

  std::string take(const ScanConditions& drawn, bool is_given) {
    core::FloorPlan plan = maps[drawn.world]->plan();
    if (drawn.mirrored) plan = mirrored(std::move(plan));
    if (drawn.map_error_m > 0) {
      plan = replay::with_map_error(plan, drawn.map_error_m, random.bits());
    }
    plan = aged(std::move(plan), drawn, random);
    if (plan.walls.empty()) return {};
    const core::WallMap world(std::move(plan));
    try {
      const core::Pose2 truth = replay::random_poses(world, 1, kRight_m, random.bits()).front();
      return lines(drawn, take_scan(drawn, world, truth), truth, is_given);
    } catch (const std::runtime_error&) {
      return {};  // no room for so much clutter
    }
  }
};

EvidenceSamples::EvidenceSamples(std::vector<MapPtr> maps, std::uint64_t seed)
    : state_(std::make_unique<State>(std::move(maps), seed)) {
  for (std::uint64_t k = 1; k <= kOffices; ++k) {
    state_->maps.push_back(std::make_shared<const core::WallMap>(office_building(30 + 40 * k, k)));
  }
  for (std::uint64_t k = 1; k <= kRandomFlats; ++k) {
    state_->maps.push_back(std::make_shared<const core::WallMap>(partitioned_flat(k)));
    state_->maps.push_back(std::make_shared<const core::WallMap>(plain_flat(k)));
  }
  state_->searchers.resize(state_->maps.size());
}

EvidenceSamples::~EvidenceSamples() = default;

std::string EvidenceSamples::take() {
  ++state_->scans;
  replay::Random& random = state_->random;
  const std::size_t maps = state_->maps.size();
  const std::string found = state_->take(draw_conditions(maps, random), /*is_given=*/false);
  return found + state_->take(draw_aged_conditions(maps, random), /*is_given=*/true);
}

}  // namespace cornerd::bench
