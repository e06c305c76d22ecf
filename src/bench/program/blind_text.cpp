// SPDX-License-Identifier: MIT
#include "bench/program/blind_text.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "tool/drawing/formatted.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

namespace {

nlohmann::ordered_json figures_of(const PoseHonesty& poses) {
  return {{"poses", poses.poses},       {"mean_error", poses.mean_m},
          {"max_error", poses.worst_m}, {"max_heading_error", poses.worst_rad},
          {"nees", poses.mean_nees},    {"share_within", poses.share_within}};
}

}  // namespace

std::string blind_text(const std::vector<BlindRow>& rows) {
  tool::TextTable table;
  table.add_row({"robot", "age [s]", "poses", "mean, max [mm]", "max [deg]", "NEES", "< 7.815"});
  const auto add = [&](const std::string& robot, const std::string& age, const PoseHonesty& poses) {
    table.add_row({robot, age, tool::formatted("%zu", poses.poses),
                   tool::formatted("%.2f, %.1f", 1e3 * poses.mean_m, 1e3 * poses.worst_m),
                   tool::formatted("%.2f", core::degrees(poses.worst_rad)),
                   tool::formatted("%.2f", poses.mean_nees),
                   tool::formatted("%.1f %%", 100 * poses.share_within)});
  };
  for (const BlindRow& row : rows) {
    add(std::string(row.title), "fix", row.result.fixes);
    for (const BlindAges& ages : row.result.carried_on) {
      add("", tool::formatted("%.2f-%.2f", ages.from_s, ages.to_s), ages);
    }
  }
  return "The fixes, and the poses that wheels and gyro carry on between the turns of the lidar "
         "and\n"
         "while it is covered, by their age. NEES: the error squared in units of the covariance, 3 "
         "is exact,\n"
         "and 95 % are under 7.815.\n\n" +
         table.text();
}

nlohmann::ordered_json blind_json(const std::vector<BlindRow>& rows) {
  nlohmann::ordered_json robots = nlohmann::ordered_json::array();
  for (const BlindRow& row : rows) {
    nlohmann::ordered_json by_age = nlohmann::ordered_json::array();
    for (const BlindAges& ages : row.result.carried_on) {
      nlohmann::ordered_json figures = {{"from", ages.from_s}, {"to", ages.to_s}};
      figures.update(figures_of(ages));
      by_age.push_back(std::move(figures));
    }
    robots.push_back(
        {{"robot", row.title}, {"fix", figures_of(row.result.fixes)}, {"ages", std::move(by_age)}});
  }
  return robots;
}

}  // namespace cornerd::bench
