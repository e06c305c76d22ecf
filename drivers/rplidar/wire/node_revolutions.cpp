// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/node_revolutions.hpp"

namespace cornerd::rplidar {
namespace {

constexpr float kHalfRevolution = kFullRevolutionQ6 / 2.0F;
// The flag comes with an angle of 351 to 359 degrees: 5 past zero it is not late but lost.
constexpr float kLost = 5 * 64.0F;

}  // namespace

bool NodeRevolutions::advance(bool start_flag, const NodeTrack& track) {
  travelled_q6_ += track.last_move_q6();
  const float angle_q6 = track.angle_q6();
  const bool half_done = travelled_q6_ >= kHalfRevolution;
  before_zero_ = before_zero_ || (half_done && angle_q6 > kHalfRevolution);
  if (start_flag && !track.near_zero()) ++false_marks_;

  const bool marked = start_flag && track.near_zero();
  const bool mark_lost = before_zero_ && angle_q6 >= kLost && angle_q6 < kHalfRevolution;
  if (!half_done || (!marked && !mark_lost)) return false;
  travelled_q6_ = 0;
  before_zero_ = false;
  return true;
}

void NodeRevolutions::forget() {
  travelled_q6_ = kFullRevolution;
  before_zero_ = false;
}

}  // namespace cornerd::rplidar
