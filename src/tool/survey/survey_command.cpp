// SPDX-License-Identifier: MIT
// cornerctl survey: from a recorded drive to a map that the robot can localize in.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "settings/map_file.hpp"
#include "settings/object_reader.hpp"
#include "survey/plan_refinement.hpp"
#include "survey/ransac_survey.hpp"
#include "survey/survey.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/progress_bar.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/survey_drawing.hpp"
#include "tool/fleet/broker_options.hpp"
#include "tool/fleet/drives.hpp"
#include "tool/map/map_text.hpp"
#include "tool/survey/survey_files.hpp"

namespace cornerd::tool {

namespace {

struct SurveyOptions : MapOutput {
  std::vector<std::filesystem::path> files;
  BrokerOptions broker;
  std::string robot;  ///< whose drives the broker has
  SettingsOptions settings;
  std::string wire = "auto";
  std::filesystem::path odometry;
  std::filesystem::path trajectory;
  std::string start;
  std::filesystem::path prior;
  std::string method = "adjusted";
  std::optional<std::size_t> iterations;
  bool manhattan = false;
};

survey::SurveyResult make_map(const SurveyOptions& options, const core::LocalizerConfig& sensor,
                              const survey::RecordedDrive& drive) {
  constexpr std::size_t kSteps = 1000;
  ProgressBar bar("survey", kSteps);
  const auto show = [&](std::string_view phase, double share) {
    bar.show(static_cast<std::size_t>(share * static_cast<double>(kSteps)), phase);
  };
  try {
    if (options.method == "ransac") {
      survey::RansacConfig config;
      config.iterations = options.iterations.value_or(config.iterations);
      return survey::ransac_survey(drive, sensor, config, show);
    }
    survey::SurveyConfig config;
    config.sensor = sensor;
    config.manhattan = options.manhattan;
    return survey::survey(drive, config, show);
  } catch (const std::invalid_argument& error) {
    throw Failure(options.files.front().string() + ": " + error.what());
  }
}

/// Moves the result into the plan's frame and replaces its walls by the plan's, moved to where they
/// are.
std::string refine(const SurveyOptions& options, const core::LocalizerConfig& sensor,
                   const survey::RecordedDrive& drive,
                   const std::shared_ptr<const core::WallMap>& prior,
                   survey::SurveyResult& result) {
  try {
    const survey::RefinedPlan refined = survey::refine_to_plan(drive, sensor, prior, result);
    return refined_plan_report(prior->plan(), refined);
  } catch (const std::invalid_argument& error) {
    throw Failure(options.prior.string() + ": " + error.what());
  }
}

core::Pose2 parse_start(const std::string& text) {
  if (text.empty()) return {};
  const core::Pose2 start = parse_pose(text);
  if (std::max(std::abs(start.x_m), std::abs(start.y_m)) > settings::kMaxCoordinateM) {
    throw UsageError("--start: coordinates of a map go from " +
                     settings::to_text(-settings::kMaxCoordinateM) + " to " +
                     settings::to_text(settings::kMaxCoordinateM) + " m; shift the origin");
  }
  return start;
}

void check_usage(const SurveyOptions& options) {
  CommandFiles files{.read = options.files,
                     .written = {options.plot, options.trajectory},
                     .output = options.output};
  files.read.insert(files.read.end(),
                    {options.odometry, options.prior, options.settings.config_file()});
  guard_files(files);
  if (options.broker.is_given() == !options.files.empty() ||
      options.broker.is_given() == options.robot.empty())
    throw UsageError("recordings are needed: files, or --broker and --robot");
  const bool is_ransac = options.method == "ransac";
  if (is_ransac && options.manhattan)
    throw UsageError("--manhattan: not available with --method ransac; leave one out");
  if (!options.prior.empty() && (is_ransac || !options.start.empty()))
    throw UsageError(
        "--prior: the plan gives the frame, and --method adjusted the walls; leave out " +
        std::string(is_ransac ? "--method ransac" : "--start"));
  if (!is_ransac && options.iterations)
    throw UsageError("--iterations: only for --method ransac; add it");
}

void run_survey(SurveyOptions options) {
  check_usage(options);
  std::optional<FleetDrives> drives;
  if (options.broker.is_given())
    options.files = drives.emplace(options.broker, options.robot).files();
  const core::Pose2 start = parse_start(options.start);
  const settings::Config config = options.settings.resolve(/*needs_map=*/false);
  const std::shared_ptr<const core::WallMap> prior =
      options.prior.empty() ? nullptr : settings::load_map(options.prior);
  const survey::RecordedDrive drive = load_drive(
      options.files, {parse_wire(options.wire), config.lidar.mount.inverted}, options.odometry);
  survey::SurveyResult result = make_map(options, config.localizer(), drive);
  std::string refined_report;
  if (prior == nullptr) {
    survey::move_frame(start, result);
  } else {
    refined_report = refine(options, config.localizer(), drive, prior, result);
  }

  options.write(result.plan);
  if (!options.trajectory.empty()) write_file(options.trajectory, trajectory_text(result));
  if (!options.plot.empty()) {
    write_file(options.plot,
               options.method == "ransac" ? ransac_canvas(result) : survey_drawing(result));
  }
  Output report = Output::report_beside(options.output);
  report.write(survey_report(result) + refined_report);
  report.flush();
}

}  // namespace

void add_survey(Command& program) {
  Command command = program.add_subcommand("survey", "a map of the walls from a recorded drive");
  const auto options = std::make_shared<SurveyOptions>();
  command.add_option("files", options->files, "consecutive recordings of one drive")
      .type_name("FILE");
  options->broker.add(command);
  command.add_option("--robot", options->robot, "with --broker: the drives that this robot sent")
      .type_name("SERIAL");
  options->add(command, "walls, points and trajectory");
  command
      .add_option("--start", options->start,
                  "pose of the first scan in the map (m, m, rad); default: the origin")
      .type_name("X,Y,THETA");
  command
      .add_option("--prior", options->prior,
                  "a drawn plan: its walls, moved to where they are, become the map")
      .type_name("MAP");
  command
      .add_option("--trajectory", options->trajectory,
                  "the estimated trajectory, a pose for each scan, in the format of --truth")
      .type_name("NDJSON");
  command
      .add_option("--method", options->method,
                  "adjusted: least squares over poses and walls; ransac: lines in points placed by "
                  "odometry alone (Bertocco et al.), for comparison")
      .choices({"adjusted", "ransac"})
      .capture_default_str();
  command.add_option("--iterations", options->iterations, "iterations of --method ransac")
      .range(std::size_t{1}, std::size_t{1'000'000})
      .default_str(std::to_string(survey::RansacConfig().iterations));
  command.add_flag("--manhattan", options->manhattan,
                   "make walls square that are square within their sigma, at most half a degree");
  command
      .add_option("--odometry", options->odometry,
                  "ODOMETRY lines of another file, in place of the recordings' own")
      .type_name("FILE");
  options->settings.add_config(command);
  add_wire_option(command, options->wire);
  command.callback([options] { run_survey(*options); });
}

}  // namespace cornerd::tool
