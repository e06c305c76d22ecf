// SPDX-License-Identifier: MIT
#include "tool/monitor/pose_panel.hpp"

#include <gtest/gtest.h>

#include "monitor/daemon_lines.hpp"

namespace cornerd::tool {
namespace {

std::string text_of(const MonitorState& state, core::TimeNs now_ns) {
  std::string text;
  for (const PanelLine& line : panel_lines(state, now_ns)) text += line.text + '\n';
  return text;
}

TEST(PosePanel, Fix_ShowsSigmaAndSource) {
  MonitorState state;
  state.connect(0);
  for (int i = 1; i <= 5; ++i) state.take_line(kFixLine, i * core::kNsPerSecond / 8);
  state.take_line(
      status_line(R"("state":"running","model":"A1M8","firmware":"1.29","mode":"Express",)"
                  R"("health":"good","rate_hz":7.1,"samples_hz":1923.4)",
                  R"(,"odometry":{"state":"running"},"latency":{"p50":0.0012,"p95":0.002,)"
                  R"("p99":0.0034})"),
      core::kNsPerSecond);
  state.take_line(R"({"class":"EVENT","t":98,"what":"device found","detail":"running"})", 0);
  state.take_line(R"({"class":"EVENT","t":100.5,"what":"state change","detail":"lost -> fix"})", 0);
  EXPECT_EQ(text_of(state, core::kNsPerSecond),
            "fix  hall\n"
            "x         1.000 m   +- 0.20 mm\n"
            "y         0.500 m   +- 0.10 mm\n"
            "theta      0.00 deg +- 0.06 deg\n"
            "corners 4, inliers 210\n"
            "rmse 2.1 mm  age 0.4 s\n"
            "wrong once in 500000\n"
            "\n"
            "poses 8.0/s  scans 7.1/s\n"
            "samples 1923/s\n"
            "latency 1.2 ms, 99 %: 3.4 ms\n"
            "last 5: 5 fix\n"
            "\n"
            "lidar running\n"
            "A1M8 1.29 Express good\n"
            "odometry running\n"
            "\n"
            "   0 s  lost -> fix\n"
            "   3 s  device found\n");
}

TEST(PosePanel, PoseWithoutSuccessor_AgesAndIsStale) {
  MonitorState state;
  state.connect(0);
  state.take_line(kFixLine, 0);
  EXPECT_EQ(panel_lines(state, core::kNsPerSecond)[0].style, Style::kGood);
  const auto lines = panel_lines(state, 3 * core::kNsPerSecond);
  EXPECT_EQ(lines[0].text, "stale fix  hall");
  EXPECT_EQ(lines[5].text, "rmse 2.1 mm  age 3.0 s");
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(lines[i].style, Style::kDim) << lines[i].text;
  state.take_line(kFixLine, 3 * core::kNsPerSecond);
  EXPECT_EQ(panel_lines(state, 3 * core::kNsPerSecond)[0].text, "fix  hall");
}

TEST(PosePanel, AmbiguousPose_ListsItsHypotheses) {
  MonitorState state;
  state.connect(0);
  state.take_line(kAmbiguousLine, 0);
  EXPECT_EQ(text_of(state, 0),
            "ambiguous\n"
            "? 0.50, 0.25 m    0 deg  0.60\n"
            "? 1.50, 0.75 m  180 deg  0.40\n"
            "corners 4, inliers 0\n"
            "\n"
            "last 1: 1 ambiguous\n"
            "\n");
}

TEST(PosePanel, NoDaemon_IsShown) {
  EXPECT_EQ(panel_lines(MonitorState(), 0)[0].text, "no daemon");
}

TEST(AgeText, Unit_FollowsAge) {
  EXPECT_EQ(age_text(99.9), "99 s");
  EXPECT_EQ(age_text(100), "1 min");
  EXPECT_EQ(age_text(6000), "1 h");
  EXPECT_EQ(age_text(-1), "");
}

}  // namespace
}  // namespace cornerd::tool
