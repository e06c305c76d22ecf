// SPDX-License-Identifier: MIT
// The experiment of El Amin et al., section V: 43 places, three methods.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bench/methods.hpp"
#include "bench/paper_places.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/scan.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::bench {

/// One turn at each place, the same for all methods.
struct PaperScans {
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  std::vector<PaperPlace> places;
  std::vector<core::Scan> scans;
};
PaperScans simulate_paper_scans(std::span<const std::shared_ptr<const core::WallMap>> maps,
                                const replay::SensorModel& sensor, std::size_t samples,
                                std::uint64_t seed);

/// What a method made of one turn.
struct PlaceResult {
  double time_us = 0;
  std::size_t true_corners = 0;
  /// Detections that claim to be corners and are none, or are a wall's end that shows one wall, or
  /// a corner that is found already.
  std::size_t false_corners = 0;
  std::size_t missed_corners = 0;                 ///< of those whose walls both give 5 returns
  std::optional<double> nearest_corners_error_m;  ///< of the paper's position
  std::optional<double> localizer_error_m;        ///< of cornerd's, where it names a place
  std::vector<core::Breakpoint> breakpoints;
};

struct PaperResult {
  NamedMethod method;
  std::vector<PlaceResult> places;  ///< as PaperScans::places
};

/// `timing_repeats`: of every turn; the median counts. 0: nothing is timed.
std::vector<PaperResult> run_paper_experiment(const PaperScans& scans,
                                              std::span<const NamedMethod> methods,
                                              std::size_t timing_repeats);

/// How many corners whose walls both give 5 returns each turn shows.
std::vector<std::size_t> supported_corners(const PaperScans& scans);

}  // namespace cornerd::bench
