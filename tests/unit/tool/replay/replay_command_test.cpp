// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

using ::testing::HasSubstr;

TEST(ReplayCommand, UnreadableOtherMap_SaidBeforeTheFirstMessage) {
  const test::TemporaryFolder folder;
  const std::string map = CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json";
  const std::string drive = (folder / "still.ndjson").string();
  const std::string config = (folder / "two.json").string();
  std::ofstream(folder / "bad.json") << "{";
  std::ofstream(config) << R"({ "maps": [{ "name": "a", "file": ")" << map
                        << R"(" }, { "name": "b", "file": "bad.json" }], "map": "a" })";
  const CommandRun made(
      {"simulate", "--map", map, "--pose", "0.3,0.5,1", "--scans", "4", "-o", drive});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const CommandRun outcome({"replay", drive, "--config", config});
  EXPECT_EQ(outcome.exit_code, 78);
  EXPECT_THAT(outcome.err, HasSubstr("bad.json: "));
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace cornerd::tool
