// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// Names of the columns of EvidenceSamples::take().
extern const char* const kEvidenceColumns;

/// Random scans in right, mirrored and other maps, and what their rays do at each place that a
/// search of the map finds: what the weights of core/recognition/place_evidence.cpp are fitted to
/// (fit_evidence.py).
class EvidenceSamples {
 public:
  /// `maps`: of contest arenas and flats; offices and random flats come to them.
  EvidenceSamples(std::vector<std::shared_ptr<const core::WallMap>> maps, std::uint64_t seed);
  ~EvidenceSamples();

  /// One line for each place that a search finds for the next scan, comma-separated; and of a scan
  /// in an aged building, at its own place and at random ones (`given`).
  std::string take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cornerd::bench
