// SPDX-License-Identifier: MIT
// cornerctl map export: a map as ROS's map_server reads it, a YAML file and a picture.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/map/outline.hpp"
#include "gridmap/image.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

// Shades of map_saver: https://wiki.ros.org/map_server#Value_Interpretation
constexpr char kOccupied = 0;
constexpr char kUnknown = static_cast<char>(205);
constexpr char kFree = static_cast<char>(254);
/// Around the walls.
constexpr double kMargin_m = 0.5;

struct ExportOptions {
  std::filesystem::path map;
  std::filesystem::path output;
  double resolution_m = 0.05;
};

/// The map in cells, row 0 at the bottom.
struct Raster {
  core::Vec2 lower_left;  ///< corner of the first cell
  double cell_m = 0;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::string shades;

  char& at(std::size_t column, std::size_t row) { return shades[row * columns + column]; }
};

Raster make_raster(const core::WallMap& map, double cell_m) {
  Raster raster;
  raster.cell_m = cell_m;
  raster.lower_left = map.lower_left() - core::Vec2::Constant(kMargin_m);
  const core::Vec2 size =
      map.upper_right() - map.lower_left() + core::Vec2::Constant(2 * kMargin_m);
  raster.columns = static_cast<std::size_t>(std::ceil(size.x() / cell_m));
  raster.rows = static_cast<std::size_t>(std::ceil(size.y() / cell_m));
  gridmap::check_size(raster.columns, raster.rows);
  raster.shades.assign(raster.columns * raster.rows, kFree);
  return raster;
}

/// Cells whose middle is in the wall; of a thinner wall those that it passes.
void draw(const core::Wall& wall, Raster& raster) {
  const core::WallBox box(wall);
  // Half of a cell as seen along the wall.
  const double half_cell_m = raster.cell_m / 2 * box.along.lpNorm<1>();
  const double half_width_m = std::max(box.half_width_m, half_cell_m);
  const double half_length_m = std::max(box.half_length_m, half_cell_m);
  const double reach_m = std::hypot(half_width_m, half_length_m) + raster.cell_m;
  const auto range = [&](double middle_m, std::size_t count) {
    const double limit = static_cast<double>(count);
    return std::pair(
        static_cast<std::size_t>(std::clamp((middle_m - reach_m) / raster.cell_m, 0.0, limit)),
        static_cast<std::size_t>(std::clamp((middle_m + reach_m) / raster.cell_m, 0.0, limit)));
  };
  const core::Vec2 middle = box.centre - raster.lower_left;
  const auto [column_begin, column_end] = range(middle.x(), raster.columns);
  const auto [row_begin, row_end] = range(middle.y(), raster.rows);
  for (std::size_t row = row_begin; row < row_end; ++row) {
    for (std::size_t column = column_begin; column < column_end; ++column) {
      const core::Vec2 cell(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
      const core::Vec2 local = box.to_local(raster.lower_left + raster.cell_m * cell);
      if (std::abs(local.x()) <= half_length_m && std::abs(local.y()) <= half_width_m) {
        raster.at(column, row) = kOccupied;
      }
    }
  }
}

/// What is reached from the border without passing a wall is not of the building.
void mark_outside(Raster& raster) {
  std::vector<std::pair<std::size_t, std::size_t>> reached{{0, 0}};
  raster.at(0, 0) = kUnknown;
  while (!reached.empty()) {
    const auto [column, row] = reached.back();
    reached.pop_back();
    const auto visit = [&](std::size_t next_column, std::size_t next_row) {
      // One below 0 is larger than any.
      if (next_column >= raster.columns || next_row >= raster.rows) return;
      char& shade = raster.at(next_column, next_row);
      if (shade != kFree) return;
      shade = kUnknown;
      reached.push_back({next_column, next_row});
    };
    visit(column - 1, row);
    visit(column + 1, row);
    visit(column, row - 1);
    visit(column, row + 1);
  }
}

std::string pgm_text(const Raster& raster) {
  std::string text =
      "P5\n" + std::to_string(raster.columns) + " " + std::to_string(raster.rows) + "\n255\n";
  for (std::size_t row = raster.rows; row-- > 0;) {
    text.append(raster.shades, row * raster.columns, raster.columns);
  }
  return text;
}

void export_map(const ExportOptions& options) {
  if (options.output.extension() != ".yaml") {
    throw UsageError("-o: names the YAML file, which ends in .yaml; its picture is beside it");
  }
  std::filesystem::path picture = options.output;
  picture.replace_extension(".pgm");
  guard_files({.read = {options.map}, .written = {options.output, picture}, .output = {}});
  const auto map = settings::load_map(options.map);
  try {
    Raster raster = make_raster(*map, options.resolution_m);
    for (const core::Wall& wall : map->plan().walls) draw(wall, raster);
    mark_outside(raster);
    write_file(picture, pgm_text(raster));
    write_file(options.output,
               "image: " + picture.filename().string() +
                   formatted("\nresolution: %.9g\norigin: [%.9g, %.9g, 0]\nnegate: 0\n"
                             "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                             raster.cell_m, raster.lower_left.x(), raster.lower_left.y()));
  } catch (const gridmap::GridError& error) {
    throw Failure(options.map.string() + ": " + error.what() + "; take a larger --resolution");
  }
}

}  // namespace

void add_map_export(Command& group) {
  Command command =
      group.add_subcommand("export", "a map for ROS: the YAML file and picture of map_server");
  const auto options = std::make_shared<ExportOptions>();
  command.add_option("map", options->map, "the map").required().type_name("MAP");
  command.add_option("--resolution", options->resolution_m, "side of a cell (m)")
      .within(0.001, 10)
      .capture_default_str();
  command
      .add_option("-o,--output", options->output,
                  "the YAML file; the picture NAME.pgm is beside it")
      .required()
      .type_name("YAML");
  command.callback([options] { export_map(*options); });
}

}  // namespace cornerd::tool
