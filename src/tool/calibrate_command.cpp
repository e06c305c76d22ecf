// SPDX-License-Identifier: MIT
// cornerctl calibrate noise: the lidar's noise from recordings of a robot that stands still.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "calibration/bearing_bins.hpp"
#include "calibration/median.hpp"
#include "calibration/range_noise.hpp"
#include "replay/recording.hpp"
#include "tool/commands.hpp"
#include "tool/failure.hpp"
#include "tool/noise_drawing.hpp"
#include "tool/noise_report.hpp"
#include "tool/options.hpp"
#include "tool/output.hpp"

namespace cornerd::tool {

namespace {

struct CalibrateNoiseOptions {
  std::vector<std::string> files;
  std::string model = "auto";
  std::string wire = "auto";
  std::filesystem::path output;
  std::filesystem::path plot;
};

/// Floor and share that are off by more than this in the mean give way to the table.
constexpr double kMisfitForTable = 0.2;
/// Median over the directions of what they drifted, in sigmas: 1.7 in an even movement.
constexpr double kMovedDrift = 1;

class BinsSink : public replay::RecordingSink {
 public:
  explicit BinsSink(calibration::BearingBins& bins) : bins_(bins) {}

  void on_sample(const core::Sample& sample) override {
    turns_ += sample.starts_turn;
    bins_.add(sample.bearing_rad, sample.range_m);
  }
  void on_gap() override {}
  void on_odometry(const message::OdometryReading&) override {}

  std::size_t turns() const { return turns_; }

 private:
  calibration::BearingBins& bins_;
  std::size_t turns_ = 0;
};

void warn_if_moved(const std::string& file, const std::vector<calibration::BinSpread>& spreads) {
  std::vector<double> drifts;
  for (const calibration::BinSpread& spread : spreads) drifts.push_back(std::abs(spread.drift));
  if (calibration::median(drifts) < kMovedDrift) return;
  std::fprintf(stderr,
               "cornerctl: warning: %s: the lidar seems to have moved; its noise will come "
               "out too large\n",
               file.c_str());
}

/// What the directions of one recording saw.
std::vector<calibration::BinSpread> measure(const std::string& file, const std::string& wire) {
  calibration::BearingBins bins;
  BinsSink sink(bins);
  replay::RecordingPlayer player(file, {parse_wire(wire), /*inverted=*/false});
  while (player.step(sink)) {
  }
  std::vector<calibration::BinSpread> spreads = bins.spreads();
  std::fprintf(stderr, "%s: %zu turns, %zu returns, %zu directions with a spread\n", file.c_str(),
               sink.turns(), bins.returns(), spreads.size());
  warn_if_moved(file, spreads);
  return spreads;
}

void calibrate_noise(const CalibrateNoiseOptions& options) {
  std::vector<calibration::BinSpread> spreads;
  for (const std::string& file : options.files) {
    const auto more = measure(file, options.wire);
    spreads.insert(spreads.end(), more.begin(), more.end());
  }
  const auto noise = calibration::fit_range_noise(spreads);
  if (!noise) {
    throw Failure(
        "too little to tell the noise from: record some 20 turns or more of a lidar that "
        "stands still and sees walls");
  }
  Output report;
  report.write(describe_noise(*noise));
  report.flush();
  if (!options.output.empty()) {
    const bool with_table = options.model == "table" ||
                            (options.model == "auto" && noise->plain_misfit > kMisfitForTable);
    Output fragment(options.output);
    fragment.write(noise_fragment(*noise, with_table));
    fragment.flush();
  }
  if (!options.plot.empty()) {
    Output picture(options.plot);
    picture.write(draw_noise(*noise, spreads));
    picture.flush();
  }
}

void add_noise(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "noise", "the lidar's noise over the range, from recordings of a robot that stands still");
  const auto options = std::make_shared<CalibrateNoiseOptions>();
  command->add_option("files", options->files, "recordings (.bin, .ndjson), each from one place")
      ->required()
      ->type_name("FILE");
  command
      ->add_option(
          "--model", options->model,
          "what -o writes: plain (floor and share), table, or the table where plain is off")
      ->check(CLI::IsMember({"auto", "plain", "table"}))
      ->capture_default_str();
  command
      ->add_option("-o,--output", options->output,
                   "the key lidar.noise, for a config and for simulate --noise")
      ->type_name("JSON");
  command->add_option("--plot", options->plot, "draw what was measured and fitted")
      ->type_name("SVG");
  add_wire_option(*command, options->wire);
  command->callback([options] { calibrate_noise(*options); });
}

}  // namespace

void add_calibrate(CLI::App& program) {
  CLI::App* group = program.add_subcommand("calibrate", "measure what a config wants to know");
  group->require_subcommand(1);
  add_noise(*group);
}

}  // namespace cornerd::tool
