// SPDX-License-Identifier: MIT
#include "replay/simulator/sensor_model.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::replay {

SensorModel SensorModel::perfect() {
  SensorModel model;
  model.noise.floor_m = 0;
  model.noise.share = 0;
  model.noise.bearing_rad = 0;
  model.missing = 0;
  model.outliers = 0;
  return model;
}

double SensorErrors::direction_error(double device_angle_rad) {
  double error_rad =
      model_.eccentricity_rad * std::sin(device_angle_rad - model_.eccentricity_phase_rad);
  if (model_.noise.bearing_rad > 0) error_rad += model_.noise.bearing_rad * random_.normal();
  return error_rad;
}

bool SensorErrors::is_missing() {
  if (model_.missing_run <= 1 || random_.chance(1 / model_.missing_run)) {
    missing_now_ = random_.chance(model_.missing);
  }
  return missing_now_;
}

double SensorErrors::measured(double range_m, std::optional<double> incidence_rad) {
  if (is_missing()) return 0;
  if (random_.chance(model_.outliers)) {
    const double farthest_m =
        range_m > model_.min_range_m && random_.chance(0.5) ? range_m : model_.max_range_m;
    return random_.uniform(model_.min_range_m, farthest_m);
  }
  if (range_m < model_.min_range_m || range_m > model_.max_range_m) return 0;
  double sigma_m = model_.noise.sigma_range_m(range_m);
  double bias_m = model_.range_offset_m;
  if (incidence_rad) {
    const double distance_m = range_m * std::cos(*incidence_rad);
    if (model_.wall.covers(distance_m)) sigma_m = model_.wall.sigma_m(distance_m);
    bias_m += model_.wall.error_m(distance_m, *incidence_rad);
  }
  const double noise_m = sigma_m > 0 ? sigma_m * random_.normal() : 0;
  return std::max(0.0, model_.range_scale * range_m + bias_m + noise_m);
}

double SensorErrors::mixed(double one_m, double other_m) {
  if (one_m <= 0 || other_m <= 0) return std::max(one_m, other_m);
  // One surface: its middle, or every bearing would be off by half a beam.
  if (std::abs(one_m - other_m) < model_.mixed_step_m) return (one_m + other_m) / 2;
  return random_.uniform(std::min(one_m, other_m), std::max(one_m, other_m));
}

bool SensorErrors::swaps_nodes() {
  // Each swap uses two nodes, and one of them steps back.
  return model_.backward > 0 && random_.chance(model_.backward / (1 - model_.backward));
}

}  // namespace cornerd::replay
