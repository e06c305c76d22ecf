// SPDX-License-Identifier: MIT
#pragma once

#include <spdlog/details/console_globals.h>
#include <spdlog/sinks/ansicolor_sink.h>

#include <cstdint>
#include <cstdio>

namespace cornerd::daemon {

/// Standard error without blocking. Lines that find no room are dropped; the next line that is
/// written reports their number. For one thread.
class LogSink final : public spdlog::sinks::ansicolor_sink<spdlog::details::console_nullmutex> {
 public:
  LogSink();

  void log(const spdlog::details::log_msg& message) override;

 private:
  explicit LogSink(std::FILE* stream);
  bool has_room() const;
  bool write(const spdlog::details::log_msg& message);

  std::FILE* stream_;
  std::uint64_t lost_ = 0;
};

}  // namespace cornerd::daemon
