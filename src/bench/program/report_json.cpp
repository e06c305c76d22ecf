// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/paper_experiment.hpp"
#include "bench/program/report.hpp"
#include "bench/statistics.hpp"

namespace cornerd::bench {

namespace {

using Figures = nlohmann::ordered_json;

Figures json_of(const PoseResult& result, const PaperPose& pose, const PaperScans& scans) {
  Figures figures = {{"location", kPaperLocations[pose.location].title},
                     {"map", scans.maps[pose.map]->plan().name},
                     {"x", pose.T_map_lidar.x_m},
                     {"y", pose.T_map_lidar.y_m},
                     {"theta", pose.T_map_lidar.theta_rad},
                     {"time_us", result.time_us},
                     {"true_corners", result.true_corners},
                     {"missed_corners", result.missed_corners},
                     {"false_corners", result.false_corners}};
  if (result.nearest_corners_error_m) {
    figures["nearest_corners_error"] = *result.nearest_corners_error_m;
  }
  if (result.localizer_error_m) figures["localizer_error"] = *result.localizer_error_m;
  return figures;
}

Figures json_of(const PaperResult& result, const PaperScans& scans) {
  Figures poses = Figures::array();
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    poses.push_back(json_of(result.poses[i], scans.poses[i], scans));
  }
  return {{"method", result.method.name}, {"poses", poses}};
}

Figures json_of(const MethodScore& line) {
  const CornerScore& score = line.score;
  std::vector<double> errors_m = score.errors_m();
  std::sort(errors_m.begin(), errors_m.end());
  return {{"method", line.method.name},
          {"scans", score.scans()},
          {"supported_corners", score.supported()},
          {"visible_corners", score.visible()},
          {"detections",
           {{"true", score.detections(Verdict::kTrue)},
            {"false", score.detections(Verdict::kFalse)},
            {"one_sided", score.detections(Verdict::kOneSided)},
            {"occlusion_edge", score.detections(Verdict::kOcclusionEdge)}}},
          {"precision", score.precision()},
          {"precision_strict", score.precision(true)},
          {"precision_of_corners", score.precision_of_corners()},
          {"precision_of_corners_strict", score.precision_of_corners(true)},
          {"recall_supported", score.recall_of_supported()},
          {"recall_visible", score.recall_of_visible()},
          {"error_median", quantile(errors_m, 0.5)},
          {"error_95", quantile(errors_m, 0.95)}};
}

}  // namespace

std::string bench_json(const BenchReport& report) {
  Figures paper = Figures::array();
  for (const PaperResult& result : report.paper) {
    paper.push_back(json_of(result, report.scans));
  }
  Figures corners = Figures::array();
  for (const CornerReport& table : report.corners) {
    Figures scores = Figures::array();
    for (const MethodScore& line : table.scores) scores.push_back(json_of(line));
    corners.push_back({{"conditions", table.conditions}, {"methods", scores}});
  }
  Figures document = {{"samples", report.samples}, {"positions", report.positions},
                      {"seed", report.seed},       {"preparation_us", report.preparation_us},
                      {"paper_experiment", paper}, {"corners", corners}};
  if (!report.instructions.empty()) {
    Figures figures = Figures::array();
    for (const InstructionFigure& figure : report.instructions) {
      figures.push_back({{"method", figure.method},
                         {"samples", figure.samples},
                         {"instructions", figure.per_scan}});
    }
    document["instructions"] = {{"counted_by", report.counter}, {"figures", figures}};
  }
  return document.dump(2) + '\n';
}

}  // namespace cornerd::bench
