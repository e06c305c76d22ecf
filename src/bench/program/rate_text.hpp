// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/rate_experiment.hpp"

namespace cornerd::bench {

struct RateRow {
  double rate_hz = 0;
  bool gently = false;
  RateResult result;
};

std::string rate_text(const std::vector<RateRow>& rows);
nlohmann::ordered_json rate_json(const std::vector<RateRow>& rows);

}  // namespace cornerd::bench
