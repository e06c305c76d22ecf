// SPDX-License-Identifier: MIT
#include "tool/command_line/output.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "command_run.hpp"
#include "gridmap/map_server_yaml.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FileGuard : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  fs::path made(const std::string& name) const {
    std::ofstream(path(name)) << "kept";
    return path(name);
  }

  test::TemporaryFolder folder_;
};

TEST_F(FileGuard, DistinctOrEmptyNames_AreAccepted) {
  EXPECT_NO_THROW(guard_files({.read = {made("a"), ""}, .written = {path("b"), ""}, .output = ""}));
  EXPECT_NO_THROW(guard_files({.read = {}, .written = {path("a"), path("b")}, .output = "-"}));
}

TEST_F(FileGuard, OutputOverAliasOfInput_IsWrongUsage) {
  const fs::path file = made("a");
  fs::create_symlink("a", path("link"));
  fs::create_hard_link(file, path("hard"));
  for (const char* name : {"a", "./a", "link", "hard"}) {
    EXPECT_THROW(guard_files({.read = {file}, .written = {path(name)}, .output = {}}), UsageError)
        << name;
    EXPECT_THROW(guard_files({.read = {file}, .written = {}, .output = path(name)}), UsageError)
        << name;
  }
  EXPECT_THROW(guard_files({.read = {path("new")}, .written = {path("./new")}, .output = {}}),
               UsageError);
}

TEST_F(FileGuard, SameFileForTwoOutputs_IsWrongUsage) {
  EXPECT_THROW(guard_files({.read = {}, .written = {path("a"), path("./a")}, .output = {}}),
               UsageError);
  EXPECT_THROW(guard_files({.read = {}, .written = {path("a")}, .output = path("a")}), UsageError);
  // Relative names of a file that does not exist yet.
  EXPECT_THROW(guard_files({.read = {}, .written = {"./absent.json"}, .output = "absent.json"}),
               UsageError);
}

TEST_F(FileGuard, DeviceForTwoOutputs_IsAccepted) {
  EXPECT_NO_THROW(guard_files({.read = {}, .written = {"/dev/null"}, .output = "/dev/null"}));
}

TEST_F(FileGuard, DashForFileOutput_IsWrongUsage) {
  EXPECT_THROW(guard_files({.read = {}, .written = {"-"}, .output = {}}), UsageError);
}

/// Input files of commands, and a check that none was changed.
class CommandFilesTest : public FileGuard {
 protected:
  CommandFilesTest() {
    fs::copy_file(CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json", path("map.json"));
    write("config.json", R"({"map": "map.json"})");
    write("noise.json", R"({"lidar": {"noise": {"floor": 0.01}}})");
    write("room.yaml",
          "image: room.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
          "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
    write("room.pgm", "P2\n3 3\n255\n0 0 0\n0 254 0\n0 0 0\n");
    CommandRun({"simulate", "--map", file("map.json"), "--path", "0.9,0.9 0.9,1.5", "--odometry",
                "--scans", "4", "-o", file("drive.ndjson"), "--truth", file("truth.ndjson")});
    contents_ = contents();
  }
  std::string file(const std::string& name) const { return path(name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      all[entry.path().filename()] = text.str();
    }
    return all;
  }
  /// The path if `word` is the name of a file, else `word`.
  std::string expand(const std::string& word) const {
    return contents_.contains(word) || word == "new" ? file(word) : word;
  }

  void expect_refused(std::span<const std::vector<std::string>> calls) const {
    for (const std::vector<std::string>& call : calls) {
      std::vector<std::string> words;
      for (const std::string& word : call) {
        const std::size_t at = word.find('@');
        words.push_back(at == std::string::npos ? expand(word)
                                                : expand(word.substr(0, at)) + word.substr(at));
      }
      const CommandRun run(words);
      EXPECT_EQ(run.exit_code, kExitUsage) << testing::PrintToString(call) << run.err;
      EXPECT_EQ(run.out, "") << testing::PrintToString(call);
      ASSERT_EQ(contents(), contents_) << testing::PrintToString(call);
    }
  }

  std::map<std::string, std::string> contents_;
};

TEST_F(CommandFilesTest, OutputOverInputOrOutput_IsWrongUsageAndWritesNothing) {
  const std::vector<std::string> calls[] = {
      {"map", "render", "map.json", "-o", "map.json"},
      {"map", "render", "map.json", "-o", "drive.ndjson", "--recording", "drive.ndjson"},
      {"map", "render", "map.json", "-o", "truth.ndjson", "--truth", "truth.ndjson"},
      {"map", "render", "map.json", "-o", "truth.ndjson", "--recording", "drive.ndjson",
       "--trajectory", "truth.ndjson"},
      {"map", "render", "map.json", "-o", "config.json", "--config", "config.json"},
      {"map", "check", "map.json", "--plot", "map.json"},
      {"survey", "drive.ndjson", "-o", "drive.ndjson"},
      {"survey", "drive.ndjson", "-o", "new", "--trajectory", "drive.ndjson"},
      {"survey", "drive.ndjson", "-o", "truth.ndjson", "--odometry", "truth.ndjson"},
      {"survey", "drive.ndjson", "-o", "config.json", "--config", "config.json"},
      {"survey", "drive.ndjson", "-o", "new", "--plot", "new"},
      {"detect", "drive.ndjson", "--plot", "drive.ndjson"},
      {"detect", "drive.ndjson", "--plot", "config.json", "--config", "config.json"},
      {"simulate", "--config", "config.json", "--pose", "1,1,0", "-o", "map.json"},
      {"simulate", "--config", "config.json", "--pose", "1,1,0", "-o", "config.json"},
      {"simulate", "--map", "map.json", "--pose", "1,1,0", "--noise", "noise.json", "-o",
       "noise.json"},
      {"simulate", "--map", "map.json", "--pose", "1,1,0", "-o", "new", "--truth", "new"},
      {"simulate", "--map", "map.json", "--pose", "1,1,0", "-o", "new", "--truth", "map.json"},
      {"simulate", "--map", "map.json", "--pose", "1,1,0", "-o", "-"},
      {"simulate", "--map", "map.json", "--path", "1,1 1,2", "-o", "new", "--odometry"},
      {"simulate", "--map", "map.json", "--path", "1,1 1,2", "-o", "new", "--truth",
       "truth.ndjson"},
      {"emulate", "--map", "map.json", "--pose", "1,1,0", "--truth", "map.json"},
      {"emulate", "drive.ndjson", "--link", "drive.ndjson"},
      {"record", "--device", "new", "-o", "new"},
      {"record", "--config", "config.json", "-o", "config.json"},
      {"calibrate", "noise", "drive.ndjson", "-o", "drive.ndjson"},
      {"calibrate", "noise", "drive.ndjson@1", "--plot", "drive.ndjson"},
      {"calibrate", "noise", "drive.ndjson", "--plot", "new", "--plot-wall", "new"},
      {"calibrate", "bias", "drive.ndjson", "--map", "map.json", "-o", "map.json"},
      {"calibrate", "bias", "drive.ndjson", "--map", "map.json", "-o", "drive.ndjson"},
      {"calibrate", "odometry", "drive.ndjson", "--map", "map.json", "-o", "map.json"},
      {"calibrate", "odometry", "drive.ndjson", "--config", "config.json", "--plot", "config.json"},
      {"calibrate", "odometry", "drive.ndjson", "--map", "map.json", "--truth", "truth.ndjson",
       "--plot", "truth.ndjson"},
  };
  expect_refused(calls);
}

TEST_F(CommandFilesTest, ImportedMapOverItsInputs_IsWrongUsageAndWritesNothing) {
  if (!gridmap::has_yaml()) GTEST_SKIP() << "built without libyaml-cpp";
  const std::vector<std::string> calls[] = {
      {"map", "import", "room.yaml", "-o", "room.yaml"},
      {"map", "import", "room.yaml", "-o", "room.pgm"},
      {"map", "import", "room.yaml", "-o", "new", "--plot", "room.pgm"},
      {"map", "import", "room.yaml", "-o", "new", "--plot", "new"},
  };
  expect_refused(calls);
}

TEST_F(CommandFilesTest, DrawingOnStandardOutput_HasNoOtherText) {
  const CommandRun run({"map", "render", file("map.json"), "-o", "-"});
  EXPECT_EQ(run.exit_code, kExitDone) << run.err;
  EXPECT_THAT(run.out, testing::StartsWith("<svg"));
  EXPECT_FALSE(fs::exists("-"));
}

TEST(WriteFile, FullDisk_LeavesTheOldFileAlone) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "map.json";
  write_file(file, "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_file(file, std::string(100'000, 'x')), Failure);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(text.str(), "old");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

}  // namespace
}  // namespace cornerd::tool
