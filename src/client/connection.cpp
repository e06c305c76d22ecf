// SPDX-License-Identifier: MIT
#include "client/connection.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace cornerd::client {

namespace {

/// Fits a SCAN of 1,000 samples.
constexpr std::size_t kFirstBufferBytes = 64 * 1024;

}  // namespace

Connection::~Connection() { close(); }

void Connection::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
  begin_ = searched_ = end_ = 0;
}

bool Connection::fail(const std::string& path, int error_number) {
  error_number_ = error_number;
  problem_ = path + ": " + std::strerror(error_number);
  close();
  return false;
}

bool Connection::connect(const std::filesystem::path& socket, bool blocking) {
  close();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& path = socket.native();
  if (path.size() >= sizeof address.sun_path) return fail(path, ENAMETOOLONG);
  path.copy(address.sun_path, path.size());

  fd_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | (blocking ? 0 : SOCK_NONBLOCK), 0);
  const auto* const any = reinterpret_cast<const sockaddr*>(&address);
  if (fd_ < 0 || ::connect(fd_, any, sizeof address) != 0) return fail(path, errno);
  return true;
}

bool Connection::send(std::string_view line) {
  while (!line.empty()) {
    const ssize_t sent = ::send(fd_, line.data(), line.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return false;
    line.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool Connection::next_line(std::string_view& line) {
  const char* const base = buffer_.data();
  // Only what is new is searched: a MAP of megabytes comes in thousands of pieces.
  const char* const newline = std::find(base + searched_, base + end_, '\n');
  const auto at = static_cast<std::size_t>(newline - base);
  searched_ = at;
  if (at == end_) return false;
  line = {base + begin_, at - begin_};
  begin_ = searched_ = at + 1;
  return true;
}

void Connection::make_room() {
  if (begin_ == end_) begin_ = searched_ = end_ = 0;
  if (end_ < buffer_.size()) return;
  if (begin_ > 0) {
    std::copy(buffer_.data() + begin_, buffer_.data() + end_, buffer_.data());
    searched_ -= begin_;
    end_ -= begin_;
    begin_ = 0;
  } else {
    buffer_.resize(std::max(kFirstBufferBytes, 2 * buffer_.size()));
  }
}

Received Connection::take(std::string_view& line) {
  if (fd_ < 0) return Received::kEnd;
  while (!next_line(line)) {
    make_room();
    const ssize_t got = ::recv(fd_, buffer_.data() + end_, buffer_.size() - end_, MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return Received::kNothing;
    if (got <= 0) return Received::kEnd;
    end_ += static_cast<std::size_t>(got);
  }
  return Received::kLine;
}

Received Connection::receive(std::string_view& line, std::chrono::milliseconds timeout) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point until = Clock::now() + timeout;
  for (;;) {
    const Received received = take(line);
    if (received != Received::kNothing) return received;
    int wait_ms = -1;
    if (timeout.count() >= 0) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
      if (left.count() <= 0) return Received::kNothing;
      wait_ms = static_cast<int>(left.count());
    }
    pollfd entry{.fd = fd_, .events = POLLIN, .revents = 0};
    if (::poll(&entry, 1, wait_ms) < 0 && errno != EINTR) return Received::kEnd;
  }
}

}  // namespace cornerd::client
