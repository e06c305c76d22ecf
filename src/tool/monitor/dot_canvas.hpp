// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "tool/monitor/frame.hpp"

namespace cornerd::tool {

/// Dots on a terminal: eight square ones to a cell with Braille characters, else one to a cell. Dot
/// (0, 0) is the upper left.
class DotCanvas {
 public:
  DotCanvas(std::size_t columns, std::size_t rows, bool unicode);

  /// Size in dots.
  std::size_t width() const { return columns_ * dots_across_; }
  std::size_t height() const { return rows_ * dots_down_; }
  /// Height of a dot by its width, on a screen whose cells are twice as high as wide.
  double dot_aspect() const { return dots_across_ == 1 ? 2.0 : 1.0; }

  /// The last dot decides the style of its cell. Dots outside are ignored.
  void dot(double across, double down, Style style);
  void line(const core::Vec2& from, const core::Vec2& to, Style style);

  /// `column`, `row`: of its upper left cell.
  void draw_on(Frame& frame, std::size_t column, std::size_t row) const;

 private:
  struct DotCell {
    std::uint8_t dots = 0;
    Style style = Style::kPlain;
  };

  std::size_t columns_;
  std::size_t rows_;
  std::size_t dots_across_;
  std::size_t dots_down_;
  std::vector<DotCell> cells_;
};

}  // namespace cornerd::tool
