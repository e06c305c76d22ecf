// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/capsule_cadence.hpp"

#include <cmath>
#include <cstdlib>

#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {
namespace {

constexpr float kDegree = 64;
// A capsule at 11 turns a second: 8.1 ms of express, 12.2 ms of ultra. Before the speed is known,
// more is taken for a hole.
constexpr float kFirstLimitExpress = 33 * kDegree;
constexpr float kFirstLimitUltra = 50 * kDegree;

constexpr float kMinRatio = 0.6F;
constexpr float kMaxRatio = 1.5F;
constexpr float kSpeedGain = 0.25F;

// A hole whose angle is a whole number of capsules, and safely less than a turn, tells that number.
constexpr float kWholeTolerance = 0.35F;
constexpr int kMaxHoleQ6 = kFullRevolutionQ6 / 2;

// So many alike in a row are a new speed, not holes; fewer where there was none before, as with an
// early head, whose express capsules take 16 ms.
constexpr int kNewSpeed = 4;
constexpr int kFirstSpeed = 2;

}  // namespace

void CapsuleCadence::reset(WireFormat format) {
  expected_q6_ = 0;
  first_limit_q6_ = format == WireFormat::kExpress ? kFirstLimitExpress : kFirstLimitUltra;
  rejections_ = 0;
}

CapsuleCadence::Result CapsuleCadence::judge(int diff_q6, int damaged_between) {
  const auto diff = static_cast<float>(diff_q6);
  const bool known = expected_q6_ > 0;
  const bool fits = known ? diff >= kMinRatio * expected_q6_ && diff <= kMaxRatio * expected_q6_
                          : diff_q6 > 0 && diff <= first_limit_q6_;
  if (fits && damaged_between == 0) {
    adopt(diff_q6);
    return {Judgement::kNeighbours, 0};
  }

  const bool like_the_last = std::abs(diff_q6 - rejected_q6_) * 5 <= rejected_q6_;
  rejections_ = damaged_between == 0 && diff_q6 > 0 && like_the_last ? rejections_ + 1 : 1;
  rejected_q6_ = diff_q6;
  if (rejections_ >= (known ? kNewSpeed : kFirstSpeed)) {
    expected_q6_ = diff;
    rejections_ = 0;
    return {Judgement::kNeighbours, 0};
  }

  if (!known) return {};
  if (diff_q6 > kMaxHoleQ6) return {Judgement::kUnknown, 1};
  const float periods = diff / expected_q6_;
  const float whole = std::round(periods);
  if (whole < 1 || std::abs(periods - whole) > kWholeTolerance) {
    return {Judgement::kUnknown, 1};
  }
  return {Judgement::kHole, static_cast<int>(whole) - 1};
}

void CapsuleCadence::adopt(int diff_q6) {
  const auto diff = static_cast<float>(diff_q6);
  expected_q6_ = expected_q6_ > 0 ? expected_q6_ + (diff - expected_q6_) * kSpeedGain : diff;
  rejections_ = 0;
}

}  // namespace cornerd::rplidar
