// SPDX-License-Identifier: MIT
// ALTBD as El Amin et al. print it (section III.A, steps 1-19), in the variants that the print
// leaves open. `cornerd-bench --variants` measures them (src/bench/corners.md).
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/breakpoint/wall_finder.hpp"
#include "core/detector_config.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::baseline {

/// Step 12 divides by the axes (as printed) or by their squares (an ellipse).
enum class EllipseAxes : std::uint8_t { kPrinted, kSquared };
/// Unit of h_max in step 5: metres, or a share of the range.
enum class MinorAxis : std::uint8_t { kMetres, kShareOfRange };
/// The predicting line: through the three points of step 1 until the wall ends (as printed), the
/// last three points, or all points so far ("line tracking").
enum class TrackedLine : std::uint8_t { kFirstThree, kLastThree, kAll };
/// Steps 4 and 18: sigma_n is the mean of the last three errors, or of all errors of the wall.
enum class ErrorMean : std::uint8_t { kLastThree, kAll };

struct PrintedAltbdConfig {
  EllipseAxes axes = EllipseAxes::kPrinted;
  MinorAxis minor = MinorAxis::kShareOfRange;
  TrackedLine line = TrackedLine::kFirstThree;
  ErrorMean mean = ErrorMean::kLastThree;
};

/// A line through three samples predicts the next one; a sample outside the ellipse ends the wall.
/// The next wall begins with that sample where it is within Dth_corner of the prediction (step 14),
/// else with the wall's last sample (step 15). Corners are intersections of walls, as for all
/// methods (extraction.hpp), not the point of step 14.
class PrintedAltbd final : public core::WallFinder {
 public:
  PrintedAltbd(const core::DetectorConfig& detector, const core::SensorNoise& noise,
               const PrintedAltbdConfig& config = {});

  /// Finds walls of at least min_support samples. Returns the number of walls dropped because
  /// `tracks` is full. Allocates nothing.
  std::size_t track(const core::PolarScan& scan, core::SegmentTracks& tracks) override;

 private:
  struct Miss;
  void start(const core::PolarScan& scan, std::size_t index);
  Miss measure(const core::PolarScan& scan, std::size_t index) const;
  bool inside(const Miss& miss) const;
  void extend(const core::PolarScan& scan, std::size_t index, double error);
  double mean_error() const;

  core::DetectorConfig detector_;
  PrintedAltbdConfig config_;
  core::SensorNoise noise_;
  core::SegmentTrack current_;
  core::Line predictor_;
  double errors_[3] = {};
  double error_sum_ = 0;
};

}  // namespace cornerd::baseline
