// SPDX-License-Identifier: MIT
// cornerctl calibrate noise: the lidar's noise from recordings of a robot at rest.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/bearing_bins.hpp"
#include "calibration/range_noise.hpp"
#include "calibration/robust_statistics.hpp"
#include "calibration/wall_model.hpp"
#include "calibration/wall_search.hpp"
#include "replay/recording.hpp"
#include "tool/calibrate/noise_report.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/noise_drawing.hpp"

namespace cornerd::tool {

namespace {

struct CalibrateNoiseOptions {
  std::vector<std::string> files;
  std::string model = "auto";
  std::string wire = "auto";
  std::filesystem::path output;
  std::filesystem::path plot;
  std::filesystem::path wall_plot;
};

/// A larger mean residual of floor and share selects the table.
constexpr double kMaxPlainResidual = 0.2;
/// Median drift of the directions in sigmas; a uniform movement gives 1.7.
constexpr double kMaxDrift_sigmas = 1;
constexpr double kMinWallDistance_m = 0.05;
constexpr double kMaxWallDistance_m = 12;

class BinsSink : public replay::RecordingSink {
 public:
  explicit BinsSink(calibration::BearingBins& bins) : bins_(bins) {}

  void on_sample(const core::Sample& sample) override {
    scans_ += sample.starts_scan;
    bins_.add(sample.bearing_rad, sample.range_m);
  }
  void on_gap() override {}
  void on_odometry(const message::OdometryReading&) override {}

  std::size_t scans() const { return scans_; }

 private:
  calibration::BearingBins& bins_;
  std::size_t scans_ = 0;
};

void warn_if_moved(const std::string& file, const std::vector<calibration::BinSpread>& spreads) {
  std::vector<double> drifts;
  for (const calibration::BinSpread& spread : spreads) drifts.push_back(std::abs(spread.drift));
  if (calibration::median(drifts) < kMaxDrift_sigmas) return;
  std::fprintf(stderr,
               "cornerctl: warning: %s: the lidar probably moved; its noise is overestimated\n",
               file.c_str());
}

/// A recording and the distance of a wall if the user gives it: "FILE@0.45".
struct RecordingOfWall {
  std::string file;
  std::optional<double> distance_m;
};

RecordingOfWall parse_recording(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos || std::filesystem::exists(text)) return {text, std::nullopt};
  const std::string number = text.substr(at + 1);
  double distance_m = 0;
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), distance_m);
  if (error != std::errc() || end != number.data() + number.size() ||
      !(distance_m >= kMinWallDistance_m && distance_m <= kMaxWallDistance_m)) {
    throw UsageError("'" + text +
                     "': the number after @ must be the wall's distance, 0.05 to 12 m, as in "
                     "still.bin@0.45");
  }
  return {text.substr(0, at), distance_m};
}

/// The measurements of all recordings.
struct Measured {
  std::vector<calibration::BinSpread> spreads;
  std::vector<calibration::KnownWall> walls;  ///< at the distances that the user gave
  std::vector<calibration::KnownWall> found;  ///< in recordings without one
};

void measure(const RecordingOfWall& recording, const std::string& wire, Measured& measured) {
  const std::string& file = recording.file;
  calibration::BearingBins bins;
  BinsSink sink(bins);
  replay::RecordingPlayer player(file, {parse_wire(wire), /*inverted=*/false});
  while (player.step(sink)) {
  }
  const std::vector<calibration::BinSpread> spreads = bins.spreads();
  std::fprintf(stderr, "%s: %zu scans, %zu returns, %zu directions with a sigma\n", file.c_str(),
               sink.scans(), bins.returns(), spreads.size());
  warn_if_moved(file, spreads);
  measured.spreads.insert(measured.spreads.end(), spreads.begin(), spreads.end());
  if (!recording.distance_m) {
    auto found = calibration::find_walls(spreads, bins.all());
    std::move(found.begin(), found.end(), std::back_inserter(measured.found));
    return;
  }
  auto wall = calibration::find_known_wall(bins.all(), *recording.distance_m);
  if (!wall) {
    char text[80];
    std::snprintf(text, sizeof text, ": no straight wall at %.3f m is in it",
                  *recording.distance_m);
    throw Failure(file + text);
  }
  measured.walls.push_back(std::move(*wall));
}

std::vector<calibration::WallPieceFit> fit_walls(const std::vector<calibration::KnownWall>& walls) {
  std::vector<calibration::WallReturn> returns;
  for (const calibration::KnownWall& wall : walls) {
    returns.insert(returns.end(), wall.returns.begin(), wall.returns.end());
  }
  return calibration::fit_wall_model(returns);
}

void calibrate_noise(const CalibrateNoiseOptions& options) {
  CommandFiles files{
      .read = {}, .written = {options.plot, options.wall_plot}, .output = options.output};
  for (const std::string& text : options.files) files.read.push_back(parse_recording(text).file);
  guard_files(files);
  Measured measured;
  for (const std::string& text : options.files) {
    measure(parse_recording(text), options.wire, measured);
  }
  const auto noise = calibration::fit_range_noise(measured.spreads);
  if (!noise) {
    throw Failure("too few data: record 20 scans or more of a lidar at rest with walls in view");
  }
  if (!noise->is_of_walls()) {
    throw Failure(
        "the returns are too scattered for walls: check that the lidar stood still and that --wire "
        "is right");
  }
  const bool distances_known = !measured.walls.empty();
  const auto& sources = distances_known ? measured.walls : measured.found;
  const std::vector<calibration::WallPieceFit> walls = fit_walls(sources);
  if (walls.empty() && (options.model == "paper" || !options.wall_plot.empty())) {
    throw Failure("no straight wall up to 2.25 m away for the paper's model");
  }
  Output report = Output::report_beside(options.output);
  report.write(describe_noise(*noise));
  if (distances_known) report.write("\n" + describe_distances(sources));
  if (!walls.empty()) report.write("\n" + describe_wall_model(walls, distances_known));
  report.flush();
  const bool with_table = options.model == "table" ||
                          (options.model != "plain" && noise->plain_residual > kMaxPlainResidual);
  if (!options.output.empty()) {
    const bool with_walls = distances_known || options.model == "paper";
    write_file(options.output,
               noise_fragment(*noise, with_table,
                              with_walls ? walls : std::vector<calibration::WallPieceFit>()));
  }
  if (!options.plot.empty()) write_file(options.plot, draw_noise(*noise, measured.spreads));
  if (!options.wall_plot.empty()) write_file(options.wall_plot, draw_walls(walls, sources));
}

void add_noise(Command& group) {
  Command command = group.add_subcommand(
      "noise", "the lidar's noise over the range, from recordings of a robot at rest");
  const auto options = std::make_shared<CalibrateNoiseOptions>();
  command
      .add_option(
          "files", options->files,
          "recordings (.bin, .ndjson), each of a lidar at rest; FILE@METRES: with a straight wall "
          "at this distance from the lidar's axis")
      .required()
      .type_name("FILE");
  command
      .add_option(
          "--model", options->model,
          "model written by -o: plain (floor and share), table, auto (table if plain has a large "
          "residual), or paper: auto and the paper's wall model, which FILE@METRES always adds")
      .choices({"auto", "plain", "table", "paper"})
      .capture_default_str();
  command
      .add_option(
          "-o,--output", options->output,
          "the key lidar.noise, for a config and for simulate --noise; -: on standard output")
      .type_name("JSON");
  command.add_option("--plot", options->plot, "draw sigma over the range").type_name("SVG");
  command
      .add_option("--plot-wall", options->wall_plot,
                  "draw the range errors of walls over the ray's angle")
      .type_name("SVG");
  add_wire_option(command, options->wire);
  command.callback([options] { calibrate_noise(*options); });
}

}  // namespace

void add_calibrate(Command& program) {
  Command group = program.add_subcommand("calibrate", "measure values for the config");
  group.require_subcommand();
  add_noise(group);
  add_calibrate_bias(group);
  add_calibrate_mount(group);
  add_calibrate_odometry(group);
}

}  // namespace cornerd::tool
