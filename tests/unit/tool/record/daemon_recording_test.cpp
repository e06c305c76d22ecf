// SPDX-License-Identifier: MIT
// cornerctl record --from-daemon against the daemon's side of a socket.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/client/line_server.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;

const std::string kScan =
    R"({"class":"SCAN","t":1.000000,"duration":0.1,"angles":[0,1],"ranges":[2,3]})"
    "\n";
const std::string kReading = R"({"class":"ODOMETRY","t":0.990000,"left":5,"right":6,"dropped":2})"
                             "\n";

class DaemonRecording : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  CommandRun record(const std::string& lines) {
    client::LineServer server(folder_ / "s");
    const std::jthread daemon([&] {
      if (!server.accept()) return;
      server.write(R"({"class":"VERSION","program":"cornerd","version":"1","schema":2})"
                   "\n");
      request_ = server.read_line();
      server.write("{\"class\":\"OK\",\"request\":\"WATCH\"}\n" + lines);
      server.read_line();  // until the client has left
    });
    return CommandRun(
        {"record", "--socket", file("s"), "-o", file("a.ndjson"), "--seconds", "0.5"});
  }

  test::TemporaryFolder folder_;
  std::string request_;
};

TEST_F(DaemonRecording, KeepsScansAndReadings_ThatReplayReads) {
  const CommandRun run = record(kReading + kScan);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(request_, "{\"class\":\"WATCH\",\"classes\":[\"SCAN\",\"ODOMETRY\"]}\n");
  std::ifstream stream(file("a.ndjson"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), kReading + kScan);
  EXPECT_THAT(run.err, HasSubstr("1 scans, 1 readings"));
  EXPECT_THAT(run.err, HasSubstr("2 messages are missing"));
  const CommandRun replay({"replay", file("a.ndjson"), "--classes", "SCAN", "--map",
                           CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json"});
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_THAT(replay.out, HasSubstr("\"class\":\"SCAN\",\"t\":1.0"));
}

TEST_F(DaemonRecording, EarlierRecording_IsKept) {
  std::ofstream(file("a.ndjson")) << kScan;
  const CommandRun run = record(kReading + kScan);
  EXPECT_THAT(run.err, HasSubstr("the earlier file is"));
  std::ifstream earlier(file("a.ndjson~"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(earlier), {}), kScan);
}

TEST_F(DaemonRecording, NothingComes_IsFailure) {
  const CommandRun run = record("");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("cornerctl doctor"));
}

TEST_F(DaemonRecording, NoDaemon_IsFailure_AndLeavesAnOldRecording) {
  std::ofstream(file("a.ndjson")) << kScan;
  const CommandRun run({"record", "--socket", file("s"), "-o", file("a.ndjson")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("does cornerd run?"));
  EXPECT_GT(std::filesystem::file_size(file("a.ndjson")), 0U);
}

TEST_F(DaemonRecording, BytesOrAPort_AreWrongUsage) {
  EXPECT_EQ(CommandRun({"record", "--from-daemon", "-o", file("a.bin")}).exit_code, 2);
  EXPECT_EQ(CommandRun({"record", "--from-daemon", "-o", file("a.ndjson"), "--device", "/dev/x"})
                .exit_code,
            2);
}

}  // namespace
}  // namespace cornerd::tool
