// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "bench/program/benches.hpp"
#include "bench/program/contest_maps.hpp"
#include "bench/random_robot_experiment.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/progress_bar.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {
namespace {

/// A mean NEES in these bounds passes for that of an exact covariance.
constexpr double kLeastNees = 2;
constexpr double kMostNees = 5;
/// Fewer covers with a prediction say nothing of its covariance.
constexpr std::size_t kFewestCovers = 15;

/// Of all drives with the same fault.
struct Row {
  std::size_t drives = 0;
  std::size_t consistent_fixes = 0;
  std::size_t predicting = 0;  ///< with predictions in kFewestCovers
  std::size_t overconfident = 0;
  std::size_t underconfident = 0;
  std::size_t covers = 0;
  std::size_t predicted = 0;
  std::size_t scans = 0;
  std::size_t named = 0;
  std::size_t wrong = 0;   ///< drives with a wrong pose that was named
  std::size_t silent = 0;  ///< with one that was predicted

  void add(const RandomRobotResult& result) {
    ++drives;
    const double fix = result.fixes.mean();
    consistent_fixes += fix >= kLeastNees && fix <= kMostNees ? 1 : 0;
    covers += result.covers;
    predicted += result.predicted.poses;
    scans += result.scans;
    named += result.named;
    wrong += result.wrong > 0 ? 1 : 0;
    silent += result.silent > 0 ? 1 : 0;
    if (result.predicted.poses < kFewestCovers) return;
    ++predicting;
    overconfident += result.predicted.mean() > kMostNees ? 1 : 0;
    underconfident += result.predicted.mean() < kLeastNees ? 1 : 0;
  }
};

using Rows = std::array<Row, static_cast<std::size_t>(OdometryFault::kCount)>;

std::string text_of(const Rows& rows) {
  const auto share = [](std::size_t part, std::size_t all) {
    return tool::formatted("%.1f %%", 100.0 * static_cast<double>(part) /
                                          static_cast<double>(std::max<std::size_t>(1, all)));
  };
  tool::TextTable table;
  table.add_row({"fault", "drives", "named", "NEES 2-5", "covers predicted", "drives", "NEES > 5",
                 "< 2", "wrong", "silent"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    if (row.drives == 0) continue;
    table.add_row({std::string(name_of(static_cast<OdometryFault>(i))), std::to_string(row.drives),
                   share(row.named, row.scans), std::to_string(row.consistent_fixes),
                   share(row.predicted, row.covers), std::to_string(row.predicting),
                   std::to_string(row.overconfident), std::to_string(row.underconfident),
                   std::to_string(row.wrong), std::to_string(row.silent)});
  }
  return "Robots, noises, clocks and faults at random; the lidar is covered for 4 s of every 7 s.\n"
         "Drives by the mean NEES of their fixes, then of the last poses of covers (where 15 have\n"
         "one). Wrong: drives with a named pose more than 10 cm or 5 degrees off; silent: with a\n"
         "predicted one, and beyond 99.9 % of its covariance.\n\n" +
         table.text();
}

nlohmann::ordered_json figures_of(const RandomRobot& robot, const RandomRobotResult& result) {
  return {{"seed", robot.seed},
          {"fault", name_of(robot.fault)},
          {"gyro", robot.model.has_gyro},
          {"track_m", robot.model.geometry.track_m},
          {"count_m", robot.model.geometry.metres_per_count()},
          {"rate_hz", robot.model.rate_hz},
          {"wheel_m_per_sqrt_m", robot.model.wheel_m_per_sqrt_m},
          {"gyro_rad_s_per_sqrt_hz", robot.model.gyro_rad_s_per_sqrt_hz},
          {"slips_per_m", robot.model.slips_per_m},
          {"delay_s", robot.delay_s},
          {"jitter_s", robot.jitter_s},
          {"speed_m_s", robot.speed_m_s},
          {"scans", result.scans},
          {"named", result.named},
          {"wrong", result.wrong},
          {"fix_nees", result.fixes.mean()},
          {"covers", result.covers},
          {"predicted", result.predicted.poses},
          {"predicted_nees", result.predicted.mean()},
          {"predicted_mean_error", result.mean_error_m},
          {"silent", result.silent}};
}

}  // namespace

void run_random_robot_bench(const OdometryBenchOptions& options) {
  std::unique_ptr<tool::Output> json;
  if (options.json == "-") json = std::make_unique<tool::Output>();
  if (!options.json.empty() && !json) {
    json = std::make_unique<tool::Output>(std::filesystem::path(options.json));
  }
  const std::shared_ptr<const core::WallMap> map =
      settings::load_map(contest_maps_folder(options.maps) / "flat-7.json");
  Rows rows;
  nlohmann::ordered_json drives = nlohmann::ordered_json::array();
  {
    tool::ProgressBar bar("robots", options.robots);
    for (std::size_t i = 0; i < options.robots; ++i) {
      const RandomRobot robot = draw_robot(options.seed + i);
      const RandomRobotResult result = run_random_robot(map, robot);
      rows[static_cast<std::size_t>(robot.fault)].add(result);
      drives.push_back(figures_of(robot, result));
      bar.show(i + 1);
    }
  }
  if (json) {
    json->write(nlohmann::ordered_json({{"seed", options.seed}, {"robots", drives}}).dump(2) +
                '\n');
    json->flush();
  }
  if (options.json == "-") return;
  tool::Output output;
  output.write(text_of(rows));
  output.flush();
}

}  // namespace cornerd::bench
