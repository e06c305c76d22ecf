// SPDX-License-Identifier: MIT
#include "tool/simulate/sensor_options.hpp"

#include <CLI/CLI.hpp>

#include "core/geometry/angle.hpp"
#include "tool/command_line/options.hpp"

namespace cornerd::tool {

namespace {

/// Measured on standard-mode recordings of A1s in living rooms: 29-51 % of the nodes empty, in
/// stretches of about six; 3-6 % step back, most of them after empty ones; 0.18 degrees of bearing
/// noise (calibrate noise, one recording). Assumed: the outliers, and the beam, which stands on few
/// edges of another RPLidar (16-47 % mixed); the A1's 13 edges showed none.
void err_as_real_ones(replay::SensorModel& model) {
  model.missing = 0.38;
  model.missing_run = 6;
  model.outliers = 0.005;
  model.beam_width_rad = core::radians(0.3);
  model.backward = 0.005;
  model.noise.bearing_rad = core::radians(0.18);
}

}  // namespace

void SensorOptions::add_to(CLI::App& command) {
  command.add_flag("--real", real,
                   "lose samples in stretches and step back in angle as recorded A1s do, with some "
                   "mixed pixels and outliers; further options refine that");
  command
      .add_option("--noise", noise,
                  "the lidar's noise, as calibrate noise writes it; else the config's lidar.noise")
      ->type_name("FILE");
  command.add_option("--sigma-floor", floor_m, "standard deviation of a range: the larger of this")
      ->check(number_within(0, 1));
  command
      .add_option("--sigma-share", share, "(m) and this share of the range; in place of --noise")
      ->check(number_within(0, 1));
  command.add_option("--bearing-noise", bearing_deg, "standard deviation of a bearing (degrees)")
      ->check(number_within(0, 5));
  command.add_option("--missing", missing, "share of samples without a return")
      ->check(number_within(0, 1));
  command
      .add_option(
          "--missing-run", missing_run,
          "mean number of samples until one's fate is drawn anew: more lose whole stretches")
      ->check(number_within(1, 1e6));
  command.add_option("--outliers", outliers, "share of samples that are wrong")
      ->check(number_within(0, 1));
  command
      .add_option("--beam", beam_deg,
                  "width of the beam (degrees): at an edge a sample lies between its two sides")
      ->check(number_within(0, 10));
  command
      .add_option("--backward", backward,
                  "share of standard nodes that arrive behind the next one: their angle steps back")
      ->check(number_within(0, 0.4));
  command.add_option("--range-scale", range_scale, "bias: what is measured of a metre (m)")
      ->check(number_within(0.9, 1.1));
  command.add_option("--range-offset", range_offset_m, "bias: added to every range (m)")
      ->check(number_within(-0.1, 0.1));
  command
      .add_option("--eccentricity", eccentricity_deg,
                  "bias: of the angle disc, largest error of a direction (degrees)")
      ->check(number_within(0, 3));
  command
      .add_option("--eccentricity-phase", eccentricity_phase_deg,
                  "device angle at which that error is zero and growing (degrees)")
      ->check(number_within(-360, 360));
}

replay::SensorModel SensorOptions::model(const settings::NoiseConfig& configured) const {
  replay::SensorModel model;
  const settings::NoiseConfig given = noise.empty() ? configured : settings::load_noise(noise);
  model.noise = given.sensor;
  model.wall = given.wall;
  if (floor_m || share) {
    model.noise.table = {};
    model.wall = {};
  }
  model.noise.floor_m = floor_m.value_or(model.noise.floor_m);
  model.noise.share = share.value_or(model.noise.share);
  if (real) err_as_real_ones(model);
  if (bearing_deg) model.noise.bearing_rad = core::radians(*bearing_deg);
  model.missing = missing.value_or(model.missing);
  model.missing_run = missing_run.value_or(model.missing_run);
  model.outliers = outliers.value_or(model.outliers);
  if (beam_deg) model.beam_width_rad = core::radians(*beam_deg);
  model.backward = backward.value_or(model.backward);
  model.range_scale = range_scale.value_or(model.range_scale);
  model.range_offset_m = range_offset_m.value_or(model.range_offset_m);
  if (eccentricity_deg) model.eccentricity_rad = core::radians(*eccentricity_deg);
  if (eccentricity_phase_deg) model.eccentricity_phase_rad = core::radians(*eccentricity_phase_deg);
  return model;
}

}  // namespace cornerd::tool
