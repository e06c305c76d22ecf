// SPDX-License-Identifier: MIT
#include "daemon/log.hpp"

#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>
#include <utility>

#include "daemon/log_sink.hpp"

namespace cornerd::daemon {

void set_up_log() {
  auto log = std::make_shared<spdlog::logger>("cornerd", std::make_shared<LogSink>());
  // sd-daemon(3): the service manager sets it where standard error is the journal.
  const bool is_journal = std::getenv("JOURNAL_STREAM") != nullptr;
  log->set_pattern(is_journal ? "%l: %v" : "%H:%M:%S.%e %^%l%$: %v");
  spdlog::set_default_logger(std::move(log));
}

void log(LogLevel level, std::string_view line) {
  switch (level) {
    case LogLevel::kDebug:
      return spdlog::debug(line);
    case LogLevel::kInfo:
      return spdlog::info(line);
    case LogLevel::kWarning:
      return spdlog::warn(line);
    case LogLevel::kError:
      return spdlog::error(line);
  }
}

}  // namespace cornerd::daemon
