// SPDX-License-Identifier: MIT
#include "tool/map/map_text.hpp"

#include <cstddef>
#include <span>
#include <string_view>

#include "message/json_text.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

/// Tenths of a micrometre: equal corners of the plan stay equal in the file.
constexpr int kMapDecimals = 7;

void write_point(message::JsonText& json, std::string_view name, const core::Vec2& point) {
  json.key(name);
  json.open_array();
  json.fixed(point.x(), kMapDecimals);
  json.fixed(point.y(), kMapDecimals);
  json.close_array();
}

std::string rooms_text(std::span<const core::Room> rooms) {
  message::JsonText json(256);
  std::string text = "  \"rooms\": [\n";
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    json.clear();
    json.open_object();
    json.key("name");
    json.string(rooms[i].name);
    json.key("polygon");
    json.open_array();
    for (const core::Vec2& point : rooms[i].polygon) {
      json.open_array();
      json.fixed(point.x(), kMapDecimals);
      json.fixed(point.y(), kMapDecimals);
      json.close_array();
    }
    json.close_array();
    json.close_object();
    text.append("    ").append(json.view()).append(i + 1 < rooms.size() ? ",\n" : "\n");
  }
  return text;
}

std::string map_text(const core::FloorPlan& plan) {
  message::JsonText json(256);
  json.string(plan.name);
  std::string text = "{ \"format\": \"cornerd-map\", \"version\": 1, \"name\": ";
  text.append(json.view()).append(formatted(", \"sigma\": %g", plan.sigma_m));
  text.append(",\n  \"walls\": [\n");
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    const core::Wall& wall = plan.walls[i];
    json.clear();
    json.open_object();
    write_point(json, "from", wall.from);
    write_point(json, "to", wall.to);
    json.key("thickness");
    json.fixed(wall.thickness_m, kMapDecimals);
    if (wall.sigma_m) {
      json.key("sigma");
      json.fixed(*wall.sigma_m, kMapDecimals);
    }
    if (wall.is_open[0] || wall.is_open[1]) {
      json.open_array("open");
      for (const bool is_open : wall.is_open) json.boolean(is_open);
      json.close_array();
    }
    json.close_object();
    text.append("    ").append(json.view()).append(i + 1 < plan.walls.size() ? ",\n" : "\n");
  }
  if (!plan.rooms.empty()) text.append("  ],\n").append(rooms_text(plan.rooms));
  return text + "  ] }\n";
}

std::shared_ptr<const core::WallMap> read_back(const std::string& text,
                                               const std::filesystem::path& file) {
  try {
    return settings::parse_map(text, file);
  } catch (const settings::SettingsError& error) {
    throw Failure(std::string(error.what()) + "; nothing is written");
  }
}

}  // namespace

void MapOutput::add(Command& command, const std::string& plotted) {
  command.add_option("-o,--output", output, "the map; -: on standard output")
      .required()
      .type_name("MAP");
  command.add_option("--name", name, "name of the map; default: the plan's, else of its file")
      .type_name("NAME");
  command.add_option("--plot", plot, "draw " + plotted).type_name("SVG");
}

std::shared_ptr<const core::WallMap> MapOutput::write(core::FloorPlan& plan) const {
  if (!name.empty()) plan.name = name;
  if (plan.name.empty()) plan.name = output == kStandardOutput ? "map" : output.stem().string();
  const std::string text = map_text(plan);
  auto map = read_back(text, output);
  write_file(output, text);
  return map;
}

std::string describe_map(const core::WallMap& map) {
  const core::Vec2 size = map.upper_right() - map.lower_left();
  return formatted("%.3f x %.3f m, %zu walls, %zu corners", size.x(), size.y(),
                   map.plan().walls.size(), map.corners().size());
}

}  // namespace cornerd::tool
