// SPDX-License-Identifier: MIT
#include "drivers/serial/standard_streams.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

namespace cornerd::drivers {
namespace {

/// The first number that a child gets for what it opens, with those closed before.
int first_free_number(const std::vector<int>& closed) {
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int fd : closed) ::close(fd);
    occupy_standard_streams();
    ::_exit(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StandardStreams, ThoseThatAreClosed_AreOccupied) {
  const int usual = first_free_number({});
  ASSERT_GT(usual, 2);
  EXPECT_EQ(first_free_number({0, 1, 2}), usual);
  EXPECT_EQ(first_free_number({2}), usual);
  EXPECT_EQ(first_free_number({0}), usual);
}

}  // namespace
}  // namespace cornerd::drivers
