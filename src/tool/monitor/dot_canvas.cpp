// SPDX-License-Identifier: MIT
#include "tool/monitor/dot_canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cornerd::tool {

namespace {

/// Bits of U+2800 and following, by row and column of the dot in its cell.
constexpr std::array<std::array<std::uint8_t, 2>, 4> kBrailleBits = {
    {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
constexpr char32_t kBraille = 0x2800;

char32_t plain_glyph(Style style) { return style == Style::kWall ? U'#' : U'.'; }

/// The part of a line within [0, width] x [0, height]; false where there is none (Liang-Barsky).
bool clip(core::Vec2& from, core::Vec2& to, double width, double height) {
  const core::Vec2 direction = to - from;
  double begin = 0;
  double end = 1;
  const auto cut = [&](double step, double room) {
    if (step == 0) return room >= 0;
    const double share = room / step;
    if (step < 0) {
      begin = std::max(begin, share);
    } else {
      end = std::min(end, share);
    }
    return begin <= end;
  };
  if (!cut(-direction.x(), from.x()) || !cut(direction.x(), width - from.x()) ||
      !cut(-direction.y(), from.y()) || !cut(direction.y(), height - from.y())) {
    return false;
  }
  to = from + end * direction;
  from = from + begin * direction;
  return true;
}

}  // namespace

DotCanvas::DotCanvas(std::size_t columns, std::size_t rows, bool unicode)
    : columns_(columns),
      rows_(rows),
      dots_across_(unicode ? 2 : 1),
      dots_down_(unicode ? 4 : 1),
      cells_(columns * rows) {}

void DotCanvas::dot(double across, double down, Style style) {
  const double right = std::floor(across);
  const double below = std::floor(down);
  if (!(right >= 0 && right < static_cast<double>(width()))) return;
  if (!(below >= 0 && below < static_cast<double>(height()))) return;
  const auto x = static_cast<std::size_t>(right);
  const auto y = static_cast<std::size_t>(below);
  DotCell& cell = cells_[y / dots_down_ * columns_ + x / dots_across_];
  cell.dots |= kBrailleBits[y % dots_down_][x % dots_across_];
  cell.style = style;
}

void DotCanvas::line(const core::Vec2& from, const core::Vec2& to, Style style) {
  core::Vec2 begin = from;
  core::Vec2 end = to;
  if (!begin.allFinite() || !end.allFinite() ||
      !clip(begin, end, static_cast<double>(width()), static_cast<double>(height()))) {
    return;
  }
  const double steps = std::max(1.0, std::ceil((end - begin).cwiseAbs().maxCoeff()));
  for (double step = 0; step <= steps; ++step) {
    const core::Vec2 at = begin + step / steps * (end - begin);
    dot(at.x(), at.y(), style);
  }
}

void DotCanvas::draw_on(Frame& frame, std::size_t column, std::size_t row) const {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const DotCell& cell = cells_[i];
    if (cell.dots == 0) continue;
    const char32_t glyph = dots_across_ == 1 ? plain_glyph(cell.style) : kBraille + cell.dots;
    frame.put(column + i % columns_, row + i / columns_, {glyph, cell.style});
  }
}

}  // namespace cornerd::tool
