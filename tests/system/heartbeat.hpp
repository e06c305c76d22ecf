// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <stop_token>
#include <thread>

namespace cornerd::system_test {

/// Detects that this process got no processor. Then the emulated lidar's bytes arrive in a burst,
/// and a reader that did not run may lose some.
class Heartbeat {
  using Clock = std::chrono::steady_clock;

 public:
  /// After the next beat: this thread may have resumed first.
  bool stood_still_lately() const {
    beats_.wait(beats_);
    return Clock::now().time_since_epoch().count() < excused_until_.load();
  }

 private:
  void beat(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto due = Clock::now() + std::chrono::milliseconds(10);
      std::this_thread::sleep_until(due);
      if (Clock::now() - due >= std::chrono::milliseconds(150)) {
        excused_until_ = (Clock::now() + std::chrono::seconds(3)).time_since_epoch().count();
      }
      ++beats_;
      beats_.notify_all();
    }
  }

  std::atomic<Clock::rep> excused_until_{0};
  std::atomic<int> beats_{0};
  std::jthread thread_{[this](const std::stop_token& stop) { beat(stop); }};
};

}  // namespace cornerd::system_test
