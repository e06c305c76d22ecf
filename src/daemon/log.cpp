// SPDX-License-Identifier: MIT
#include "daemon/log.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spdlog/details/os.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "daemon/log_sink.hpp"

namespace cornerd::daemon {
namespace {

/// Reopens a pipe or terminal on standard error, because O_NONBLOCK on the original would affect a
/// shell that shares it. Files and sockets cannot be reopened usefully: standard error itself.
std::FILE* open_without_waiting() {
  struct stat found {};
  if (::fstat(STDERR_FILENO, &found) != 0) return stderr;
  if (!S_ISFIFO(found.st_mode) && !S_ISCHR(found.st_mode)) return stderr;
  const int fd = ::open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (fd < 0) return stderr;
  std::FILE* stream = ::fdopen(fd, "w");
  if (stream == nullptr) ::close(fd);
  return stream == nullptr ? stderr : stream;
}

}  // namespace

void set_up_log() {
  auto log = std::make_shared<spdlog::logger>("cornerd", std::make_shared<LogSink>());
  // systemd.exec(5): set if standard error is connected to the journal.
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

LogSink::LogSink() : LogSink(open_without_waiting()) {}

LogSink::LogSink(std::FILE* stream)
    : ansicolor_sink(stream, spdlog::color_mode::automatic), stream_(stream) {}

void LogSink::log(const spdlog::details::log_msg& message) {
  if (lost_ > 0) {
    const std::string text =
        std::to_string(lost_) + " log messages were dropped: the reader is slow";
    if (!write({message.logger_name, spdlog::level::warn, text})) {
      ++lost_;
      return;
    }
    lost_ = 0;
  }
  if (!write(message)) ++lost_;
}

bool LogSink::write(const spdlog::details::log_msg& message) {
  if (!has_room()) return false;
  ansicolor_sink::log(message);
  const bool is_written = std::ferror(stream_) == 0;
  std::clearerr(stream_);
  return is_written;
}

/// Room for one line: poll(2) reports POLLOUT for a free page of a pipe, half a socket buffer.
bool LogSink::has_room() const {
  pollfd waiting{.fd = ::fileno(stream_), .events = POLLOUT, .revents = 0};
  return ::poll(&waiting, 1, 0) > 0 && (waiting.revents & POLLOUT) != 0;
}

}  // namespace cornerd::daemon
