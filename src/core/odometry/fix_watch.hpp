// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/geometry/pose2.hpp"

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
    seen_ = foretold_ = {};
    if (!about_turning) return;
    turns_are_proven_ = false;
    doubt_ = std::min(doubt_ + kLie, kMost);
    if (doubt_ >= kTooMuch) is_believed_ = false;
  }

  /// From the fix before to this one, in the map.
  struct Way {
    Vec2 translation = Vec2::Zero();
    double rotation_rad = 0;
  };

  /// A fix that is explained: the way that the lidar saw, and the one that odometry had foretold.
  void add_explained(const Way& seen, const Way& foretold) {
    in_a_row_ = 0;
    seen_.translation += seen.translation;
    foretold_.translation += foretold.translation;
    seen_.rotation_rad += seen.rotation_rad;
    foretold_.rotation_rad += foretold.rotation_rad;
    if (seen.translation.norm() > kDrives_m) {
      way_is_proven_ = true;
    } else if (const double way_m = seen_.translation.norm(); way_m > kDrives_m) {
      const Vec2 off = foretold_.translation - seen_.translation;
      if (off.norm() < kAgrees * way_m) way_is_proven_ = true;
      seen_.translation = foretold_.translation = Vec2::Zero();
    }
    if (std::abs(seen.rotation_rad) >= kTurns_rad) {
      prove_turns();
    } else if (const double rotation_rad = std::abs(seen_.rotation_rad);
               rotation_rad >= kTurns_rad) {
      // Slow turns are explained one by one, whatever wheels make of them.
      if (std::abs(foretold_.rotation_rad - seen_.rotation_rad) < kAgrees * rotation_rad)
        prove_turns();
      seen_.rotation_rad = foretold_.rotation_rad = 0;
    }
  }

  /// The next fix may be anywhere.
  void interrupt() {
    in_a_row_ = 0;
    seen_ = foretold_ = {};
  }

  /// Whether such a way and turn since the last fix are to be carried on. The first ones of a drive
  /// the lidar has to have seen; and after a stranger, anything.
  bool carries(double way_m, double rotation_rad) const {
    return in_a_row_ == 0 && (way_is_proven_ || way_m < kUnproven_m) &&
           (turns_are_proven_ || std::abs(rotation_rad) < kTurns_rad);
  }

  bool is_believed() const { return !is_contradicted() && is_believed_; }
  /// By the last fixes, whatever was before.
  bool is_contradicted() const { return in_a_row_ >= kInARow; }

 private:
  void prove_turns() {
    seen_.rotation_rad = foretold_.rotation_rad = 0;
    turns_are_proven_ = true;
    doubt_ = std::max(doubt_ - 1, 0);
    if (doubt_ <= kLittle) is_believed_ = true;
  }

  static constexpr int kInARow = 3;
  static constexpr double kTurns_rad = radians(3);
  static constexpr double kDrives_m = 0.02;
  static constexpr double kUnproven_m = 0.04;
  /// What a slow robot did over many fixes was foretold to this share.
  static constexpr double kAgrees = 0.3;
  /// In turns that were foretold, each of which makes up for a part of a lie.
  static constexpr int kLie = 3;
  static constexpr int kTooMuch = 7;
  static constexpr int kLittle = 4;
  static constexpr int kMost = 9;

  /// Since the last way or turn that was long enough to tell.
  Way seen_;
  Way foretold_;
  int in_a_row_ = 0;
  int doubt_ = 0;
  bool is_believed_ = true;
  bool way_is_proven_ = false;
  bool turns_are_proven_ = false;
};

}  // namespace cornerd::core
