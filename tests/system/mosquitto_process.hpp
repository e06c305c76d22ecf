// SPDX-License-Identifier: MIT
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "daemon_process.hpp"

namespace cornerd::system_test {

/// A socket on loopback; port 0: any free one.
class LoopbackSocket {
 public:
  explicit LoopbackSocket(std::uint16_t port)
      : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int reuse = 1;
    ::setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~LoopbackSocket() { ::close(fd_); }
  LoopbackSocket(const LoopbackSocket&) = delete;
  LoopbackSocket& operator=(const LoopbackSocket&) = delete;

  int fd() const { return fd_; }
  std::uint16_t port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }

 private:
  int fd_;
};

inline std::uint16_t free_port() { return LoopbackSocket(0).port(); }

/// Accepts and says nothing, as a broker that hangs.
class SilentListener {
 public:
  explicit SilentListener(std::uint16_t port) : socket_(port) { ::listen(socket_.fd(), 4); }
  bool has_client() const {
    pollfd ready{.fd = socket_.fd(), .events = POLLIN, .revents = 0};
    return ::poll(&ready, 1, 0) == 1;
  }

 private:
  LoopbackSocket socket_;
};

/// Debian's broker, on loopback, without a password and without a memory.
class MosquittoProcess {
 public:
  /// `more`: further lines of its config.
  MosquittoProcess(const std::filesystem::path& name, std::uint16_t port,
                   const std::string& more = {})
      : process_({"-c", config(name, port, more)}, name.string() + ".log", {}, {},
                 "/usr/sbin/mosquitto") {}

 private:
  static std::string config(const std::filesystem::path& name, std::uint16_t port,
                            const std::string& more) {
    const std::string file = name.string() + ".conf";
    std::ofstream(file) << "listener " << port << " 127.0.0.1\nallow_anonymous true\n"
                        << "persistence false\nuser root\n"
                        << more;
    return file;
  }

  DaemonProcess process_;
};

}  // namespace cornerd::system_test
