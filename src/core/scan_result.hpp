// SPDX-License-Identifier: MIT
#pragma once

#include "core/breakpoint/breakpoint.hpp"
#include "core/odometry/odometry_summary.hpp"
#include "core/pose_estimate.hpp"
#include "core/sensor_bias.hpp"

namespace cornerd::core {

/// Everything that one turn gave. Reused from turn to turn.
struct ScanResult {
  ScanResult() { pose.alternatives.reserve(kMaxAlternatives); }
  PoseEstimate pose;
  Detection detection;
  OdometrySummary odometry;
  LearnedBias bias;  ///< that the next turn will be corrected by
};

}  // namespace cornerd::core
