// SPDX-License-Identifier: MIT
// cornerctl map check, cornerctl map render.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "settings/map_file.hpp"
#include "tool/commands.hpp"
#include "tool/failure.hpp"
#include "tool/look_alikes.hpp"
#include "tool/map_drawing.hpp"
#include "tool/options.hpp"
#include "tool/output.hpp"
#include "tool/playback.hpp"
#include "tool/truth.hpp"

namespace cornerd::tool {

namespace {

/// "2.418 x 2.418 m, 13 walls, 40 corners"
std::string describe(const core::WallMap& map) {
  const core::Vec2 size = map.upper_right() - map.lower_left();
  char text[120];
  std::snprintf(text, sizeof text, "%.3f x %.3f m, %zu walls, %zu corners", size.x(), size.y(),
                map.plan().walls.size(), map.corners().size());
  return text;
}

struct CheckOptions {
  std::filesystem::path map;
  std::filesystem::path plot;
  std::size_t places = 400;
};

void check(const CheckOptions& options) {
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
  output.flush();
  if (options.places == 0) return;
  const std::vector<ExaminedPlace> places = examine_places(map, options.places);
  output.write(describe_look_alikes(*map, places));
  output.flush();
  if (!picture) return;
  MapDrawing drawing(*map);
  drawing.add_examined_places(places);
  picture->write(drawing.document(
      describe(*map) + "; red: places that one turn cannot tell from those at the lines' ends"));
  picture->flush();
}

struct RenderOptions {
  std::filesystem::path map;
  std::filesystem::path output;
  SettingsOptions settings;
  std::string pose;
  std::filesystem::path recording;
  std::string wire = "auto";
  std::filesystem::path truth;
};

/// What a recording looks like in the map: the way of the robot, and one turn in full.
struct RecordedView {
  std::vector<core::Vec2> path;
  core::Scan turn;
  core::TurnResult result;
  std::size_t turns = 0;
};

bool names_place(const core::PoseEstimate& pose) {
  return pose.state != core::PoseState::kAmbiguous && pose.state != core::PoseState::kLost;
}

RecordedView view_recording(const RenderOptions& options, const settings::Config& config,
                            std::shared_ptr<const core::WallMap> map) {
  RecordedView view;
  core::Pipeline pipeline(std::move(map), config.localizer());
  Playback playback(pipeline, [&](const core::Scan& turn, const core::TurnResult& result) {
    ++view.turns;
    const bool named = names_place(result.pose);
    if (named) view.path.push_back(result.pose.T_map_base.translation());
    // A turn without a place is shown only where there is none with one.
    if (!named && !view.path.empty()) return;
    view.turn = turn;
    view.result = result;
  });
  playback.play(options.recording, {parse_wire(options.wire), config.lidar.mount.inverted});
  return view;
}

void draw_turn(MapDrawing& drawing, const RecordedView& view, const core::Pose2& T_map_base,
               const core::Pose2& T_base_lidar) {
  const core::Pose2 T_map_lidar = T_map_base * T_base_lidar;
  drawing.add_scan(view.turn, T_map_lidar);
  drawing.add_breakpoints(view.result.detection.breakpoints, T_map_lidar);
}

void render(RenderOptions& options) {
  const settings::Config config = options.settings.resolve(/*needs_map=*/false);
  const auto map = settings::load_map(options.map);
  std::optional<core::Pose2> T_map_base;
  if (!options.pose.empty()) T_map_base = parse_pose(options.pose);

  MapDrawing drawing(*map);
  std::string subtitle = describe(*map);
  if (!options.truth.empty()) {
    const Truth truth = Truth::load(options.truth);
    std::vector<core::Vec2> way;
    for (const message::RecordedTruth& point : truth.points()) {
      way.push_back(point.T_map_base.translation());
    }
    drawing.add_path(way, /*truth=*/true);
  }
  if (!options.recording.empty()) {
    const RecordedView view = view_recording(options, config, map);
    const core::PoseEstimate& found = view.result.pose;
    drawing.add_path(view.path);
    if (!T_map_base && names_place(found)) {
      T_map_base = found.T_map_base;
      drawing.add_uncertainty(found.T_map_base, found.covariance);
    }
    if (T_map_base) {
      draw_turn(drawing, view, *T_map_base, config.localizer().T_base_lidar);
    } else {
      std::fprintf(stderr, "cornerctl: no turn of %s names a place; the map is drawn alone\n",
                   options.recording.c_str());
    }
    subtitle += "; " + std::to_string(view.path.size()) + " of " + std::to_string(view.turns) +
                " turns found their place";
  }
  if (T_map_base) drawing.add_pose(*T_map_base);

  Output output(options.output);
  output.write(drawing.document(subtitle));
  output.flush();
}

void add_check(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "check", "validate a map and say what is in it, and which places a turn cannot tell apart");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("map", options->map, "the map")->required()->type_name("MAP");
  command
      ->add_option("--places", options->places,
                   "look around at about so many places; 0: only validate")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000}))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--plot", options->plot, "draw them")->type_name("SVG");
  command->callback([options] { check(*options); });
}

void add_render(CLI::App& group) {
  CLI::App* command = group.add_subcommand("render", "draw a map, and a recording in it, as SVG");
  const auto options = std::make_shared<RenderOptions>();
  command->add_option("map", options->map, "the map")->required()->type_name("MAP");
  command->add_option("-o,--output", options->output, "the picture")->required()->type_name("SVG");
  command->add_option("--recording", options->recording, "draw its way and its last turn")
      ->type_name("FILE");
  command
      ->add_option("--pose", options->pose,
                   "draw the robot there, and the recording's turn as seen from there")
      ->type_name("X,Y,THETA");
  command->add_option("--truth", options->truth, "draw the true way, dashed")->type_name("FILE");
  options->settings.add_config(*command);
  add_wire_option(*command, options->wire);
  command->callback([options] { render(*options); });
}

}  // namespace

void add_map(CLI::App& program) {
  CLI::App* group = program.add_subcommand("map", "validate and draw maps");
  group->require_subcommand(1);
  add_check(*group);
  add_render(*group);
}

}  // namespace cornerd::tool
