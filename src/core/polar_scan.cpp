// SPDX-License-Identifier: MIT
#include "core/polar_scan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/angle.hpp"
#include "core/geometry/ray_iterator.hpp"
#include "core/geometry/small_angle.hpp"

namespace cornerd::core {

namespace {

/// A return is isolated where less than this share of the samples around it are returns.
constexpr double kNeighbourhood_rad = radians(10);
constexpr double kMinNeighbourShare = 0.25;

PolarPoint point_at(double bearing_rad, double range_m, double dt_s, const Vec2& ray) {
  return {bearing_rad, range_m, ray.x(), ray.y(), range_m * ray.x(), range_m * ray.y(), dt_s};
}

PolarPoint unbiased(const PolarPoint& point, const SensorBias& bias) {
  const double bearing_rad = bias.true_bearing_rad(point.bearing_rad, point.ray_y, point.ray_x);
  return point_at(bearing_rad, std::max(bias.true_range_m(point.range_m), 1e-6), point.dt_s,
                  rotated(point.ray(), angle_between(point.bearing_rad, bearing_rad)));
}

/// Cyclic iterator over the points in the order of bearing.
class Cursor {
 public:
  Cursor(std::span<const PolarPoint> points, double round_rad)
      : points_(points), round_rad_(round_rad) {}
  double bearing_rad() const { return points_[i_].bearing_rad + round_rad_; }
  void advance() {
    if (++i_ < points_.size()) return;
    i_ = 0;
    round_rad_ += kTwoPi;
  }

 private:
  std::span<const PolarPoint> points_;
  double round_rad_;
  std::size_t i_ = 0;
};

PolarPoint moved(const PolarPoint& point, const ScanMotion& motion) {
  const double dt_s = point.dt_s;
  const double rotation_rad = motion.rotation_rad(dt_s);
  // Exponential map as in Twist2::over(), by series: rotations within a scan are small.
  const double along = 1 - rotation_rad * rotation_rad / 6;
  const double aside = rotation_rad / 2 * (1 - rotation_rad * rotation_rad / 12);
  const Vec2 position = Vec2(along * motion.twist.vx_m_s - aside * motion.twist.vy_m_s,
                             aside * motion.twist.vx_m_s + along * motion.twist.vy_m_s) *
                            dt_s +
                        rotated(point.position(), rotation_rad);
  const double range_m = std::max(position.norm(), 1e-6);
  const Vec2 ray = position * (1 / range_m);
  return {normalize_angle(point.bearing_rad + rotation_between(point.ray(), position)),
          range_m,
          ray.x(),
          ray.y(),
          position.x(),
          position.y(),
          dt_s};
}

}  // namespace

std::size_t take_few(std::span<const PolarPoint> points, std::size_t least,
                     std::vector<PolarPoint>& few) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / least);
  few.clear();
  for (std::size_t i = 0; i < points.size(); i += stride) few.push_back(points[i]);
  return stride;
}

PolarScan::PolarScan() { points_.reserve(kMaxSamplesPerScan); }

void PolarScan::assign(const Scan& scan, double min_range_m, double max_range_m, TimeNs at_ns,
                       const ScanMotion& motion, const SensorBias& bias) {
  points_.clear();
  largest_gap_rad_.reset();
  const bool biased = !bias.is_none();
  const bool moves = !motion.is_rest();
  RayIterator rays;
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
  largest_gap_rad_.reset();
  spacing_rad_ = spacing_rad;
}

void PolarScan::append(double bearing_rad, double range_m) {
  largest_gap_rad_.reset();
  if (points_.size() < kMaxSamplesPerScan)
    points_.push_back(point_at(bearing_rad, range_m, 0, unit_vector(bearing_rad)));
}

double PolarScan::largest_gap_rad() const {
  if (!largest_gap_rad_) largest_gap_rad_ = find_largest_gap_rad();
  return *largest_gap_rad_;
}

double PolarScan::largest_step_rad() const {
  double largest_rad = points_.front().bearing_rad + kTwoPi - points_.back().bearing_rad;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    largest_rad = std::max(largest_rad, points_[i].bearing_rad - points_[i - 1].bearing_rad);
  }
  return largest_rad;
}

double PolarScan::find_largest_gap_rad() const {
  const double around = 2 * kNeighbourhood_rad / spacing_rad_;  // samples around a return
  const double min_neighbours = std::max(2.0, kMinNeighbourShare * around);
  const double missing = kTwoPi / spacing_rad_ - static_cast<double>(points_.size());
  if (missing < around - min_neighbours - 1) return largest_step_rad();  // none is isolated
  // The neighbourhood of a return is [first, end), started one round before.
  Cursor first(points_, -kTwoPi);
  Cursor end = first;
  std::size_t neighbours = 0;
  std::optional<double> first_rad;
  double last_rad = 0;
  double largest_rad = 0;
  for (const PolarPoint& point : points_) {
    while (first.bearing_rad() < point.bearing_rad - kNeighbourhood_rad) {
      first.advance();
      if (neighbours > 0) {
        --neighbours;
      } else {
        end = first;
      }
    }
    while (neighbours < points_.size() &&
           end.bearing_rad() <= point.bearing_rad + kNeighbourhood_rad) {
      end.advance();
      ++neighbours;
    }
    if (static_cast<double>(neighbours) < min_neighbours) continue;
    if (first_rad) largest_rad = std::max(largest_rad, point.bearing_rad - last_rad);
    if (!first_rad) first_rad = point.bearing_rad;
    last_rad = point.bearing_rad;
  }
  return first_rad ? std::max(largest_rad, *first_rad + kTwoPi - last_rad) : kTwoPi;
}

void PolarScan::sort() {
  const auto by_bearing = [](const PolarPoint& a, const PolarPoint& b) {
    return a.bearing_rad < b.bearing_rad;
  };
  if (points_.size() < 2) return;
  // The A1 rotates clockwise: its bearings fall, from anywhere in the circle.
  if (angle_between(points_[0].bearing_rad, points_[1].bearing_rad) < 0) {
    std::reverse(points_.begin(), points_.end());
  }
  const auto seam = std::adjacent_find(
      points_.begin(), points_.end(),
      [](const PolarPoint& a, const PolarPoint& b) { return b.bearing_rad < a.bearing_rad - kPi; });
  if (seam != points_.end()) std::rotate(points_.begin(), seam + 1, points_.end());

  // Remaining samples are a few positions out of order, which insertion sort handles in linear
  // time. Any other input falls back to std::sort.
  std::size_t moves_left = 16 * points_.size();
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (!by_bearing(points_[i], points_[i - 1])) continue;
    const PolarPoint moving = points_[i];
    std::size_t target = i;
    while (target > 0 && by_bearing(moving, points_[target - 1])) {
      if (moves_left-- == 0) {
        points_[target] = moving;
        std::sort(points_.begin(), points_.end(), by_bearing);
        return;
      }
      points_[target] = points_[target - 1];
      --target;
    }
    points_[target] = moving;
  }
}

}  // namespace cornerd::core
