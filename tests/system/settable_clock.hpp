// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "clock_offset.hpp"

namespace cornerd::system_test {

/// The time of day of a process that is started with environment(): somebody sets it, and the
/// machine's stays as it is. Monotonic clocks go on.
class SettableClock {
 public:
  /// `file`: is made. Throws std::system_error.
  explicit SettableClock(const std::filesystem::path& file);
  ~SettableClock();
  SettableClock(const SettableClock&) = delete;
  SettableClock& operator=(const SettableClock&) = delete;

  std::map<std::string, std::string> environment() const;
  void step_s(double by_s);
  /// How far it is ahead of the machine's.
  double offset_s() const;
  /// UNIX time by it.
  double now_s() const;

 private:
  std::filesystem::path file_;
  ClockOffset* offset_ns_;
};

}  // namespace cornerd::system_test
