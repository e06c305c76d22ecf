// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {
namespace {

class ExportCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  std::string output() const {
    std::ostringstream text;
    text << std::ifstream(path("drive.mcap")).rdbuf();
    return text.str();
  }
  CommandRun export_file(const std::string& name) const {
    return CommandRun({"export", path(name), "-o", path("drive.mcap")});
  }

  test::TemporaryFolder folder_;
};

TEST_F(ExportCommand, Failure_LeavesTheOldFileAlone) {
  write("drive.mcap", "old");
  write("empty.ndjson", "");
  EXPECT_NE(export_file("empty.ndjson").exit_code, kExitDone);
  EXPECT_EQ(output(), "old");
  EXPECT_FALSE(std::filesystem::exists(path("drive.mcap.part")));
}

TEST_F(ExportCommand, NameOfAnotherFormat_IsWrongUsage) {
  write("drive.ndjson", "");
  const CommandRun run({"export", path("drive.ndjson"), "-o", path("drive.bag")});
  EXPECT_EQ(run.exit_code, kExitUsage);
  EXPECT_THAT(run.err, testing::HasSubstr("*.mcap"));
}

TEST_F(ExportCommand, DamagedLines_AreCountedAndTheFirstNamed) {
  write("drive.mcap", "old");
  const std::string scan =
      "{\"class\":\"SCAN\",\"t\":2,\"duration\":0.1,\"angles\":[-2,-1],\"ranges\":[1,2],"
      "\"quality\":[1,2]}\n";
  write("damaged.ndjson", scan + "{\"class\":\"POSE\",\"t\":\nno message\n\n" + scan);
  const CommandRun outcome = export_file("damaged.ndjson");
  EXPECT_EQ(outcome.exit_code, kExitDone) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr("2 lines skipped; the first: line 2: "));
  EXPECT_TRUE(output().starts_with("\x89MCAP"));
  EXPECT_FALSE(std::filesystem::exists(path("drive.mcap.part")));
}

}  // namespace
}  // namespace cornerd::tool
