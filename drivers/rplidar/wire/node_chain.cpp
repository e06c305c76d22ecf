// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/node_chain.hpp"

#include <cstdlib>

namespace cornerd::rplidar {
namespace {

constexpr int kChainDegree = 64;
constexpr int kNodesOnTrack = 4;
constexpr int kNodesAlone = 10;
constexpr int kMostNodes = 40;  // to see a slow head's advance through the corrections' jitter

// Consecutive nodes of real A1s differ by -7 to +10 degrees.
constexpr int kChainMinStep = -10 * kChainDegree;
constexpr int kChainMaxStep = 14 * kChainDegree;
// Bytes that stand still (a wall at one distance, read three bytes off) are no rotation.
constexpr int kMinAdvancePerNode = kChainDegree / 16;
constexpr int kChainZeroZone = 30 * kChainDegree;

bool flag_is_believable(const StandardNode& node) {
  return !node.start_flag || std::abs(angle_step_q6(0, node.angle_q6)) <= kChainZeroZone;
}

}  // namespace

ChainMatch match_node_chain(std::span<const std::uint8_t> bytes, const NodeTrack* track,
                            int periods, bool final) {
  bool on_track = track != nullptr;
  bool alone = true;
  int advance_q6 = 0;
  int previous_q6 = 0;
  for (int count = 0; on_track || alone; ++count) {
    if (bytes.size() < kNodeSize) return {final ? Verdict::kNo : Verdict::kMore, false};
    const auto node = parse_standard_node(bytes);
    if (!node) break;
    if (count > 0) {
      const int step_q6 = angle_step_q6(previous_q6, node->angle_q6);
      alone = alone && step_q6 >= kChainMinStep && step_q6 <= kChainMaxStep;
      advance_q6 += step_q6;
    }
    alone = alone && flag_is_believable(*node);
    on_track = on_track && track->explains(*node, periods + count);
    const bool scans = advance_q6 >= count * kMinAdvancePerNode;
    if (on_track && scans && count + 1 >= kNodesOnTrack) return {Verdict::kYes, true};
    if (alone && scans && count + 1 >= kNodesAlone) return {Verdict::kYes, false};
    if (count + 1 >= kMostNodes) break;
    previous_q6 = node->angle_q6;
    bytes = bytes.subspan(kNodeSize);
  }
  return {};
}

}  // namespace cornerd::rplidar
