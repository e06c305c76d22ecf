// SPDX-License-Identifier: MIT
#include "bench/program/odometry_text.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

namespace {

nlohmann::ordered_json figures_of(const PoseConsistency& poses) {
  return {{"poses", poses.poses},       {"mean_error", poses.mean_m},
          {"max_error", poses.worst_m}, {"max_heading_error", poses.worst_rad},
          {"nees", poses.mean_nees},    {"share_within", poses.share_within}};
}

}  // namespace

std::string dead_reckoning_text(const std::vector<DeadReckoningRow>& rows) {
  tool::TextTable table;
  table.add_row({"robot", "age [s]", "poses", "mean, max [mm]", "max [deg]", "NEES", "< 7.815"});
  const auto add = [&](const std::string& robot, const std::string& age,
                       const PoseConsistency& poses) {
    table.add_row({robot, age, tool::formatted("%zu", poses.poses),
                   tool::formatted("%.2f, %.1f", 1e3 * poses.mean_m, 1e3 * poses.worst_m),
                   tool::formatted("%.2f", core::degrees(poses.worst_rad)),
                   tool::formatted("%.2f", poses.mean_nees),
                   tool::formatted("%.1f %%", 100 * poses.share_within)});
  };
  for (const DeadReckoningRow& row : rows) {
    add(std::string(row.title), "fix", row.result.fixes);
    for (const AgeConsistency& ages : row.result.predicted) {
      add("", tool::formatted("%.2f-%.2f", ages.from_s, ages.to_s), ages);
    }
  }
  return "Fixes, and poses dead reckoned by wheels and gyro between scans and while the lidar is\n"
         "covered, by age. NEES: normalized estimation error squared. Consistent covariances give\n"
         "a mean of 3, and 95 % below 7.815 (chi-square, 3 degrees of freedom).\n\n" +
         table.text();
}

nlohmann::ordered_json dead_reckoning_json(const std::vector<DeadReckoningRow>& rows) {
  nlohmann::ordered_json robots = nlohmann::ordered_json::array();
  for (const DeadReckoningRow& row : rows) {
    nlohmann::ordered_json by_age = nlohmann::ordered_json::array();
    for (const AgeConsistency& ages : row.result.predicted) {
      nlohmann::ordered_json figures = {{"from", ages.from_s}, {"to", ages.to_s}};
      figures.update(figures_of(ages));
      by_age.push_back(std::move(figures));
    }
    robots.push_back(
        {{"robot", row.title}, {"fix", figures_of(row.result.fixes)}, {"ages", std::move(by_age)}});
  }
  return robots;
}

std::string rate_text(const std::vector<RateRow>& rows) {
  tool::TextTable table;
  table.add_row({"starts", "readings/s", "fixes", "mean, max [mm]", "max [deg]", "NEES",
                 "predicted", "wrong", "max [deg]"});
  for (const RateRow& row : rows) {
    const RateResult& result = row.result;
    table.add_row(
        {row.gently ? "gentle" : "abrupt",
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
  return "Poses at 0.25 m/s with rotations in place, by the rate of the odometry. Wrong: error\n"
         "above 10 cm or 5 degrees.\n\n" +
         table.text();
}

nlohmann::ordered_json rate_json(const std::vector<RateRow>& rows) {
  nlohmann::ordered_json rates = nlohmann::ordered_json::array();
  for (const RateRow& row : rows) {
    const RateResult& result = row.result;
    rates.push_back({{"readings_hz", row.rate_hz},
                     {"gently", row.gently},
                     {"scans", result.scans},
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
