// SPDX-License-Identifier: MIT
// cornerctl map scale: the same map in another size.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/commands.hpp"
#include "tool/map/map_text.hpp"

namespace cornerd::tool {

namespace {

struct ScaleOptions {
  std::filesystem::path map;
  std::filesystem::path output;
  std::vector<double> factors;  ///< of both axes, or of x and y
};

/// Multiplies the numbers of a value: a length, a point, a polygon.
void multiply(nlohmann::json& value, const core::Vec2& factors) {
  if (value.is_number()) value = value.get<double>() * std::sqrt(factors.prod());
  if (!value.is_array()) return;
  const bool is_point = std::all_of(value.begin(), value.end(),
                                    [](const nlohmann::json& each) { return each.is_number(); });
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!is_point) {
      multiply(value[i], factors);
    } else if (i < 2) {
      value[i] = value[i].get<double>() * factors[static_cast<Eigen::Index>(i)];
    }
  }
}

/// Multiplies these keys of an object, or of each object of an array.
void multiply(nlohmann::json& object, std::initializer_list<const char*> keys,
              const core::Vec2& factors) {
  if (object.is_array()) {
    for (nlohmann::json& element : object) multiply(element, keys, factors);
  }
  if (!object.is_object()) return;
  for (const char* key : keys) {
    if (object.contains(key)) multiply(object[key], factors);
  }
}

/// Before the map is checked: one in millimetres is larger than a map may be.
core::FloorPlan load_scaled(const std::filesystem::path& file, const core::Vec2& factors) {
  const std::string text = settings::read_map_text(file);
  nlohmann::json map = nlohmann::json::parse(text, nullptr, false, true);
  if (!map.is_object()) return settings::parse_floor_plan(text, file);  // it says what is wrong
  multiply(map, {"thickness"}, factors);
  if (map.contains("walls")) multiply(map["walls"], {"from", "to", "thickness"}, factors);
  if (map.contains("rooms")) multiply(map["rooms"], {"polygon"}, factors);
  return settings::parse_floor_plan(map.dump(), file);
}

void scale(const ScaleOptions& options) {
  if (options.factors.size() > 2) throw UsageError("--factor: one number, or X,Y");
  guard_files({.read = {options.map}, .written = {}, .output = options.output});
  core::FloorPlan plan =
      load_scaled(options.map, {options.factors.front(), options.factors.back()});
  MapOutput output;
  output.output = options.output;
  const auto scaled = output.write(plan);
  Output report = Output::report_beside(options.output);
  report.write(describe_map(*scaled) + "\n");
  report.flush();
}

}  // namespace

void add_map_scale(Command& group) {
  Command command = group.add_subcommand(
      "scale", "multiply a map's lengths: a drawing in millimetres, a tape that was off");
  const auto options = std::make_shared<ScaleOptions>();
  command.add_option("map", options->map, "the map").required().type_name("MAP");
  command
      .add_option("--factor", options->factors,
                  "metres of the building for a metre of the map: 0.001 for millimetres; X,Y: "
                  "along each axis")
      .required()
      .delimiter(',')
      .one_word()
      .type_name("FACTOR")
      .within(1e-6, 1e6);
  command.add_option("-o,--output", options->output, "the map; -: on standard output")
      .required()
      .type_name("MAP");
  command.callback([options] { scale(*options); });
}

}  // namespace cornerd::tool
