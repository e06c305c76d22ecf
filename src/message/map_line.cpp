// SPDX-License-Identifier: MIT
// MAP of LineWriter.
#include "core/map/wall_map.hpp"
#include "message/line_writer.hpp"

namespace cornerd::message {
namespace {

void write_point(JsonText& json, const core::Vec2& point) {
  json.open_array();
  json.shortest(point.x());
  json.shortest(point.y());
  json.close_array();
}

void write_point(JsonText& json, std::string_view name, const core::Vec2& point) {
  json.key(name);
  write_point(json, point);
}

void write_wall(JsonText& json, const core::Wall& wall, double default_thickness_m) {
  json.open_object();
  write_point(json, "from", wall.from);
  write_point(json, "to", wall.to);
  if (wall.thickness_m != default_thickness_m) {
    json.key("thickness");
    json.shortest(wall.thickness_m);
  }
  if (wall.sigma_m) {
    json.key("sigma");
    json.shortest(*wall.sigma_m);
  }
  if (wall.is_open[0] || wall.is_open[1]) {
    json.open_array("open");
    for (const bool is_open : wall.is_open) json.boolean(is_open);
    json.close_array();
  }
  json.close_object();
}

void write_room(JsonText& json, const core::Room& room) {
  json.open_object();
  json.string("name", room.name);
  json.open_array("polygon");
  for (const core::Vec2& point : room.polygon) write_point(json, point);
  json.close_array();
  json.close_object();
}

}  // namespace

std::string_view LineWriter::map(const core::FloorPlan& plan) {
  begin("MAP");
  json_.string("name", plan.name);
  json_.text("hash", plan.hash);
  json_.key("thickness");
  json_.shortest(plan.thickness_m);
  json_.key("sigma");
  json_.shortest(plan.sigma_m);
  json_.open_array("walls");
  for (const core::Wall& wall : plan.walls) write_wall(json_, wall, plan.thickness_m);
  json_.close_array();
  json_.open_array("rooms");
  for (const core::Room& room : plan.rooms) write_room(json_, room);
  json_.close_array();
  return finish();
}

}  // namespace cornerd::message
