// SPDX-License-Identifier: MIT
#include "client/request.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "line_server.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::client {
namespace {

TEST(Ask, NobodyThere_SaysWho) {
  const test::TemporaryFolder folder;
  const Answer answer = ask(folder / "control.sock", "{}\n", std::chrono::milliseconds(100));
  EXPECT_EQ(answer.kind, Answer::Kind::kNone);
  EXPECT_NE(answer.text.find("control.sock"), std::string::npos) << answer.text;
}

TEST(Ask, Answer_IsFoundAmongMessages) {
  const test::TemporaryFolder folder;
  LineServer server(folder / "s");
  std::string asked;
  for (const bool is_ok : {true, false}) {
    std::thread daemon([&] {
      server.accept();
      server.write("{\"class\":\"VERSION\"}\n");
      asked = server.read_line();
      server.write(is_ok ? "{\"class\":\"OK\"}\n" : "{\"class\":\"ERROR\",\"code\":\"map\"}\n");
      server.hang_up();
    });
    const Answer answer = ask(folder / "s", "{\"class\":\"FLY\"}\n", std::chrono::seconds(60));
    daemon.join();
    EXPECT_EQ(asked, "{\"class\":\"FLY\"}\n");
    EXPECT_EQ(answer.kind, is_ok ? Answer::Kind::kOk : Answer::Kind::kError) << answer.text;
  }
}

TEST(Ask, DaemonThatHangsUp_DidNotAnswer) {
  const test::TemporaryFolder folder;
  LineServer server(folder / "s");
  std::thread daemon([&] {
    server.accept();
    server.hang_up();
  });
  EXPECT_EQ(ask(folder / "s", "{}\n", std::chrono::seconds(60)).kind, Answer::Kind::kNone);
  daemon.join();
}

}  // namespace
}  // namespace cornerd::client
