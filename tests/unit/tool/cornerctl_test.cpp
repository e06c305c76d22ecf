// SPDX-License-Identifier: MIT
// The program as its users call it: words in; standard output, standard error and exit code out.
#include "tool/cornerctl.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/command_line/failure.hpp"
#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

CommandRun run(const std::vector<std::string>& words) { return CommandRun(words); }

std::size_t count_lines(const std::string& text, const std::string& beginning) {
  std::istringstream lines(text);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) count += line.starts_with(beginning) ? 1 : 0;
  return count;
}

std::string read(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class Cornerctl : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  /// Four scans at one pose of the sample map, and their truth in still.truth.
  std::string recording() const {
    run({"simulate", "--map", map_, "--pose", "0.3,0.5,1", "--scans", "4", "-o",
         path("still.ndjson"), "--truth", path("still.truth")});
    return path("still.ndjson");
  }

  const std::string map_ = CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json";
  test::TemporaryFolder folder_;
};

TEST_F(Cornerctl, HelpAndVersion_ExitCode0) {
  EXPECT_EQ(run({"--help"}).exit_code, kExitDone);
  EXPECT_THAT(run({"replay", "--help"}).out, HasSubstr("--truth"));
  EXPECT_EQ(run({"--version"}).out, "cornerctl " CORNERD_VERSION "\n");
  EXPECT_EQ(run({"map", "check", "--version"}).exit_code, kExitDone);
}

TEST_F(Cornerctl, WrongUsage_ExitCode2WithReasonOnStandardError) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"dance"},
      {"replay"},
      {"calibrate", "odometry", "x.ndjson"},
      {"replay", "x.bin", "--map", map_, "--nonsense"},
      {"replay", "x.bin", "--map", map_, "--set", "x"},
      {"replay", "x.bin", "--map", map_, "--speed", "fast"},
      {"replay", "x.bin", "--map", map_, "--classes", "POSES"},
      {"replay", "x.bin", "--map", map_, "--wire", "thin"},
      {"detect", "x.bin", "--method", "guess"},
      {"simulate", "--map", map_, "-o", path("x.bin")},
      {"simulate", "--map", map_, "-o", path("x.bin"), "--pose", "1,2"},
      {"simulate", "--map", map_, "-o", path("x.bin"), "--pose", "1,1,0", "--places", "2"},
      {"doctor", "--nonsense"},
      {"map"},
      {"map", "render", map_},
  };
  for (const auto& words : wrong) {
    const CommandRun outcome = run(words);
    EXPECT_EQ(outcome.exit_code, kExitUsage) << testing::PrintToString(words);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, StartsWith("cornerctl: "));
  }
}

TEST_F(Cornerctl, OldName_IsRefusedWithItsNewName) {
  const std::pair<std::vector<std::string>, std::string> renamed[] = {
      {{"bench"}, "bench is now called cornerd-bench"},
      {{"bench", "--json", "-"}, "cornerd-bench"},
      {{"detect", "x.bin", "--turn", "3"}, "--turn is now called --scan"},
      {{"simulate", "--turns", "30"}, "--turns is now called --scans"},
      {{"simulate", "--turns=30"}, "--scans"},
      {{"emulate", "--turns-each", "3"}, "--scans-each"},
      {{"simulate", "--turn-speed", "2"}, "--rotation-speed"},
      {{"emulate", "--turn-acceleration", "2"}, "--rotation-acceleration"},
  };
  for (const auto& [words, reason] : renamed) {
    const CommandRun outcome = run(words);
    EXPECT_EQ(outcome.exit_code, kExitUsage) << testing::PrintToString(words);
    EXPECT_THAT(outcome.err, StartsWith("cornerctl: "));
    EXPECT_THAT(outcome.err, HasSubstr(reason));
  }
  EXPECT_THAT(run({"--help"}).out, Not(HasSubstr("bench")));
  EXPECT_THAT(run({"simulate", "--help"}).out, Not(HasSubstr("--turn")));
}

TEST_F(Cornerctl, UnknownCommand_IsNamed) {
  EXPECT_THAT(run({"dance"}).err, HasSubstr("there is no command \"dance\""));
}

TEST_F(Cornerctl, WrongMapOrConfig_ExitCode78AndOneLine) {
  write("no-map.json", R"({"format": "cornerd-map", "version": 1, "walls": 7})");
  write("typo.json", R"({"lidar": {"devise": "/dev/ttyUSB0"}})");
  const std::vector<std::vector<std::string>> wrong = {
      {"map", "check", path("no-map.json")},
      {"map", "check", path("absent.json")},
      {"replay", "x.bin", "--map", path("no-map.json")},
      {"replay", "x.bin", "--map", map_, "--config", path("typo.json")},
      {"replay", "x.bin", "--map", map_, "--set", "/advanced/lidar/baud=fast"},
      {"doctor", "--config", path("typo.json")},
  };
  for (const auto& words : wrong) {
    const CommandRun outcome = run(words);
    EXPECT_EQ(outcome.exit_code, kExitConfig) << testing::PrintToString(words);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_THAT(run(wrong[0]).err, HasSubstr("no-map.json: /"));
  EXPECT_THAT(run(wrong[3]).err, HasSubstr("/lidar/devise"));
}

TEST_F(Cornerctl, Replay_NotARecording_Fails) {
  write("noise.bin", "The quick brown fox jumps over the lazy dog.");
  for (const std::string& name : {path("absent.bin"), path("noise.bin"), path(".")}) {
    const CommandRun outcome = run({"replay", name, "--map", map_});
    EXPECT_EQ(outcome.exit_code, kExitFailed) << name;
    EXPECT_THAT(outcome.err, HasSubstr(name));
  }
}

TEST_F(Cornerctl, MapCheck_ValidMap_ListsItsContent) {
  const CommandRun outcome = run({"map", "check", map_});
  EXPECT_EQ(outcome.exit_code, kExitDone);
  EXPECT_THAT(outcome.out, HasSubstr("krpai-2019-a"));
  EXPECT_THAT(outcome.out, HasSubstr("room-1"));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Cornerctl, Replay_SimulatedRecording_NoWrongPose) {
  const CommandRun outcome = run(
      {"replay", recording(), "--map", map_, "--classes", "POSE", "--truth", path("still.truth")});
  EXPECT_EQ(outcome.exit_code, kExitDone);
  EXPECT_EQ(count_lines(outcome.out, R"({"class":"POSE")"), 4U);
  EXPECT_THAT(outcome.err, HasSubstr("scans            4"));
  EXPECT_THAT(outcome.err, HasSubstr("wrong            0"));
}

TEST_F(Cornerctl, Replay_SameInput_GivesSameBytes) {
  const std::vector<std::string> words = {
      "replay", recording(), "--map", map_, "--classes", "VERSION,SCAN,BREAKPOINTS,POSE,STATUS"};
  const std::string once = run(words).out;
  EXPECT_THAT(once, StartsWith(R"({"class":"VERSION")"));
  EXPECT_EQ(count_lines(once, R"({"class":"SCAN")"), 4U);
  EXPECT_EQ(once, run(words).out);
}

TEST_F(Cornerctl, Replay_NoPosesRequested_NeedsNoMap) {
  const CommandRun outcome = run({"replay", recording(), "--classes", "SCAN,STATUS"});
  EXPECT_EQ(outcome.exit_code, kExitDone);
  EXPECT_EQ(count_lines(outcome.out, R"({"class":"SCAN")"), 4U);
  EXPECT_GE(count_lines(outcome.out, R"({"class":"STATUS")"), 1U);
}

TEST_F(Cornerctl, Replay_MapRequested_PrintedOnce) {
  const CommandRun outcome = run({"replay", recording(), "--map", map_, "--classes", "MAP"});
  EXPECT_THAT(outcome.out, StartsWith(R"({"class":"MAP","name":"krpai-2019-a","hash":")"));
  EXPECT_EQ(count_lines(outcome.out, ""), 1u);
}

TEST_F(Cornerctl, Replay_SeveralFiles_ArePlayedInOrder) {
  const std::string file = recording();
  const CommandRun outcome = run({"replay", file, file, "--classes", "SCAN"});
  EXPECT_EQ(count_lines(outcome.out, R"({"class":"SCAN")"), 8U);
}

TEST_F(Cornerctl, Replay_RecordedScans_GivesAllPoses) {
  write("scans.ndjson", run({"replay", recording(), "--classes", "SCAN"}).out);
  const CommandRun outcome =
      run({"replay", path("scans.ndjson"), "--map", map_, "--classes", "POSE"});
  EXPECT_EQ(outcome.exit_code, kExitDone);
  EXPECT_EQ(count_lines(outcome.out, R"({"class":"POSE")"), 4U);
}

TEST_F(Cornerctl, Detect_Recording_GivesBreakpointsOfEachScan) {
  const CommandRun outcome = run({"detect", recording(), "--method", "altbd"});
  EXPECT_EQ(outcome.exit_code, kExitDone);
  EXPECT_EQ(count_lines(outcome.out, R"({"class":"BREAKPOINTS")"), 4U);
  EXPECT_THAT(outcome.out, HasSubstr(R"("kind":"corner")"));
}

TEST_F(Cornerctl, Simulate_TruthOfMovingRobotInBin_IsUsageError) {
  const CommandRun outcome = run({"simulate", "--map", map_, "--path", "0.3,0.3 0.3,0.6", "-o",
                                  path("moving.bin"), "--truth", path("moving.truth")});
  EXPECT_EQ(outcome.exit_code, kExitUsage);
}

TEST_F(Cornerctl, MapRender_Recording_IsDrawnAtItsPoses) {
  const CommandRun outcome = run({"map", "render", map_, "-o", path("map.svg"), "--recording",
                                  recording(), "--truth", path("still.truth")});
  EXPECT_EQ(outcome.exit_code, kExitDone) << outcome.err;
  const std::string picture = read(path("map.svg"));
  EXPECT_EQ(find_xml_error(picture), "");
  EXPECT_THAT(picture, HasSubstr("id=\"scan\""));
  EXPECT_THAT(picture, HasSubstr("id=\"points\""));
  EXPECT_THAT(picture, HasSubstr("4 of 4 scans localized"));
}

TEST_F(Cornerctl, MapRender_Trajectory_PlacesTheRecording) {
  const std::string file = recording();
  const CommandRun outcome = run({"map", "render", map_, "-o", path("map.svg"), "--recording", file,
                                  "--trajectory", path("still.truth")});
  EXPECT_EQ(outcome.exit_code, kExitDone) << outcome.err;
  const std::string picture = read(path("map.svg"));
  EXPECT_EQ(find_xml_error(picture), "");
  EXPECT_THAT(picture, HasSubstr("id=\"points\""));
  EXPECT_THAT(picture, HasSubstr("placed by still.truth"));
  EXPECT_EQ(run({"map", "render", map_, "-o", path("map.svg"), "--trajectory", path("still.truth")})
                .exit_code,
            kExitUsage);
}

TEST_F(Cornerctl, MapRender_UnwritableFile_Fails) {
  const CommandRun outcome = run({"map", "render", map_, "-o", path("absent/map.svg")});
  EXPECT_EQ(outcome.exit_code, kExitFailed);
  EXPECT_THAT(outcome.err, HasSubstr("absent/map.svg: No such file or directory"));
}

TEST_F(Cornerctl, Watch_NoDaemon_FailsAtOnce) {
  const CommandRun outcome = run({"watch", "--socket", path("pose.sock")});
  EXPECT_EQ(outcome.exit_code, kExitFailed);
  EXPECT_THAT(outcome.err, HasSubstr("pose.sock"));
}

TEST_F(Cornerctl, Doctor_NoPortAndNoDaemon_ReportsBothAndFails) {
  write("cornerd.json", R"({"lidar": {"device": "/dev/no-such-port"}, "map": ")" + map_ +
                            R"(", "socket": {"pose": ")" + path("pose.sock") + "\"}}");
  const CommandRun outcome = run({"doctor", "--config", path("cornerd.json")});
  EXPECT_EQ(outcome.exit_code, kExitFailed);
  EXPECT_THAT(outcome.out, HasSubstr("ok     map "));
  EXPECT_THAT(outcome.out, HasSubstr("WRONG  port      /dev/no-such-port: no such port"));
  EXPECT_THAT(outcome.out, HasSubstr("WRONG  daemon "));
  EXPECT_THAT(outcome.err, HasSubstr("faults found"));
}

TEST_F(Cornerctl, Doctor_WrongConfig_ChecksTheRest) {
  write("typo.json", R"({"lidar": {"devise": "/dev/ttyUSB0"}})");
  const CommandRun outcome = run({"doctor", "--config", path("typo.json")});
  EXPECT_EQ(outcome.exit_code, kExitConfig);
  EXPECT_THAT(outcome.out, HasSubstr("/lidar/devise"));
  EXPECT_THAT(outcome.out, HasSubstr("port "));
}

TEST_F(Cornerctl, Record_NoPort_FailsAtOnce) {
  const CommandRun outcome = run({"record", "--device", path("tty"), "-o", path("r.bin")});
  EXPECT_EQ(outcome.exit_code, kExitFailed);
  EXPECT_THAT(outcome.err, HasSubstr(path("tty")));
  EXPECT_FALSE(std::filesystem::exists(path("r.bin")));
}

TEST_F(Cornerctl, Replay_ClosedReader_EndsWithoutError) {
  const std::string file = recording();
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const int standard_output = ::dup(STDOUT_FILENO);
  ::dup2(ends[1], STDOUT_FILENO);
  ::close(ends[0]);
  ::close(ends[1]);
  testing::internal::CaptureStderr();
  const char* const words[] = {"cornerctl", "replay", file.c_str(), "--classes", "SCAN"};
  const int exit_code = run_cornerctl(5, words);
  ::dup2(standard_output, STDOUT_FILENO);
  ::close(standard_output);
  std::clearerr(stdout);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(exit_code, kExitDone);
}

}  // namespace
}  // namespace cornerd::tool
