// SPDX-License-Identifier: MIT
#include "fixtures.hpp"

#include <cmath>
#include <random>
#include <utility>

namespace cornerd::core::testing {
namespace {

constexpr double kThickness_m = 0.02;

/// Wall centre lines half a thickness outside the given inner outline.
void add_box(FloorPlan& plan, double x0, double y0, double x1, double y1) {
  const double h = kThickness_m / 2;
  const Vec2 a(x0 - h, y0 - h);
  const Vec2 b(x1 + h, y0 - h);
  const Vec2 c(x1 + h, y1 + h);
  const Vec2 d(x0 - h, y1 + h);
  for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}}) {
    plan.walls.push_back({from, to, kThickness_m});
  }
}

}  // namespace

FloorPlan rectangular_room(double width_m, double depth_m) {
  FloorPlan plan;
  add_box(plan, 0, 0, width_m, depth_m);
  return plan;
}

FloorPlan l_shaped_room() {
  FloorPlan plan;
  const double h = kThickness_m / 2;
  const Vec2 outline[] = {{-h, -h},           {4 + h, -h},      {4 + h, 1.8 + h},
                          {2.5 + h, 1.8 + h}, {2.5 + h, 3 + h}, {-h, 3 + h}};
  for (std::size_t i = 0; i < std::size(outline); ++i) {
    plan.walls.push_back({outline[i], outline[(i + 1) % std::size(outline)], kThickness_m});
  }
  plan.rooms.push_back({"nook", {{0, 1.8}, {2.5, 1.8}, {2.5, 3}, {0, 3}}});
  plan.rooms.push_back({"hall", {{0, 0}, {4, 0}, {4, 3}, {0, 3}}});
  return plan;
}

FloorPlan equal_rooms(int count) {
  FloorPlan plan;
  for (int i = 0; i < count; ++i) {
    const double x = 5.0 * i;
    add_box(plan, x, 0, x + 3, 2);
    plan.walls.push_back({{x + 1, 0}, {x + 1, 0.7}, kThickness_m});  // breaks the room's symmetry
  }
  return plan;
}

FloorPlan with_walls_off(FloorPlan plan, double sigma_m, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> off_m(0, sigma_m);
  for (Wall& wall : plan.walls) {
    const Vec2 across = off_m(random) * rotate_left((wall.to - wall.from).normalized());
    wall.from += across;
    wall.to += across;
  }
  return plan;
}

std::shared_ptr<const WallMap> make_map(FloorPlan plan) {
  return std::make_shared<const WallMap>(std::move(plan));
}

double ScanSource::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
}

double ScanSource::normal() {
  return std::sqrt(-2 * std::log(1 - uniform(0, 1))) * std::cos(uniform(0, kTwoPi));
}

Pose2 ScanSource::place_in(double low_x_m, double high_x_m, double low_y_m, double high_y_m) {
  return {uniform(low_x_m, high_x_m), uniform(low_y_m, high_y_m), uniform(-kPi, kPi)};
}

Scan ScanSource::take(const WallMap& map, const Pose2& T_map_lidar, const ScanOptions& options) {
  Scan scan;
  for (int i = 0; i < options.samples; ++i) {
    const double share = static_cast<double>(i) / options.samples;
    const double bearing = options.first_bearing_rad - kTwoPi * share;
    const double dt_s = (share - 0.5) * options.scan_s;
    const Pose2 T_map_now = T_map_lidar * options.motion.twist.over(dt_s) *
                            Pose2{0, 0, options.motion.alpha_rad_s2 / 2 * dt_s * dt_s};
    const double aside = options.with_noise ? options.noise.bearing_rad * normal() : 0;
    double range =
        map.range_along(T_map_now.translation(), T_map_now.theta_rad + bearing + aside, 12);
    if (options.with_noise) range += options.noise.sigma_range_m(range) * normal();
    if (uniform(0, 1) < options.missing_share) range = 0;
    Sample sample;
    sample.t_ns = options.start_ns + from_seconds(share * options.scan_s);
    sample.bearing_rad = static_cast<float>(normalize_angle(bearing));
    sample.range_m = static_cast<float>(range);
    sample.starts_scan = i == 0;
    scan.add(sample);
  }
  return scan;
}

PolarScan polar(const Scan& scan) {
  PolarScan points;
  points.assign(scan, 0.05, 12);
  return points;
}

}  // namespace cornerd::core::testing
