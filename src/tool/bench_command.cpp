// SPDX-License-Identifier: MIT
// cornerctl bench: the published experiment, measured again.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bench/corner_experiment.hpp"
#include "core/scan.hpp"
#include "tool/bench_text.hpp"
#include "tool/commands.hpp"
#include "tool/contest_maps.hpp"
#include "tool/failure.hpp"
#include "tool/output.hpp"
#include "tool/progress_bar.hpp"

namespace cornerd::tool {

namespace {

struct BenchOptions {
  std::filesystem::path maps;
  std::vector<std::string> methods;
  bool variants = false;
  std::size_t positions = 10'000;
  std::size_t samples = 800;
  std::uint64_t seed = 1;
};

std::vector<bench::NamedMethod> chosen_methods(const BenchOptions& options) {
  std::vector<bench::NamedMethod> methods;
  for (const std::string& name : options.methods) {
    const bench::NamedMethod* method = bench::find_method(name);
    if (method == nullptr) throw UsageError("--methods: none is called '" + name + "'");
    methods.push_back(*method);
  }
  if (!methods.empty()) return methods;
  const auto add = [&](auto table) { methods.insert(methods.end(), table.begin(), table.end()); };
  add(bench::paper_methods());
  if (options.variants) add(bench::variants());
  return methods;
}

void bench_corners(const BenchOptions& options, Output& output) {
  const auto maps = load_contest_maps(options.maps);
  const auto methods = chosen_methods(options);
  output.write("Corners at " + std::to_string(options.positions) + " random places, " +
               std::to_string(options.samples) + " samples a turn\n\n");
  for (const bench::Circumstances& circumstances : bench::usual_circumstances()) {
    ProgressBar bar(circumstances.title, options.positions);
    const auto scores = bench::score_methods(maps, methods, circumstances.sensor, options.samples,
                                             options.positions, options.seed,
                                             [&](std::size_t done) { bar.show(done); });
    output.write(corner_table(circumstances.title, scores) + "\n");
  }
  output.write(corner_table_legend());
}

void run_bench(const BenchOptions& options) {
  Output output(/*flush_each=*/true);
  bench_corners(options, output);
  output.flush();
}

}  // namespace

void add_bench(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("bench", "the published tables, measured again on this machine");
  const auto options = std::make_shared<BenchOptions>();
  command
      ->add_option("--maps", options->maps,
                   "folder with krpai-2019-a.json to -d.json; else the installed ones")
      ->type_name("DIR");
  command
      ->add_option("--methods", options->methods,
                   "only these: altbd, abd-iepf, lt, or a variant's name")
      ->delimiter(',')
      ->type_name("NAME,...");
  command->add_flag("--variants", options->variants, "also other forms of the methods");
  command->add_option("--positions", options->positions, "random places")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000'000}))
      ->capture_default_str();
  command->add_option("--samples", options->samples, "a turn")
      ->check(CLI::Range(std::size_t{1}, core::kMaxSamplesPerTurn))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of all randomness")->capture_default_str();
  command->callback([options] { run_bench(*options); });
}

}  // namespace cornerd::tool
