// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bench/drawn_plan.hpp"
#include "bench/drawn_plan_experiment.hpp"
#include "bench/partitioned_flat.hpp"
#include "bench/program/benches.hpp"
#include "bench/program/contest_maps.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/output.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

namespace {

constexpr double kMillimetresPerMetre = 1e3;
/// Two flats of partitioned_flat().
constexpr std::uint64_t kFlats[] = {3, 8};

std::string millimetres(double metres) {
  return tool::formatted("%.1f mm", metres * kMillimetresPerMetre);
}

void add_row(tool::TextTable& table, const std::string& building, const char* learning,
             const DrawnPlanResult& result) {
  const std::size_t scans = result.first.scans() + result.later.scans();
  const std::size_t named = result.first.named() + result.later.named();
  double aligned_m = 0;
  for (const double error_m : result.aligned_errors_m) {
    aligned_m += error_m / static_cast<double>(result.aligned_errors_m.size());
  }
  table.add_row(
      {building, learning,
       tool::formatted("%.1f %%", 100 * static_cast<double>(named) / static_cast<double>(scans)),
       tool::formatted("%zu", result.first.wrong() + result.later.wrong()),
       millimetres(result.first.mean_error_m()), millimetres(result.later.mean_error_m()),
       millimetres(aligned_m), tool::formatted("%.2f", result.first.mean_nees()),
       tool::formatted("%.2f", result.later.mean_nees())});
}

}  // namespace

void run_drawn_plan_bench(const DrawnPlanBenchOptions& options) {
  tool::TextTable table;
  table.add_row({"building", "learning", "named", "wrong", "error, 1st minute", "2nd minute",
                 "aligned", "NEES, 1st minute", "2nd minute"});
  std::vector<core::FloorPlan> buildings;
  for (const char* name : {"flat-7.json", "krpai-2019-a.json"}) {
    buildings.push_back(settings::load_map(contest_maps_folder(options.maps) / name)->plan());
  }
  for (const std::uint64_t seed : kFlats) buildings.push_back(partitioned_flat(seed));
  for (const core::FloorPlan& plan : buildings) {
    const auto building = std::make_shared<const core::WallMap>(plan);
    DrawnPlanResult off;
    DrawnPlanResult on;
    DrawnPlanResult alone;
    for (std::uint64_t seed = options.seed; seed < options.seed + options.plans; ++seed) {
      const auto map = std::make_shared<const core::WallMap>(drawn_plan(plan, seed));
      drive_in_drawn_plan(building, map, seed, {}, off);
      drive_in_drawn_plan(building, map, seed, {.learns_walls = true}, on);
      drive_in_drawn_plan(building, map, seed, {.learns_walls = true, .has_odometry = false},
                          alone);
    }
    add_row(table, plan.name, "off", off);
    add_row(table, plan.name, "on", on);
    add_row(table, plan.name, "on, no odometry", alone);
  }
  tool::Output output;
  output.write(table.text());
  output.flush();
}

}  // namespace cornerd::bench
