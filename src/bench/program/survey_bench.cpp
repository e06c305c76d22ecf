// SPDX-License-Identifier: MIT
#include <string>
#include <system_error>
#include <vector>

#include "bench/building.hpp"
#include "bench/program/benches.hpp"
#include "bench/program/contest_maps.hpp"
#include "bench/survey_experiment.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/drawing/survey_drawing.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

namespace {

constexpr double kMillimetres = 1e3;

std::string describe_second(const std::optional<LocalizationScore>& score) {
  if (!score) return "-";
  return tool::formatted("%.2f mm, %zu wrong", score->mean_error_m * kMillimetres, score->wrong);
}

std::string walls_text(const SurveyScore& score) {
  return tool::formatted("%zu of %zu", score.walls_found, score.walls_visible);
}
std::string corners_text(const SurveyScore& score) {
  return tool::formatted("%zu of %zu", score.corners_found, score.corners_visible);
}
std::string corner_errors_text(const SurveyScore& score) {
  return tool::formatted("%.2f, %.2f mm", score.corner_median_m() * kMillimetres,
                         score.corner_max_m() * kMillimetres);
}

std::string experiment_text(const SurveyExperiment& experiment) {
  tool::TextTable table;
  table.add_row({"method", "walls over 30 cm", "invented", "corners", "median, max error",
                 "second drive, mean error", "CPU"});
  for (const SurveyCase& made : experiment.cases) {
    const SurveyScore& score = made.score;
    table.add_row({made.title, walls_text(score), tool::formatted("%.2f m", score.invented_m),
                   corners_text(score), corner_errors_text(score),
                   describe_second(made.second_drive), tool::formatted("%.1f s", made.cpu_s)});
  }
  return tool::formatted(
             "A drive of %.1f m through seven rooms, errors: wheels 1.5 and 2.5 %%, gyro 2 %% and "
             "0.01 rad/s:\n",
             experiment.length_m) +
         table.text() +
         tool::formatted(
             "A second drive in the true map: mean error %.2f mm, %zu of %zu scans with a "
             "pose, %zu wrong.\n",
             experiment.in_true_map.mean_error_m * kMillimetres, experiment.in_true_map.named,
             experiment.in_true_map.scans, experiment.in_true_map.wrong);
}

void write_drawing(const std::filesystem::path& folder, const char* name, const std::string& text) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw tool::Failure(folder.string() + ": " + error.message());
  tool::write_file(folder / name, text);
}

/// Walls and trajectory without the returns, which would hide them at this scale.
std::string loop_drawing(survey::SurveyResult result, const core::Pose2& start) {
  result.points.clear();
  survey::move_frame(start, result);
  return tool::survey_drawing(result);
}

std::string loops_text(const SurveyBenchOptions& options) {
  const core::WallMap ring(ring_corridor());
  const SimulatedDrive drive = ring_drive(options.seed);
  const core::Pose2& start = drive.T_map_base.front();
  tool::TextTable table;
  table.add_row({"loops", "walls over 30 cm", "invented", "corners", "median, max error",
                 "largest position error"});
  for (const bool closes : {false, true}) {
    const LoopCase made = survey_loop(ring, drive, closes);
    table.add_row({closes ? "closed" : "left open", walls_text(made.score),
                   tool::formatted("%.2f m", made.score.invented_m), corners_text(made.score),
                   corner_errors_text(made.score), tool::formatted("%.2f m", made.worst_m)});
    if (options.plots.empty()) continue;
    write_drawing(options.plots, closes ? "ring-closed.svg" : "ring-open.svg",
                  loop_drawing(made.result, start));
  }
  return "A ring corridor, three wheel slips in ten metres, a lidar with a range of 4 m:\n" +
         table.text();
}

}  // namespace

void run_survey_bench(const SurveyBenchOptions& options) {
  const auto map = settings::load_map(contest_maps_folder(options.maps) / "flat-7.json");
  const SurveyExperiment experiment = run_survey_experiment(map, kSurveyScans, options.seed);
  if (!options.plots.empty()) {
    write_drawing(options.plots, "survey-adjusted.svg",
                  tool::survey_drawing(experiment.cases.front().result));
    write_drawing(options.plots, "survey-ransac.svg",
                  tool::ransac_canvas(experiment.cases.back().result));
  }
  tool::Output output;
  output.write(experiment_text(experiment));
  output.write(loops_text(options));
  output.flush();
}

}  // namespace cornerd::bench
