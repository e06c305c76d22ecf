// SPDX-License-Identifier: MIT
#include <algorithm>
#include <system_error>
#include <vector>

#include "bench/paper_experiment.hpp"
#include "bench/program/boxplot_drawing.hpp"
#include "bench/program/report.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/drawing/map_drawing.hpp"

namespace cornerd::bench {

namespace {

constexpr double kPlotMm = 1e3;

std::string draw_times(const BenchReport& report) {
  std::vector<BoxplotSeries> series;
  for (const PaperResult& result : report.paper) {
    BoxplotSeries times{std::string(result.method.title), {}};
    for (const PoseResult& pose : result.poses) times.values.push_back(pose.time_us);
    series.push_back(std::move(times));
  }
  return draw_boxplots(
      {"Time a scan", std::to_string(report.scans.poses.size()) + " poses", "microseconds"},
      series);
}

std::string draw_positions(const BenchReport& report) {
  std::vector<BoxplotSeries> series;
  for (const PaperResult& result : report.paper) {
    if (result.method.name == "lt") continue;  // not in the paper's figure
    BoxplotSeries errors{std::string(result.method.title), {}};
    for (const PoseResult& pose : result.poses) {
      if (!pose.nearest_corners_error_m) continue;
      errors.values.push_back(kPlotMm * *pose.nearest_corners_error_m);
    }
    series.push_back(std::move(errors));
  }
  BoxplotSeries own{"cornerd", {}};
  if (!report.paper.empty()) {
    for (const PoseResult& pose : report.paper.front().poses) {
      if (pose.localizer_error_m) own.values.push_back(kPlotMm * *pose.localizer_error_m);
    }
  }
  series.push_back(std::move(own));
  return draw_boxplots(
      {"Position error", "by the two nearest corners; cornerd: by all returns", "millimetres"},
      series);
}

/// The scan with most visible corners.
std::size_t richest_scan(const BenchReport& report) {
  const auto& counts = report.supported_corners;
  return static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

std::string draw_bench_scan(const BenchReport& report, const PaperResult& result,
                            std::size_t scan) {
  const PaperPose& pose = report.scans.poses[scan];
  const PoseResult& found = result.poses[scan];
  tool::MapDrawing drawing(*report.scans.maps[pose.map]);
  drawing.add_scan(report.scans.scans[scan], pose.T_map_lidar);
  drawing.add_breakpoints(found.breakpoints, pose.T_map_lidar);
  drawing.add_pose(pose.T_map_lidar);
  return drawing.document(std::string(result.method.title) + ": " +
                          std::to_string(found.true_corners) + " true corners (rings), " +
                          std::to_string(found.false_corners) + " false ones; squares: terminals");
}

}  // namespace

void draw_bench(const BenchReport& report, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw tool::Failure(folder.string() + ": " + error.message());
  tool::write_file(folder / "times.svg", draw_times(report));
  tool::write_file(folder / "positions.svg", draw_positions(report));
  if (report.scans.scans.empty()) return;
  const std::size_t scan = richest_scan(report);
  for (const PaperResult& result : report.paper) {
    tool::write_file(folder / ("scan-" + std::string(result.method.name) + ".svg"),
                     draw_bench_scan(report, result, scan));
  }
}

}  // namespace cornerd::bench
