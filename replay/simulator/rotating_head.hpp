// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "core/types.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::replay {

/// Angle of the rotating head at each sample. Not reduced: revolution n is 360 n to 360 (n + 1)
/// deg.
class RotatingHead {
 public:
  struct Position {
    core::TimeNs t_ns = 0;
    double angle_deg = 0;
  };

  /// `jitter`: relative standard deviation of the rate from revolution to revolution.
  RotatingHead(double rate_hz, double jitter, core::TimeNs period_ns, std::uint64_t seed)
      : random_(seed), mean_rate_hz_(rate_hz), jitter_(jitter), period_ns_(period_ns) {
    draw_rate();
  }

  void start(core::TimeNs t_ns, double angle_deg) { now_ = {t_ns, angle_deg}; }

  /// Continues at `t_ns` (or now, if that is past) with another sample period.
  void resume(core::TimeNs t_ns, core::TimeNs period_ns) {
    if (t_ns > now_.t_ns) {
      now_.angle_deg += 360 * rate_hz_ * core::to_seconds(t_ns - now_.t_ns);
      now_.t_ns = t_ns;
    }
    period_ns_ = period_ns;
  }

  /// Of the next sample.
  const Position& position() const { return now_; }

  Position next() {
    const Position position = now_;
    const double scan = std::floor(now_.angle_deg / 360);
    now_.t_ns += period_ns_;
    now_.angle_deg += step_deg();
    if (std::floor(now_.angle_deg / 360) > scan) draw_rate();
    return position;
  }

  /// Degrees between samples.
  double step_deg() const { return 360 * rate_hz_ * core::to_seconds(period_ns_); }
  core::TimeNs period_ns() const { return period_ns_; }

 private:
  void draw_rate() {
    // Bounded, as a real motor's rate is.
    const double deviation = std::fmin(3, std::fmax(-3, random_.normal()));
    rate_hz_ = mean_rate_hz_ * (1 + jitter_ * deviation);
  }

  Random random_;
  double mean_rate_hz_;
  double jitter_;
  core::TimeNs period_ns_;
  double rate_hz_ = 0;
  Position now_;
};

}  // namespace cornerd::replay
