// SPDX-License-Identifier: MIT
#include <memory>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/instruction_counter.hpp"
#include "bench/localization/cost.hpp"
#include "bench/localization/kidnapping.hpp"
#include "bench/localization/trials.hpp"
#include "bench/program/benches.hpp"
#include "bench/program/contest_maps.hpp"
#include "bench/statistics.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/progress_bar.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kMetresToMillimetres = 1e3;
/// The difference of two counts cancels the program's own cost.
constexpr std::size_t kFewScans = 20;
constexpr std::size_t kManyScans = kMaxCountedScans;

struct TrialResult {
  std::string title;
  PoseScore score;
};

struct CostResult {
  std::optional<double> first_fix;  ///< instructions a scan of 800 samples, no prior
  std::optional<double> tracking;
};

struct LocalizationReport {
  std::vector<TrialResult> trials;
  Reliability reliability;
  KidnappingScore kidnapping;
  std::optional<CostResult> cost;
};

std::optional<double> count_scan(const LocalizationBenchOptions& options, bool tracking) {
  const auto count = [&](std::size_t scans) {
    return count_by_callgrind({"--localizer", "--maps", contest_maps_folder(options.maps).string(),
                               "--only-localize", tracking ? "tracking" : "first", "--only-detect",
                               std::to_string(scans)});
  };
  const auto few = count(kFewScans);
  const auto many = few ? count(kManyScans) : std::nullopt;
  if (!many || *many < *few) return std::nullopt;
  return static_cast<double>(*many - *few) / (kManyScans - kFewScans);
}

double percent(std::size_t part, std::size_t whole) {
  return 100 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
}

std::string trials_text(const std::vector<TrialResult>& trials) {
  tool::TextTable table;
  table.add_row({"trial", "scans", "named %", "wrong", "ambiguous", "with truth", "lost", "mean mm",
                 "median", "rms", "of bound", "mean deg", "NEES", "< 7.8 %"});
  for (const auto& [title, score] : trials) {
    table.add_row({title, std::to_string(score.scans()),
                   tool::formatted("%.2f", percent(score.named(), score.scans())),
                   std::to_string(score.wrong()), std::to_string(score.ambiguous()),
                   std::to_string(score.ambiguous_with_truth()), std::to_string(score.lost()),
                   tool::formatted("%.3f", kMetresToMillimetres * score.mean_error_m()),
                   tool::formatted("%.3f", kMetresToMillimetres * score.median_error_m()),
                   tool::formatted("%.3f", kMetresToMillimetres * score.rmse_m()),
                   tool::formatted("%.2f", score.rmse_over_bound()),
                   tool::formatted("%.3f", core::degrees(score.mean_heading_error_rad())),
                   tool::formatted("%.2f", score.mean_nees()),
                   tool::formatted("%.1f", 100 * score.share_inside_95())});
  }
  return "The localizer, scans of 800 samples, without a prior except in motion\n\n" +
         table.text(/*numbers=*/true) +
         "\n  wrong: over 10 cm or 5 degrees off; rms of bound: over the Cramer-Rao bound's of the "
         "same scans;\n  NEES: normalised error squared, 3 if covariances are consistent, and 95 % "
         "below 7.8\n";
}

std::string reliability_text(const Reliability& reliability) {
  tool::TextTable table;
  table.add_row(
      {"p_wrong of the best hypothesis", "scans", "expected wrong", "wrong", "95 % from", "to"});
  for (const Reliability::Bin& bin : reliability.bins()) {
    const Interval rate = clopper_pearson(bin.wrong, bin.scans);
    table.add_row({tool::formatted("from %g", bin.min_p_wrong), std::to_string(bin.scans),
                   tool::formatted("%.3g", bin.expected_wrong), std::to_string(bin.wrong),
                   tool::formatted("%.2g", rate.low), tool::formatted("%.2g", rate.high)});
  }
  return "\nReliability, all trials\n\n" + table.text(/*numbers=*/true);
}

std::string kidnapping_text(const KidnappingScore& score) {
  std::string text =
      "\nKidnapped " + std::to_string(score.jumps) + " times: correct again with scan";
  for (std::size_t k = 0; k < score.recovered.size(); ++k) {
    if (score.recovered[k] == 0) continue;
    text += tool::formatted(" %zu: %zu,", k + 1, score.recovered[k]);
  }
  return text + tool::formatted(" never: %zu; wrong with the first scan: %zu, later: %zu\n",
                                score.never, score.wrong_first, score.wrong_later);
}

std::string cost_text(const CostResult& cost) {
  const auto millions = [](const std::optional<double>& value) {
    return value ? tool::formatted("%.2f million", *value * 1e-6) : std::string("not counted");
  };
  return "\nInstructions a scan of 800 samples, arena A: first fix " + millions(cost.first_fix) +
         ", tracking " + millions(cost.tracking) + "\n";
}

OrderedJson json_of(const TrialResult& trial) {
  const PoseScore& score = trial.score;
  return {{"trial", trial.title},
          {"scans", score.scans()},
          {"named", score.named()},
          {"wrong", score.wrong()},
          {"predicted", score.predicted()},
          {"ambiguous", score.ambiguous()},
          {"ambiguous_with_truth", score.ambiguous_with_truth()},
          {"lost", score.lost()},
          {"mean_error", score.mean_error_m()},
          {"median_error", score.median_error_m()},
          {"rmse", score.rmse_m()},
          {"bound", score.bound_m()},
          {"of_bound", score.rmse_over_bound()},
          {"mean_heading_error", score.mean_heading_error_rad()},
          {"nees", score.mean_nees()},
          {"share_inside_95", score.share_inside_95()}};
}

std::string report_json(const LocalizationReport& report, const LocalizationBenchOptions& options) {
  OrderedJson document = {{"seed", options.seed}, {"samples", 800}};
  for (const TrialResult& trial : report.trials) document["trials"].push_back(json_of(trial));
  for (const Reliability::Bin& bin : report.reliability.bins()) {
    document["reliability"].push_back({{"min_p_wrong", bin.min_p_wrong},
                                       {"scans", bin.scans},
                                       {"expected_wrong", bin.expected_wrong},
                                       {"wrong", bin.wrong}});
  }
  const KidnappingScore& kidnapping = report.kidnapping;
  document["kidnapping"] = {{"jumps", kidnapping.jumps},
                            {"recovered_with_scan", kidnapping.recovered},
                            {"never", kidnapping.never},
                            {"wrong_first", kidnapping.wrong_first},
                            {"wrong_later", kidnapping.wrong_later}};
  if (report.cost && report.cost->first_fix) {
    document["instructions"]["first_fix"] = *report.cost->first_fix;
  }
  if (report.cost && report.cost->tracking) {
    document["instructions"]["tracking"] = *report.cost->tracking;
  }
  return document.dump(2) + '\n';
}

}  // namespace

void only_localize_in_arena(const LocalizationBenchOptions& options, std::size_t scans,
                            bool tracking) {
  localize_scans(load_contest_maps(contest_maps_folder(options.maps)).front(), scans, tracking);
}

void run_localization_bench(const LocalizationBenchOptions& options) {
  const std::filesystem::path folder = contest_maps_folder(options.maps);
  const auto arenas = load_contest_maps(folder);
  const auto flat = settings::load_map(folder / "flat-7.json");
  std::unique_ptr<tool::Output> json;
  if (options.json == "-") json = std::make_unique<tool::Output>();
  if (!options.json.empty() && !json) {
    json = std::make_unique<tool::Output>(std::filesystem::path(options.json));
  }

  LocalizationReport report;
  for (const Trial& trial : default_trials(arenas, flat)) {
    tool::ProgressBar bar(trial.title, options.poses);
    report.trials.push_back({trial.title, run_trial(trial, options.poses, options.seed,
                                                    [&](std::size_t n) { bar.show(n); })});
  }
  {
    tool::ProgressBar bar("kidnapping", options.poses);
    report.kidnapping =
        run_kidnapping(arenas, options.poses, options.seed, [&](std::size_t n) { bar.show(n); });
  }
  if (options.instructions) {
    report.cost = CostResult{count_scan(options, false), count_scan(options, true)};
  }
  for (const TrialResult& trial : report.trials) report.reliability.add(trial.score.reliability());
  if (json) {
    json->write(report_json(report, options));
    json->flush();
  }
  if (options.json == "-") return;
  tool::Output output;
  output.write(trials_text(report.trials) + reliability_text(report.reliability) +
               kidnapping_text(report.kidnapping) + (report.cost ? cost_text(*report.cost) : ""));
  output.flush();
}

}  // namespace cornerd::bench
