// SPDX-License-Identifier: MIT
#include "tool/replay/truth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/temporary_folder.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;

constexpr core::TimeNs kSecond = core::kNsPerSecond;

TEST(Truth, BetweenTwoPoints_IsInterpolated) {
  const Truth truth({{kSecond, {1, 0, 0}}, {3 * kSecond, {2, 4, 1}}});
  const auto pose = truth.at(2 * kSecond);
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x_m, 1.5);
  EXPECT_DOUBLE_EQ(pose->y_m, 2);
  EXPECT_DOUBLE_EQ(pose->theta_rad, 0.5);
}

TEST(Truth, HeadingAcrossPi_TakesShorterRotation) {
  const Truth truth({{0, {0, 0, core::kPi - 0.1}}, {kSecond, {0, 0, -core::kPi + 0.3}}});
  EXPECT_NEAR(truth.at(kSecond / 2)->theta_rad, -core::kPi + 0.1, 1e-12);
}

TEST(Truth, TwoPointsOfOneTime_Jump) {
  const Truth truth(
      {{0, {1, 0, 0}}, {kSecond, {1, 0, 0}}, {kSecond, {9, 0, 0}}, {2 * kSecond, {9, 0, 0}}});
  EXPECT_DOUBLE_EQ(truth.at(kSecond - 1)->x_m, 1);
  EXPECT_DOUBLE_EQ(truth.at(kSecond)->x_m, 9);
}

TEST(Truth, OutsideItsTime_GivesNullopt) {
  const Truth truth({{kSecond, {1, 0, 0}}, {2 * kSecond, {1, 0, 0}}});
  EXPECT_FALSE(truth.at(kSecond - 1));
  EXPECT_TRUE(truth.at(kSecond));
  EXPECT_TRUE(truth.at(2 * kSecond + kSecond / 10));
  EXPECT_FALSE(truth.at(3 * kSecond));
}

class TruthFile : public testing::Test {
 protected:
  std::string problem_with(const std::string& text) {
    const auto file = folder_.path() / "truth.ndjson";
    std::ofstream(file) << text;
    try {
      Truth::load(file);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

TEST_F(TruthFile, ValidLines_AreRead) {
  EXPECT_EQ(problem_with("{\"t\":0,\"x\":1,\"y\":2,\"theta\":0}\n\n"
                         "{\"t\":1,\"x\":1,\"y\":2,\"theta\":0}\n"),
            "");
}

TEST_F(TruthFile, InvalidFiles_AreNamedWithTheirLine) {
  EXPECT_THAT(problem_with(""), HasSubstr("holds no pose"));
  EXPECT_THAT(problem_with("{\"t\":0,\"x\":1,\"y\":2,\"theta\":0}\nnonsense\n"),
              HasSubstr("truth.ndjson:2: "));
  EXPECT_THAT(problem_with("{\"t\":1,\"x\":1,\"y\":2,\"theta\":0}\n"
                           "{\"t\":0,\"x\":1,\"y\":2,\"theta\":0}\n"),
              HasSubstr("truth.ndjson:2: t goes back"));
}

TEST(TruthLoad, AbsentFile_IsNamed) {
  try {
    Truth::load("/nowhere/truth.ndjson");
    FAIL() << "loaded";
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("/nowhere/truth.ndjson: No such file"));
  }
}

}  // namespace
}  // namespace cornerd::tool
