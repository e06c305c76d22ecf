// SPDX-License-Identifier: MIT
#include "tool/monitor/screen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "monitor/daemon_lines.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A room of 2 x 1 m.
core::FloorPlan room() {
  core::FloorPlan plan;
  plan.name = "hall";
  plan.walls = {{{0, 0}, {2, 0}, 0}, {{2, 0}, {2, 1}, 0}, {{2, 1}, {0, 1}, 0}, {{0, 1}, {0, 0}, 0}};
  return plan;
}

class Screen : public testing::Test {
 protected:
  Screen() : map_(room()), scene_{&map_, {}} {
    state_.connect(0);
    state_.take_line(kVersionLine, 0);
    state_.take_line(status_line(), 0);
    choice_.unicode = false;
  }
  /// One scan that sees the walls ahead and behind, and a corner.
  void receive_scan(const std::string& pose) {
    state_.take_line(pose, 0);
    state_.take_line(
        R"({"class":"SCAN","t":100.4,"duration":0.1,"angles":[0,3.14159],"ranges":[0.5,0.5]})", 0);
    state_.take_line(
        R"({"class":"BREAKPOINTS","t":100.4,"points":[{"x":0.95,"y":0.45,"kind":"corner"},)"
        R"({"x":-0.5,"y":-0.25,"kind":"terminal"}]})",
        0);
  }
  std::string shown(std::size_t columns, std::size_t rows) const {
    return draw_screen(state_, scene_, choice_, columns, rows, 0).text();
  }

  core::WallMap map_;
  Scene scene_;
  ViewChoice choice_;
  MonitorState state_;
};

TEST_F(Screen, Fix_IsDrawnInMap) {
  receive_scan(kFixLine);
  EXPECT_EQ("\n" + shown(64, 14), R"(
 cornerd 1.2.3  hall                                  fix  hall
                                fix  hall
############################### x         1.000 m   +- 0.20 mm
#                            o# y         0.500 m   +- 0.10 mm
#                             # theta      0.00 deg +- 0.06 deg
#                             # corners 4, inliers 210
#       .      >       .      # rmse 2.1 mm  age 0.0 s
#                             # wrong once in 500000
#       x                     #
#                             # last 1: 1 fix
###############################
                                lidar running
all is well
q quit  + - zoom  l lidar's view  a ASCII         |------| 0.5 m
)");
}

TEST_F(Screen, Unicode_IsDrawnInBraille) {
  choice_.unicode = true;
  receive_scan(kFixLine);
  EXPECT_EQ("\n" + shown(64, 14), R"(
 cornerd 1.2.3  hall                                  fix  hall
                                fix  hall
⡤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⠤⢤ x         1.000 m   +- 0.20 mm
⡇                            o⢸ y         0.500 m   +- 0.10 mm
⡇                             ⢸ theta      0.00 deg +- 0.06 deg
⡇                             ⢸ corners 4, inliers 210
⡇      ⠐       →       ⠄      ⢸ rmse 2.1 mm  age 0.0 s
⡇                             ⢸ wrong once in 500000
⡇      x                      ⢸
⡇                             ⢸ last 1: 1 fix
⠓⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠚
                                lidar running
all is well
q quit  + - zoom  l lidar's view  a ASCII         |------| 0.5 m
)");
}

TEST_F(Screen, NarrowScreen_PanelIsAboveMap) {
  receive_scan(kFixLine);
  EXPECT_EQ("\n" + shown(30, 20), R"(
 cornerd 1.2.3  hall
fix  hall
x         1.000 m   +- 0.20 mm
y         0.500 m   +- 0.10 mm
theta      0.00 deg +- 0.06 de
corners 4, inliers 210
rmse 2.1 mm  age 0.0 s
##############################
#                           o#
#                            #
#                            #
#      .       >      .      #
#                            #
#      x                     #
#                            #
##############################
all is well


q quit  + - zoom  l lidar's vi
)");
}

TEST_F(Screen, LidarView_IsCentredOnLidar) {
  receive_scan(kLostLine);
  choice_.lidar_view = true;
  EXPECT_EQ("\n" + shown(64, 12), R"(
 cornerd 1.2.3  hall                                       lost
                              o lost
                                corners 1, inliers 0
                                age 3.5 s

       .       >       .        last 1: 1 lost

       x                        lidar running


no pose in the map fits the scan
q quit  + - zoom  l lidar's view  a ASCII         |------| 0.5 m
)");
}

TEST_F(Screen, LidarView_OutlierDoesNotShrinkTheRoom) {
  const auto scale_of = [this](double last_range_m) {
    std::string angles;
    std::string ranges;
    for (int i = 0; i < 30; ++i) {
      angles += (i == 0 ? "" : ",") + std::to_string(0.2 * i);
      ranges += (i == 0 ? "" : ",") + std::to_string(i < 29 ? 0.5 : last_range_m);
    }
    state_.take_line(R"({"class":"SCAN","t":100.4,"duration":0.1,"angles":[)" + angles +
                         R"(],"ranges":[)" + ranges + "]}",
                     0);
    const std::string screen = shown(64, 12);
    return screen.substr(screen.find('|'));
  };
  choice_.lidar_view = true;
  EXPECT_EQ(scale_of(11), scale_of(0.5));
}

TEST_F(Screen, AnySize_IsFilled) {
  receive_scan(kFixLine);
  for (std::size_t columns = 1; columns < 140; columns += 7) {
    for (std::size_t rows = 1; rows < 60; ++rows) {
      const Frame frame = draw_screen(state_, scene_, choice_, columns, rows, 0);
      ASSERT_EQ(frame.columns(), columns);
      ASSERT_EQ(frame.rows(), rows);
    }
  }
}

TEST_F(Screen, AmbiguousPose_MarksItsHypotheses) {
  receive_scan(kAmbiguousLine);
  const std::string text = shown(80, 24);
  const std::size_t map_marks = static_cast<std::size_t>(std::count(text.begin(), text.end(), '?'));
  EXPECT_EQ(map_marks, 4U);  // two on the map, two beside it
  EXPECT_THAT(text, HasSubstr("2 poses fit"));
}

TEST_F(Screen, Zoom_CentresRobot) {
  state_.take_line(kPredictedLine, 0);
  choice_.zoom = 2;
  const Frame frame = draw_screen(state_, scene_, choice_, 80, 24, 0);
  // 47 columns of map, 19 rows below the title.
  EXPECT_EQ(frame.at(23, 10), (Cell{U'^', Style::kRobot}));
  EXPECT_THAT(frame.text(), Not(HasSubstr("#")));
}

TEST_F(Screen, NoDaemon_HasRemedy) {
  state_.lose("/run/cornerd/pose.sock: No such file or directory", 0);
  const std::string text = shown(80, 24);
  EXPECT_THAT(text, HasSubstr("no daemon since 0 s: /run/cornerd/pose.sock: No such file"));
  EXPECT_THAT(text, HasSubstr("systemctl start cornerd"));
}

TEST_F(Screen, LongDetail_Fits80By24) {
  std::string detail;
  for (int i = 0; i < 23; ++i) detail += "ten chars ";
  detail += "the end";
  state_.take_line(status_line(R"("state":"faulty","detail":")" + detail + '"'), 0);
  EXPECT_THAT(shown(80, 24), HasSubstr("the end\n"));
}

TEST_F(Screen, EscapeSequencesInNames_AreReplaced) {
  state_.take_line(status_line(R"("state":"\u001b]0;owned\u0007","detail":"\u001b[2J")"), 0);
  for (const char c : shown(80, 24)) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= ' ');
}

}  // namespace
}  // namespace cornerd::tool
