// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stop_token>

#include "drivers/driver_clock.hpp"

namespace cornerd::replay {

/// A clock that advances only on waits, so that hours take seconds. For one thread.
class VirtualClock : public drivers::Clock {
 public:
  core::TimeNs monotonic_ns() override { return now_ns_; }
  core::TimeNs unix_offset_ns() override { return 0; }
  void wait(std::chrono::milliseconds duration, const std::stop_token& /*stop*/) override {
    advance_to(now_ns_ + std::chrono::nanoseconds(duration).count());
  }

  /// No effect if that is in the past.
  void advance_to(core::TimeNs t_ns) {
    if (t_ns <= now_ns_) return;
    now_ns_ = t_ns;
    if (on_advance_) on_advance_(now_ns_);
  }
  /// Called with each new time.
  void set_on_advance(std::function<void(core::TimeNs)> call) { on_advance_ = std::move(call); }

 private:
  core::TimeNs now_ns_ = 0;
  std::function<void(core::TimeNs)> on_advance_;
};

}  // namespace cornerd::replay
