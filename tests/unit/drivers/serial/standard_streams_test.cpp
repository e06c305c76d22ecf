// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include "drivers/serial/file_descriptor.hpp"

namespace cornerd::drivers {
namespace {

/// The descriptor number that a child gets from open() after closing some.
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

TEST(StandardStreams, ClosedStreams_AreOccupied) {
  const int expected = first_free_number({});
  ASSERT_GT(expected, 2);
  EXPECT_EQ(first_free_number({0, 1, 2}), expected);
  EXPECT_EQ(first_free_number({2}), expected);
  EXPECT_EQ(first_free_number({0}), expected);
}

TEST(StandardStreams, WriteToClosedOutput_FailsStill) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(STDOUT_FILENO);
    occupy_standard_streams();
    ::_exit(::write(STDOUT_FILENO, "x", 1) < 0 ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace cornerd::drivers
