// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/breakpoint/breakpoint.hpp"
#include "core/recognition/beam_model.hpp"

namespace cornerd::core {

/// What a scan shows, wherever it was taken.
struct ScanStructure {
  double wall_m = 0;    ///< length of its segments, each at most 3 m
  double segments = 0;  ///< their number
};

ScanStructure scan_structure(std::span<const WallSegment> segments);

/// Log odds that a scan was taken at a pose, against "somewhere else, or not in this map", nats.
/// `wall_ends`: breakpoints at an end of a wall that the map has there. A logistic regression on
/// the statistics of the beam model: single rays are not independent, so that products of their
/// likelihoods promise too much (`cornerd-bench --evidence`,
/// src/bench/localization/fit_evidence.py).
double log_odds_of_place(const BeamStatistics& place, double wall_ends, const ScanStructure& scan);

}  // namespace cornerd::core
