// SPDX-License-Identifier: MIT
// ALTBD as El Amin et al. print it (section III.A, steps 1-19), in the readings that the print
// leaves open. `cornerctl bench --variants` measures them; README.md beside this file concludes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/breakpoint/wall_finder.hpp"
#include "core/detector_config.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::baseline {

/// Whether step 12 divides by the axes, as it is printed, or by their squares, as an ellipse has
/// it.
enum class EllipseAxes : std::uint8_t { kPrinted, kSquared };
/// What step 5's h_max, a share, is taken to be: metres, or a share of the range.
enum class MinorAxis : std::uint8_t { kMetres, kShareOfRange };
/// The line that predicts: the three points of step 1 until the wall ends (as printed), the last
/// three points, or all points so far ("line tracking").
enum class TrackedLine : std::uint8_t { kFirstThree, kLastThree, kAll };
/// Steps 4 and 18: sigma_n is the mean of the last three errors, or of all since the wall began.
enum class ErrorMean : std::uint8_t { kLastThree, kAll };

/// ALTBD as it is printed, in its readings.
struct PrintedAltbdConfig {
  EllipseAxes axes = EllipseAxes::kPrinted;
  MinorAxis minor = MinorAxis::kShareOfRange;
  TrackedLine line = TrackedLine::kFirstThree;
  ErrorMean mean = ErrorMean::kLastThree;
};

/// One wall after another: a line through three samples predicts the next, one outside the ellipse
/// ends the wall. The next wall begins with that sample where it is within Dth_corner of the
/// prediction (step 14), else with the wall's last one (step 15). Corners are placed as all
/// methods' are, at the intersection of the walls (extraction.hpp), not at step 14's foot.
class PrintedAltbd final : public core::WallFinder {
 public:
  PrintedAltbd(const core::DetectorConfig& detector, const core::SensorNoise& noise,
               const PrintedAltbdConfig& config = {});

  /// Walls of at least min_support samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
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
