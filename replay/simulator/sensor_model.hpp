// SPDX-License-Identifier: MIT
// Error model of an A1.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "calibration/wall_model.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensor_noise.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::replay {

/// The sector that a lidar sees, in its frame.
struct FieldOfView {
  double width_rad = core::kTwoPi;
  double centre_rad = 0;

  bool contains(double bearing_rad) const {
    return std::abs(core::angle_between(centre_rad, bearing_rad)) <= width_rad / 2;
  }
};

/// Errors of a simulated A1. Real units lose 38 to 84 % of their samples indoors; `missing` sets
/// it.
struct SensorModel {
  double min_range_m = 0.15;  ///< no return below
  double max_range_m = 12.0;  ///< no return beyond
  FieldOfView field_of_view;  ///< no return, nor an outlier, outside

  /// Noise of range and bearing: the localizer's own model. The sigmas may be 0 here.
  core::SensorNoise noise;
  /// If not empty: range error and sigma by the wall's distance and the angle of incidence.
  calibration::WallModel wall;

  double missing = 0.005;  ///< share of the samples without a return
  /// Mean run length of missing samples: 1 loses them independently, more in runs, as dark or
  /// glossy surfaces do. Does not change the share.
  double missing_run = 1;
  /// Share of outliers: half uniform within the limits (crosstalk), half too near (obstacles).
  double outliers = 0.002;

  /// Beam width; 0: a ray. If the ranges at its two sides differ by more than `mixed_step_m`, the
  /// sample lies uniformly between them, as on a triangulating sensor at an edge.
  double beam_width_rad = 0;
  double mixed_step_m = 0.05;

  /// Share of standard nodes swapped with the next one, so that the angle steps back. A return
  /// after an empty node steps back anyway, as only returns have corrected angles.
  double backward = 0;

  double range_scale = 1;     ///< bias: measured = scale * true + offset
  double range_offset_m = 0;  ///< bias
  /// Bias by an eccentric encoder disc: direction error = eccentricity * sin(angle - phase).
  double eccentricity_rad = 0;
  double eccentricity_phase_rad = 0;

  /// No errors but the range limits.
  static SensorModel perfect();
};

/// Draws the errors of one sensor, sample by sample.
class SensorErrors {
 public:
  SensorErrors(const SensorModel& model, std::uint64_t seed) : model_(model), random_(seed) {}

  /// Whether a reported bearing (lidar frame) is in the field of view.
  bool sees(double bearing_rad) const { return model_.field_of_view.contains(bearing_rad); }

  /// True direction minus reported direction of a sample.
  double direction_error(double device_angle_rad);

  /// Measured range of a wall at `range_m` (0: no wall); 0: no return. `incidence_rad`: from the
  /// wall's normal, counter-clockwise, for needs_incidence().
  double measured(double range_m, std::optional<double> incidence_rad = std::nullopt);
  bool needs_incidence() const { return !model_.wall.empty(); }

  /// Range of a beam whose two sides have these ranges.
  double mixed(double one_m, double other_m);

  /// Whether the next two nodes are swapped. Call once per pair.
  bool swaps_nodes();

 private:
  bool is_missing();

  SensorModel model_;
  Random random_;
  bool missing_now_ = false;
};

}  // namespace cornerd::replay
