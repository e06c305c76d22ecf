// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/covered_lidar_experiment.hpp"
#include "bench/rate_experiment.hpp"

namespace cornerd::bench {

/// Fixes and predictions of one robot.
struct DeadReckoningRow {
  std::string_view title;
  CoveredLidarResult result;
};

std::string dead_reckoning_text(const std::vector<DeadReckoningRow>& rows);
nlohmann::ordered_json dead_reckoning_json(const std::vector<DeadReckoningRow>& rows);

/// Poses at one rate of odometry; 0: the lidar alone.
struct RateRow {
  double rate_hz = 0;
  bool gently = false;  ///< limited acceleration
  RateResult result;
};

std::string rate_text(const std::vector<RateRow>& rows);
nlohmann::ordered_json rate_json(const std::vector<RateRow>& rows);

}  // namespace cornerd::bench
