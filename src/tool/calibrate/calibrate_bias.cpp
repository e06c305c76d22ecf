// SPDX-License-Identifier: MIT
// cornerctl calibrate bias: the lidar's systematic errors, from recordings in a known map.
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/pipeline.hpp"
#include "settings/lidar_calibration.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/replay/playback.hpp"

namespace cornerd::tool {
namespace {

/// Enough for a significant bias (cornerd-bench --localizer, "biased lidar").
constexpr std::size_t kMinBiasScans = 20;

/// The localizer corrects scans by the prior before it tests whether the map fits them whole,
/// as a scan with a scale error of 1.5 % or more is not: other priors are tried then.
constexpr double kScaleStarts[] = {0, 0.02, -0.02};
/// A larger scale error means a wrong map.
constexpr double kMaxScaleChange = 0.03;

struct CalibrateBiasOptions : CalibrationOptions {
  std::vector<std::filesystem::path> files;
};

std::string describe_bias(const core::EstimatedBias& estimated) {
  TextTable table;
  const core::SensorBias& bias = estimated.bias;
  const core::SensorBias& sigma = estimated.sigma;
  const auto row = [&](const char* name, double value, double deviation, double unit) {
    table.add_row({name, formatted("%+.3f", unit * value), formatted("+- %.3f", unit * deviation)});
  };
  row("range scale, %", bias.range_scale, sigma.range_scale, 100);
  row("range offset, mm", bias.range_offset_m, sigma.range_offset_m, 1e3);
  row("bearing, sine, degrees", bias.bearing_sine_rad, sigma.bearing_sine_rad, core::degrees(1));
  row("bearing, cosine, degrees", bias.bearing_cosine_rad, sigma.bearing_cosine_rad,
      core::degrees(1));
  return formatted("From %zu localized scans at rest or with odometry:\n", estimated.scans) +
         table.text();
}

/// From a prior whose scale is `scale` larger than the config's.
core::EstimatedBias estimate_bias(const CalibrateBiasOptions& options,
                                  const settings::Config& config,
                                  const std::shared_ptr<const core::WallMap>& map, double scale) {
  core::LocalizerConfig localizer = config.localizer();
  localizer.calibrate_online = true;
  localizer.forget_bias = false;
  localizer.bias.range_scale += scale;
  core::Pipeline pipeline(map, localizer);
  Playback playback(pipeline, [](const core::Scan&, const core::ScanResult&) {});
  for (const std::filesystem::path& file : options.files) {
    pipeline.localizer().relocalize();
    playback.play(file, {parse_wire(options.wire), config.lidar.mount.inverted});
  }
  return pipeline.localizer().estimated_bias();
}

void calibrate_bias(const CalibrateBiasOptions& options) {
  const settings::Config config = options.settings.resolve(/*needs_map=*/true);
  CommandFiles files{.read = options.files, .written = {}, .output = options.output};
  files.read.insert(files.read.end(), {options.settings.config_file(), config.map});
  guard_files(files);
  const auto map = settings::load_map(config.map);
  core::EstimatedBias estimated;
  for (const double scale : kScaleStarts) {
    estimated = estimate_bias(options, config, map, scale);
    if (estimated.scans >= kMinBiasScans) break;
  }
  const double scale_change = estimated.bias.range_scale - config.lidar.bias.range_scale;
  if (estimated.scans < kMinBiasScans) {
    throw Failure(
        "only " + std::to_string(estimated.scans) +
        " scans were localized with the lidar at rest: record some seconds each at "
        "several places; where replay does not localize them, check that the map is to scale");
  }
  if (estimated.is_limited || std::abs(scale_change) > kMaxScaleChange) {
    throw Failure("the bias exceeds its limits: check that the map is to scale");
  }
  Output report = Output::report_beside(options.output);
  report.write(describe_bias(estimated));
  report.flush();
  if (options.output.empty()) return;
  const nlohmann::ordered_json fragment = {
      {"advanced", {{"lidar", {{"bias", settings::json_of(estimated.bias)}}}}}};
  write_file(options.output, fragment.dump(2) + '\n');
}

}  // namespace

void add_calibrate_bias(Command& group) {
  Command command = group.add_subcommand(
      "bias", "the systematic errors of ranges and bearings, from recordings in a known map");
  const auto options = std::make_shared<CalibrateBiasOptions>();
  command
      .add_option("files", options->files,
                  "recordings (.bin, .ndjson) of a robot at rest, some seconds each at several "
                  "places")
      .required()
      .type_name("FILE");
  options->add(command, "advanced.lidar.bias");
  command.callback([options] { calibrate_bias(*options); });
}

}  // namespace cornerd::tool
