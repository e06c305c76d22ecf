// SPDX-License-Identifier: MIT
// cornerctl map learned: the map with the walls where the daemon has learned them to be.
#include <filesystem>
#include <memory>
#include <string>

#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/output.hpp"
#include "tool/commands.hpp"
#include "tool/map/learned_map.hpp"
#include "tool/map/map_text.hpp"

namespace cornerd::tool {

namespace {

struct LearnedOptions {
  std::filesystem::path map;
  std::filesystem::path walls;
  std::filesystem::path output;
  bool leaves_out_gone = false;
};

void write_learned(const LearnedOptions& options) {
  const auto map = settings::load_map(options.map);
  const std::filesystem::path file = learned_walls_file(map->plan(), options.walls);
  guard_files({.read = {options.map, file}, .written = {}, .output = options.output});
  const settings::LearnedWallsOfMap learned = load_learned_walls(map->plan(), file);
  core::FloorPlan plan = with_learned_walls(map->plan(), learned.walls);
  if (options.leaves_out_gone) plan = without_gone_walls(std::move(plan), learned.changes);
  MapOutput output;
  output.output = options.output;
  const auto written = output.write(plan);
  Output report = Output::report_beside(options.output);
  report.write(describe_map(*written) + "; " + std::to_string(learned.walls.offsets.size()) +
               " walls learned\n");
  for (const core::MapChange& change : learned.changes) {
    report.write("  " + settings::describe(change, map->plan()) + '\n');
  }
  report.flush();
}

}  // namespace

void add_map_learned(Command& group) {
  Command command = group.add_subcommand(
      "learned",
      "write a map with its walls where the daemon has learned them to be, and name what has "
      "changed");
  const auto options = std::make_shared<LearnedOptions>();
  command.add_option("map", options->map, "the map that the daemon used")
      .required()
      .type_name("MAP");
  command
      .add_option("--walls", options->walls,
                  "what the daemon learned, walls-HASH.json of /advanced/localizer/walls_folder; "
                  "default: the service's")
      .type_name("FILE");
  command.add_flag("--without-gone", options->leaves_out_gone,
                   "leave out walls that are no longer there");
  command.add_option("-o,--output", options->output, "the map; -: on standard output")
      .required()
      .type_name("MAP");
  command.callback([options] { write_learned(*options); });
}

}  // namespace cornerd::tool
