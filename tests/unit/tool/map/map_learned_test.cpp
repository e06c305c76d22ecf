// SPDX-License-Identifier: MIT
// What the daemon has learned of a map: map learned, map render --walls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "command_run.hpp"
#include "settings/map_file.hpp"
#include "tests/temporary_folder.hpp"
#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using ::testing::HasSubstr;

class MapLearned : public ::testing::Test {
 protected:
  MapLearned() {
    std::ofstream(map_) << R"({"format": "cornerd-map", "version": 1, "name": "hall", "sigma": 0.03,
      "walls": [{"from": [0, 0], "to": [4, 0]}, {"from": [4, 0], "to": [4, 3]},
                {"from": [4, 3], "to": [0, 3]}, {"from": [0, 3], "to": [0, 0]},
                {"from": [1, 1], "to": [2, 1]}]})";
    write_walls(settings::load_map(map_)->plan().hash);
  }
  void write_walls(const std::string& hash, int gone = 4) {
    std::ofstream(walls_) << R"({"format": "cornerd-walls", "map": ")" << hash
                          << R"(", "walls": [{"wall": 0, "offset": 0.02}], "covariance": [2.5e-5],
                             "gone": [)"
                          << gone << R"(], "new": [[3.1, 2.2]]})";
  }
  CommandRun learned(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"map", "learned", map_, "--walls", walls_, "-o", better_};
    words.insert(words.end(), more.begin(), more.end());
    return CommandRun(words);
  }

  test::TemporaryFolder folder_;
  std::string map_ = (folder_ / "hall.json").string();
  std::string walls_ = (folder_ / "walls.json").string();
  std::string better_ = (folder_ / "better.json").string();
};

TEST_F(MapLearned, Walls_AreWhereTheyWereLearnedAndChangesAreNamed) {
  const CommandRun run = learned();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("1 walls learned"));
  EXPECT_THAT(run.out, HasSubstr("wall 4 at (1.50, 1.00) is gone"));
  EXPECT_THAT(run.out, HasSubstr("something new at (3.10, 2.20) stays"));
  const core::FloorPlan plan = settings::load_map(better_)->plan();
  ASSERT_EQ(plan.walls.size(), 5u) << "what is gone is left out on demand alone";
  EXPECT_NEAR(plan.walls[0].from.y(), 0.02, 1e-6);
  EXPECT_NEAR(plan.walls[0].sigma_m.value_or(0), 0.005, 1e-6);
  EXPECT_FALSE(plan.walls[1].sigma_m);
}

TEST_F(MapLearned, WithoutGone_LeavesThatWallOutAndDiffNamesIt) {
  ASSERT_EQ(learned({"--without-gone"}).exit_code, 0);
  EXPECT_EQ(settings::load_map(better_)->plan().walls.size(), 4u);
  const CommandRun diff({"map", "diff", map_, better_, "--json"});
  const auto found = nlohmann::json::parse(diff.out);
  EXPECT_EQ(found["gone"].size(), 1u) << diff.out;
  ASSERT_FALSE(found["moved"].empty()) << diff.out;
  EXPECT_EQ(found["moved"][0]["wall"], 0) << "the ends of its neighbours follow";
}

TEST_F(MapLearned, OtherMapOrNoFile_IsRefusedWithTheWayOut) {
  write_walls(std::string(64, 'a'));
  EXPECT_THAT(learned().err, HasSubstr("was learned in another map"));
  write_walls(settings::load_map(map_)->plan().hash, 5);
  EXPECT_THAT(learned().err, HasSubstr("has a wall that the map has not"));
  std::filesystem::remove(walls_);
  EXPECT_THAT(learned().err, HasSubstr("is not there: the daemon has learned nothing"));
}

TEST_F(MapLearned, Render_ShowsOffsetsAndChanges) {
  const std::string picture = (folder_ / "hall.svg").string();
  const CommandRun run({"map", "render", map_, "--walls", walls_, "-o", picture});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::ostringstream text;
  text << std::ifstream(picture).rdbuf();
  EXPECT_EQ(find_xml_error(text.str()), "");
  EXPECT_THAT(text.str(), HasSubstr("+20 ± 5"));
  EXPECT_THAT(text.str(), HasSubstr("1 walls learned, 2 changes"));
}

}  // namespace
}  // namespace cornerd::tool
