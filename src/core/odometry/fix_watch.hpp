// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace cornerd::core {

/// Tells odometry that lies (wheels that were exchanged, that spin free, another robot's) from a
/// fix that is wrong, a slip, or a robot that was carried: by how often it cannot explain one. What
/// lied about turning has to foretell turns before it is believed again: on a straight any wheels
/// are right.
class FixWatch {
 public:
  /// A fix that cannot be explained; `about_turning`: its heading cannot.
  void add_stranger(bool about_turning) {
    ++in_a_row_;
    if (!about_turning) return;
    turns_are_proven_ = false;
    doubt_ = std::min(doubt_ + kLie, kMost);
    if (doubt_ >= kTooMuch) is_believed_ = false;
  }

  /// A fix that is explained, and how far the robot has come and turned since the one before.
  void add_explained(double way_m, double turn_rad) {
    in_a_row_ = 0;
    if (way_m > kDrives_m) way_is_proven_ = true;
    if (std::abs(turn_rad) < kTurns_rad) return;
    turns_are_proven_ = true;
    doubt_ = std::max(doubt_ - 1, 0);
    if (doubt_ <= kLittle) is_believed_ = true;
  }

  /// The next fix may be anywhere.
  void interrupt() { in_a_row_ = 0; }

  /// Whether such a way and turn since the last fix are to be carried on. The first ones of a drive
  /// the lidar has to have seen; and after a stranger, anything.
  bool carries(double way_m, double turn_rad) const {
    return in_a_row_ == 0 && (way_is_proven_ || way_m < kUnproven_m) &&
           (turns_are_proven_ || std::abs(turn_rad) < kTurns_rad);
  }

  bool is_believed() const { return !is_contradicted() && is_believed_; }
  /// By the last fixes, whatever was before.
  bool is_contradicted() const { return in_a_row_ >= kInARow; }

 private:
  static constexpr int kInARow = 3;
  static constexpr double kTurns_rad = radians(3);
  static constexpr double kDrives_m = 0.02;
  static constexpr double kUnproven_m = 0.04;
  /// In turns that were foretold, each of which makes up for a part of a lie.
  static constexpr int kLie = 3;
  static constexpr int kTooMuch = 7;
  static constexpr int kLittle = 4;
  static constexpr int kMost = 9;

  int in_a_row_ = 0;
  int doubt_ = 0;
  bool is_believed_ = true;
  bool way_is_proven_ = false;
  bool turns_are_proven_ = false;
};

}  // namespace cornerd::core
