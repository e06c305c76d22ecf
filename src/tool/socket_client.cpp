// SPDX-License-Identifier: MIT
#include "tool/socket_client.hpp"

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
}

bool SocketClient::connect(const std::filesystem::path& socket) {
  close();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& path = socket.native();
  if (path.size() >= sizeof address.sun_path) {
    problem_ = path + ": too long for a socket's path";
    return false;
  }
  path.copy(address.sun_path, path.size());

  fd_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const auto* const any = reinterpret_cast<const sockaddr*>(&address);
  if (fd_ < 0 || ::connect(fd_, any, sizeof address) != 0) {
    problem_ = path + ": " + std::strerror(errno);
    close();
    return false;
  }
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

std::string_view SocketClient::receive() {
  buffer_.erase(0, handed_out_);
  handed_out_ = 0;
  for (;;) {
    char chunk[64 * 1024];
    const ssize_t got = ::recv(fd_, chunk, sizeof chunk, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return {};
    const std::size_t searched = buffer_.size();
    buffer_.append(chunk, static_cast<std::size_t>(got));
    const std::size_t last_newline = buffer_.rfind('\n');
    if (last_newline != std::string::npos && last_newline >= searched) {
      handed_out_ = last_newline + 1;
      return std::string_view(buffer_).substr(0, handed_out_);
    }
  }
}

}  // namespace cornerd::tool
