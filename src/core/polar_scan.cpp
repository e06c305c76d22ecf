// SPDX-License-Identifier: MIT
#include "core/polar_scan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/angle.hpp"
#include "core/geometry/small_angle.hpp"

namespace cornerd::core {

namespace {

/// A return is lonely where less than this share of the samples about it are returns.
constexpr double kNeighbourhood_rad = radians(10);
constexpr double kCompany = 0.25;

PolarPoint point_at(double bearing_rad, double range_m, double dt_s, const Vec2& ray) {
  return {bearing_rad, range_m, ray.x(), ray.y(), range_m * ray.x(), range_m * ray.y(), dt_s};
}

/// Rays in the order of a turn: each is the one before turned a little, one of some is computed
/// afresh, so that nothing adds up.
class RayFan {
 public:
  const Vec2& at(double bearing_rad) {
    if (left_-- == 0) {
      left_ = kTurnedInARow;
      ray_ = unit_vector(bearing_rad);
    } else {
      ray_ = turned(ray_, bearing_rad - bearing_rad_);
    }
    bearing_rad_ = bearing_rad;
    return ray_;
  }

 private:
  static constexpr int kTurnedInARow = 31;
  int left_ = 0;
  double bearing_rad_ = 0;
  Vec2 ray_ = Vec2::Zero();
};

PolarPoint unbiased(const PolarPoint& point, const SensorBias& bias) {
  const double bearing_rad = bias.true_bearing_rad(point.bearing_rad, point.ray_y, point.ray_x);
  return point_at(bearing_rad, std::max(bias.true_range_m(point.range_m), 1e-6), point.dt_s,
                  turned(point.ray(), angle_between(point.bearing_rad, bearing_rad)));
}

/// Goes through the returns of a turn in the order of their bearing, round and round.
class Cursor {
 public:
  Cursor(std::span<const PolarPoint> points, double round_rad)
      : points_(points), round_rad_(round_rad) {}
  double bearing_rad() const { return points_[i_].bearing_rad + round_rad_; }
  void go_on() {
    if (++i_ < points_.size()) return;
    i_ = 0;
    round_rad_ += kTwoPi;
  }

 private:
  std::span<const PolarPoint> points_;
  double round_rad_;
  std::size_t i_ = 0;
};

PolarPoint moved(const PolarPoint& point, const Twist2& motion) {
  const double dt_s = point.dt_s;
  const double rotation_rad = motion.omega_rad_s * dt_s;
  // Along an arc, as Twist2::over() has it, by series: turns are small.
  const double along = 1 - rotation_rad * rotation_rad / 6;
  const double aside = rotation_rad / 2 * (1 - rotation_rad * rotation_rad / 12);
  const Vec2 place = Vec2(along * motion.vx_m_s - aside * motion.vy_m_s,
                          aside * motion.vx_m_s + along * motion.vy_m_s) *
                         dt_s +
                     turned(point.place(), rotation_rad);
  const double range_m = std::max(place.norm(), 1e-6);
  const Vec2 ray = place * (1 / range_m);
  return {normalize_angle(point.bearing_rad + rotation_between(point.ray(), place)),
          range_m,
          ray.x(),
          ray.y(),
          place.x(),
          place.y(),
          dt_s};
}

}  // namespace

PolarScan::PolarScan() { points_.reserve(kMaxSamplesPerScan); }

void PolarScan::assign(const Scan& scan, double min_range_m, double max_range_m, TimeNs at_ns,
                       const Twist2& motion, const SensorBias& bias) {
  points_.clear();
  const bool biased = !bias.is_none();
  const bool moves = !motion.is_rest();
  RayFan rays;
  for (const Sample& sample : scan.samples()) {
    const double range_m = sample.range_m;
    if (!(range_m >= min_range_m && range_m <= max_range_m)) continue;
    const double dt_s = to_seconds(sample.t_ns - at_ns);
    PolarPoint point = point_at(sample.bearing_rad, range_m, dt_s, rays.at(sample.bearing_rad));
    if (biased) point = unbiased(point, bias);
    points_.push_back(moves ? moved(point, motion) : point);
  }
  spacing_rad_ = scan.empty() ? 0 : kTwoPi / static_cast<double>(scan.size());
  sort();
}

void PolarScan::begin(double spacing_rad) {
  points_.clear();
  spacing_rad_ = spacing_rad;
}

void PolarScan::append(double bearing_rad, double range_m) {
  if (points_.size() < kMaxSamplesPerScan)
    points_.push_back(point_at(bearing_rad, range_m, 0, unit_vector(bearing_rad)));
}

double PolarScan::widest_gap_rad() const {
  const double enough = std::max(2.0, kCompany * 2 * kNeighbourhood_rad / spacing_rad_);
  // Those about a return: from `first` to before `end`, begun in the round before.
  Cursor first(points_, -kTwoPi);
  Cursor end = first;
  std::size_t company = 0;
  std::optional<double> first_rad;
  double last_rad = 0;
  double widest_rad = 0;
  for (const PolarPoint& point : points_) {
    while (first.bearing_rad() < point.bearing_rad - kNeighbourhood_rad) {
      first.go_on();
      if (company > 0) {
        --company;
      } else {
        end = first;
      }
    }
    while (company < points_.size() &&
           end.bearing_rad() <= point.bearing_rad + kNeighbourhood_rad) {
      end.go_on();
      ++company;
    }
    if (static_cast<double>(company) < enough) continue;
    if (first_rad) widest_rad = std::max(widest_rad, point.bearing_rad - last_rad);
    if (!first_rad) first_rad = point.bearing_rad;
    last_rad = point.bearing_rad;
  }
  return first_rad ? std::max(widest_rad, *first_rad + kTwoPi - last_rad) : kTwoPi;
}

void PolarScan::sort() {
  const auto by_bearing = [](const PolarPoint& a, const PolarPoint& b) {
    return a.bearing_rad < b.bearing_rad;
  };
  if (points_.size() < 2) return;
  // The A1 turns clockwise: its samples come with falling bearings, from somewhere in the circle.
  if (angle_between(points_[0].bearing_rad, points_[1].bearing_rad) < 0) {
    std::reverse(points_.begin(), points_.end());
  }
  const auto seam = std::adjacent_find(
      points_.begin(), points_.end(),
      [](const PolarPoint& a, const PolarPoint& b) { return b.bearing_rad < a.bearing_rad - kPi; });
  if (seam != points_.end()) std::rotate(points_.begin(), seam + 1, points_.end());

  // What is left out of order is a few places away from where it belongs, unless the input is no
  // turn of a lidar at all: then the work is bounded by a sort that is indifferent to the order.
  std::size_t moves_left = 16 * points_.size();
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (!by_bearing(points_[i], points_[i - 1])) continue;
    const PolarPoint moving = points_[i];
    std::size_t place = i;
    while (place > 0 && by_bearing(moving, points_[place - 1])) {
      if (moves_left-- == 0) {
        points_[place] = moving;
        std::sort(points_.begin(), points_.end(), by_bearing);
        return;
      }
      points_[place] = points_[place - 1];
      --place;
    }
    points_[place] = moving;
  }
}

}  // namespace cornerd::core
