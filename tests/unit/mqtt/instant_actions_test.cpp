// SPDX-License-Identifier: MIT
#include "mqtt/instant_actions.hpp"

#include <gtest/gtest.h>

namespace cornerd::mqtt {
namespace {

std::string init(const std::string& x) {
  return R"({"actions":[{"actionType":"initPosition","actionId":"a","blockingType":"NONE",)"
         R"("actionParameters":[{"key":"x","value":)" +
         x +
         R"(},{"key":"y","value":"2.5"},{"key":"theta","value":1},{"key":"mapId","value":"m"},)"
         R"({"key":"lastNodeId","value":"n"}]}]})";
}

TEST(InstantActions, InitPosition_HasPoseMapAndNode) {
  const InstantActions parsed = parse_instant_actions(init("1.5"));
  ASSERT_EQ(parsed.actions.size(), 1u) << parsed.problem;
  const InstantAction& action = parsed.actions[0];
  EXPECT_TRUE(action.problem.empty()) << action.problem;
  EXPECT_EQ(action.id, "a");
  EXPECT_DOUBLE_EQ(action.T_map_base.x_m, 1.5);
  EXPECT_DOUBLE_EQ(action.T_map_base.y_m, 2.5);
  EXPECT_DOUBLE_EQ(action.T_map_base.theta_rad, 1);
  EXPECT_EQ(action.map, "m");
  EXPECT_EQ(action.last_node, "n");
}

TEST(InstantActions, WrongNumber_FailsTheActionAlone) {
  for (const char* x : {"null", "[1]", "\"one\"", "1e9", "\"1e400\"", "\"\"", "true", "{}"}) {
    const InstantActions parsed = parse_instant_actions(init(x));
    ASSERT_EQ(parsed.actions.size(), 1u) << x;
    EXPECT_NE(parsed.actions[0].problem.find("parameter x"), std::string::npos) << x;
  }
}

TEST(InstantActions, NameOfVersion1_IsReadToo) {
  const InstantActions parsed =
      parse_instant_actions(R"({"instantActions":[{"actionType":"stateRequest","actionId":"s"}]})");
  ASSERT_EQ(parsed.actions.size(), 1u);
  EXPECT_EQ(parsed.actions[0].type, "stateRequest");
}

TEST(InstantActions, Garbage_IsRefusedWhole) {
  std::string many = R"({"actions":[)";
  for (std::size_t i = 0; i <= kMaxActions; ++i) many += R"({"actionType":"t","actionId":"i"},)";
  many.back() = ']';
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{}"), std::string("\xff\xfe"),
        std::string(R"({"actions":{}})"), std::string(R"({"actions":[1]})"),
        std::string(R"({"actions":[{"actionType":1,"actionId":"i"}]})"),
        R"({"actions":[{"actionType":"t","actionId":")" + std::string(kMaxIdBytes + 1, 'i') +
            "\"}]}",
        many + "}", std::string(100'000, '['), std::string(100'000, ' ') + "{}"}) {
    const InstantActions parsed = parse_instant_actions(text);
    EXPECT_TRUE(parsed.actions.empty()) << text.substr(0, 80);
    EXPECT_FALSE(parsed.problem.empty()) << text.substr(0, 80);
  }
}

}  // namespace
}  // namespace cornerd::mqtt
