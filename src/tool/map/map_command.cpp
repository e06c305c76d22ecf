// SPDX-License-Identifier: MIT
// cornerctl map, and its check.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/output.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/map_drawing.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/map/look_alikes.hpp"
#include "tool/map/map_text.hpp"
#include "tool/map/map_warnings.hpp"

namespace cornerd::tool {

namespace {

struct CheckOptions {
  std::filesystem::path map;
  std::filesystem::path plot;
  std::size_t places = 400;
};

void check(const CheckOptions& options) {
  guard_files({.read = {options.map}, .written = {options.plot}, .output = {}});
  const auto map = settings::load_map(options.map);
  std::optional<Output> picture;
  if (!options.plot.empty()) picture.emplace(options.plot);
  const auto corners = map->corners();
  const auto convex = std::count_if(corners.begin(), corners.end(),
                                    [](const core::Corner& corner) { return corner.is_convex(); });
  std::string rooms;
  for (const core::Room& room : map->plan().rooms) {
    rooms += (rooms.empty() ? ": " : ", ") + room.name;
  }

  const core::Vec2 size = map->upper_right() - map->lower_left();
  char text[400];
  std::snprintf(text, sizeof text,
                "name     %s\nsize     %.3f x %.3f m\nwalls    %zu\nfaces    %zu\n"
                "corners  %zu (%td convex)\nrooms    %zu",
                map->plan().name.c_str(), size.x(), size.y(), map->plan().walls.size(),
                map->faces().size(), corners.size(), convex, map->plan().rooms.size());
  Output output;
  output.write(text);
  output.write(rooms);
  output.write("\n");
  output.write(describe_warnings(map_warnings(*map)));
  output.flush();
  if (options.places == 0) return;
  const std::vector<ExaminedPlace> places = examine_places(map, options.places);
  output.write(describe_look_alikes(*map, places));
  output.flush();
  if (!picture) return;
  MapDrawing drawing(*map);
  drawing.add_examined_places(places);
  picture->write(drawing.document(
      describe_map(*map) +
      "; red: places that one scan cannot distinguish from those at the ends of the lines"));
  picture->flush();
}

void add_check(Command& group) {
  Command command = group.add_subcommand("check",
                                         "validate a map; report its content, what is probably a "
                                         "mistake in it, and the places that one "
                                         "scan cannot distinguish");
  const auto options = std::make_shared<CheckOptions>();
  command.add_option("map", options->map, "the map").required().type_name("MAP");
  command
      .add_option("--places", options->places,
                  "approximate number of simulated scans; 0: only validate")
      .range(std::size_t{0}, std::size_t{1'000'000})
      .type_name("N")
      .capture_default_str();
  command.add_option("--plot", options->plot, "draw the map and the places").type_name("SVG");
  command.callback([options] { check(*options); });
}

}  // namespace

void add_map(Command& program) {
  Command group = program.add_subcommand("map", "validate, draw, convert, scale and compare maps");
  group.require_subcommand();
  add_check(group);
  add_map_render(group);
  add_map_import(group);
  add_map_export(group);
  add_map_learned(group);
  add_map_scale(group);
  add_map_diff(group);
  add_map_publish(group);
}

}  // namespace cornerd::tool
