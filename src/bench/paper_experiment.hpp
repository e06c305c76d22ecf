// SPDX-License-Identifier: MIT
// The experiment of El Amin et al., section V: 43 poses, three methods.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bench/methods.hpp"
#include "bench/paper_poses.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/scan.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::bench {

/// One scan at each pose, the same for all methods.
struct PaperScans {
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  std::vector<PaperPose> poses;
  std::vector<core::Scan> scans;
};
PaperScans simulate_paper_scans(std::span<const std::shared_ptr<const core::WallMap>> maps,
                                const replay::SensorModel& sensor, std::size_t samples,
                                std::uint64_t seed);

/// Result of a method for one scan.
struct PoseResult {
  double time_us = 0;
  std::size_t true_corners = 0;
  /// Detections of the kind "corner" without a corner, at a wall's end that shows one wall, or at a
  /// corner that has a nearer detection.
  std::size_t false_corners = 0;
  std::size_t missed_corners = 0;                 ///< of those whose walls both give 5 returns
  std::optional<double> nearest_corners_error_m;  ///< of pose_from_nearest_corners
  std::optional<double> localizer_error_m;        ///< of the localizer, where it gives a fix
  std::vector<core::Breakpoint> breakpoints;
};

struct PaperResult {
  NamedMethod method;
  std::vector<PoseResult> poses;  ///< as PaperScans::poses
};

/// `timing_repeats`: rounds whose median is the time of a scan; 0: no timing.
std::vector<PaperResult> run_paper_experiment(const PaperScans& scans,
                                              std::span<const NamedMethod> methods,
                                              std::size_t timing_repeats);

/// For each scan the number of visible corners whose walls both give 5 returns.
std::vector<std::size_t> supported_corners(const PaperScans& scans);

/// In the order of paper_methods(): ALTBD, ABD+IEPF, LT.
inline constexpr std::size_t kPaperMethodCount = 3;

struct PaperCell {
  double time_ms;
  double time_deviation_ms;
  std::size_t true_corners;
  std::size_t false_corners;
};

struct PaperLocation {
  std::string_view title;
  std::string_view room;  ///< its name in the maps
  std::size_t poses;
  std::array<PaperCell, kPaperMethodCount> cells;
};

inline constexpr std::array<PaperLocation, 5> kPaperLocations = {{
    {"Room 1", "room-1", 9, {{{103.3, 8.0, 33, 0}, {198.9, 11.0, 34, 3}, {62.4, 0.0, 36, 4}}}},
    {"Room 2", "room-2", 8, {{{103.8, 8.0, 32, 0}, {208.6, 8.0, 32, 0}, {58.5, 7.2, 32, 6}}}},
    {"Room 3", "room-3", 10, {{{99.5, 8.0, 30, 0}, {157.9, 15.5, 32, 3}, {56.5, 8.0, 36, 3}}}},
    {"Room 4", "room-4", 8, {{{101.4, 8.0, 28, 1}, {169.0, 11.7, 28, 2}, {62.4, 0.0, 26, 3}}}},
    {"Street", "street", 8, {{{100.3, 8.0, 34, 1}, {135.9, 21.5, 32, 2}, {60.2, 5.9, 45, 7}}}},
}};

struct PaperMean {
  double mean;
  double deviation;
};
inline constexpr std::array<PaperMean, kPaperMethodCount> kPaperTimes_ms = {
    {{101.61, 2.63}, {175.4, 10.13}, {59.87, 1.94}}};
/// Position from the two nearest corners; the paper has none for LT.
inline constexpr std::array<PaperMean, 2> kPaperPositionErrors_mm = {{{9.72, 1.55}, {11.2, 2.14}}};

}  // namespace cornerd::bench
