// SPDX-License-Identifier: MIT
#include "tool/bench_survey.hpp"

#include <string>
#include <system_error>
#include <vector>

#include "bench/survey_experiment.hpp"
#include "settings/map_file.hpp"
#include "tool/contest_maps.hpp"
#include "tool/failure.hpp"
#include "tool/output.hpp"
#include "tool/survey_files.hpp"
#include "tool/text_table.hpp"

namespace cornerd::tool {

namespace {

constexpr double kMillimetres = 1e3;

std::string describe_second(const std::optional<bench::LocalizationScore>& score) {
  if (!score) return "-";
  return formatted("%.2f mm, %zu wrong", score->mean_error_m * kMillimetres, score->wrong);
}

std::string experiment_text(const bench::SurveyExperiment& experiment) {
  TextTable table;
  table.add_row({"method", "walls over 30 cm", "invented", "corners", "median, max error",
                 "second drive, mean error", "CPU"});
  for (const bench::SurveyCase& made : experiment.cases) {
    const bench::SurveyScore& score = made.score;
    table.add_row({made.title, formatted("%zu of %zu", score.walls_found, score.walls_seen),
                   formatted("%.2f m", score.invented_m),
                   formatted("%zu of %zu", score.corners_found, score.corners_seen),
                   formatted("%.2f, %.2f mm", score.corner_median_m() * kMillimetres,
                             score.corner_max_m() * kMillimetres),
                   describe_second(made.second_drive), formatted("%.1f s", made.cpu_s)});
  }
  return formatted(
             "A drive of %.1f m through seven rooms, wheels 1.5 and 2.5 %% and gyro 2 %% and "
             "0.01 rad/s off:\n",
             experiment.way_m) +
         table.text() +
         formatted(
             "A second drive in the true map: mean error %.2f mm, %zu of %zu turns named a "
             "place, %zu wrong.\n",
             experiment.in_true_map.mean_error_m * kMillimetres, experiment.in_true_map.named,
             experiment.in_true_map.turns, experiment.in_true_map.wrong);
}

void draw_experiment(const bench::SurveyExperiment& experiment,
                     const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Failure(folder.string() + ": " + error.message());
  const auto write = [&](const char* name, const std::string& text) {
    Output output(folder / name);
    output.write(text);
    output.flush();
  };
  write("survey-adjusted.svg", survey_drawing(experiment.cases.front().result));
  write("survey-ransac.svg", ransac_canvas(experiment.cases.back().result));
}

}  // namespace

void run_survey_bench(const SurveyBenchOptions& options) {
  const auto map = settings::load_map(contest_maps_folder(options.maps) / "flat-7.json");
  const bench::SurveyExperiment experiment =
      bench::run_survey_experiment(map, bench::kSurveyTurns, options.seed);
  if (!options.plots.empty()) draw_experiment(experiment, options.plots);
  Output output;
  output.write(experiment_text(experiment));
  output.flush();
}

}  // namespace cornerd::tool
