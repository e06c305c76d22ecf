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

/// Standard error, or a second way to what it leads to: whether a write waits is the way's own, and
/// the first one may be shared with a shell. Of a file both ways would write over each other; a
/// socket has no second one.
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
  // sd-daemon(3): the service manager sets it where standard error is the journal.
  const bool is_journal = std::getenv("JOURNAL_STREAM") != nullptr;
  log->set_pattern(is_journal ? "%l: %v" : "%H:%M:%S.%e %^%l%$: %v");
  spdlog::set_default_logger(std::move(log));
}

LogSink::LogSink() : LogSink(open_without_waiting()) {}

LogSink::LogSink(std::FILE* stream)
    : ansicolor_sink(stream, spdlog::color_mode::automatic), stream_(stream) {}

void LogSink::log(const spdlog::details::log_msg& message) {
  if (lost_ > 0) {
    const std::string text = std::to_string(lost_) + " messages found no room in this log";
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

/// For a line: a pipe says so of a page, a socket of half of its buffer.
bool LogSink::has_room() const {
  pollfd waiting{.fd = ::fileno(stream_), .events = POLLOUT, .revents = 0};
  return ::poll(&waiting, 1, 0) > 0 && (waiting.revents & POLLOUT) != 0;
}

}  // namespace cornerd::daemon
