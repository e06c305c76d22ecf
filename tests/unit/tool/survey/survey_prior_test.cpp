// SPDX-License-Identifier: MIT
// A simulated drive moves the walls of a drawn plan.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

class SurveyPriorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const CommandRun simulated({"simulate", "--map", arena_, "--path",
                                "0.9,0.9 0.9,1.5 1.15,1.15 0.9,0.9", "--loop", "--scans", "120",
                                "--odometry", "-o", file("one.ndjson")});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  }
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  static std::string content(const std::string& name) {
    std::ifstream stream(name);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  test::TemporaryFolder folder_;
  const std::string arena_ = CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json";
};

TEST_F(SurveyPriorTest, DrawnPlan_IsMovedToTheWallsAndKeepsItsRooms) {
  nlohmann::json plan = nlohmann::json::parse(content(arena_), nullptr, true, true);
  nlohmann::json truth = plan;
  // The first wall is drawn 4 cm off, another is invented.
  for (const char* end : {"from", "to"}) {
    for (int axis : {0, 1})
      plan["walls"][0][end][axis] = plan["walls"][0][end][axis].get<double>() + 0.04;
  }
  plan["walls"].push_back({{"from", {0.7, 1.25}}, {"to", {1.05, 1.25}}});
  std::ofstream(file("plan.json")) << plan;
  const CommandRun survey(
      {"survey", file("one.ndjson"), "--prior", file("plan.json"), "-o", file("better.json")});
  ASSERT_EQ(survey.exit_code, 0) << survey.err;
  const nlohmann::json better = nlohmann::json::parse(content(file("better.json")));
  EXPECT_EQ(better["name"], truth["name"]);
  EXPECT_EQ(better["rooms"].size(), truth["rooms"].size());
  EXPECT_NE(survey.out.find("walls of the plan were seen"), std::string::npos) << survey.out;
  for (const char* end : {"from", "to"}) {
    for (int axis : {0, 1}) {
      EXPECT_NEAR(better["walls"][0][end][axis], truth["walls"][0][end][axis], 0.015);
    }
  }
}

TEST_F(SurveyPriorTest, PlanOfAnotherBuilding_IsRefused) {
  const CommandRun survey({"survey", file("one.ndjson"), "--prior",
                           CORNERD_SOURCE_DIR "/config/maps/flat-7.json", "-o", file("no.json")});
  EXPECT_EQ(survey.exit_code, 1);
  EXPECT_NE(survey.err.find("does not fit the plan"), std::string::npos) << survey.err;
  EXPECT_FALSE(std::filesystem::exists(file("no.json")));
}

TEST_F(SurveyPriorTest, PlanAndStart_AreWrongUsage) {
  const CommandRun survey(
      {"survey", file("one.ndjson"), "--prior", arena_, "--start", "0,0,0", "-o", file("no.json")});
  EXPECT_EQ(survey.exit_code, 2);
  EXPECT_NE(survey.err.find("--start"), std::string::npos) << survey.err;
}

}  // namespace
}  // namespace cornerd::tool
