// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::drivers {

/// Where a clockwise angle passes zero. A flag of the device may be lost with its packet; the angle
/// may jitter about zero, so half a revolution must lie between two marks.
class RevolutionMark {
 public:
  static constexpr float kRevolution_deg = 360;

  /// The next sample is after a gap that is less than a revolution.
  void after_gap() { has_gap_ = true; }

  /// `angle_deg`: in [0, 360). True for the first sample of a revolution.
  bool passes(float angle_deg) {
    float step_deg = angle_deg - last_deg_;
    if (!has_gap_ && step_deg > kRevolution_deg / 2) step_deg -= kRevolution_deg;  // jitters back
    const bool wraps = step_deg < (has_gap_ ? 0 : -kRevolution_deg / 2);
    last_deg_ = angle_deg;
    has_gap_ = false;
    if (!has_last_) {
      has_last_ = true;
      return false;
    }
    swept_deg_ += wraps ? step_deg + kRevolution_deg : step_deg;
    if (!wraps || swept_deg_ < kRevolution_deg / 2) return false;
    swept_deg_ = 0;
    return true;
  }

 private:
  bool has_last_ = false;
  bool has_gap_ = false;
  float last_deg_ = 0;
  float swept_deg_ = kRevolution_deg;  ///< since the last mark
};

}  // namespace cornerd::drivers
