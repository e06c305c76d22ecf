// SPDX-License-Identifier: MIT
// cornerctl map import: a ROS map (yaml and picture) to walls.
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
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/options.hpp"
#include "tool/command_line/output.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/map_drawing.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/map/map_text.hpp"

namespace cornerd::tool {

namespace {

using gridmap::MadeBy;
using gridmap::Remark;

constexpr std::size_t kMaxYamlBytes = 64 << 10;
/// Of the largest picture in digits: "255 " a pixel.
constexpr std::size_t kMaxImageBytes = 4 * gridmap::kMaxPixels + 4096;

struct MapImportOptions {
  std::filesystem::path yaml;
  std::filesystem::path output;
  std::filesystem::path plot;
  std::string name;
  std::string made_by = "auto";
  gridmap::ImportOptions grid;
};

/// What is read, with its errors naming the file.
gridmap::MapServerYaml read_yaml(const std::filesystem::path& file) {
  const std::string text = settings::read_file(file, kMaxYamlBytes);
  try {
    return gridmap::parse_map_server_yaml(text);
  } catch (const gridmap::GridError& error) {
    throw settings::SettingsError(file.string(), error.pointer(), error.what());
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

/// "3 specks, the largest 0.10 m at 1.20,3.40"; nothing where there are none.
std::string describe(const std::vector<Remark>& remarks, const char* label, const char* what) {
  if (remarks.empty()) return {};
  const auto largest =
      std::max_element(remarks.begin(), remarks.end(),
                       [](const Remark& a, const Remark& b) { return a.size_m < b.size_m; });
  return formatted("%-12s %zu %s, the largest %.2f m at %.2f,%.2f\n", label, remarks.size(), what,
                   largest->size_m, largest->place.x(), largest->place.y());
}

std::string report(const gridmap::MapServerYaml& yaml, const gridmap::Image& image,
                   const gridmap::ImportResult& result, const core::WallMap& map, bool guessed) {
  std::string text = formatted("%-12s %zu x %zu cells of %g m\n", "picture", image.width,
                               image.height, yaml.resolution_m);
  text += formatted("%-12s %s%s\n", "taken as",
                    result.made_by == MadeBy::kDrawing
                        ? "drawn: surfaces on the sides of the occupied cells"
                        : "mapped by a lidar: surfaces in the middle of the occupied cells",
                    guessed ? " (--made-by says otherwise)" : "");
  const auto one_sided = std::span(result.plan.walls).subspan(result.two_sided);
  const auto lines = std::count_if(one_sided.begin(), one_sided.end(),
                                   [](const core::Wall& wall) { return wall.thickness_m == 0; });
  text += formatted("%-12s %s: %zu with both sides, %zu seen from one side", "walls",
                    describe_map(map).c_str(), result.two_sided, one_sided.size());
  if (!one_sided.empty()) {
    text += formatted(" (%zu as thick as is occupied behind it, %zu lines)",
                      one_sided.size() - static_cast<std::size_t>(lines),
                      static_cast<std::size_t>(lines));
  }
  text += "\n";
  text += describe(result.specks, "left out", "specks of occupied cells");
  text += describe(result.pockets, "left out", "enclosed patches of free cells");
  text += describe(result.short_pieces, "left out", "borders too short for a wall");
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
  Output output(options.plot);
  output.write(
      drawing.document(describe_map(map) + "; crosses: left out; orange rings: gaps closed"));
  output.flush();
}

void import_map(MapImportOptions options) {
  static const std::map<std::string, MadeBy> kMakers = {
      {"auto", MadeBy::kUnknown}, {"lidar", MadeBy::kLidar}, {"drawing", MadeBy::kDrawing}};
  options.grid.made_by = kMakers.at(options.made_by);
  const gridmap::MapServerYaml yaml = read_yaml(options.yaml);
  const std::filesystem::path picture = options.yaml.parent_path() / yaml.image;
  guard_files(
      {.read = {options.yaml, picture}, .written = {options.plot}, .output = options.output});
  const gridmap::Image image = read_image(options.yaml, picture);
  gridmap::ImportResult result = gridmap::import_grid(
      gridmap::read_shades(image, yaml), yaml.resolution_m, yaml.T_map_picture, options.grid);
  if (result.plan.walls.empty()) {
    throw Failure(options.yaml.string() +
                  ": no border between free and occupied cells: check negate, mode and the "
                  "thresholds");
  }
  result.plan.name = map_name(options.name, options.output);

  const std::string text = map_text(result.plan);
  const auto map = read_back(text, options.output);
  Output output(options.output);
  output.write(text);
  output.flush();
  if (!options.plot.empty()) draw(options, result, *map);
  Output summary = Output::report_beside(options.output);
  summary.write(report(yaml, image, result, *map, options.grid.made_by == MadeBy::kUnknown));
  summary.flush();
}

}  // namespace

void add_map_import(Command& group) {
  Command command =
      group.add_subcommand("import", "make a map of walls from a ROS map (yaml, and pgm or png)");
  const auto options = std::make_shared<MapImportOptions>();
  command.add_option("yaml", options->yaml, "what map_server reads; it names the picture")
      .required()
      .type_name("YAML");
  command.add_option("-o,--output", options->output, "the map; -: on standard output")
      .required()
      .type_name("MAP");
  command.add_option("--name", options->name, "of the map; the file's without it")
      .type_name("NAME");
  command
      .add_option("--made-by", options->made_by,
                  "lidar: beams ended in the occupied cells, surfaces go through their middle; "
                  "drawing: what is solid was filled; auto: drawing where nothing is unknown, or "
                  "more than a quarter of the occupied cells lie behind others")
      .choices({"auto", "lidar", "drawing"})
      .capture_default_str();
  command
      .add_option("--speck", options->grid.speck_m,
                  "what is occupied and smaller (m), or smaller than 2.5 cells, is left out")
      .within(0, 10)
      .type_name("M")
      .capture_default_str();
  command
      .add_option("--gap", options->grid.join_gap_m,
                  "an unknown stretch of at most this (m) is wall where the wall goes on behind")
      .within(0, 10)
      .type_name("M")
      .capture_default_str();
  command
      .add_option("--thickest", options->grid.thickness_m,
                  "two faces at most so far apart (m) are one wall, though what is between them "
                  "is unknown")
      .within(0, 5)
      .type_name("M")
      .capture_default_str();
  command
      .add_option("--thin", options->grid.thin_m,
                  "thickness of the walls that are thinner than the picture can tell (m)")
      .within(0, 1)
      .type_name("M")
      .capture_default_str();
  command
      .add_option("--roughness", options->grid.roughness_m,
                  "steps of at most this (m), or 1.25 cells, in what a lidar mapped are noise")
      .within(0, 0.5)
      .type_name("M")
      .capture_default_str();
  command.add_flag("!--keep-angles", options->grid.square,
                   "leave walls oblique that are square within what the picture tells");
  command.add_option("--plot", options->plot, "draw the walls, and what was left out")
      .type_name("SVG");
  command.callback([options] { import_map(*options); });
}

}  // namespace cornerd::tool
