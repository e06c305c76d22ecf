// SPDX-License-Identifier: MIT
#pragma once

#include "core/geometry/pose2.hpp"

namespace cornerd::core {

/// Whether wheels and lidar tell the same story, fix by fix. Wheels that told another one have to
/// agree for a while of driving before they are believed again: a robot that stands proves nothing.
class Trust {
 public:
  void disagreed(const Pose2& T_map_base) {
    share_ += kShare * (1 - share_);
    if (++in_a_row_ >= kDistrusted || share_ > kTooMany) is_lost_ = true;
    T_map_counted_ = T_map_base;
  }
  void agreed(const Pose2& T_map_base) {
    in_a_row_ = 0;
    if (same_place(T_map_counted_, T_map_base, kDriven_m, kDriven_rad)) return;
    T_map_counted_ = T_map_base;
    share_ -= kShare * share_;
    if (share_ < kFewAgain) is_lost_ = false;
  }
  bool is_lost() const { return is_lost_; }

 private:
  /// So many fixes in a row that the wheels cannot explain: they are not this robot's, or spin
  /// free.
  static constexpr int kDistrusted = 3;
  static constexpr double kShare = 1.0 / 8;  ///< of the newest fix
  static constexpr double kTooMany = 0.35;
  static constexpr double kFewAgain = 0.1;
  static constexpr double kDriven_m = 0.03;
  static constexpr double kDriven_rad = radians(5);

  double share_ = 0;  ///< of the fixes that disagreed, lately
  int in_a_row_ = 0;
  bool is_lost_ = false;
  Pose2 T_map_counted_;  ///< at the fix that counted last
};

}  // namespace cornerd::core
