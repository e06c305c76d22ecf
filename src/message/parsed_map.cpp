// SPDX-License-Identifier: MIT
#include "message/parsed_map.hpp"

namespace cornerd::message {
namespace {

// The limits of a map file.
constexpr Limits kThicknessLimitsM{0, 10};
constexpr Limits kSigmaLimitsM{0, 10};
constexpr std::size_t kMaxWalls = 100'000;
constexpr std::size_t kMaxRooms = 10'000;
constexpr std::size_t kMaxPolygonPoints = 10'000;

core::Vec2 read_point(FieldReader& fields, const char* name, const Json& point) {
  if (!point.is_array() || point.size() != 2) {
    fields.fail("\"" + std::string(name) + "\" must hold points [x, y]");
    return core::Vec2::Zero();
  }
  return {fields.element(name, point, 0, kCoordinateLimitsM),
          fields.element(name, point, 1, kCoordinateLimitsM)};
}

core::Wall read_wall(const Json& object, double thickness_m, FieldReader& walls) {
  core::Wall wall;
  FieldReader fields(object);
  wall.from = read_point(fields, "from", fields.array("from", 2));
  wall.to = read_point(fields, "to", fields.array("to", 2));
  wall.thickness_m = fields.optional_number("thickness", kThicknessLimitsM).value_or(thickness_m);
  wall.sigma_m = fields.optional_number("sigma", kSigmaLimitsM);
  if (fields.has("open")) {
    const Json& open = fields.array("open", 2);
    for (std::size_t end = 0; end < 2; ++end) {
      if (open.size() != 2 || !open[end].is_boolean()) {
        fields.fail("\"open\" must hold two of true and false");
        break;
      }
      wall.is_open[end] = open[end].get<bool>();
    }
  }
  if (fields.error()) walls.fail("\"walls\": " + fields.error()->text);
  return wall;
}

core::Room read_room(const Json& object, FieldReader& rooms) {
  core::Room room;
  FieldReader fields(object);
  room.name = fields.text("name");
  for (const Json& point : fields.array("polygon", kMaxPolygonPoints)) {
    room.polygon.push_back(read_point(fields, "polygon", point));
    if (fields.error()) break;
  }
  if (fields.error()) rooms.fail("\"rooms\": " + fields.error()->text);
  return room;
}

}  // namespace

core::FloorPlan read_map(FieldReader& fields) {
  core::FloorPlan plan;
  plan.name = fields.text("name");
  plan.hash = fields.optional_text("hash");
  plan.thickness_m = fields.optional_number("thickness", kThicknessLimitsM).value_or(0);
  plan.sigma_m = fields.optional_number("sigma", kSigmaLimitsM).value_or(plan.sigma_m);
  for (const Json& wall : fields.array("walls", kMaxWalls)) {
    plan.walls.push_back(read_wall(wall, plan.thickness_m, fields));
    if (fields.error()) break;
  }
  if (!fields.has("rooms")) return plan;
  for (const Json& room : fields.array("rooms", kMaxRooms)) {
    plan.rooms.push_back(read_room(room, fields));
    if (fields.error()) break;
  }
  return plan;
}

}  // namespace cornerd::message
