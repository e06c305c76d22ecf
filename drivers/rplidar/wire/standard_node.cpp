// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/standard_node.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cornerd::rplidar {
namespace {

// The A1's angle correction reaches slightly beyond 360 degrees.
constexpr int kMaxRawAngleQ6 = 380 * 64;

}  // namespace

std::optional<StandardNode> parse_standard_node(std::span<const std::uint8_t> bytes) {
  const bool start = (bytes[0] & 1) != 0;
  const bool not_start = (bytes[0] & 2) != 0;
  const bool check = (bytes[1] & 1) != 0;
  const int raw_angle_q6 = (bytes[1] | bytes[2] << 8) >> 1;
  if (start == not_start || !check || raw_angle_q6 > kMaxRawAngleQ6) return std::nullopt;
  return StandardNode{.start_flag = start,
                      .quality = static_cast<std::uint8_t>(bytes[0] >> 2),
                      .angle_q6 = static_cast<std::uint16_t>(raw_angle_q6 % kFullRevolutionQ6),
                      .dist_q2 = static_cast<std::uint16_t>(bytes[3] | bytes[4] << 8)};
}

namespace {

constexpr float kTrackDegree = 64;
constexpr float kRevolution = kFullRevolutionQ6;

// At 508 us per sample: 1 degree at 5.5 Hz, 0.18 at 1 Hz, 3.7 at 20 Hz.
constexpr float kNominalStep = 1.2F * kTrackDegree;
constexpr float kTrackMaxStep = 4 * kTrackDegree;

// Gains of a critically damped filter over about 8 nodes.
constexpr float kAngleGain = 1.0F / 8;
constexpr float kStepGain = 1.0F / 128;

// The A1's angle correction spans 9.2 degrees; the filtered angle may be at either end.
constexpr float kMaxAngleError = 13 * kTrackDegree;
// Real start flags arrive at 351 to 359 degrees.
constexpr float kTrackZeroZone = 30 * kTrackDegree;

float wrap_difference(float difference) {
  return difference - kRevolution * std::round(difference / kRevolution);
}
float wrap_angle(float angle) {
  const float wrapped = angle - kRevolution * std::floor(angle / kRevolution);
  return wrapped < kRevolution ? wrapped : 0;
}

}  // namespace

void HeadAngleFilter::begin(const StandardNode& node) {
  angle_q6_ = node.angle_q6;
  if (step_q6_ <= 0) step_q6_ = kNominalStep;  // else keep the head's speed
  last_move_q6_ = 0;
}

void HeadAngleFilter::advance(const StandardNode& node, int periods) {
  const float expected_move = step_q6_ * static_cast<float>(periods);
  const float residual =
      wrap_difference(static_cast<float>(node.angle_q6) - (angle_q6_ + expected_move));
  last_move_q6_ = expected_move + residual * kAngleGain;
  angle_q6_ = wrap_angle(angle_q6_ + last_move_q6_);
  step_q6_ = std::clamp(step_q6_ + residual * kStepGain, 0.01F * kTrackDegree, kTrackMaxStep);
}

bool HeadAngleFilter::is_consistent(const StandardNode& node, int periods) const {
  const float expected = angle_q6_ + step_q6_ * static_cast<float>(periods);
  return std::abs(wrap_difference(static_cast<float>(node.angle_q6) - expected)) <= kMaxAngleError;
}

bool HeadAngleFilter::near_zero() const {
  return std::abs(wrap_difference(angle_q6_)) <= kTrackZeroZone;
}

namespace {

constexpr float kHalfRevolution = kFullRevolutionQ6 / 2.0F;
// Start flags come at 351 to 359 degrees; 5 degrees past zero the flag is lost.
constexpr float kLost = 5 * 64.0F;

}  // namespace

bool ScanSplitter::advance(bool start_flag, const HeadAngleFilter& track) {
  travelled_q6_ += track.last_move_q6();
  const float angle_q6 = track.angle_q6();
  const bool half_done = travelled_q6_ >= kHalfRevolution;
  before_zero_ = before_zero_ || (half_done && angle_q6 > kHalfRevolution);
  if (start_flag && !track.near_zero()) ++false_starts_;

  const bool marked = start_flag && track.near_zero();
  const bool flag_lost = before_zero_ && angle_q6 >= kLost && angle_q6 < kHalfRevolution;
  if (!half_done || (!marked && !flag_lost)) return false;
  travelled_q6_ = 0;
  before_zero_ = false;
  return true;
}

void ScanSplitter::forget() {
  travelled_q6_ = kFullRevolution;
  before_zero_ = false;
}

namespace {

constexpr int kDegreeQ6 = 64;
constexpr int kNodesOnTrack = 4;
constexpr int kNodesAlone = 10;
constexpr int kMaxNodes = 40;  // a slow head's advance exceeds the corrections' jitter

// Consecutive nodes of real A1s differ by -7 to +10 degrees.
constexpr int kChainMinStep = -10 * kDegreeQ6;
constexpr int kChainMaxStep = 14 * kDegreeQ6;
// Repeated bytes (a wall at one distance, read three bytes off) do not rotate.
constexpr int kMinAdvancePerNode = kDegreeQ6 / 16;
constexpr int kChainZeroZone = 30 * kDegreeQ6;

bool flag_is_plausible(const StandardNode& node) {
  return !node.start_flag || std::abs(angle_step_q6(0, node.angle_q6)) <= kChainZeroZone;
}

}  // namespace

ChainMatch match_node_chain(std::span<const std::uint8_t> bytes, const HeadAngleFilter* track,
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
    alone = alone && flag_is_plausible(*node);
    on_track = on_track && track->is_consistent(*node, periods + count);
    const bool rotates = advance_q6 >= count * kMinAdvancePerNode;
    if (on_track && rotates && count + 1 >= kNodesOnTrack) return {Verdict::kYes, true};
    if (alone && rotates && count + 1 >= kNodesAlone) return {Verdict::kYes, false};
    if (count + 1 >= kMaxNodes) break;
    previous_q6 = node->angle_q6;
    bytes = bytes.subspan(kNodeSize);
  }
  return {};
}

}  // namespace cornerd::rplidar
