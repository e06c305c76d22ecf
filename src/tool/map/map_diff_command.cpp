// SPDX-License-Identifier: MIT
// cornerctl map diff: the walls in which two maps differ.
#include <filesystem>
#include <memory>

#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/output.hpp"
#include "tool/commands.hpp"
#include "tool/map/map_difference.hpp"

namespace cornerd::tool {

namespace {

struct DiffOptions {
  std::filesystem::path a;
  std::filesystem::path b;
  DifferenceOptions difference;
  bool is_json = false;
};

void diff(const DiffOptions& options) {
  const core::FloorPlan a = settings::load_map(options.a)->plan();
  const core::FloorPlan b = settings::load_map(options.b)->plan();
  const MapDifference difference = compare_maps(a, b, options.difference);
  Output output;
  output.write(options.is_json ? difference_json(a, b, difference)
                               : difference_text(a, b, difference));
  output.flush();
}

}  // namespace

void add_map_diff(Command& group) {
  Command command = group.add_subcommand(
      "diff",
      "walls that are moved, gone or new in another map of the same building and frame: across and "
      "ends are signed, to the left and forward of the wall's direction");
  const auto options = std::make_shared<DiffOptions>();
  command.add_option("a", options->a, "the map before").required().type_name("A");
  command.add_option("b", options->b, "the map after").required().type_name("B");
  command
      .add_option("--reach", options->difference.reach_m,
                  "a wall that is further away is another wall (m)")
      .within(0.001, 10)
      .type_name("M")
      .capture_default_str();
  command
      .add_option("--tolerance", options->difference.tolerance_m,
                  "smaller differences are not reported (m)")
      .within(0, 1)
      .type_name("M")
      .capture_default_str();
  command.add_flag("--json", options->is_json, "one JSON object: moved, gone, new");
  command.callback([options] { diff(*options); });
}

}  // namespace cornerd::tool
