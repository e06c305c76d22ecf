// SPDX-License-Identifier: MIT
// Of the filter alone: what its files hand to each other.
#pragma once

#include "core/odometry/corrected_increment.hpp"
#include "core/odometry/fusion_filter.hpp"

namespace cornerd::core {

/// What one step goes through.
struct FusionFilter::Prediction {
  const OdometryIncrement& step;
  double dt_s = 0;
  double track_m = 0;
  double gyro_gain = 1;
  CorrectedIncrement moved{};
  bool rolls = false;  ///< or stands: then no count has come
  bool slips = false;

  // What wheels and gyro may be off by, and what was told of it; variances.
  double left_m2 = 0;
  double right_m2 = 0;
  double rotation_variance = 0;  ///< of the wheels' turn
  double old_rests_rad2 = 0;     ///< of the part of it that stood in the counts before
  double told_rad2 = 0;
  double gyro_rad2 = 0;
  double jitter_rad2 = 0;  ///< the part of it that is of the times
  double gyro_told_rad2 = 0;

  // What the gyro says beyond the wheels, and how that and the turn change with the state.
  double bias_rad = 0;
  double surprise_rad = 0;
  Row turn_by = Row::Zero();
  Row seen_by = Row::Zero();
  Row usual_by = Row::Zero();  ///< seen_by as it was in the steps before

  /// The way is taken in the direction half-way through the wheels' turn, and follows it as the
  /// gyro corrects it; a slip is too large for that, and the way is taken at what the gyro leaves
  /// of it.
  double course_rad = 0;
  double follows = 1;
};

}  // namespace cornerd::core
