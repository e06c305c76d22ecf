// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::core {

/// Of a line's direction where both its ends are off by N(0, sigma_m) across it, rad^2.
inline double direction_variance(double length_m, double sigma_m) {
  return 2 * sigma_m * sigma_m / (length_m * length_m);
}

/// Sums over a scan's points on one face: of weight (1/m^2), lever d(distance)/d(theta) (m), and
/// distance in front of it (m), the last four times the point's weight.
struct LineSums {
  void add(const LineSums& other) {
    weight += other.weight;
    lever += other.lever;
    lever_squared += other.lever_squared;
    distance += other.distance;
    distance_lever += other.distance_lever;
  }
  /// From a plane that is so much before theirs, and turned by an angle to the left about the point
  /// of a lever.
  void move(double offset_m, double angle_rad, double lever_m) {
    const double intercept_m = offset_m - angle_rad * lever_m;
    distance += intercept_m * weight + angle_rad * lever;
    distance_lever += intercept_m * lever + angle_rad * lever_squared;
  }

  double mean_lever_m() const { return lever / weight; }
  /// What the points tell of their line's direction, its offset marginalised: 1/rad^2.
  double direction_weight() const {
    return weight > 0 ? std::max(0.0, lever_squared - lever * lever / weight) : 0;
  }
  /// That times the angle by which the points are turned from the face, to the left.
  double direction() const { return weight > 0 ? distance_lever - distance * lever / weight : 0; }
  /// That angle, a posteriori of N(0, variance).
  double direction_rad(double variance) const {
    return variance > 0 ? direction() / (direction_weight() + 1 / variance) : 0;
  }
  /// What the normal equations lose where a direction of N(0, variance) is eliminated, about the
  /// mean of its points: the Schur complement.
  struct Eliminated {
    double information = 0;  ///< of the heading
    double gradient = 0;     ///< of the same
    double chi_square = 0;
  };
  Eliminated eliminate_direction(double variance) const {
    const double angle_rad = direction_rad(variance);
    const double points = direction_weight();
    const double turned = variance > 0 ? points / (points + 1 / variance) : 0;
    return {turned * points, angle_rad * points, angle_rad * direction()};
  }

  double weight = 0;
  double lever = 0;
  double lever_squared = 0;
  double distance = 0;
  double distance_lever = 0;
};

}  // namespace cornerd::core
