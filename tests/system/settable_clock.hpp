// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "clock_offset.hpp"

namespace cornerd::system_test {

/// Sets the time of day of a process that is started with environment(). The machine's clock and
/// monotonic clocks are unchanged.
class SettableClock {
 public:
  /// Creates `file`. Throws std::system_error.
  explicit SettableClock(const std::filesystem::path& file);
  ~SettableClock();
  SettableClock(const SettableClock&) = delete;
  SettableClock& operator=(const SettableClock&) = delete;

  std::map<std::string, std::string> environment() const;
  void step_s(double by_s);
  /// Offset from the machine's clock.
  double offset_s() const;
  /// UNIX time of this clock.
  double now_s() const;

 private:
  std::filesystem::path file_;
  ClockOffset* offset_ns_;
};

}  // namespace cornerd::system_test
