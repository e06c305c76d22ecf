// SPDX-License-Identifier: MIT
#include "client/subscription.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "line_server.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::client {
namespace {

TEST(Subscription, DaemonStartsExitsAndReturns_EachIsTold) {
  const test::TemporaryFolder folder;
  Subscription daemon(folder / "s", watch_request("POSE,SCAN"));
  std::string_view line;
  EXPECT_EQ(daemon.wait(line), Event::kLost);
  EXPECT_NE(daemon.problem().find("No such file"), std::string::npos) << daemon.problem();
  EXPECT_EQ(daemon.wait(line, std::chrono::milliseconds(1)), Event::kTimeout);
  for (int start = 0; start < 2; ++start) {
    LineServer server(folder / "s");
    ASSERT_EQ(daemon.wait(line), Event::kConnected);
    ASSERT_TRUE(server.accept());
    EXPECT_EQ(server.read_line(), "{\"class\":\"WATCH\",\"classes\":[\"POSE\",\"SCAN\"]}\n");
    EXPECT_EQ(daemon.wait(line, std::chrono::milliseconds(0)), Event::kTimeout);
    server.write("hello\n");
    ASSERT_EQ(daemon.wait(line), Event::kMessage);
    EXPECT_EQ(line, "hello");
    server.hang_up();
    EXPECT_EQ(daemon.wait(line), Event::kLost);
    EXPECT_FALSE(daemon.is_connected());
  }
}

TEST(RetryDelay, DoublesUpToTheLargest) {
  RetryDelay delay(std::chrono::milliseconds(500));
  EXPECT_EQ(delay.next().count(), 200);
  EXPECT_EQ(delay.next().count(), 400);
  EXPECT_EQ(delay.next().count(), 500);
  EXPECT_EQ(delay.next().count(), 500);
  delay.reset();
  EXPECT_EQ(delay.next().count(), 200);
}

}  // namespace
}  // namespace cornerd::client
