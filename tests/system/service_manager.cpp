// SPDX-License-Identifier: MIT
#include "service_manager.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>

namespace cornerd::system_test {

ServiceManager::ServiceManager(const std::filesystem::path& socket)
    : fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, socket.c_str(), sizeof(address.sun_path) - 1);
  EXPECT_EQ(::bind(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
}

bool ServiceManager::hears(const std::string& word) const {
  while (true) {
    pollfd readable{fd_.get(), POLLIN, 0};
    if (::poll(&readable, 1, 60'000) <= 0) return false;
    char text[512];
    const ssize_t count = ::recv(fd_.get(), text, sizeof(text), 0);
    if (count > 0 && std::string(text, static_cast<std::size_t>(count)) == word) return true;
  }
}

void ServiceManager::forget() const {
  char text[512];
  while (::recv(fd_.get(), text, sizeof(text), MSG_DONTWAIT) >= 0) {
  }
}

}  // namespace cornerd::system_test
