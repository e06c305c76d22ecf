// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/log.hpp"

namespace cornerd::daemon {

/// Logs an event at most once per 10 s. Further events are summarized: their number and the last.
class RateLimitedLog {
 public:
  /// `what`: a string literal, the prefix of each line.
  RateLimitedLog(LogLevel level, const char* what) : level_(level), what_(what) {}

  /// `now_ns`: monotonic.
  void add(const std::string& text, std::int64_t now_ns);
  /// Logs the summary if 10 s have passed. Call it periodically.
  void flush(std::int64_t now_ns);

 private:
  LogLevel level_;
  const char* what_;
  std::optional<std::int64_t> logged_ns_;
  std::uint64_t suppressed_ = 0;
  std::string last_;
};

}  // namespace cornerd::daemon
