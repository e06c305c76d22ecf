// SPDX-License-Identifier: MIT
// Every parameter of every detector with its unit, default and source. "Paper" is El Amin,
// Priandana and Hardhienata; section and step are those of its print.
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

/// ALTBD as cornerd runs it. Defaults without a source are tuned by `cornerd-bench`.
struct AltbdConfig {
  /// Half axes of the ellipse in standard deviations of the residual: one normal sample in 2,000
  /// lies outside.
  double gate_sigmas = 3.5;
  /// Samples that start a line: step 1.
  std::uint32_t seed_samples = 3;
  /// Consecutive misses that end a wall: outliers come alone, mixed pixels in pairs.
  std::uint32_t misses_to_break = 3;
  /// Largest step in bearing within a wall: 0.8 m of door from 1.8 m.
  double max_gap_rad = radians(25);
  /// Largest step along a wall between two samples: less than a door.
  double max_gap_m = 0.3;
  /// Weight of the noise model in the estimate of the scan's noise, in residuals.
  double prior_residuals = 20;
};

/// Post-processing of the walls, whatever the method: merging, corners, ends. Defaults are tuned by
/// `cornerd-bench`.
struct ExtractionConfig {
  /// Gate in standard deviations: one normal residual in 2,000 is beyond.
  double gate_sigmas = 3.5;
  /// Samples between two pieces of one wall: a table leg, a run of outliers.
  std::size_t max_interruption = 4;
  /// Largest gap between the pieces: below a door's width.
  double merge_gap_m = 0.3;
  /// Largest angle between the pieces.
  double merge_angle_rad = radians(60);
  /// Largest increase of chi-square when two lines become one. Normal noise reaches 15 once in
  /// 2,000 times; a tracker that stops at the worst sample reaches more.
  double merge_chi_square = 40;
  /// A wall of at most this many samples, or with a less certain direction, may be noise of its
  /// neighbours and is tested for it.
  std::uint32_t short_wall_samples = 12;
  double short_wall_sigma_rad = radians(3);
  /// Smallest angle between the walls of a corner.
  double min_corner_angle_rad = radians(15);
  /// Rays without a return between a wall at grazing incidence and its corner.
  double grazing_rays = 4;
  /// Gap that such rays may leave, in units of Dth_corner.
  double grazing_gap = 2;
  /// A single sample behind a corner is an outlier where more than this many samples lie between
  /// its walls, or where their gap is smaller than this.
  std::size_t see_through_samples = 3;
  double see_through_gap_m = 0.06;
  /// Largest depth of the face at a wall's end, which is too short for a wall of its own.
  double max_face_m = 0.1;
  /// Samples on that face that make a corner: a single one may be a mixed pixel.
  std::size_t min_face_samples = 2;
  /// Largest distance between a wall's last sample and the next ray's intersection: a terminal is
  /// not localized better than this.
  double max_end_span_m = 0.12;
  /// Samples beyond the end that are tested for occlusion; two have to pass.
  std::size_t occlusion_samples = 3;
  /// Largest direction uncertainty of two to four samples that count as the rest of a wall.
  double stub_sigma_rad = radians(9);
  /// Smallest angle between that rest and the rays: smaller angles are mixed pixels at an edge.
  double stub_angle_rad = radians(3.5);
  /// Largest standard deviation of a corner made with such a rest.
  double stub_corner_sigma_m = 0.02;
};

struct DetectorConfig {
  WallFinderFactory finder;          ///< replaces ALTBD; empty: ALTBD
  double sigma_offset = 0.04;        ///< share of the range (paper, step 5 and section V.C)
  double corner_tolerance_m = 0.23;  ///< Dth_corner: half a door of 46 cm (step 13, section V.C)
  /// Samples that make a wall. The paper has "more than four points" (section V.B); all methods
  /// find more corners with four (core/breakpoint/README.md).
  std::uint32_t min_support = 4;
  AltbdConfig altbd;
  ExtractionConfig extraction;
};

}  // namespace cornerd::core
