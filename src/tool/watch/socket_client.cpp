// SPDX-License-Identifier: MIT
#include "tool/watch/socket_client.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace cornerd::tool {

SocketClient::~SocketClient() { close(); }

void SocketClient::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
  buffer_.clear();
  handed_out_ = 0;
  lines_end_ = 0;
}

bool SocketClient::fail(const std::string& path, int error_number) {
  error_number_ = error_number;
  problem_ = path + ": " + std::strerror(error_number);
  close();
  return false;
}

bool SocketClient::connect(const std::filesystem::path& socket, bool blocking) {
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

bool SocketClient::send(std::string_view line) {
  while (!line.empty()) {
    const ssize_t sent = ::send(fd_, line.data(), line.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return false;
    line.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool SocketClient::fetch(int flags) {
  buffer_.erase(0, handed_out_);
  handed_out_ = 0;
  lines_end_ = 0;
  char chunk[64 * 1024];
  ssize_t got = 0;
  do {
    got = ::recv(fd_, chunk, sizeof chunk, flags);
  } while (got < 0 && errno == EINTR);
  if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return true;
  if (got <= 0) return false;
  const std::string_view added(chunk, static_cast<std::size_t>(got));
  // Only what is new is searched: a MAP of megabytes comes in thousands of pieces.
  const std::size_t last_newline = added.rfind('\n');
  if (last_newline != std::string_view::npos) lines_end_ = buffer_.size() + last_newline + 1;
  buffer_ += added;
  return true;
}

std::string_view SocketClient::whole_lines() {
  handed_out_ = lines_end_;
  return std::string_view(buffer_).substr(0, lines_end_);
}

std::string_view SocketClient::receive() {
  while (fetch(0)) {
    if (const std::string_view lines = whole_lines(); !lines.empty()) return lines;
  }
  return {};
}

std::optional<std::string_view> SocketClient::take() {
  if (!fetch(MSG_DONTWAIT)) return std::nullopt;
  return whole_lines();
}

}  // namespace cornerd::tool
