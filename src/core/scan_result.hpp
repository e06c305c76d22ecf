// SPDX-License-Identifier: MIT
#pragma once

#include "core/breakpoint/breakpoint.hpp"
#include "core/odometry/odometry_summary.hpp"
#include "core/pose_estimate.hpp"
#include "core/sensor_bias.hpp"

namespace cornerd::core {

/// Result of one scan. Reused from scan to scan.
struct ScanResult {
  ScanResult() { pose.alternatives.reserve(kMaxAlternatives); }
  PoseEstimate pose;
  Detection detection;
  OdometrySummary odometry;
  EstimatedBias bias;  ///< that the next scan will be corrected by
};

}  // namespace cornerd::core
