// SPDX-License-Identifier: MIT
#include "tool/monitor/dot_canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cornerd::tool {
namespace {

std::string drawn(const DotCanvas& canvas) {
  Frame frame(6, 3);
  canvas.draw_on(frame, 1, 1);
  return frame.text();
}

TEST(DotCanvas, Dots_EightPerCell) {
  DotCanvas canvas(2, 1, /*unicode=*/true);
  EXPECT_EQ(canvas.width(), 4U);
  EXPECT_EQ(canvas.height(), 4U);
  canvas.dot(0, 0, Style::kWall);
  canvas.dot(1.9, 3.2, Style::kReturn);
  canvas.dot(3, 1, Style::kReturn);
  EXPECT_EQ(drawn(canvas), "\n ⢁⠐\n\n");
}

TEST(DotCanvas, LaterDot_SetsStyleOfCell) {
  DotCanvas canvas(1, 1, /*unicode=*/true);
  canvas.dot(0, 0, Style::kWall);
  canvas.dot(1, 0, Style::kReturn);
  Frame frame(1, 1);
  canvas.draw_on(frame, 0, 0);
  EXPECT_EQ(frame.at(0, 0), (Cell{U'⠉', Style::kReturn}));
}

TEST(DotCanvas, NoUnicode_OneDotPerCell) {
  DotCanvas canvas(3, 2, /*unicode=*/false);
  EXPECT_EQ(canvas.dot_aspect(), 2);
  canvas.line({0, 0}, {2.5, 0}, Style::kWall);
  canvas.dot(1, 1, Style::kReturn);
  EXPECT_EQ(drawn(canvas), "\n ###\n  .\n");
}

TEST(DotCanvas, Lines_AreClippedAtEdges) {
  DotCanvas canvas(3, 2, /*unicode=*/false);
  canvas.line({-1e9, 1.5}, {1e9, 1.5}, Style::kWall);
  canvas.line({-5, -1}, {5, -1}, Style::kWall);
  canvas.line({NAN, 0}, {1, 0}, Style::kWall);
  EXPECT_EQ(drawn(canvas), "\n\n ###\n");
}

TEST(DotCanvas, DotsOutside_AreIgnored) {
  DotCanvas canvas(1, 1, /*unicode=*/true);
  for (const double off : {-0.5, 4.0, 1e300, std::nan("")}) {
    canvas.dot(off, 0, Style::kWall);
    canvas.dot(0, off, Style::kWall);
  }
  EXPECT_EQ(drawn(canvas), "\n\n\n");
}

}  // namespace
}  // namespace cornerd::tool
