// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <system_error>

#include <nlohmann/json.hpp>

#include "bench/instruction_counter.hpp"
#include "bench/program/benches.hpp"
#include "bench/scale_experiment.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/progress_bar.hpp"
#include "tool/drawing/plot.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

namespace {

constexpr double kMillimetre = 1e3;
constexpr double kMebibyte = 1024 * 1024;
constexpr double kMillion = 1e6;
constexpr double kMicroToMilli = 1e-3;
/// Scans localized under valgrind.
constexpr std::size_t kCountedByValgrind = 50;

/// `corners`: of the building, or 0 for the equal rooms, which come last.
std::optional<double> count_scan_by_valgrind(const ScaleBenchOptions& options,
                                             std::size_t corners) {
  const std::size_t scans = std::min(options.scans, kCountedByValgrind);
  const auto count = [&](int times) {
    return count_by_callgrind({"--scale", "--corners", std::to_string(corners), "--positions",
                               std::to_string(scans), "--seed", std::to_string(options.seed),
                               "--only-detect", std::to_string(times)});
  };
  const auto once = count(1);
  const auto twice = once ? count(2) : std::nullopt;
  if (!twice || *twice < *once || scans == 0) return std::nullopt;
  return static_cast<double>(*twice - *once) / static_cast<double>(scans);
}

std::string scale_text(const std::vector<ScaleResult>& results) {
  tool::TextTable table;
  table.add_row({"building", "corners", "rooms", "load s", "MiB", "fix %", "wrong", "ambiguous",
                 "with truth", "lost", "error mm", "time ms", "99 %", "10^6 instr."});
  for (const ScaleResult& r : results) {
    const double scans = static_cast<double>(std::max<std::size_t>(1, r.score.scans()));
    table.add_row({r.title, std::to_string(r.corners), std::to_string(r.rooms),
                   tool::formatted("%.3f", r.map_s + r.catalog_s),
                   tool::formatted("%.2f", static_cast<double>(r.memory_bytes) / kMebibyte),
                   tool::formatted("%.1f", 100 * static_cast<double>(r.score.right()) / scans),
                   std::to_string(r.score.wrong()), std::to_string(r.score.ambiguous()),
                   std::to_string(r.score.ambiguous_with_truth()), std::to_string(r.score.lost()),
                   tool::formatted("%.2f", kMillimetre * r.score.mean_error_m()),
                   tool::formatted("%.3f", kMicroToMilli * r.time_us),
                   tool::formatted("%.3f", kMicroToMilli * r.time_99_us),
                   r.instructions ? tool::formatted("%.2f", *r.instructions / kMillion) : "-"});
  }
  return "First fix by the size of the building: no prior, one scan of 800 samples\n\n" +
         table.text(/*numbers=*/true);
}

std::string scale_json(const std::vector<ScaleResult>& results, const ScaleBenchOptions& options) {
  nlohmann::ordered_json buildings = nlohmann::ordered_json::array();
  for (const ScaleResult& r : results) {
    nlohmann::ordered_json figures = {{"building", r.title},
                                      {"corners", r.corners},
                                      {"rooms", r.rooms},
                                      {"pairs", r.pairs},
                                      {"map_s", r.map_s},
                                      {"catalog_s", r.catalog_s},
                                      {"memory_bytes", r.memory_bytes},
                                      {"scans", r.score.scans()},
                                      {"fixed", r.score.right()},
                                      {"wrong", r.score.wrong()},
                                      {"ambiguous", r.score.ambiguous()},
                                      {"ambiguous_with_truth", r.score.ambiguous_with_truth()},
                                      {"lost", r.score.lost()},
                                      {"mean_error", r.score.mean_error_m()},
                                      {"time_us", r.time_us},
                                      {"time_99_us", r.time_99_us}};
    if (r.instructions) figures["instructions"] = *r.instructions;
    buildings.push_back(std::move(figures));
  }
  const nlohmann::ordered_json document = {{"seed", options.seed}, {"scale", buildings}};
  return document.dump(2) + '\n';
}

/// Time, memory and instructions over the number of corners, both axes logarithmic, relative to the
/// smallest building.
std::string draw_scale(const std::vector<ScaleResult>& results) {
  tool::Plot plot({1, 5, "corners, power of ten"}, {-0.5, 3.5, "times the smallest, power of ten"},
                  "First fix by the size of the building");
  const auto draw = [&](std::string_view name, std::string_view colour, auto&& value) {
    std::vector<core::Vec2> points;
    for (const ScaleResult& r : results) {
      // The equal rooms measure ambiguity, not size.
      if (&r == &results.back() && results.size() > 1) break;
      const double share = value(r) / value(results.front());
      if (!(share > 0)) continue;
      points.emplace_back(std::log10(static_cast<double>(r.corners)), std::log10(share));
      plot.dot(points.back().x(), points.back().y(), 3, {.fill = colour});
    }
    plot.line(points, {.stroke = colour, .stroke_width = 1.5});
    plot.legend(name, {.stroke = colour, .stroke_width = 1.5});
  };
  draw("corners", "#8c867a", [](const auto& r) { return static_cast<double>(r.corners); });
  draw("memory", "#2f6f9f", [](const auto& r) { return static_cast<double>(r.memory_bytes); });
  draw("time of a scan", "#c2255c", [](const auto& r) { return r.time_us; });
  if (results.front().instructions) {
    draw("instructions of a scan", "#1b9e77",
         [](const auto& r) { return r.instructions.value_or(0); });
  }
  return plot.document();
}

}  // namespace

void only_localize(const ScaleBenchOptions& options, std::size_t times) {
  const auto cases = scale_cases(options.corners, options.seed);
  const ScaleCase& building = options.corners.front() == 0 ? cases.back() : cases.front();
  const auto map = std::make_shared<const core::WallMap>(building.plan);
  const ScaleScans scans(map, options.scans, options.seed);
  core::Localizer localizer(map, {});
  for (std::size_t i = 0; i < times; ++i) {
    scans.localize(localizer, [](std::size_t, const core::PoseEstimate&) {});
  }
}

void run_scale_bench(const ScaleBenchOptions& options) {
  std::unique_ptr<tool::Output> json;
  if (options.json == "-") json = std::make_unique<tool::Output>();
  if (!options.json.empty() && !json) {
    json = std::make_unique<tool::Output>(std::filesystem::path(options.json));
  }
  std::unique_ptr<tool::Output> picture;
  if (!options.plots.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.plots, error);
    if (error) throw tool::Failure(options.plots.string() + ": " + error.message());
    picture = std::make_unique<tool::Output>(options.plots / "scale.svg");
  }

  std::vector<ScaleResult> results;
  const auto cases = scale_cases(options.corners, options.seed);
  {
    tool::ProgressBar bar("scale", cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      results.push_back(run_scale_case(cases[i], options.scans, options.seed));
      if (!options.instructions) {
        results.back().instructions.reset();
      } else if (!results.back().instructions) {
        results.back().instructions =
            count_scan_by_valgrind(options, i < options.corners.size() ? options.corners[i] : 0);
      }
      bar.show(i + 1);
    }
  }
  if (options.instructions && !results.front().instructions) {
    std::fputs(kNotCounted, stderr);
  }
  if (picture) {
    picture->write(draw_scale(results));
    picture->flush();
  }
  if (json) {
    json->write(scale_json(results, options));
    json->flush();
  }
  if (options.json == "-") return;
  tool::Output output;
  output.write(scale_text(results));
  output.flush();
}

}  // namespace cornerd::bench
