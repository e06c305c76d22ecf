// SPDX-License-Identifier: MIT
#include "settings/map_file.hpp"

#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "settings/object_reader.hpp"
#include "settings/sha256.hpp"

namespace cornerd::settings {
namespace {

/// Enough for kMaxWalls walls with all their keys and spaces.
constexpr std::size_t kMaxMapBytes = 32 << 20;
constexpr std::size_t kMaxWalls = 100'000;
constexpr std::size_t kMaxRooms = 10'000;
constexpr std::size_t kMaxPolygonPoints = 10'000;
constexpr std::size_t kMaxNameBytes = 128;
constexpr int kVersion = 1;

constexpr Interval kCoordinateM{-kMaxCoordinateM, kMaxCoordinateM};
constexpr Interval kThicknessM{0, kMaxThicknessM,
                               " metres (`cornerctl map scale` converts millimetres)"};
constexpr Interval kSigmaOfWallsM{0.001, 0.5};

/// Points closer than this are one: below any drawing's precision.
constexpr double kSamePointM = 1e-4;

const Json& require_array(ObjectReader& object, std::string_view key, std::size_t min_size,
                          std::size_t max_size) {
  const Json* array = object.find(key);
  if (array == nullptr) object.fail(key, "is missing");
  if (!array->is_array()) object.fail(key, "must be an array");
  if (array->size() < min_size) {
    object.fail(key, "must have at least " + std::to_string(min_size) +
                         (min_size == 1 ? " element" : " elements"));
  }
  if (array->size() > max_size) {
    object.fail(key, "must have at most " + std::to_string(max_size) + " elements");
  }
  return *array;
}

/// `fail` is called with the reason and does not return.
core::Vec2 read_point(const Json& value, const auto& fail) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    fail("must be a point, [x, y] in metres");
  }
  const core::Vec2 point{value[0].get<double>(), value[1].get<double>()};
  if (!(point.minCoeff() >= kCoordinateM.low && point.maxCoeff() <= kCoordinateM.high)) {
    fail("coordinates must be from " + to_text(kCoordinateM.low) + " to " +
         to_text(kCoordinateM.high) + " metres: `cornerctl map scale` converts other units");
  }
  return point;
}

core::Vec2 require_point(ObjectReader& object, std::string_view key) {
  const Json* value = object.find(key);
  if (value == nullptr) object.fail(key, "is missing");
  return read_point(*value, [&](const std::string& reason) { object.fail(key, reason); });
}

core::Wall read_wall(ObjectReader object, double default_thickness_m) {
  core::Wall wall;
  wall.from = require_point(object, "from");
  wall.to = require_point(object, "to");
  wall.thickness_m = default_thickness_m;
  object.number("thickness", wall.thickness_m, kThicknessM);
  if (double sigma_m = 0; object.number("sigma", sigma_m, kSigmaOfWallsM)) wall.sigma_m = sigma_m;
  if (object.find("open") != nullptr) {
    const Json& open = require_array(object, "open", 2, 2);
    for (std::size_t end = 0; end < 2; ++end) {
      if (!open[end].is_boolean()) object.fail("open", end, "must be true or false");
      wall.is_open[end] = open[end].get<bool>();
    }
  }
  object.finish();
  if ((wall.to - wall.from).norm() < kSamePointM && wall.thickness_m < kSamePointM) {
    object.fail("to", "the wall has neither length nor thickness");
  }
  return wall;
}

/// Names are printed on terminals, where a control character is a command.
bool read_name(ObjectReader& object, std::string& name) {
  if (!object.text("name", name, kMaxNameBytes)) return false;
  if (one_line(name) != name) object.fail("name", "must not have control characters");
  return true;
}

core::Room read_room(ObjectReader object) {
  core::Room room;
  if (!read_name(object, room.name)) object.fail("name", "is missing");
  const Json& polygon = require_array(object, "polygon", 3, kMaxPolygonPoints);
  room.polygon.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    room.polygon.push_back(read_point(
        polygon[i], [&](const std::string& reason) { object.fail("polygon", i, reason); }));
  }
  object.finish();
  return room;
}

void check_format(ObjectReader& root) {
  std::string format;
  if (!root.text("format", format, kMaxNameBytes) || format != "cornerd-map") {
    root.fail("format", "must be \"cornerd-map\"; is this file a map?");
  }
  int version = 0;
  if (!root.integer("version", version, 0, 1'000'000)) root.fail("version", "is missing");
  if (version != kVersion) {
    root.fail("version", "is " + std::to_string(version) + "; this program reads version " +
                             std::to_string(kVersion));
  }
}

core::FloorPlan read_plan(ObjectReader root, const std::filesystem::path& file) {
  core::FloorPlan plan;
  check_format(root);
  plan.name = one_line(file.stem().string());
  read_name(root, plan.name);
  root.number("thickness", plan.thickness_m, kThicknessM);
  root.number("sigma", plan.sigma_m, kSigmaOfWallsM);
  const Json& walls = require_array(root, "walls", 1, kMaxWalls);
  plan.walls.reserve(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    plan.walls.push_back(read_wall(root.element("walls", walls, i), plan.thickness_m));
  }
  if (root.find("rooms") != nullptr) {
    const Json& rooms = require_array(root, "rooms", 0, kMaxRooms);
    plan.rooms.reserve(rooms.size());
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      plan.rooms.push_back(read_room(root.element("rooms", rooms, i)));
    }
  }
  root.finish();
  return plan;
}

/// What a file is that somebody took for a map; nullopt where it may be one.
std::optional<std::string> why_no_map(std::string_view text) {
  constexpr const char* kImage =
      "is an image, not a map; cornerctl map import makes a map from the yaml beside it";
  constexpr const char* kPlan = "is a drawing, not a map; cornerctl map import makes a map from it";
  constexpr const char* kRos =
      "is the yaml of a ROS map, not a map; cornerctl map import makes a map from it";
  constexpr const char* kPage = "is a web page, not a map; download the file itself";
  constexpr const char* kUtf16 = "is UTF-16 text; save it as UTF-8";
  constexpr std::pair<std::string_view, const char*> kBegins[] = {
      {"\x89PNG", kImage},
      {"P2", kImage},
      {"P4", kImage},
      {"P5", kImage},
      {"<svg", kPlan},
      {"<?xml", kPlan},
      {"0\nSECTION", kPlan},
      {"0\r\nSECTION", kPlan},
      {"999\n", kPlan},
      {"999\r\n", kPlan},
      {"<!", kPage},
      {"<html", kPage},
      {"\x1f\x8b", "is compressed; unpack it first (gunzip)"},
      {"\xff\xfe", kUtf16},
      {"\xfe\xff", kUtf16},
      {"{\"class\":", "is a recording, not a map"},
      {"image:", kRos},
      {"resolution:", kRos}};
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return "is empty";
  for (const auto& [start, reason] : kBegins) {
    if (text.substr(begin).starts_with(start)) return reason;
  }
  // After comments or other keys.
  if (text[begin] != '{' && text.find("\nimage:") != std::string_view::npos) return kRos;
  return std::nullopt;
}

std::shared_ptr<const core::WallMap> make_map(core::FloorPlan plan,
                                              const std::filesystem::path& file) {
  try {
    return std::make_shared<const core::WallMap>(std::move(plan));
  } catch (const std::invalid_argument& error) {
    throw SettingsError(file.string(), "/walls", error.what());
  }
}

}  // namespace

core::FloorPlan parse_floor_plan(std::string_view text, const std::filesystem::path& file) {
  if (const auto reason = why_no_map(text)) throw SettingsError(file.string(), "", *reason);
  const DocumentContext context{.file = file};
  const Json document = parse_document(text, file);
  core::FloorPlan plan = read_plan({context, document, ""}, file);
  plan.hash = sha256(text);
  return plan;
}

std::string size_warning(const core::WallMap& map) {
  // Larger buildings are rare; drawings in millimetres or pixels are not.
  constexpr double kMaxSize_m = 500;
  const core::Vec2 size = map.upper_right() - map.lower_left();
  if (size.maxCoeff() <= kMaxSize_m) return {};
  std::array<char, 64> metres{};
  std::snprintf(metres.data(), metres.size(), "%.0f x %.0f m", size.x(), size.y());
  return std::string("the map is ") + metres.data() +
         " large: if it was drawn in other units, cornerctl map scale --factor 0.001 (millimetres) "
         "or 0.01 (centimetres) converts it; else look for a stray wall";
}

std::shared_ptr<const core::WallMap> parse_map(std::string_view text,
                                               const std::filesystem::path& file) {
  return make_map(parse_floor_plan(text, file), file);
}

std::string read_map_text(const std::filesystem::path& file, FileKind kind) {
  return read_file(file, kMaxMapBytes, kind);
}

std::shared_ptr<const core::WallMap> load_map(const std::filesystem::path& file, FileKind kind,
                                              const std::string& name) {
  core::FloorPlan plan = parse_floor_plan(read_map_text(file, kind), file);
  if (!name.empty()) plan.name = name;
  return make_map(std::move(plan), file);
}

}  // namespace cornerd::settings
