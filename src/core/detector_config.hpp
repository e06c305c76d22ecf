// SPDX-License-Identifier: MIT
// Every parameter of the detector, with its unit, its default and where that comes from. "Paper"
// is El Amin, Priandana and Hardhienata; section and step are those of its print.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "core/geometry/angle.hpp"

namespace cornerd::core {

struct DetectorConfig;
struct SensorNoise;
class WallFinder;

/// Makes a method that finds walls, by these parameters and this noise.
using WallFinderFactory =
    std::function<std::unique_ptr<WallFinder>(const DetectorConfig&, const SensorNoise&)>;

/// ALTBD as cornerd runs it. The defaults without a source of their own are what
/// `cornerctl bench` likes best.
struct AltbdConfig {
  /// Half axes of the ellipse in standard deviations of the residual: one normal sample in 2,000
  /// lies outside.
  double gate_sigmas = 3.5;
  /// Samples that start a line: step 1.
  std::uint32_t seed_samples = 3;
  /// Misses in a row that end a wall: outliers come alone, mixed pixels in twos.
  std::uint32_t misses_to_break = 3;
  /// Step between two bearings over which no wall is followed: a door at a usual distance.
  double max_gap_rad = radians(25);
  /// Step along a wall from one sample to the next over which it is not followed: less than a door.
  double max_gap_m = 0.3;
  /// The noise model counts like this many residuals when the turn's own noise is judged.
  double prior_residuals = 20;
};

/// What becomes of the walls, whatever the method found them: joining, corners, ends. All defaults
/// are what `cornerctl bench` likes best.
struct ExtractionConfig {
  /// Deviation in standard deviations that is still noise: one in 2,000 of a normal one is beyond.
  double gate_sigmas = 3.5;
  /// Samples that may lie between two pieces of one wall: a table leg, a run of outliers.
  std::size_t max_interruption = 4;
  /// What the pieces may be apart, so that no door becomes a wall.
  double max_piece_gap_m = 0.3;
  /// Between the pieces: a wall that turns by more does not go on.
  double max_piece_angle_rad = radians(60);
  /// Chi-square that one line instead of two may cost. Normal noise reaches 15 once in 2,000 times;
  /// a tracker that stops at the worst noise reaches more.
  double joined_chi_square = 40;
  /// A wall of no more samples than this, or whose direction is less certain, may be noise about
  /// its neighbours, and is tested for it.
  std::uint32_t doubtful_samples = 12;
  double doubtful_sigma_rad = radians(3);
  /// Between the walls of a corner.
  double min_corner_angle_rad = radians(15);
  /// Rays that may give nothing between a wall that they graze and its corner.
  double grazing_rays = 4;
  /// What such rays may leave open, in units of Dth_corner.
  double grazing_reach = 2;
  /// One sample behind the place where two walls meet is an outlier where more than so many lie
  /// between them, or where they are nearer than this: nothing could be seen through the gap.
  std::size_t see_through_samples = 3;
  double see_through_gap_m = 0.06;
  /// Depth of the face of a wall's end, which is too short for a wall of its own.
  double max_face_m = 0.1;
  /// Samples on it that make it a corner: one alone may be a mixed pixel.
  std::size_t min_face_samples = 2;
  /// Between a wall's last sample and where the next ray would have met it: a wall that ends
  /// somewhere in more than this has no place to end at.
  double max_end_span_m = 0.12;
  /// Samples beyond the end that are asked whether the wall hides them; two have to say so.
  std::size_t look_beyond = 3;
  /// Uncertainty of the direction of two to four samples that count as the rest of a wall.
  double max_rest_sigma_rad = radians(9);
  /// Samples closer to a ray than this lie between an edge and what is behind it, on nothing.
  double min_rest_angle_rad = radians(3.5);
  /// A corner that they make is none where its place is less certain than this.
  double max_rest_corner_sigma_m = 0.02;
};

struct DetectorConfig {
  WallFinderFactory finder;          ///< takes the place of ALTBD; empty: none does
  double sigma_offset = 0.04;        ///< share of the range (paper, step 5 and section V.C)
  double corner_tolerance_m = 0.23;  ///< Dth_corner: half a door of 46 cm (step 13, section V.C)
  /// Samples that make a wall, whatever the method. The paper has "more than four points" (section
  /// V.B): all methods find more of the corners with four (breakpoint/README.md).
  std::uint32_t min_support = 4;
  AltbdConfig altbd;
  ExtractionConfig extraction;
};

}  // namespace cornerd::core
