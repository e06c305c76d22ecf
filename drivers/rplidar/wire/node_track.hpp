// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {

/// `to - from` by the shorter way, in [-180, 180) degrees (q6).
constexpr int angle_step_q6(int from_q6, int to_q6) {
  constexpr int kHalf = kFullRevolutionQ6 / 2;
  return ((to_q6 - from_q6) % kFullRevolutionQ6 + kFullRevolutionQ6 + kHalf) % kFullRevolutionQ6 -
         kHalf;
}

/// Where the head points, smoothed over the nodes' angles: an alpha-beta filter. It is needed
/// because the core corrects each node's angle by what it measured (up to 9 degrees, none for a
/// node without a return), so that on a real A1 one node in eight lies behind its predecessor.
class NodeTrack {
 public:
  /// Begins anew at this node.
  void begin(const StandardNode& node);
  /// Goes on by `periods` sample periods, the last of which is this node.
  void advance(const StandardNode& node, int periods);
  /// Whether a node that comes `periods` after the last one could be of this rotation.
  bool explains(const StandardNode& node, int periods) const;

  /// The smoothed angle, in [0, 360 * 64).
  float angle_q6() const { return angle_q6_; }
  /// By how much the last advance() moved it.
  float last_move_q6() const { return last_move_q6_; }
  /// Whether the smoothed angle is close enough to 0 for a start flag to be true.
  bool near_zero() const;

 private:
  float angle_q6_ = 0;
  float step_q6_ = 0;  ///< a sample period
  float last_move_q6_ = 0;
};

}  // namespace cornerd::rplidar
