// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/log.hpp"

namespace cornerd::daemon {

/// In the log, something that may happen ten times a second for a year: the first is a line, of
/// those that follow within ten seconds one line has the number and the last.
class RepeatedLog {
 public:
  /// `what`: a literal, before the colon.
  RepeatedLog(LogLevel level, const char* what) : level_(level), what_(what) {}

  /// `now_ns`: monotonic, as below.
  void say(const std::string& text, std::int64_t now_ns);
  /// Says what was held back, once its time has come. To be called now and then.
  void tick(std::int64_t now_ns);

 private:
  LogLevel level_;
  const char* what_;
  std::optional<std::int64_t> said_ns_;
  std::uint64_t held_back_ = 0;
  std::string last_;
};

}  // namespace cornerd::daemon
