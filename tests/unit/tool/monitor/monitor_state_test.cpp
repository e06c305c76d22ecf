// SPDX-License-Identifier: MIT
#include "tool/monitor/monitor_state.hpp"

#include <gtest/gtest.h>

#include "monitor/daemon_lines.hpp"

namespace cornerd::tool {
namespace {

TEST(MonitorState, Connection_HasAgeAndReason) {
  MonitorState state;
  state.lose("nobody there", 10 * core::kNsPerSecond);
  state.lose("still nobody", 14 * core::kNsPerSecond);
  EXPECT_FALSE(state.is_connected());
  EXPECT_EQ(state.reason(), "still nobody");
  EXPECT_EQ(state.connection_age_s(15 * core::kNsPerSecond), 5);
  state.connect(20 * core::kNsPerSecond);
  EXPECT_TRUE(state.is_connected());
  EXPECT_EQ(state.silence_s(23 * core::kNsPerSecond), 3);
  state.take_line(kVersionLine, 22 * core::kNsPerSecond);
  EXPECT_EQ(state.silence_s(23 * core::kNsPerSecond), 1);
  EXPECT_EQ(state.version(), "1.2.3");
}

TEST(MonitorState, LostDaemon_ClearsItsState) {
  MonitorState state;
  state.connect(0);
  state.take_line(kFixLine, 1);
  state.take_line(status_line(), 1);
  state.take_line(R"({"class":"EVENT","t":1,"what":"device found"})", 1);
  state.lose("gone", 2);
  EXPECT_FALSE(state.pose());
  EXPECT_FALSE(state.status());
  EXPECT_EQ(state.recent(), 0U);
  EXPECT_EQ(state.events().size(), 1U);
}

TEST(MonitorState, Scan_GetsPoseBeforeIt) {
  MonitorState state;
  state.connect(0);
  state.take_line(kFixLine, 1);
  state.take_line(R"({"class":"SCAN","t":100.4,"duration":0.1,"angles":[0],"ranges":[1]})", 1);
  state.take_line(R"({"class":"BREAKPOINTS","t":100.4,"points":[{"x":1,"y":0,"kind":"corner"}]})",
                  1);
  ASSERT_TRUE(state.scan());
  ASSERT_TRUE(state.scan()->T_map_base);
  EXPECT_EQ(state.scan()->T_map_base->y_m, 0.5);
  EXPECT_EQ(state.breakpoints().points.size(), 1U);
  state.take_line(kLostLine, 2);
  state.take_line(R"({"class":"SCAN","t":100.5,"duration":0.1,"angles":[0],"ranges":[1]})", 2);
  EXPECT_FALSE(state.scan()->T_map_base);
  EXPECT_TRUE(state.breakpoints().points.empty());
}

TEST(MonitorState, Rate_IsOfLastPoses) {
  MonitorState state;
  state.connect(0);
  EXPECT_FALSE(state.pose_rate_hz(0));
  core::TimeNs now_ns = 0;
  for (int i = 0; i < 100; ++i) state.take_line(kFixLine, now_ns += core::kNsPerSecond);
  for (int i = 0; i < 22; ++i) state.take_line(kLostLine, now_ns += core::kNsPerSecond / 8);
  EXPECT_EQ(state.pose_rate_hz(now_ns), 8);
  EXPECT_EQ(state.recent(), 100U);
  EXPECT_EQ(state.recent(core::PoseState::kLost), 22U);
  EXPECT_EQ(state.recent(core::PoseState::kFix), 78U);
  EXPECT_FALSE(state.pose_rate_hz(now_ns + 3 * core::kNsPerSecond));
}

TEST(MonitorState, InvalidMessage_SetsProtocolError) {
  MonitorState state;
  state.connect(0);
  state.take_line("hello", 1);
  EXPECT_NE(state.protocol_error(), "");
  state.take_line(R"({"class":"ERROR","code":"too-many-clients","message":"no more"})", 1);
  EXPECT_EQ(state.protocol_error(), "too-many-clients: no more");
}

TEST(MonitorState, ManyEvents_NewestFirstAndLimited) {
  MonitorState state;
  for (int i = 0; i < 60; ++i) {
    state.take_line(R"({"class":"EVENT","t":1,"what":"e)" + std::to_string(i) + "\"}", 1);
  }
  EXPECT_EQ(state.events().size(), 50U);
  EXPECT_EQ(state.events().front().what, "e59");
}

}  // namespace
}  // namespace cornerd::tool
