// SPDX-License-Identifier: MIT
#include "bench/program/cornerd_bench.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/program/benches.hpp"
#include "bench/program/contest_maps.hpp"
#include "bench/program/report.hpp"
#include "bench/workload.hpp"
#include "core/scan.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/progress_bar.hpp"

namespace cornerd::bench {

namespace {

/// Runs per scan; their median is its time.
constexpr std::size_t kTimingRepeats = 51;

struct BenchOptions {
  std::filesystem::path maps;
  std::vector<std::string> methods;
  bool variants = false;
  std::size_t positions = 10'000;
  std::size_t samples = 800;
  std::uint64_t seed = 1;
  bool instructions = false;
  std::filesystem::path plots;
  std::string json;
  std::size_t detections = 0;
  std::size_t robots = 0;
  bool scale = false;
  std::size_t floor_starts = 0;
  bool localizer = false;
  std::string only_localize;
  bool odometry = false;
  bool survey = false;
  bool drawn_plans = false;
  std::size_t corridors = 0;
  std::filesystem::path evidence;
  std::vector<std::size_t> corners;
  std::optional<tool::Option> positions_given;
};

std::vector<NamedMethod> chosen_methods(const BenchOptions& options) {
  std::vector<NamedMethod> methods;
  for (const std::string& name : options.methods) {
    const NamedMethod* method = find_method(name);
    if (method == nullptr)
      throw tool::UsageError("--methods: '" + name +
                             "' is no method; known: altbd, abd-iepf, lt and the variants");
    methods.push_back(*method);
  }
  if (!methods.empty()) return methods;
  const auto add = [&](auto table) { methods.insert(methods.end(), table.begin(), table.end()); };
  add(paper_methods());
  if (options.variants) add(variants());
  return methods;
}

/// The noise of the published experiment.
replay::SensorModel published_sensor() { return default_conditions().front().sensor; }

/// The workload for the instruction counter.
void only_detect(const BenchOptions& options) {
  const auto maps = load_contest_maps(options.maps);
  const auto scans = simulate_paper_scans(maps, published_sensor(), options.samples, options.seed);
  Workload workload(chosen_methods(options).front(), scans.scans);
  for (std::size_t i = 0; i < options.detections; ++i) workload.run_all();
}

BenchReport measure(const BenchOptions& options) {
  const std::filesystem::path folder = contest_maps_folder(options.maps);
  const auto maps = load_contest_maps(folder);
  const auto methods = chosen_methods(options);

  BenchReport report;
  report.samples = options.samples;
  report.positions = options.positions;
  report.seed = options.seed;
  report.scans = simulate_paper_scans(maps, published_sensor(), options.samples, options.seed);
  report.supported_corners = supported_corners(report.scans);
  report.preparation_us = time_preparation_us(report.scans.scans, kTimingRepeats);
  report.paper = run_paper_experiment(report.scans, methods, kTimingRepeats);
  if (options.instructions) {
    count_instructions({maps, folder, published_sensor(), options.seed}, methods, report);
  }
  for (const Conditions& conditions : default_conditions()) {
    if (options.positions == 0) break;
    tool::ProgressBar bar(conditions.title, options.positions);
    report.corners.push_back(
        {conditions.title,
         score_methods(maps, methods, conditions.sensor, options.samples, options.positions,
                       options.seed, [&](std::size_t done) { bar.show(done); })});
  }
  return report;
}

void run_scale(const BenchOptions& options) {
  ScaleBenchOptions scale;
  if (!options.corners.empty()) scale.corners = options.corners;
  if (options.positions_given->is_given()) scale.scans = options.positions;
  scale.seed = options.seed;
  scale.instructions = options.instructions;
  scale.plots = options.plots;
  scale.json = options.json;
  if (options.detections > 0) {
    only_localize(scale, options.detections);
  } else {
    run_scale_bench(scale);
  }
}

void run_localizer(const BenchOptions& options) {
  LocalizationBenchOptions localization;
  localization.maps = options.maps;
  if (options.positions_given->is_given()) localization.poses = options.positions;
  localization.seed = options.seed;
  localization.instructions = options.instructions;
  localization.json = options.json;
  if (options.detections > 0) {
    only_localize_in_arena(localization, options.detections, options.only_localize == "tracking");
  } else {
    run_localization_bench(localization);
  }
}

/// The maps are inputs: --json must not overwrite one.
void guard_maps(const BenchOptions& options) {
  if (options.json.empty() || (options.scale && options.maps.empty())) return;
  tool::CommandFiles files{.read = {}, .written = {}, .output = options.json};
  std::error_code ignored;  // load_contest_maps() reports an unreadable folder
  for (const auto& entry :
       std::filesystem::directory_iterator(contest_maps_folder(options.maps), ignored)) {
    files.read.push_back(entry.path());
  }
  tool::guard_files(files);
}

void run_bench(const BenchOptions& options) {
  guard_maps(options);
  if (!options.evidence.empty()) {
    EvidenceBenchOptions evidence{options.maps, options.evidence};
    evidence.seed = options.seed;
    if (options.positions_given->is_given()) evidence.scans = options.positions;
    return run_evidence_bench(evidence);
  }
  if (options.floor_starts > 0) return run_floors_bench(options.floor_starts, options.seed);
  if (options.localizer) {
    if (options.scale || options.survey)
      throw tool::UsageError("--localizer excludes --scale and --survey; name one of them");
    return run_localizer(options);
  }
  if (options.odometry) {
    if (options.scale) throw tool::UsageError("--odometry excludes --scale; name one of them");
    OdometryBenchOptions odometry{options.maps, options.plots, options.json, options.seed};
    if (options.positions_given->is_given()) odometry.drives = options.positions;
    odometry.robots = options.robots;
    return odometry.robots > 0 ? run_random_robot_bench(odometry) : run_odometry_bench(odometry);
  }
  if (options.corridors > 0) return run_corridor_bench(options.corridors, options.seed);
  if (options.drawn_plans) {
    DrawnPlanBenchOptions drawn{.maps = options.maps, .seed = options.seed};
    if (options.positions_given->is_given()) drawn.plans = options.positions;
    return run_drawn_plan_bench(drawn);
  }
  if (options.survey) {
    if (options.scale) throw tool::UsageError("--survey excludes --scale; name one of them");
    return run_survey_bench({options.maps, options.plots, options.seed});
  }
  if (options.scale) return run_scale(options);
  if (options.robots > 0) throw tool::UsageError("--robots: only with --odometry; add it");
  if (!options.corners.empty()) throw tool::UsageError("--corners: only with --scale; add it");
  if (options.detections > 0) return only_detect(options);
  // Fails before the work if the file cannot be written.
  std::unique_ptr<tool::Output> json;
  if (options.json == "-") json = std::make_unique<tool::Output>();
  if (!options.json.empty() && !json) {
    json = std::make_unique<tool::Output>(std::filesystem::path(options.json));
  }
  const BenchReport report = measure(options);
  if (!options.plots.empty()) draw_bench(report, options.plots);
  if (json) {
    json->write(bench_json(report));
    json->flush();
  }
  if (options.json == "-") return;
  tool::Output output;
  output.write(bench_text(report));
  output.flush();
}

void add_options(tool::Command& program, const std::shared_ptr<BenchOptions>& options) {
  program
      .add_option("--maps", options->maps,
                  "folder with krpai-2019-a.json to -d.json; default: the installed one")
      .type_name("DIR");
  program
      .add_option("--methods", options->methods,
                  "methods to run: altbd, abd-iepf, lt, or a variant's name; default: all three")
      .delimiter(',')
      .type_name("NAME,...");
  program.add_flag("--variants", options->variants, "also run the variants of the methods");
  program.add_flag(
      "--scale", options->scale,
      "other benchmark: the first fix in buildings of 20 to 20,000 corners, and in equal rooms; "
      "--positions: scans in each, default 200");
  program
      .add_option("--floors", options->floor_starts,
                  "other benchmark: N drives on ten floors of one building, and a tenth as many in "
                  "each of other sets of ten maps: which map they are in, and when it is named")
      .range(std::size_t{1}, std::size_t{1'000'000})
      .type_name("N");
  program.add_flag(
      "--localizer", options->localizer,
      "other benchmark: poses against the truth and the Cramer-Rao bound, with a biased lidar, few "
      "returns, unmapped obstacles, displaced walls, a closed door, half a view, a wrong map, in "
      "motion, kidnapped; "
      "--positions: poses of each, default 1,000");
  program.add_flag(
      "--odometry", options->odometry,
      "other benchmark: the paper's odometry modes on its drives, and poses dead reckoned "
      "while the lidar is covered; --maps: with flat-7.json");
  program
      .add_option("--robots", options->robots,
                  "with --odometry, in place of its tables: drives of so many robots with noises, "
                  "clocks and faults drawn at random")
      .range(std::size_t{0}, std::size_t{100'000})
      .type_name("N");
  program.add_flag("--survey", options->survey,
                   "other benchmark: a drive of 100 m, surveyed by both methods, and a second one "
                   "localized in the maps");
  program
      .add_option("--corridors", options->corridors,
                  "other benchmark: drives along N corridors drawn at random")
      .type_name("N");
  program.add_flag("--drawn-plans", options->drawn_plans,
                   "other benchmark: drives in maps with the errors of a plan drawn by hand, with "
                   "and without learning where the walls are; --positions: plans of each building, "
                   "default 8");
  program
      .add_option("--evidence", options->evidence,
                  "write what rays do at right and wrong places of --positions random scans "
                  "(default 16,000), as CSV: what the weights of the evidence are fitted to")
      .type_name("FILE");
  program
      .add_option("--corners", options->corners,
                  "with --scale: approximate number of corners of each building")
      .delimiter(',')
      .range(std::size_t{0}, std::size_t{100'000})
      .type_name("N,...");
  options->positions_given =
      program
          .add_option("--positions", options->positions,
                      "random poses; 0: only the paper's 43 (--odometry: drives of each robot)")
          .range(std::size_t{0}, std::size_t{10'000'000})
          .type_name("N")
          .capture_default_str();
  program.add_option("--samples", options->samples, "samples per scan")
      .range(std::size_t{1}, core::kMaxSamplesPerScan)
      .type_name("N")
      .capture_default_str();
  program.add_option("--seed", options->seed, "seed of the random numbers")
      .check([](const std::string& text) {  // -1 would be the largest number
        return text.starts_with('-') ? std::string("is negative") : std::string();
      })
      .capture_default_str();
  program.add_flag("--instructions", options->instructions,
                   "count the instructions per scan, of 400 to 10,000 samples: by the processor's "
                   "counter, else by valgrind (slow)");
  program.add_option("--plots", options->plots, "draw the figures into this folder, as SVG")
      .type_name("DIR");
  program.add_option("--json", options->json, "all figures; -: on standard output, without text")
      .type_name("FILE");
  program.add_option("--only-detect", options->detections)
      .hidden();  // hidden: the workload for valgrind
  program.add_option("--only-localize", options->only_localize).hidden();  // likewise
  program.callback([options] { run_bench(*options); });
}

}  // namespace

int run_cornerd_bench(int argc, const char* const* argv) {
  const auto options = std::make_shared<BenchOptions>();
  return tool::run_program(
      "cornerd-bench", "the published tables, measured again on this machine, and more poses",
      [&](tool::Command& program) { add_options(program, options); }, argc, argv);
}

}  // namespace cornerd::bench
