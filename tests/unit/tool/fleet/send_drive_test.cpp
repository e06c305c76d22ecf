// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

using ::testing::HasSubstr;

class SendDrive : public ::testing::Test {
 protected:
  /// Nobody listens there.
  CommandRun send(const std::string& name) const {
    return CommandRun(
        {"send-drive", (folder_ / name).string(), "--robot", "r1", "--broker", "127.0.0.1:1"});
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  test::TemporaryFolder folder_;
};

TEST_F(SendDrive, WhatIsNoDrive_IsRefusedBeforeItIsSent) {
  std::string noise;
  for (unsigned i = 0; i < 100'000; ++i) noise += static_cast<char>(i * i * 2654435761U >> 13);
  write("picture.png", "\x89PNG" + noise);
  write("noise.bin", noise);
  write("map.json", R"({ "format": "cornerd-map", "version": 1, "walls": [] })");
  write("poses.ndjson", "{\"class\":\"POSE\",\"seq\":1,\"t\":1,\"state\":\"lost\"}\n");
  EXPECT_THAT(send("picture.png").err, HasSubstr("picture.png: is no drive"));
  for (const char* name : {"noise.bin", "map.json", "poses.ndjson"}) {
    const CommandRun run = send(name);
    EXPECT_EQ(run.exit_code, 1) << name;
    EXPECT_THAT(run.err, HasSubstr(std::string(name) + ": has no whole scan of a lidar"));
  }
}

TEST_F(SendDrive, BytesOfAPort_AreADriveByTheirName) {
  const std::string bytes = (folder_ / "drive.bin").string();
  const CommandRun made({"simulate", "--map", CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json",
                         "--pose=0.95,0.6,1.57", "--scans", "4", "-o", bytes});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(send("drive.bin").err, testing::ContainsRegex("no broker: .*:[0-9]+: "));
  std::filesystem::rename(bytes, folder_ / "drive.txt");
  EXPECT_THAT(send("drive.txt").err, HasSubstr("drive.txt: is no drive"));
}

}  // namespace
}  // namespace cornerd::tool
