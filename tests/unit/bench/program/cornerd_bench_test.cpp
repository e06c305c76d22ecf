// SPDX-License-Identifier: MIT
// cornerd-bench as its users call it, at few poses.
#include "bench/program/cornerd_bench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/program_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/tool/xml_check.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::bench {
namespace {

using test::ProgramRun;
using testing::HasSubstr;
using testing::Not;
using tool::count_elements;
using tool::find_xml_error;

class BenchCommand : public testing::Test {
 protected:
  static ProgramRun run(std::vector<std::string> words,
                        const std::string& maps = CORNERD_SOURCE_DIR "/config/maps") {
    words.insert(words.begin(), {"--maps", maps});
    return {"cornerd-bench", run_cornerd_bench, words};
  }

  static std::string read(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  test::TemporaryFolder folder_;
};

TEST_F(BenchCommand, Scale_GivesTableDrawingAndJson) {
  const ProgramRun outcome = run({"--scale", "--corners", "60,120", "--positions", "6", "--plots",
                                  (folder_.path() / "plots").string(), "--json",
                                  (folder_.path() / "scale.json").string()});
  EXPECT_EQ(outcome.exit_code, tool::kExitDone);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("offices, about 120"));
  EXPECT_THAT(outcome.out, HasSubstr("equal rooms"));
  const auto figures = nlohmann::json::parse(read(folder_.path() / "scale.json"));
  ASSERT_EQ(figures["scale"].size(), 3U);
  EXPECT_EQ(figures["scale"][0]["scans"], 6);
  EXPECT_EQ(figures["scale"][0]["wrong"], 0);
  EXPECT_FALSE(figures["scale"][0].contains("instructions"));
  EXPECT_EQ(find_xml_error(read(folder_.path() / "plots/scale.svg")), "");
}

TEST_F(BenchCommand, WrongUsage_ExitCode2WithReasonOnStandardError) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--corners", "60"}, {"--positions", "-1"},   {"--positions", "nan"},
      {"--samples", "-3"}, {"--seed", "-1"},        {"--methods", "guess"},
      {"--nonsense"},      {"--scale", "--survey"}, {"word"},
  };
  for (const auto& words : wrong) {
    const ProgramRun outcome = run(words);
    EXPECT_EQ(outcome.exit_code, tool::kExitUsage) << testing::PrintToString(words);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
  }
}

TEST_F(BenchCommand, JsonOverMap_IsWrongUsage) {
  const std::filesystem::path map = folder_.path() / "krpai-2019-a.json";
  std::ofstream(map) << "{}";
  const ProgramRun outcome = run({"--json", map.string()}, folder_.path().string());
  EXPECT_EQ(outcome.exit_code, tool::kExitUsage);
  EXPECT_THAT(outcome.err, HasSubstr("is an input of this command"));
}

TEST_F(BenchCommand, Text_HasFiguresOfPaperAndOfCornerd) {
  const ProgramRun outcome = run({"--positions", "8"});
  EXPECT_EQ(outcome.exit_code, tool::kExitDone);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("Table I"));
  EXPECT_THAT(outcome.out, HasSubstr("(101.6 +- 2.6 ms)"));
  EXPECT_THAT(outcome.out, HasSubstr("(157 / 2)"));
  EXPECT_THAT(outcome.out, HasSubstr("11.20 +- 2.14"));
  EXPECT_THAT(outcome.out, HasSubstr("Corners at 8 random poses"));
  EXPECT_THAT(outcome.out, HasSubstr("sigma max(3 mm, 1 %), a third missing"));
}

TEST_F(BenchCommand, Json_HasAllFiguresWithoutText) {
  const ProgramRun outcome = run({"--positions", "8", "--methods", "altbd,lt", "--json", "-"});
  EXPECT_EQ(outcome.exit_code, tool::kExitDone);
  const auto figures = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(figures["samples"], 800);
  ASSERT_EQ(figures["paper_experiment"].size(), 2u);
  EXPECT_EQ(figures["paper_experiment"][1]["method"], "lt");
  EXPECT_EQ(figures["paper_experiment"][0]["poses"].size(), 43u);
  ASSERT_EQ(figures["corners"].size(), 4u);
  const auto& score = figures["corners"][0]["methods"][0];
  EXPECT_EQ(score["scans"], 8);
  EXPECT_GT(score["recall_supported"], 0.8);
}

TEST_F(BenchCommand, SameSeed_SameCorners) {
  const auto corners_of = [](const std::string& seed) {
    const ProgramRun outcome =
        run({"--positions", "8", "--methods", "altbd", "--json", "-", "--seed", seed});
    return nlohmann::json::parse(outcome.out)["corners"];
  };
  EXPECT_EQ(corners_of("5"), corners_of("5"));
  EXPECT_NE(corners_of("5"), corners_of("6"));
}

TEST_F(BenchCommand, Plots_AreDrawn) {
  const std::filesystem::path plots = folder_.path() / "new" / "plots";
  const ProgramRun outcome = run({"--positions", "0", "--plots", plots.string()});
  EXPECT_EQ(outcome.exit_code, tool::kExitDone);
  EXPECT_THAT(outcome.out, Not(HasSubstr("random poses")));
  for (const char* name : {"times", "positions", "scan-altbd", "scan-abd-iepf", "scan-lt"}) {
    const std::string picture = read(plots / (std::string(name) + ".svg"));
    EXPECT_EQ(find_xml_error(picture), "") << name;
    EXPECT_GT(count_elements(picture, "polygon"), 2u) << name;
  }
}

TEST_F(BenchCommand, UnwritableOutput_Fails) {
  std::ofstream(folder_.path() / "file") << "";
  const ProgramRun plots =
      run({"--positions", "0", "--plots", (folder_.path() / "file" / "plots").string()});
  EXPECT_EQ(plots.exit_code, tool::kExitFailed);
  EXPECT_NE(plots.err, "");
  const ProgramRun json = run({"--json", (folder_.path() / "absent" / "x.json").string()});
  EXPECT_EQ(json.exit_code, tool::kExitFailed);
  EXPECT_EQ(json.out, "");
}

TEST_F(BenchCommand, MissingMaps_ExitCode78) {
  const ProgramRun outcome = run({"--positions", "0"}, folder_.path().string());
  EXPECT_EQ(outcome.exit_code, tool::kExitConfig);
  EXPECT_THAT(outcome.err, HasSubstr("krpai-2019-a.json"));
}

}  // namespace
}  // namespace cornerd::bench
