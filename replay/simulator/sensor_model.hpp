// SPDX-License-Identifier: MIT
// How an A1 errs.
#pragma once

#include <cstdint>
#include <optional>

#include "calibration/wall_model.hpp"
#include "core/sensor_noise.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::replay {

/// Errors of a simulated A1. Indoors, real units lose 38-84 % of their samples: set `missing` for
/// that.
struct SensorModel {
  double min_range_m = 0.15;  ///< nearer walls give nothing
  double max_range_m = 12.0;  ///< farther ones neither

  /// Of the range, and between the direction that a sample claims and the one that it measured: the
  /// same model that the localizer believes in. The sigmas may be 0 here.
  core::SensorNoise noise;
  /// Where it is not empty: what a range errs by, and its sigma, by the distance of the wall and
  /// the ray's angle to the wall's normal.
  calibration::WallModel wall;

  double missing = 0.005;  ///< share of the samples without a return
  /// Mean number of samples until a sample's fate is drawn anew: 1 loses samples one by one, more
  /// loses whole stretches, as dark or glossy surfaces do. The share stays the same.
  double missing_run = 1;
  /// Share of the samples that are wrong: half of them anywhere within the limits (crosstalk), half
  /// too near (something in the way).
  double outliers = 0.002;

  /// Width of the beam. Where its two sides see ranges further than `mixed_step_m` apart, the
  /// sample lies anywhere between them, as a triangulating sensor's does at an edge. 0: a ray.
  double beam_width_rad = 0;
  double mixed_step_m = 0.05;

  /// Share of the standard nodes that arrive a step late, behind the next one, so that the angle
  /// steps back. Returns after empty nodes step back in any case, as only theirs are corrected.
  double backward = 0;

  double range_scale = 1;     ///< bias: measured = scale * true + offset
  double range_offset_m = 0;  ///< bias
  /// Bias: the angle disc's centre is off the axis; amplitude of the direction's error, and the
  /// device angle at which it is zero and growing.
  double eccentricity_rad = 0;
  double eccentricity_phase_rad = 0;

  /// A sensor without any error but its range limits.
  static SensorModel perfect();
};

/// The errors of one sensor, sample after sample.
class SensorErrors {
 public:
  SensorErrors(const SensorModel& model, std::uint64_t seed) : model_(model), random_(seed) {}

  /// Where a sample that claims `device_angle_rad` really looks, less what it claims.
  double direction_error(double device_angle_rad);

  /// What is measured of a wall at `range_m` (0: no wall); 0: nothing. `incidence_rad`: from the
  /// wall's normal, counter-clockwise, where it is known and needs_incidence().
  double measured(double range_m, std::optional<double> incidence_rad = std::nullopt);
  bool needs_incidence() const { return !model_.wall.empty(); }

  /// What is measured where the two sides of the beam see different ranges.
  double mixed(double one_m, double other_m);

  /// True where the next two nodes change places. Asked once for each pair that may.
  bool swaps_nodes();

 private:
  bool is_missing();

  SensorModel model_;
  Random random_;
  bool missing_now_ = false;
};

}  // namespace cornerd::replay
