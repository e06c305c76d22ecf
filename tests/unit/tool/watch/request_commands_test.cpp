// SPDX-License-Identifier: MIT
// cornerctl status, set-pose and relocalize against the daemon's side of a socket.
#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/client/line_server.hpp"

namespace cornerd::tool {
namespace {

constexpr const char* kPose =
    "{\"class\":\"POSE\",\"seq\":7,\"t\":12.5,\"x\":0.9,\"y\":1.5,\"theta\":1.5707963,\"cov\":{"
    "\"xx\":4e-6,"
    "\"xy\":0,\"xt\":0,\"yy\":0,\"yt\":0,\"tt\":1e-6},\"state\":\"fix\",\"room\":\"hall\","
    "\"corners\":5,"
    "\"inliers\":300}\n";
constexpr const char* kStatus =
    "{\"class\":\"STATUS\",\"t\":12.6,\"lidar\":{\"state\":\"running\",\"rate_hz\":7.1},"
    "\"faults\":[\"odometry-absent\"],\"hint\":\"no ODOMETRY line comes\"}\n";

/// A daemon that greets, takes one request and answers it.
class RequestCommandTest : public ::testing::Test {
 protected:
  std::string socket() const { return (folder_ / "s").string(); }
  CommandRun run(std::vector<std::string> words, const std::string& answer) {
    client::LineServer server(folder_ / "s");
    std::jthread daemon([&] {
      if (!server.accept()) return;
      server.write(
          "{\"class\":\"VERSION\",\"program\":\"cornerd\",\"version\":\"1\",\"schema\":2}\n");
      request_ = server.read_line();
      server.write(answer);
      server.read_line();  // until the client has left
    });
    words.insert(words.end(), {"--socket", socket()});
    return CommandRun(words);
  }

  test::TemporaryFolder folder_;
  std::string request_;
};

TEST_F(RequestCommandTest, Status_PrintsTheLastPoseAndStatus) {
  const CommandRun status =
      run({"status"}, std::string(kPose) + kStatus + "{\"class\":\"OK\",\"id\":1}\n");
  EXPECT_EQ(status.exit_code, 0) << status.err;
  EXPECT_EQ(status.out, std::string(kPose) + kStatus);
  EXPECT_EQ(request_, "{\"class\":\"POLL\",\"classes\":[\"POSE\",\"STATUS\"],\"id\":1}\n");
}

TEST_F(RequestCommandTest, StatusAsText_HasStateSigmaAndHint) {
  const CommandRun status = run({"status", "--format", "text"},
                                std::string(kPose) + kStatus + "{\"class\":\"OK\",\"id\":1}\n");
  EXPECT_EQ(status.out,
            "12.500 fix       x 0.900 y 1.500 m, 90.0 degrees (sigma 2.0 mm, 0.06 degrees), hall\n"
            "lidar running, 7.1 scans/s\n    no ODOMETRY line comes\n");
}

TEST_F(RequestCommandTest, OldPoseAsText_HasItsAge) {
  std::string later = kStatus;
  later.replace(later.find("12.6"), 4, "27.7");
  const CommandRun status = run({"status", "--format", "text"},
                                std::string(kPose) + later + "{\"class\":\"OK\",\"id\":1}\n");
  EXPECT_THAT(status.out, testing::StartsWith("15 s old: 12.500 fix"));
}

TEST_F(RequestCommandTest, SetPose_SendsThePose) {
  const CommandRun sent = run({"set-pose", "--pose=-1.25,2,0.5"}, "{\"class\":\"OK\",\"id\":1}\n");
  EXPECT_EQ(sent.exit_code, 0) << sent.err;
  EXPECT_EQ(sent.out, "");
  EXPECT_EQ(request_, "{\"class\":\"SET_POSE\",\"x\":-1.25,\"y\":2,\"theta\":0.5,\"id\":1}\n");
}

TEST_F(RequestCommandTest, Refusal_IsFailureWithTheDaemonsReason) {
  const CommandRun sent = run({"relocalize"},
                              "{\"class\":\"ERROR\",\"code\":\"read-only\",\"message\":\"use the "
                              "control socket\",\"id\":1}\n");
  EXPECT_EQ(sent.exit_code, 1);
  EXPECT_NE(sent.err.find("use the control socket"), std::string::npos) << sent.err;
  EXPECT_EQ(request_, "{\"class\":\"RELOCALIZE\",\"id\":1}\n");
}

TEST_F(RequestCommandTest, NoDaemon_IsFailureThatSaysSo) {
  const CommandRun sent({"relocalize", "--socket", socket()});
  EXPECT_EQ(sent.exit_code, 1);
  EXPECT_NE(sent.err.find("does cornerd run?"), std::string::npos) << sent.err;
}

}  // namespace
}  // namespace cornerd::tool
