// SPDX-License-Identifier: MIT
// cornerctl map import: a ROS map (YAML and image), or a drawn plan (SVG, DXF), to walls.
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gridmap/grid_import.hpp"
#include "gridmap/image.hpp"
#include "gridmap/map_server_yaml.hpp"
#include "settings/document.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/map_drawing.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/map/map_text.hpp"
#include "tool/map/plan_import.hpp"

namespace cornerd::tool {

namespace {

using gridmap::MadeBy;
using gridmap::Remark;

constexpr std::size_t kMaxYamlBytes = 64 << 10;
/// The largest image as PGM text: "255 " for each pixel.
constexpr std::size_t kMaxImageBytes = 4 * gridmap::kMaxPixels + 4096;

struct MapImportOptions : MapOutput {
  std::filesystem::path file;
  std::string made_by = "auto";
  gridmap::ImportOptions grid;
  double metres_per_unit = 0;
  std::vector<std::string> layers;
};

/// Errors name the file.
gridmap::MapServerYaml read_yaml(const std::filesystem::path& file) {
  const std::string text = settings::read_file(file, kMaxImageBytes);
  if (text.size() > kMaxYamlBytes) {
    throw settings::SettingsError(file.string(), "",
                                  "is too long for the yaml of a map: name the yaml, not the "
                                  "picture");
  }
  try {
    return gridmap::parse_map_server_yaml(text);
  } catch (const gridmap::GridError& error) {
    const std::string suffix = file.extension();
    const bool is_named_so = suffix == ".yaml" || suffix == ".yml";
    throw settings::SettingsError(
        file.string(), error.pointer(),
        error.what() + std::string(is_named_so ? ""
                                               : "; it was read as the .yaml of a ROS map: "
                                                 "plans end in .svg or .dxf"));
  }
}

gridmap::Image read_image(const std::filesystem::path& yaml, const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw settings::SettingsError(yaml.string(), "/image", file.string() + " is no file");
  }
  const std::string bytes = settings::read_file(file, kMaxImageBytes);
  try {
    return gridmap::decode_image(bytes);
  } catch (const gridmap::GridError& error) {
    throw settings::SettingsError(file.string(), "", error.what());
  }
}

/// "3 specks, the largest 0.10 m at 1.20,3.40"; empty if there are none.
std::string describe(const std::vector<Remark>& remarks, const char* label, const char* what) {
  if (remarks.empty()) return {};
  const auto largest =
      std::max_element(remarks.begin(), remarks.end(),
                       [](const Remark& a, const Remark& b) { return a.size_m < b.size_m; });
  return formatted("%-12s %zu %s, the largest %.2f m at %.2f,%.2f\n", label, remarks.size(), what,
                   largest->size_m, largest->place.x(), largest->place.y());
}

std::string report(const gridmap::MapServerYaml& yaml, const gridmap::Image& image,
                   const gridmap::ImportResult& result, const core::WallMap& map,
                   bool is_detected) {
  std::string text = formatted("%-12s %zu x %zu cells of %g m\n", "image", image.width,
                               image.height, yaml.resolution_m);
  if (result.cell_m > yaml.resolution_m) {
    text += formatted("%-12s %g m: the picture's are finer than its noise\n", "cells used",
                      result.cell_m);
  }
  text += formatted("%-12s %s%s\n", "made by",
                    result.made_by == MadeBy::kDrawing
                        ? "drawing: surfaces on the edges of the occupied cells"
                        : "lidar: surfaces in the middle of the occupied cells",
                    is_detected ? "; detected, --made-by overrides it" : "");
  const auto one_sided = std::span(result.plan.walls)
                             .subspan(result.two_sided, result.plan.walls.size() -
                                                            result.two_sided - result.rectangles);
  const auto lines = std::count_if(one_sided.begin(), one_sided.end(),
                                   [](const core::Wall& wall) { return wall.thickness_m == 0; });
  text += formatted("%-12s %s: %zu with both faces, %zu with one face", "walls",
                    describe_map(map).c_str(), result.two_sided, one_sided.size());
  if (!one_sided.empty()) {
    text += formatted(" (%zu as thick as the occupied cells behind it, %zu lines)",
                      one_sided.size() - static_cast<std::size_t>(lines),
                      static_cast<std::size_t>(lines));
  }
  if (result.rectangles > 0) {
    text += formatted(", %zu patches beside the walls", result.rectangles);
  }
  text += "\n";
  text += describe(result.specks, "dropped", "specks of occupied cells");
  text += describe(result.pockets, "dropped", "enclosed patches of free cells");
  text += describe(result.short_pieces, "dropped", "borders too short for a wall");
  text += describe(result.joined_gaps, "closed", "gaps of unknown cells in walls");
  for (const std::string& key : yaml.unknown_keys) {
    text += "ignored      the key " + key + "\n";
  }
  return text;
}

void draw(const MapImportOptions& options, const gridmap::ImportResult& result,
          const core::WallMap& map) {
  MapDrawing drawing(map);
  for (const auto* remarks : {&result.specks, &result.pockets, &result.short_pieces}) {
    for (const Remark& remark : *remarks) drawing.add_left_out(remark.place);
  }
  for (const Remark& gap : result.joined_gaps) drawing.add_closed(gap.place, gap.size_m);
  write_file(options.plot,
             drawing.document(describe_map(map) + "; crosses: dropped; orange rings: gaps closed"));
}

void import_plan(const MapImportOptions& options) {
  guard_files({.read = {options.file}, .written = {options.plot}, .output = options.output});
  PlanImport imported =
      import_plan_file(options.file, {options.metres_per_unit,
                                      {options.layers.begin(), options.layers.end()},
                                      {options.grid.thickness_m, options.grid.thin_m}});
  const auto map = options.write(imported.plan);
  if (!options.plot.empty()) {
    write_file(options.plot, MapDrawing(*map).document(describe_map(*map)));
  }
  Output summary = Output::report_beside(options.output);
  summary.write(imported.report + formatted("%-12s %s\n", "map", describe_map(*map).c_str()));
  summary.flush();
}

void import_map(MapImportOptions options) {
  if (is_drawn_plan(options.file)) return import_plan(options);
  if (options.metres_per_unit > 0 || !options.layers.empty()) {
    throw UsageError("--scale and --layer are of SVG and DXF; a ROS map states its resolution");
  }
  static const std::map<std::string, MadeBy> kMakers = {
      {"auto", MadeBy::kUnknown}, {"lidar", MadeBy::kLidar}, {"drawing", MadeBy::kDrawing}};
  options.grid.made_by = kMakers.at(options.made_by);
  const gridmap::MapServerYaml yaml = read_yaml(options.file);
  const std::filesystem::path image_file = options.file.parent_path() / yaml.image;
  guard_files(
      {.read = {options.file, image_file}, .written = {options.plot}, .output = options.output});
  const gridmap::Image image = read_image(options.file, image_file);
  gridmap::ImportResult result = gridmap::import_grid(
      gridmap::read_shades(image, yaml), yaml.resolution_m, yaml.T_map_picture, options.grid);
  if (result.plan.walls.empty()) {
    throw Failure(options.file.string() +
                  ": no border between free and occupied cells: check negate, mode and the "
                  "thresholds");
  }
  const double thickest_m =
      std::ranges::max(result.plan.walls, {}, &core::Wall::thickness_m).thickness_m;
  if (thickest_m > settings::kMaxThicknessM) {
    throw Failure(options.file.string() +
                  formatted(": has a wall %.1f m thick: check negate, mode, the thresholds and "
                            "resolution",
                            thickest_m));
  }
  const auto map = options.write(result.plan);
  if (!options.plot.empty()) draw(options, result, *map);
  Output summary = Output::report_beside(options.output);
  summary.write(report(yaml, image, result, *map, options.grid.made_by == MadeBy::kUnknown));
  summary.flush();
}

}  // namespace

void add_map_import(Command& group) {
  Command command =
      group.add_subcommand("import",
                           "make a map of walls from a ROS map (YAML, and PGM or PNG) or from a "
                           "drawn plan (SVG, DXF)");
  const auto options = std::make_shared<MapImportOptions>();
  command
      .add_option("file", options->file,
                  "the map's file for map_server, whose key image names the image; or a plan, "
                  "*.svg or *.dxf")
      .required()
      .type_name("FILE");
  options->add(command, "the walls, what was dropped and what was closed");
  command
      .add_option("--made-by", options->made_by,
                  "lidar: surfaces are in the middle of the occupied cells, where beams ended; "
                  "drawing: surfaces are on their edges; auto: drawing if the walls are straight, "
                  "and no cell is unknown or a quarter of the occupied cells are behind others")
      .choices({"auto", "lidar", "drawing"})
      .capture_default_str();
  command
      .add_option("--speck", options->grid.speck_m,
                  "occupied patches beside the walls that are smaller than this (m), or than 2.5 "
                  "cells, are dropped")
      .within(0, 10)
      .type_name("M")
      .capture_default_str();
  command
      .add_option(
          "--gap", options->grid.join_gap_m,
          "largest gap of unknown cells in a wall that is closed (m), as furniture leaves it")
      .within(0, 10)
      .type_name("M")
      .capture_default_str();
  command
      .add_option(
          "--thickest", options->grid.thickness_m,
          "largest distance of two faces of one wall (m); of a ROS map, with unknown cells in "
          "between")
      .within(0, 5)
      .type_name("M")
      .capture_default_str();
  command
      .add_option("--thin", options->grid.thin_m,
                  "thickness of walls thinner than a cell, or drawn as one line (m)")
      .within(0, 1)
      .type_name("M")
      .capture_default_str();
  command
      .add_option("--roughness", options->grid.roughness_m,
                  "steps up to this (m), or 1.25 cells, of a wall mapped by a lidar are noise")
      .within(0, 0.5)
      .type_name("M")
      .capture_default_str();
  command
      .add_option("--scale", options->metres_per_unit,
                  "SVG, DXF: metres per unit of the drawing; default: what it states")
      .positive()
      .type_name("METRES_PER_UNIT");
  command
      .add_option("--layer", options->layers,
                  "SVG, DXF: read this layer alone; may be given several times. SVG: a group's "
                  "label or id")
      .one_word()
      .type_name("NAME");
  command.add_flag("!--keep-angles", options->grid.square,
                   "do not make walls square that are square within the error of the cells");
  command.callback([options] { import_map(*options); });
}

}  // namespace cornerd::tool
