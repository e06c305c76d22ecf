// SPDX-License-Identifier: MIT
#include "client/connection.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>
#include <thread>

#include "line_server.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::client {
namespace {

struct ConnectionTest : ::testing::Test {
  test::TemporaryFolder folder;
  LineServer server{folder / "s"};
  Connection client;
  std::string_view line;

  void SetUp() override {
    ASSERT_TRUE(client.connect(folder / "s")) << client.problem();
    ASSERT_TRUE(server.accept());
  }
};

TEST_F(ConnectionTest, OneLineAtATime) {
  server.write("one\n\ntwo\nthr");
  ASSERT_EQ(client.receive(line), Received::kLine);
  EXPECT_EQ(line, "one");
  ASSERT_EQ(client.receive(line), Received::kLine);
  EXPECT_EQ(line, "");
  ASSERT_EQ(client.take(line), Received::kLine);
  EXPECT_EQ(line, "two");
  EXPECT_EQ(client.take(line), Received::kNothing);
  EXPECT_EQ(client.receive(line, std::chrono::milliseconds(0)), Received::kNothing);
  server.write("ee\n");
  ASSERT_EQ(client.receive(line), Received::kLine);
  EXPECT_EQ(line, "three");
}

TEST_F(ConnectionTest, End_IncompleteLineIsDropped) {
  server.write("whole\nhalf");
  server.hang_up();
  ASSERT_EQ(client.receive(line), Received::kLine);
  EXPECT_EQ(line, "whole");
  EXPECT_EQ(client.receive(line), Received::kEnd);
  EXPECT_EQ(client.take(line), Received::kEnd);
}

TEST_F(ConnectionTest, LongLinesBetweenShortOnes_Whole) {
  std::string sent;
  for (int i = 0; i < 40; ++i) {
    sent += std::string(static_cast<std::size_t>(i % 4 == 3 ? 300'000 : 10 + i), 'a') + "\n";
  }
  std::thread writer([&] { server.write(sent); });
  std::string received;
  while (received.size() < sent.size() && client.receive(line) == Received::kLine) {
    received.append(line).push_back('\n');
  }
  writer.join();
  EXPECT_TRUE(received == sent);
}

TEST_F(ConnectionTest, Send_ArrivesAndFailsAfterTheEnd) {
  ASSERT_TRUE(client.send("{\"class\":\"POLL\"}\n"));
  EXPECT_EQ(server.read_line(), "{\"class\":\"POLL\"}\n");
  server.hang_up();
  EXPECT_EQ(client.receive(line), Received::kEnd);
  EXPECT_FALSE(client.send("{}\n"));
}

TEST(Connection, NobodyListens_SaysSo) {
  const test::TemporaryFolder folder;
  Connection client;
  EXPECT_FALSE(client.connect(folder / "none"));
  EXPECT_EQ(client.error_number(), ENOENT);
  EXPECT_NE(client.problem().find("none: No such file"), std::string::npos) << client.problem();
  std::string_view line;
  EXPECT_EQ(client.take(line), Received::kEnd);
  EXPECT_FALSE(client.connect(std::string(200, 'x')));
  EXPECT_EQ(client.error_number(), ENAMETOOLONG);
}

}  // namespace
}  // namespace cornerd::client
