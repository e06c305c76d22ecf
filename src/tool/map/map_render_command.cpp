// SPDX-License-Identifier: MIT
// cornerctl map render.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/map_drawing.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/map/drive_points.hpp"
#include "tool/map/learned_map.hpp"
#include "tool/map/map_text.hpp"
#include "tool/replay/playback.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

namespace {

struct RenderOptions {
  std::filesystem::path map;
  std::filesystem::path output;
  SettingsOptions settings;
  std::string pose;
  std::filesystem::path recording;
  std::string wire = "auto";
  std::filesystem::path trajectory;
  std::filesystem::path truth;
  std::filesystem::path walls;
};

/// A recording in the map: the robot's path, all points and one scan.
struct RecordedView {
  std::vector<core::Vec2> path;
  DrivePoints points;
  core::Scan scan;
  core::PoseEstimate pose;                ///< of that scan
  std::optional<core::Pose2> T_map_base;  ///< of that scan
  std::vector<core::Breakpoint> breakpoints;
  std::size_t scans = 0;
};

bool has_pose(const core::PoseEstimate& pose) {
  return pose.state != core::PoseState::kAmbiguous && pose.state != core::PoseState::kLost;
}

/// `trajectory`: poses of the recording; null: localize in `map`.
RecordedView view_recording(const RenderOptions& options, const settings::Config& config,
                            std::shared_ptr<const core::WallMap> map, const Truth* trajectory) {
  RecordedView view;
  core::Pipeline pipeline(trajectory == nullptr ? std::move(map) : nullptr, config.localizer());
  Playback playback(pipeline, [&](const core::Scan& scan, const core::ScanResult& result) {
    ++view.scans;
    std::optional<core::Pose2> T_map_base;
    if (trajectory != nullptr) {
      T_map_base = trajectory->at(scan.start_ns() + (scan.end_ns() - scan.start_ns()) / 2);
    } else if (has_pose(result.pose)) {
      T_map_base = result.pose.T_map_base;
    }
    view.points.add(scan, T_map_base);
    if (T_map_base) view.path.push_back(T_map_base->translation());
    // Prefers the last scan with a pose.
    if (!T_map_base && !view.path.empty()) return;
    view.scan = scan;
    view.pose = result.pose;
    view.T_map_base = T_map_base;
    const auto found = result.detection.breakpoints;
    view.breakpoints.assign(found.begin(), found.end());
  });
  playback.play(options.recording, {parse_wire(options.wire), config.lidar.mount.inverted});
  return view;
}

std::vector<core::Vec2> path_of(const Truth& truth) {
  std::vector<core::Vec2> path;
  for (const message::RecordedTruth& point : truth.points()) {
    path.push_back(point.T_map_base.translation());
  }
  return path;
}

void draw_points(MapDrawing& drawing, const core::WallMap& map,
                 const std::vector<core::Vec2>& points) {
  // Up to the margin of the drawing.
  constexpr double kBeyondPx = 40;
  const core::Vec2 margin = core::Vec2::Constant(kBeyondPx * drawing.pixel_m());
  drawing.add_points(
      thin_out(points, drawing.pixel_m(), map.lower_left() - margin, map.upper_right() + margin));
}

/// Returns what it drew, for the subtitle.
std::string draw_learned(MapDrawing& drawing, const core::FloorPlan& plan,
                         const std::filesystem::path& file) {
  const settings::LearnedWallsOfMap learned = load_learned_walls(plan, file);
  const core::FloorPlan moved = with_learned_walls(plan, learned.walls);
  for (const core::WallOffset& wall : learned.walls.offsets) {
    drawing.add_learned_wall(moved.walls[wall.wall], wall);
  }
  for (const core::MapChange& change : learned.changes) {
    const bool is_gone = change.kind == core::MapChange::Kind::kWallGone;
    const core::Vec2 at = settings::place_of(change, plan);
    is_gone ? drawing.add_left_out(at) : drawing.add_new_thing(at);
  }
  return formatted("; %zu walls learned, %zu changes", learned.walls.offsets.size(),
                   learned.changes.size());
}

void render(const RenderOptions& options) {
  if (!options.trajectory.empty() && options.recording.empty()) {
    throw UsageError("--trajectory needs --recording");
  }
  guard_files({.read = {options.map, options.recording, options.trajectory, options.truth,
                        options.walls, options.settings.config_file()},
               .written = {},
               .output = options.output});
  const settings::Config config = options.settings.resolve(/*needs_map=*/false);
  const core::Pose2 T_base_lidar = config.localizer().T_base_lidar;
  const auto map = settings::load_map(options.map);
  std::optional<core::Pose2> T_map_base;
  if (!options.pose.empty()) T_map_base = parse_pose(options.pose);

  MapDrawing drawing(*map);
  std::string subtitle = describe_map(*map);
  if (!options.walls.empty()) subtitle += draw_learned(drawing, map->plan(), options.walls);
  if (!options.truth.empty()) {
    drawing.add_path(path_of(Truth::load(options.truth)), /*truth=*/true);
  }
  if (!options.recording.empty()) {
    std::optional<Truth> trajectory;
    if (!options.trajectory.empty()) trajectory = Truth::load(options.trajectory);
    const RecordedView view =
        view_recording(options, config, map, trajectory ? &*trajectory : nullptr);
    draw_points(drawing, *map,
                trajectory ? view.points.place(T_base_lidar, *trajectory)
                           : view.points.place(T_base_lidar));
    drawing.add_path(view.path);
    if (!T_map_base && view.T_map_base) {
      T_map_base = view.T_map_base;
      if (!trajectory) drawing.add_uncertainty(*T_map_base, view.pose.covariance);
    }
    if (T_map_base) {
      const core::Pose2 T_map_lidar = *T_map_base * T_base_lidar;
      drawing.add_scan(view.scan, T_map_lidar);
      drawing.add_breakpoints(view.breakpoints, T_map_lidar);
    } else {
      std::fprintf(stderr, "cornerctl: no scan of %s was localized; drawing the map alone\n",
                   options.recording.c_str());
    }
    subtitle += formatted("; %zu of %zu scans ", view.path.size(), view.scans);
    subtitle += trajectory ? "placed by " + options.trajectory.filename().string() : "localized";
  }
  if (T_map_base) drawing.add_pose(*T_map_base);

  write_file(options.output, drawing.document(subtitle));
}

}  // namespace

void add_map_render(Command& group) {
  Command command = group.add_subcommand("render", "draw a map, and a recording in it, as SVG");
  const auto options = std::make_shared<RenderOptions>();
  command.add_option("map", options->map, "the map").required().type_name("MAP");
  command.add_option("-o,--output", options->output, "the drawing; -: on standard output")
      .required()
      .type_name("SVG");
  command
      .add_option("--recording", options->recording,
                  "draw its points, its path and its last scan, localized in the map")
      .type_name("FILE");
  command
      .add_option("--trajectory", options->trajectory,
                  "poses of the recording (a --truth file, or survey --trajectory), in place of "
                  "localization")
      .type_name("FILE");
  command
      .add_option("--pose", options->pose,
                  "draw the robot at this pose, and the recording's last scan from it")
      .type_name("X,Y,THETA");
  command.add_option("--truth", options->truth, "draw the true path, dashed").type_name("FILE");
  command
      .add_option(
          "--walls", options->walls,
          "draw what the daemon learned: offsets of walls in mm, crosses where one is gone, "
          "rings at new things (walls-HASH.json of /advanced/localizer/walls_folder)")
      .type_name("FILE");
  options->settings.add_config(command);
  add_wire_option(command, options->wire);
  command.callback([options] { render(*options); });
}

}  // namespace cornerd::tool
