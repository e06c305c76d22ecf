// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/rplidar/wire/byte_window.hpp"

namespace cornerd::rplidar {

inline constexpr std::size_t kNodeSize = 5;
inline constexpr int kFullRevolutionQ6 = 360 * 64;

/// One sample of a standard scan (answer type 0x81).
struct StandardNode {
  bool start_flag = false;
  std::uint8_t quality = 0;
  std::uint16_t angle_q6 = 0;  ///< in [0, 360 * 64)
  std::uint16_t dist_q2 = 0;
};

/// Parses the first kNodeSize of `bytes`. nullopt if S does not differ from its inverse, the check
/// bit is wrong, or the angle is beyond its limit.
std::optional<StandardNode> parse_standard_node(std::span<const std::uint8_t> bytes);

/// `to - from`, in [-180, 180) degrees (q6).
constexpr int angle_step_q6(int from_q6, int to_q6) {
  constexpr int kHalf = kFullRevolutionQ6 / 2;
  return ((to_q6 - from_q6) % kFullRevolutionQ6 + kFullRevolutionQ6 + kHalf) % kFullRevolutionQ6 -
         kHalf;
}

/// Alpha-beta filter of the head's angle over the nodes' angles. The A1 corrects each angle by the
/// measured distance, by up to 9 degrees, and not without a return; so on a real A1 one node in
/// eight lies behind its predecessor.
class HeadAngleFilter {
 public:
  /// Restarts at this node; keeps the speed.
  void begin(const StandardNode& node);
  /// `node` comes `periods` sample periods after the last one.
  void advance(const StandardNode& node, int periods);
  /// Whether the residual of a node `periods` after the last one is within the tolerance.
  bool is_consistent(const StandardNode& node, int periods) const;

  /// The smoothed angle, in [0, 360 * 64).
  float angle_q6() const { return angle_q6_; }
  /// Change by the last advance().
  float last_move_q6() const { return last_move_q6_; }
  /// Within 30 degrees of 0, where a start flag is plausible.
  bool near_zero() const;

 private:
  float angle_q6_ = 0;
  float step_q6_ = 0;  ///< per sample period
  float last_move_q6_ = 0;
};

/// Splits nodes into scans by the filtered angle. The device's start flag gives the exact node if
/// it comes near 0 degrees; if it was lost, the scan ends a few degrees later.
class ScanSplitter {
 public:
  /// Whether the node with which `track` was just advanced starts a scan.
  bool advance(bool start_flag, const HeadAngleFilter& track);
  /// The angle is no longer known.
  void forget();

  /// Start flags seen away from 0 degrees.
  std::uint64_t false_starts() const { return false_starts_; }

 private:
  static constexpr float kFullRevolution = kFullRevolutionQ6;

  float travelled_q6_ = kFullRevolution;  ///< since the last scan start
  bool before_zero_ = false;              ///< in the second half of the revolution
  std::uint64_t false_starts_ = 0;
};

struct ChainMatch {
  Verdict verdict = Verdict::kNo;
  bool continues_track = false;  ///< else the nodes are at an unrelated angle
};

/// Whether nodes begin at the first of `bytes`. Random bytes pass a node's checks with probability
/// 1/4, so several successive nodes that rotate like a head are required: ten in general, four if
/// they continue `track` (may be null) after `periods` samples. `final`: no more bytes will come.
ChainMatch match_node_chain(std::span<const std::uint8_t> bytes, const HeadAngleFilter* track,
                            int periods, bool final);

}  // namespace cornerd::rplidar
