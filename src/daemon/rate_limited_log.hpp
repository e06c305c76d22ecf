// SPDX-License-Identifier: MIT
#pragma once

#include <spdlog/common.h>

#include <cstdint>
#include <optional>
#include <string>

namespace cornerd::daemon {

/// In the log, something that may happen ten times a second for a year: the first is a line, of
/// those that follow within ten seconds one line has the number and the last.
class RateLimitedLog {
 public:
  /// `what`: a literal, before the colon.
  RateLimitedLog(spdlog::level::level_enum level, const char* what) : level_(level), what_(what) {}

  /// `now_ns`: monotonic, as below.
  void add(const std::string& text, std::int64_t now_ns);
  /// Says what was held back, once its time has come. To be called now and then.
  void flush(std::int64_t now_ns);

 private:
  spdlog::level::level_enum level_;
  const char* what_;
  std::optional<std::int64_t> logged_ns_;
  std::uint64_t suppressed_ = 0;
  std::string last_;
};

}  // namespace cornerd::daemon
