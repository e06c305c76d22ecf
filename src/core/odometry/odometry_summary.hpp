// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/odometry/odometry_config.hpp"

namespace cornerd::core {

/// Rejected readings by cause.
struct OdometryCounters {
  std::uint64_t readings = 0;
  std::uint64_t past = 0;           ///< not after the last reading, long before now, or held back
  std::uint64_t future = 0;         ///< well after now, or ahead of the readings that followed
  std::uint64_t jumps = 0;          ///< more counts than a wheel can turn
  std::uint64_t invalid_rates = 0;  ///< rates that are none
  std::uint64_t stuck = 0;          ///< rates that stay the same to the bit while the wheels turn
  std::uint64_t gaps = 0;           ///< times of which nothing is known
  std::uint64_t restarts = 0;       ///< counts or times that went on somewhere else
};

/// For STATUS: state of the readings and estimated parameters.
struct OdometrySummary {
  bool enabled = false;
  bool present = false;  ///< readings arrive
  bool healthy = false;  ///< readings are consistent with the lidar and each other
  OdometryParameters parameters;
  OdometryParameters sigma;  ///< of `parameters`
  OdometryCounters counters;
  std::uint64_t slips = 0;
  std::uint64_t fixes = 0;           ///< used by the filter
  std::uint64_t rejected_fixes = 0;  ///< inconsistent with the wheels
};

}  // namespace cornerd::core
