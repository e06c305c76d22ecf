// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "daemon_process.hpp"
#include "tests/sanitized.hpp"

namespace cornerd::system_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class CommandLine : public DaemonTest {
 protected:
  /// Exit code 78 and one line with file, pointer and reason.
  void expect_config_error(const std::vector<std::string>& arguments, const std::string& file,
                           const std::string& rest) {
    for (const bool checks : {false, true}) {
      std::vector<std::string> all = arguments;
      if (checks) all.emplace_back("--check");
      const Result result = run(all);
      EXPECT_EQ(result.exit_code, 78);
      EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
      EXPECT_THAT(result.output, StartsWith("cornerd: " + file + ": " + rest));
    }
  }

  std::string write(const char* name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
};

TEST_F(CommandLine, CheckOfValidConfig_PrintsOk) {
  const Result result = run({"--config", config(), "--check"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output, "ok\n");
}

TEST_F(CommandLine, UnknownKey_NamedInError) {
  const std::string file =
      write("typo.json", R"({ "map": "map.json", "lidar": { "devise": "x" } })");
  expect_config_error({"--config", file}, file, "/lidar/devise: unknown key");
}

TEST_F(CommandLine, ConfigNotJson_LineInError) {
  const std::string file = write("bad.json", "{\n  \"map\" }\n");
  expect_config_error({"--config", file}, file, "line 2, column");
}

TEST_F(CommandLine, MapOfAnotherFormat_NamedInError) {
  const std::string map = write("nomap.json", R"({ "hello": 1 })");
  expect_config_error({"--config", config(), "--set", "/map=" + map}, map, "/format: ");
}

TEST_F(CommandLine, MapWithInvalidWall_PointerInError) {
  const std::string map = write(
      "wall.json", R"({ "format": "cornerd-map", "version": 1, "walls": [ { "from": [0, 0] } ] })");
  expect_config_error({"--config", config(), "--set", "/map=" + map}, map, "/walls/0/to: ");
}

TEST_F(CommandLine, MissingFiles_NamedInError) {
  expect_config_error({"--config", "/nowhere/c.json"}, "/nowhere/c.json", "cannot be opened");
  expect_config_error({"--config", config(), "--set", "/map=/nowhere/m.json"}, "/nowhere/m.json",
                      "cannot be opened");
}

TEST_F(CommandLine, WrongUsage_ExitCode2) {
  EXPECT_EQ(run({}).exit_code, 2);
  const Result result = run({"--config", config(), "--frobnicate"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.output, HasSubstr("--frobnicate"));
}

TEST_F(CommandLine, HelpAndVersion_OnStandardOutput) {
  const Result help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.output, HasSubstr("--check"));
  const Result version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.output, StartsWith("cornerd "));
}

TEST_F(CommandLine, UnwritableOutput_ExitCode1) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"--help"}, {"--version"}, {"--config", config(), "--check"}}) {
    // The error message cannot be written either.
    DaemonProcess process(arguments, "/dev/full");
    EXPECT_EQ(process.wait_for_exit(), 1) << arguments.front();
  }
}

TEST_F(CommandLine, PipeInsteadOfFile_RefusedWithoutBlocking) {
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_config_error({"--config", pipe}, pipe, "is no ordinary file");
  expect_config_error({"--config", config(), "--set", "/map=" + pipe}, pipe, "is no ordinary file");
}

TEST_F(CommandLine, StackOf64kB_Runs) {
  if (test::kSanitized) GTEST_SKIP() << "a sanitizer needs more";
  const std::string run = "ulimit -s 64; exec " CORNERD_BINARY " --config " + config();
  {
    DaemonProcess check({"-c", run + " --check"}, folder_ / "check.log", {}, {}, "/bin/sh");
    EXPECT_EQ(check.wait_for_exit(), 0);
  }
  DaemonProcess daemon({"-c", run}, folder_ / "run.log", {}, {}, "/bin/sh");
  TestClient client = connect();
  EXPECT_TRUE(next_of(client, "POSE").is_object());
  daemon.send_signal(SIGHUP);
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait_for_exit(), 0) << daemon.output();
}

TEST_F(CommandLine, OneMapTwice_IsWarnedOf) {
  const json maps = {{{"name", "ground"}, {"file", (folder_ / "map.json").string()}},
                     {{"name", "first"}, {"file", (folder_ / "map.json").string()}}};
  const Result result = run(
      {"--config", config(), "--check", "--set", "/maps=" + maps.dump(), "--set", "/map=first"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("\"ground\" and \"first\" are one file"));
}

}  // namespace
}  // namespace cornerd::system_test
