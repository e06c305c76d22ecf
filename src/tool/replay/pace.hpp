// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/types.hpp"

namespace cornerd::tool {

/// "max": nullopt; else how many times real time, above 0. Throws UsageError.
std::optional<double> parse_speed(const std::string& text);

/// Holds recorded data back until its time has come.
class Pace {
 public:
  explicit Pace(double speed) : speed_(speed) {}

  /// Sleeps until as much time has passed since the first call, divided by the speed, as lies
  /// between the data of the two calls.
  void wait_until(core::TimeNs data_ns);

 private:
  using Clock = std::chrono::steady_clock;

  double speed_;
  std::optional<core::TimeNs> first_data_ns_;
  Clock::time_point began_;
};

}  // namespace cornerd::tool
