// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/node_track.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::rplidar {
namespace {

constexpr float kTrackDegree = 64;
constexpr float kTurn = kFullRevolutionQ6;

// 508 us a sample: 1 degree at 5.5 turns a second; 0.18 at 1, 3.7 at 20.
constexpr float kUsualStep = 1.2F * kTrackDegree;
constexpr float kTrackMaxStep = 4 * kTrackDegree;

// Gains of a critically damped filter over about 8 nodes.
constexpr float kAngleGain = 1.0F / 8;
constexpr float kStepGain = 1.0F / 128;

// The core's angle correction spans 9.2 degrees between a near return and none; the smoothed angle
// may stand at either end.
constexpr float kTolerance = 13 * kTrackDegree;
// Real start flags arrive at 351 to 359 degrees.
constexpr float kTrackZeroZone = 30 * kTrackDegree;

float wrap_difference(float difference) {
  return difference - kTurn * std::round(difference / kTurn);
}
float wrap_angle(float angle) {
  const float wrapped = angle - kTurn * std::floor(angle / kTurn);
  return wrapped < kTurn ? wrapped : 0;
}

}  // namespace

void NodeTrack::begin(const StandardNode& node) {
  angle_q6_ = node.angle_q6;
  if (step_q6_ <= 0) step_q6_ = kUsualStep;  // else the head still turns as it did
  last_move_q6_ = 0;
}

void NodeTrack::advance(const StandardNode& node, int periods) {
  const float expected_move = step_q6_ * static_cast<float>(periods);
  const float residual =
      wrap_difference(static_cast<float>(node.angle_q6) - (angle_q6_ + expected_move));
  last_move_q6_ = expected_move + residual * kAngleGain;
  angle_q6_ = wrap_angle(angle_q6_ + last_move_q6_);
  step_q6_ = std::clamp(step_q6_ + residual * kStepGain, 0.01F * kTrackDegree, kTrackMaxStep);
}

bool NodeTrack::explains(const StandardNode& node, int periods) const {
  const float expected = angle_q6_ + step_q6_ * static_cast<float>(periods);
  return std::abs(wrap_difference(static_cast<float>(node.angle_q6) - expected)) <= kTolerance;
}

bool NodeTrack::near_zero() const { return std::abs(wrap_difference(angle_q6_)) <= kTrackZeroZone; }

}  // namespace cornerd::rplidar
