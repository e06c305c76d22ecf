// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/covered_lidar_experiment.hpp"
#include "bench/rate_experiment.hpp"

namespace cornerd::bench {

struct BlindRow {
  std::string_view title;
  CoveredLidarResult result;
};

std::string blind_text(const std::vector<BlindRow>& rows);
nlohmann::ordered_json blind_json(const std::vector<BlindRow>& rows);

struct RateRow {
  double rate_hz = 0;
  bool gently = false;
  RateResult result;
};

std::string rate_text(const std::vector<RateRow>& rows);
nlohmann::ordered_json rate_json(const std::vector<RateRow>& rows);

}  // namespace cornerd::bench
