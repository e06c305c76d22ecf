// SPDX-License-Identifier: MIT
#pragma once

#include "drivers/rplidar/decoder.hpp"

namespace cornerd::rplidar {

/// By how much the start angle of successive capsules grows, and so whether one is missing between
/// two: the packets bear no number. A motor does not change its speed much within 20 ms.
class CapsuleCadence {
 public:
  enum class Judgement { kNeighbours, kHole, kUnknown };

  struct Result {
    Judgement judgement = Judgement::kUnknown;
    int missing = 0;  ///< capsules in a kHole; at least so many where it is kUnknown
  };

  /// Forgets the speed: another stream begins.
  void reset(WireFormat format);

  /// Judges the angle between two capsules that came one after the other, `damaged_between` that
  /// were recognised as damaged apart.
  Result judge(int diff_q6, int damaged_between);

 private:
  void adopt(int diff_q6);

  float expected_q6_ = 0;  ///< 0: not known yet
  float first_limit_q6_ = 0;
  int rejected_q6_ = 0;
  int rejections_ = 0;
};

}  // namespace cornerd::rplidar
