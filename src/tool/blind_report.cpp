// SPDX-License-Identifier: MIT
#include "tool/blind_report.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "tool/formatted.hpp"
#include "tool/text_table.hpp"

namespace cornerd::tool {

std::string blind_text(const std::vector<BlindRow>& rows) {
  TextTable table;
  table.add_row({"robot", "age [s]", "poses", "mean, max [mm]", "max [deg]", "NEES", "< 7.815"});
  for (const BlindRow& row : rows) {
    for (const bench::BlindAges& ages : row.ages) {
      const bool is_first = &ages == &row.ages.front();
      table.add_row({is_first ? std::string(row.title) : std::string(),
                     formatted("%.2f-%.2f", ages.from_s, ages.to_s), formatted("%zu", ages.poses),
                     formatted("%.2f, %.1f", 1e3 * ages.mean_m, 1e3 * ages.worst_m),
                     formatted("%.2f", core::degrees(ages.worst_rad)),
                     formatted("%.2f", ages.mean_nees),
                     formatted("%.1f %%", 100 * ages.share_within)});
    }
  }
  return "The poses that wheels and gyro carry on, between the turns of the lidar and while it is\n"
         "covered, by their age. NEES: the error squared in units of the covariance, 3 is exact,\n"
         "and 95 % are under 7.815.\n\n" +
         table.text();
}

nlohmann::ordered_json blind_json(const std::vector<BlindRow>& rows) {
  nlohmann::ordered_json robots = nlohmann::ordered_json::array();
  for (const BlindRow& row : rows) {
    nlohmann::ordered_json by_age = nlohmann::ordered_json::array();
    for (const bench::BlindAges& ages : row.ages) {
      by_age.push_back({{"from", ages.from_s},
                        {"to", ages.to_s},
                        {"poses", ages.poses},
                        {"mean_error", ages.mean_m},
                        {"max_error", ages.worst_m},
                        {"max_heading_error", ages.worst_rad},
                        {"nees", ages.mean_nees},
                        {"share_within", ages.share_within}});
    }
    robots.push_back({{"robot", row.title}, {"ages", std::move(by_age)}});
  }
  return robots;
}

}  // namespace cornerd::tool
