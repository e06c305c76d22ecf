// SPDX-License-Identifier: MIT
#include "daemon/log_sink.hpp"

#include <gtest/gtest.h>
#include <spdlog/logger.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {
namespace {

/// Makes standard error a socket, like a service's, during its lifetime.
class LogSinkTest : public ::testing::Test {
 protected:
  LogSinkTest() : before_(::dup(STDERR_FILENO)) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    journal_ = FileDescriptor(ends[0]);
    ::dup2(ends[1], STDERR_FILENO);
    ::close(ends[1]);
  }
  ~LogSinkTest() override { ::dup2(before_.get(), STDERR_FILENO); }

  std::string drain() {
    std::string all;
    std::array<char, 4096> block{};
    ssize_t size = 0;
    while ((size = ::recv(journal_.get(), block.data(), block.size(), MSG_DONTWAIT)) > 0) {
      all.append(block.data(), static_cast<std::size_t>(size));
    }
    return all;
  }

  FileDescriptor before_;
  FileDescriptor journal_;
};

TEST_F(LogSinkTest, StalledReader_LinesDroppedAndCounted) {
  constexpr int kMessages = 10'000;
  spdlog::logger log("test", std::make_shared<LogSink>());
  log.set_pattern("%v");
  for (int i = 0; i < kMessages; ++i) log.info("{:100}", i);
  const std::string found = drain();
  const auto lines = std::count(found.begin(), found.end(), '\n');
  EXPECT_LT(lines, kMessages);
  log.info("again");
  EXPECT_EQ(drain(), std::to_string(kMessages - lines) +
                         " log messages were dropped: the reader is slow\nagain\n");
}

}  // namespace
}  // namespace cornerd::daemon
