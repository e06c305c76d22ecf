// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "drivers/rplidar/wire/node_track.hpp"

namespace cornerd::rplidar {

/// Splits standard nodes into turns by the smoothed angle. The device's start flag says exactly
/// where, if it comes near zero; where it was lost the turn ends a few degrees later.
class NodeRevolutions {
 public:
  /// Whether the node with which `track` has just been advanced begins a turn.
  bool advance(bool start_flag, const NodeTrack& track);
  /// The place in the turn is no longer known.
  void forget();

  /// Start flags in the middle of a turn so far.
  std::uint64_t false_marks() const { return false_marks_; }

 private:
  static constexpr float kFullRevolution = kFullRevolutionQ6;

  float travelled_q6_ = kFullRevolution;  ///< since the last start
  bool before_zero_ = false;              ///< the last half of the turn has been entered
  std::uint64_t false_marks_ = 0;
};

}  // namespace cornerd::rplidar
