// SPDX-License-Identifier: MIT
// cornerctl map learned: the map with the walls where the daemon has learned them to be.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "replay/simulator/map_error.hpp"
#include "settings/document.hpp"
#include "settings/learned_walls.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/commands.hpp"
#include "tool/map/map_text.hpp"

namespace cornerd::tool {

namespace {

/// Of the packaged service.
constexpr const char* kStateFolder = "/var/lib/cornerd";
/// The format's least sigma of a wall.
constexpr double kLeastSigma_m = 0.001;

struct LearnedOptions {
  std::filesystem::path map;
  std::filesystem::path walls;
  std::filesystem::path output;
};

core::FloorPlan with_learned(const core::FloorPlan& drawn, const core::LearnedWalls& walls,
                             const std::filesystem::path& file) {
  std::vector<double> by_m(drawn.walls.size());
  for (const core::WallOffset& wall : walls.offsets) {
    if (wall.wall >= by_m.size()) {
      throw Failure(file.string() + ": has a wall that the map has not; give the map's own file");
    }
    by_m[wall.wall] = wall.offset_m;
  }
  core::FloorPlan plan = replay::with_walls_moved(drawn, by_m);
  for (const core::WallOffset& wall : walls.offsets) {
    plan.walls[wall.wall].sigma_m = std::max(wall.sigma_m, kLeastSigma_m);
  }
  return plan;
}

void write_learned(const LearnedOptions& options) {
  const auto map = settings::load_map(options.map);
  const std::string& hash = map->plan().hash;
  const std::filesystem::path file =
      options.walls.empty()
          ? kStateFolder / std::filesystem::path(settings::learned_walls_name(hash))
          : options.walls;
  guard_files({.read = {options.map, file}, .written = {}, .output = options.output});
  const settings::LearnedWallsOfMap learned = settings::parse_learned_walls(
      settings::read_file(file, settings::kMaxLearnedWallsBytes), file);
  if (learned.map_hash != hash) {
    throw Failure(file.string() + ": was learned in another map than " + options.map.string() +
                  "; give the map that the daemon used");
  }
  core::FloorPlan plan = with_learned(map->plan(), learned.walls, file);
  MapOutput output;
  output.output = options.output;
  const auto written = output.write(plan);
  Output report = Output::report_beside(options.output);
  report.write(describe_map(*written) + "; " + std::to_string(learned.walls.offsets.size()) +
               " walls learned\n");
  report.flush();
}

}  // namespace

void add_map_learned(Command& group) {
  Command command = group.add_subcommand(
      "learned", "write a map with its walls where the daemon has learned them to be");
  const auto options = std::make_shared<LearnedOptions>();
  command.add_option("map", options->map, "the map that the daemon used")
      .required()
      .type_name("MAP");
  command
      .add_option("--walls", options->walls,
                  "what the daemon learned, walls-HASH.json of /advanced/localizer/walls_folder; "
                  "default: the service's")
      .type_name("FILE");
  command.add_option("-o,--output", options->output, "the map; -: on standard output")
      .required()
      .type_name("MAP");
  command.callback([options] { write_learned(*options); });
}

}  // namespace cornerd::tool
