// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"

namespace cornerd::core {

/// normal.dot(p) = offset_m, with its accuracy.
struct Line {
  Vec2 normal = Vec2::Zero();
  double offset_m = 0;
  Vec2 centroid = Vec2::Zero();
  double weight =
      0;  ///< sum of the points' 1 / sigma^2: inverse variance of the offset at the centroid
  double variance_along = 0;  ///< weighted variance of the points along the line, m^2
  Vec2 direction() const { return {normal.y(), -normal.x()}; }  ///< rotate_left(direction) = normal

  /// Variance of the line's position across itself, `along_m` from its centroid, m^2.
  double variance_at(double along_m) const {
    return (1 + along_m * along_m / variance_along) / weight;
  }
};

/// Unweighted sums over a few points.
struct PointSums {
  void add(double x_m, double y_m) {
    x += x_m;
    y += y_m;
    xx += x_m * x_m;
    xy += x_m * y_m;
    yy += y_m * y_m;
  }
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  double yy = 0;
};

/// Running sums of weighted points. Adding a point, removing one and fitting the total least
/// squares line each take constant time.
class LineFit {
 public:
  /// Sums are relative to `origin`, near the points, against cancellation.
  explicit LineFit(const Vec2& origin = Vec2::Zero()) : origin_(origin) {}

  void add(double x_m, double y_m, double weight) { accumulate(x_m, y_m, weight, 1); }
  void remove(double x_m, double y_m, double weight) { accumulate(x_m, y_m, -weight, -1); }

  void add(const LineFit& other);
  /// Adds `count` points of one weight.
  void add(const PointSums& sums, int count, double weight);

  /// The points added since this fit was equal to `part`.
  LineFit without(const LineFit& part) const;

  int count() const { return count_; }

  /// Requires two points. The normal points towards the sensor at (0, 0).
  Line line() const;

  /// Weighted sum of the points' squared distances to the best line.
  double chi_square() const;

 private:
  struct Moments {
    Vec2 mean;
    double xx;
    double xy;
    double yy;
  };
  Moments moments() const;
  void accumulate(double x_m, double y_m, double weight, int count) {
    const double x = x_m - origin_.x();
    const double y = y_m - origin_.y();
    w_ += weight;
    x_ += weight * x;
    y_ += weight * y;
    xx_ += weight * x * x;
    xy_ += weight * x * y;
    yy_ += weight * y * y;
    count_ += count;
  }

  Vec2 origin_;
  double w_ = 0;
  double x_ = 0;
  double y_ = 0;
  double xx_ = 0;
  double xy_ = 0;
  double yy_ = 0;
  int count_ = 0;
};

}  // namespace cornerd::core
