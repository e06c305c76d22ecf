// SPDX-License-Identifier: MIT
#include "baseline/printed_altbd.hpp"

#include <cmath>

namespace cornerd::baseline {
namespace {

constexpr std::size_t kThree = 3;

/// Line through three neighbouring samples of equal weight.
core::Line line_through(const core::PolarScan& scan, std::size_t first) {
  core::LineFit fit({scan[first].x_m, scan[first].y_m});
  for (std::size_t i = first; i < first + kThree; ++i) fit.add(scan[i].x_m, scan[i].y_m, 1);
  return fit.line();
}

double relative_error(const core::Line& line, const core::PolarPoint& point) {
  const double j_m = line.normal.dot(point.position()) - line.offset_m;
  return std::abs(j_m) / point.range_m;
}

}  // namespace

/// Deviation of the next sample from its prediction, steps 6-11.
struct PrintedAltbd::Miss {
  double k_m = 0;         ///< from the predicted point, along the line
  double j_m = 0;         ///< across it
  double q_max_m = 0;     ///< step 9
  double h_max = 0;       ///< steps 5 and 18
  bool meets = false;     ///< the ray meets the line in front of the sensor
  double error = 0;       ///< steps 3 and 17
  double distance_m = 0;  ///< from the predicted point
};

PrintedAltbd::PrintedAltbd(const core::DetectorConfig& detector, const core::SensorNoise& noise,
                           const PrintedAltbdConfig& config)
    : detector_(detector), config_(config), noise_(noise) {}

void PrintedAltbd::start(const core::PolarScan& scan, std::size_t index) {
  current_ = core::SegmentTrack::starting_at(scan, index);
  for (std::size_t i = index; i < index + kThree; ++i) current_.add(scan, i, noise_);
  predictor_ = line_through(scan, index);
  error_sum_ = 0;
  for (std::size_t k = 0; k < kThree; ++k) {
    errors_[k] = relative_error(predictor_, scan[index + k]);
    error_sum_ += errors_[k];
  }
}

double PrintedAltbd::mean_error() const {
  if (config_.mean == ErrorMean::kAll) return error_sum_ / current_.support;
  return (errors_[0] + errors_[1] + errors_[2]) / kThree;
}

PrintedAltbd::Miss PrintedAltbd::measure(const core::PolarScan& scan, std::size_t index) const {
  const core::PolarPoint& point = scan[index];
  const core::PolarPoint& before = scan[current_.last];
  const core::Vec2 ray = point.ray();
  const double approach = predictor_.normal.dot(ray);
  Miss miss;
  if (approach * predictor_.offset_m <= 0) return miss;
  miss.meets = true;
  const core::Vec2 predicted = predictor_.offset_m / approach * ray;
  const core::Vec2 offset = point.position() - predicted;
  miss.k_m = predictor_.direction().dot(offset);
  miss.j_m = predictor_.normal.dot(offset);
  miss.q_max_m = std::abs(predictor_.direction().dot(predicted - before.position()));
  const double h_max = mean_error() + detector_.sigma_offset;
  miss.h_max = config_.minor == MinorAxis::kMetres ? h_max : h_max * point.range_m;
  miss.error = std::abs(miss.j_m) / point.range_m;
  miss.distance_m = offset.norm();
  return miss;
}

/// Step 12.
bool PrintedAltbd::inside(const Miss& miss) const {
  if (!miss.meets || miss.q_max_m <= 0) return false;
  const double k2 = miss.k_m * miss.k_m;
  const double j2 = miss.j_m * miss.j_m;
  if (config_.axes == EllipseAxes::kPrinted) {
    return k2 / miss.q_max_m + j2 / miss.h_max <= 1;
  }
  return k2 / (miss.q_max_m * miss.q_max_m) + j2 / (miss.h_max * miss.h_max) <= 1;
}

/// Steps 16-18, and the refit of the variant.
void PrintedAltbd::extend(const core::PolarScan& scan, std::size_t index, double error) {
  errors_[current_.support % kThree] = error;
  error_sum_ += error;
  current_.add(scan, index, noise_);
  if (config_.line == TrackedLine::kAll) {
    predictor_ = current_.fit.line();
  } else if (config_.line == TrackedLine::kLastThree) {
    predictor_ = line_through(scan, index + 1 - kThree);
  }
}

std::size_t PrintedAltbd::track(const core::PolarScan& scan, core::SegmentTracks& tracks) {
  tracks.clear();
  std::size_t dropped = 0;
  std::size_t index = 0;
  while (index + kThree <= scan.size()) {
    start(scan, index);
    std::size_t next = index + kThree;
    Miss miss;
    for (; next < scan.size(); ++next) {
      miss = measure(scan, next);
      if (!inside(miss)) break;
      extend(scan, next, miss.error);
    }
    const bool corner = miss.meets && miss.distance_m <= detector_.corner_tolerance_m;
    if (current_.support >= detector_.min_support) {
      current_.line = current_.fit.line();
      if (!keep_wall(current_, tracks)) ++dropped;
      index = corner ? next : next - 1;
    } else {
      // Step 15 would repeat the same three samples for ever where the wall has no others.
      index = corner || next == index + kThree ? index + 1 : next - 1;
    }
  }
  return dropped;
}

}  // namespace cornerd::baseline
