// SPDX-License-Identifier: MIT
// cornerctl calibrate odometry: errors of wheels and gyro from a recorded drive.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "calibration/drive_reckoning.hpp"
#include "calibration/factor_search.hpp"
#include "calibration/odometry_fit.hpp"
#include "settings/map_file.hpp"
#include "tool/calibrate/calibration_drive.hpp"
#include "tool/calibrate/drive_fit.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/drive_drawing.hpp"
#include "tool/drawing/factors_text.hpp"
#include "tool/drawing/svg.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

namespace {

using calibration::DriveError;
using calibration::HeadingSource;

struct CalibrateOdometryOptions : DriveOptions {
  std::filesystem::path truth;
  std::filesystem::path plot;
};

std::vector<std::string> row(const char* name, const std::string& factors,
                             const DriveError& error) {
  return {name, factors, formatted("%.3f", error.mean_m), formatted("%.3f", error.end_m)};
}

std::string describe_estimate(const calibration::OdometryFit& fit) {
  TextTable table;
  bool at_bound = false;
  const auto add = [&](const char* name, double value, double sigma) {
    const bool is_bound = std::abs(value) >= calibration::kMaxFittedScale;
    at_bound = at_bound || is_bound;
    table.add_row(
        {name, formatted("%+.5f", value) + (is_bound ? "*" : ""), formatted("+- %.5f", sigma)});
  };
  add("left wheel", fit.learned.left_scale, fit.sigma.left_scale);
  add("right wheel", fit.learned.right_scale, fit.sigma.right_scale);
  add("track", fit.learned.track_scale, fit.sigma.track_scale);
  if (fit.has_gyro) {
    add("gyro scale", fit.learned.gyro_scale, fit.sigma.gyro_scale);
    add("gyro bias, rad/s", fit.learned.gyro_bias_rad_s, fit.sigma.gyro_bias_rad_s);
  }
  table.add_row({"delay, s", formatted("%+.5f", fit.learned.delay_s),
                 formatted("+- %.5f", fit.sigma.delay_s),
                 fit.has_delay ? "" : "as configured: the drive does not show it"});
  constexpr const char* kBoundText =
      "* at the limit: correct odometry.track, wheel_radius or counts_per_turn first\n";
  return table.text() + (at_bound ? kBoundText : "");
}

/// A delay that differs by more sigmas from the configured one is written.
constexpr double kSignificantDelaySigmas = 3;

/// The fitted delay if it is significant, else the configured one.
double written_delay_s(const calibration::OdometryFit& fit, double configured_s) {
  const double change_s = fit.learned.delay_s - configured_s;
  const bool is_significant =
      fit.has_delay && std::abs(change_s) > kSignificantDelaySigmas * fit.sigma.delay_s;
  const bool is_allowed = std::abs(fit.learned.delay_s) <= settings::kMaxInitialDelay_s;
  return is_significant && is_allowed ? fit.learned.delay_s : configured_s;
}

std::string fragment(const calibration::OdometryFit& fit, double delay_s) {
  const core::OdometryParameters& learned = fit.learned;
  std::string text = "{\n  \"advanced\": {\n    \"odometry\": {\n      \"initial\": {";
  const auto add = [&text](const char* key, double value) {
    text += formatted("%s\n        \"%s\": %.6f", text.back() == '{' ? "" : ",", key, value);
  };
  add("left_scale", learned.left_scale);
  add("right_scale", learned.right_scale);
  add("track_scale", learned.track_scale);
  add("gyro_scale", learned.gyro_scale);
  add("gyro_bias", learned.gyro_bias_rad_s);
  if (delay_s != 0) add("delay", delay_s);
  return text + "\n      }\n    }\n  }\n}\n";
}

/// Reports a delay that exceeds the daemon's limit.
std::string describe_delay(const calibration::OdometryFit& fit) {
  if (std::abs(fit.learned.delay_s) <= settings::kMaxInitialDelay_s) return {};
  return formatted(
      "The readings are %.2f s %s, more than advanced.odometry.initial.delay allows (%.1f s): "
      "send the time of measurement in each. The values above hold for such readings.\n",
      std::abs(fit.learned.delay_s), fit.learned.delay_s > 0 ? "late" : "early",
      settings::kMaxInitialDelay_s);
}

/// The filter gets fixes in the drive's first half and dead reckons in the second. `steps`: at the
/// times of measurement.
calibration::FilteredDrive filter_half(const CalibrationDrive& drive,
                                       std::span<const core::OdometryIncrement> steps,
                                       core::OdometryConfig config) {
  config.enabled = true;
  config.initial.delay_s = 0;
  const core::TimeNs first_ns = drive.places.front().t_ns;
  const core::TimeNs last_ns = drive.places.back().t_ns;
  return calibration::filter_drive(steps, drive.places, config,
                                   first_ns + (last_ns - first_ns) / 2);
}

std::string draw_dead_reckoning(const CalibrationDrive& drive,
                                std::span<const core::OdometryIncrement> steps,
                                const settings::Config& config, const calibration::OdometryFit& fit,
                                const calibration::FilteredDrive& filtered) {
  const core::DriveGeometry& geometry = config.odometry.core.geometry;
  calibration::DrivePoints known;
  for (const calibration::KnownPose& place : drive.places) {
    known.push_back(place.T_map_base.translation());
  }
  calibration::DrivePoints raw;
  reckon(steps, drive.places, geometry, calibration::DeadReckoningConfig{}, &raw);
  calibration::DrivePoints fitted;
  reckon(drive.steps, drive.places, geometry, fit.learned, &fitted);
  const std::span<const core::Vec2> points(filtered.points);
  const std::size_t alone = filtered.alone.places;
  const DrawnTrack tracks[] = {
      {"by the lidar", kInk, known, true},
      {"wheels as configured", "#c2255c", raw},
      {"wheels corrected by least squares", "#d9822b", fitted},
      {"filter, with fixes (first half)", "#8fb8d8", points.first(points.size() - alone)},
      {"filter, dead reckoning (second half)", "#2f6f9f", points.last(alone)}};
  std::shared_ptr<const core::WallMap> map;
  if (!config.map.empty()) map = settings::load_map(config.map);
  return draw_drive("The drive by wheels and gyro", tracks, map.get());
}

void calibrate_odometry(const CalibrateOdometryOptions& options) {
  std::optional<Truth> truth;
  if (!options.truth.empty()) truth = Truth::load(options.truth);
  const settings::Config config = options.settings.resolve(/*needs_map=*/!truth);
  guard_files({.read = {options.file, options.odometry, options.truth,
                        options.settings.config_file(), config.map},
               .written = {options.plot},
               .output = options.output});
  // Fails before the work if the file cannot be written.
  std::unique_ptr<Output> plot;
  if (!options.plot.empty()) plot = std::make_unique<Output>(Output::replacing(options.plot));
  const auto [drive, fit] = fit_drive(options.drive(), config, truth ? &*truth : nullptr);
  const auto steps = calibration::at_true_times(drive.steps, fit.learned.delay_s);
  const core::DriveGeometry& geometry = config.odometry.core.geometry;

  TextTable table;
  table.add_row({"heading from", "factors", "mean error, m", "at the end, m"});
  bool at_edge = false;
  const std::pair<HeadingSource, const char*> modes[] = {{HeadingSource::kEncoder, "encoder"},
                                                         {HeadingSource::kGyro, "gyro"},
                                                         {HeadingSource::kMean, "mean"},
                                                         {HeadingSource::kWeighted, "weighted"}};
  for (const auto& [source, name] : modes) {
    if (source != HeadingSource::kEncoder && !fit.has_gyro) continue;
    calibration::DeadReckoningConfig reckoning{source, {}};
    if (source != HeadingSource::kWeighted) {
      table.add_row(row(name, "none", reckon(steps, drive.places, geometry, reckoning)));
    }
    if (source == HeadingSource::kMean) continue;
    const auto found = search_factors(steps, drive.places, geometry, reckoning);
    at_edge = at_edge || found.at_edge();
    reckoning.factors = found.factors;
    table.add_row(row(name, describe_factors(source, found),
                      reckon(steps, drive.places, geometry, reckoning)));
  }
  table.add_row(
      row("least squares", "below", reckon(drive.steps, drive.places, geometry, fit.learned)));

  const calibration::FilteredDrive filtered = filter_half(drive, steps, config.odometry.core);
  table.add_row(row("filter, 2nd half", "estimated in the 1st", filtered.alone));

  Output report = Output::report_beside(options.output);
  report.write(formatted("The drive by wheels and gyro alone, against %zu known poses:\n",
                         drive.places.size()));
  report.write(table.text());
  if (at_edge) report.write(std::string(kEdgeText));
  report.write(
      formatted("\nLeast squares over %zu windows of a second, as shares:\n", fit.windows));
  report.write(describe_estimate(fit));
  report.write(describe_delay(fit));
  report.flush();
  if (plot) {
    plot->write(draw_dead_reckoning(drive, steps, config, fit, filtered));
    plot->commit();
  }
  if (!options.output.empty()) {
    write_file(options.output,
               fragment(fit, written_delay_s(fit, config.odometry.core.initial.delay_s)));
  }
}

}  // namespace

void add_calibrate_odometry(Command& group) {
  Command command = group.add_subcommand(
      "odometry", "errors and delay of wheels and gyro, from a recorded drive in a known map");
  const auto options = std::make_shared<CalibrateOdometryOptions>();
  options->add_drive(command,
                     "half a minute or more, straight and with rotations in both directions",
                     "advanced.odometry.initial");
  command.add_option("--truth", options->truth, "true poses in place of the lidar's fixes")
      .type_name("FILE");
  command
      .add_option("--plot", options->plot, "draw the drive by wheels, least squares and the filter")
      .type_name("SVG");
  command.callback([options] { calibrate_odometry(*options); });
}

}  // namespace cornerd::tool
