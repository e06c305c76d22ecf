// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;

class CheckSettings : public testing::Test {
 protected:
  SettingsCheck check(const std::string& text) const {
    const std::filesystem::path file = folder_.path() / "cornerd.json";
    std::ofstream(file) << text;
    return check_settings(file, {});
  }
  test::TemporaryFolder folder_;
};

TEST_F(CheckSettings, ValidConfigAndMap_AreSummarized) {
  const auto found =
      check(R"({ "map": ")" CORNERD_SOURCE_DIR R"(/config/maps/krpai-2019-a.json" })");
  EXPECT_THAT(found.findings, ElementsAre(Finds(Verdict::kGood, "config", "cornerd.json"),
                                          Finds(Verdict::kGood, "map",
                                                "krpai-2019-a.json: 2.418 x 2.418 m, 14 walls")));
  EXPECT_EQ(found.error, nullptr);
}

TEST_F(CheckSettings, UnknownKey_IsNamedAndDefaultsStay) {
  const auto found = check(R"({ "lidar": { "devise": "x" } })");
  EXPECT_THAT(found.findings,
              ElementsAre(Finds(Verdict::kWrong, "config", "/lidar/devise: unknown key")));
  EXPECT_NE(found.error, nullptr);
  EXPECT_EQ(found.config.lidar.device, "/dev/ttyUSB0");
}

TEST_F(CheckSettings, WrongMap_IsNamed) {
  const auto found = check(R"({ "map": "nowhere.json" })");
  EXPECT_THAT(found.findings, ElementsAre(Finds(Verdict::kGood, "config", "cornerd.json"),
                                          Finds(Verdict::kWrong, "map", "nowhere.json")));
  EXPECT_NE(found.error, nullptr);
}

TEST_F(CheckSettings, NoMap_IsWrong) {
  EXPECT_THAT(check("{}").findings[1], Finds(Verdict::kWrong, "map", "names none"));
}

TEST_F(CheckSettings, MapWithTooFewCorners_IsWrong) {
  std::ofstream(folder_.path() / "line.json")
      << R"({ "format": "cornerd-map", "version": 1, "thickness": 0,
              "walls": [ { "from": [0, 0], "to": [1, 0] } ] })";
  EXPECT_THAT(check(R"({ "map": "line.json" })").findings[1],
              Finds(Verdict::kWrong, "map", "2 corners"));
}

TEST_F(CheckSettings, NoFile_DefaultsAreNoted) {
  EXPECT_THAT(check_settings({}, {}).findings[0], Finds(Verdict::kNote, "config", "default"));
}

}  // namespace
}  // namespace cornerd::tool
