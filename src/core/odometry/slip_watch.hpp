// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::core {

/// Tells a wheel that slips now and then from wheels and a gyro of which one lies: an encoder that
/// stands still, a gyro whose axis points down.
class SlipWatch {
 public:
  /// A step in which wheels or gyro say that the robot turns; or neither does, and nothing tells.
  void add(bool turns, bool slips, double dt_s) {
    const double memory_s = turns ? kTurning_s : kStraight_s;
    const double slipping = turns && slips ? 1 : 0;
    share_ += std::min(kMostOfAStep, dt_s / memory_s) * (slipping - share_);
  }

  /// A step in which there is but one of them.
  void add_single(double dt_s) { share_ -= std::min(1.0, dt_s / kTurning_s) * share_; }

  /// Which of them is wrong nobody can tell: as if it had been so for long.
  void contradict() { share_ = 1; }

  /// True where they have said different things for most of the last third of a second of turning.
  bool is_contradiction() const { return share_ > 0.5; }

 private:
  static constexpr double kTurning_s = 0.4;
  /// Driving straight on, a gyro that is upside down is as good as any.
  static constexpr double kStraight_s = 10;
  /// Readings that come seldom tell little of what was between them.
  static constexpr double kMostOfAStep = 0.12;

  double share_ = 0;  ///< of the turning that slipped, lately
};

}  // namespace cornerd::core
