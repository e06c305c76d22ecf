// SPDX-License-Identifier: MIT
#include "bench/program/rate_text.hpp"

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "tool/drawing/formatted.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

std::string rate_text(const std::vector<RateRow>& rows) {
  tool::TextTable table;
  table.add_row({"starts", "readings/s", "fixes", "mean, max [mm]", "max [deg]", "NEES",
                 "predicted", "wrong", "max [deg]"});
  for (const RateRow& row : rows) {
    const RateResult& result = row.result;
    table.add_row(
        {row.gently ? "gently" : "at once",
         row.rate_hz > 0 ? tool::formatted("%.0f", row.rate_hz) : "lidar alone",
         tool::formatted("%.1f %%", 100.0 * static_cast<double>(result.fixes.scans()) /
                                        static_cast<double>(result.scans)),
         tool::formatted("%.2f, %.1f", 1e3 * result.fixes.mean_error_m(), 1e3 * result.worst_fix_m),
         tool::formatted("%.2f", core::degrees(result.worst_fix_rad)),
         tool::formatted("%.1f", result.fixes.mean_nees()),
         tool::formatted("%zu", result.predicted.scans()),
         tool::formatted("%zu", result.fixes.wrong() + result.predicted.wrong()),
         tool::formatted("%.2f", core::degrees(result.worst_predicted_rad))});
  }
  return "Poses at 0.25 m/s with turns on the spot, by how often wheels and gyro are read. Wrong:\n"
         "over 10 cm or 5 degrees off.\n\n" +
         table.text();
}

nlohmann::ordered_json rate_json(const std::vector<RateRow>& rows) {
  nlohmann::ordered_json rates = nlohmann::ordered_json::array();
  for (const RateRow& row : rows) {
    const RateResult& result = row.result;
    rates.push_back({{"readings_hz", row.rate_hz},
                     {"gently", row.gently},
                     {"turns", result.scans},
                     {"fixes", result.fixes.scans()},
                     {"wrong_fixes", result.fixes.wrong()},
                     {"mean_error", result.fixes.mean_error_m()},
                     {"max_error", result.worst_fix_m},
                     {"max_heading_error", result.worst_fix_rad},
                     {"nees", result.fixes.mean_nees()},
                     {"predicted", result.predicted.scans()},
                     {"wrong_predicted", result.predicted.wrong()},
                     {"predicted_max_heading_error", result.worst_predicted_rad}});
  }
  return rates;
}

}  // namespace cornerd::bench
