// SPDX-License-Identifier: MIT
#include "tool/monitor/frame_encoder.hpp"

namespace cornerd::tool {

namespace {

/// Parameters of "select graphic rendition" (ECMA-48, 8.3.117), reset first.
const char* rendition(Style style, bool colours) {
  switch (style) {
    case Style::kPlain:
      return "0";
    case Style::kDim:
      return colours ? "0;2" : "0";
    case Style::kBold:
      return "0;1";
    case Style::kTitle:
      return "0;7";
    case Style::kGood:
      return colours ? "0;32" : "0";
    case Style::kDoubt:
      return colours ? "0;33" : "0;1";
    case Style::kBad:
      return colours ? "0;1;31" : "0;1";
    case Style::kWall:
      return "0";
    case Style::kReturn:
      return colours ? "0;32" : "0";
    case Style::kMark:
      return colours ? "0;1;35" : "0;1";
    case Style::kRobot:
      return colours ? "0;1;31" : "0;1";
  }
  return "0";
}

}  // namespace

void FrameEncoder::append_style(std::string& out, Style style) const {
  out += "\x1b[";
  out += rendition(style, colours_);
  out += 'm';
}

std::string FrameEncoder::encode(const Frame& frame) {
  const bool whole =
      !shown_ || shown_->columns() != frame.columns() || shown_->rows() != frame.rows();
  std::string out;
  if (whole) out += "\x1b[0m\x1b[2J";
  std::optional<Style> style;
  for (std::size_t row = 0; row < frame.rows(); ++row) {
    // Where the cursor is: behind the last cell that was drawn. A row's last cell leaves it
    // undefined.
    std::optional<std::size_t> cursor;
    for (std::size_t column = 0; column < frame.columns(); ++column) {
      const Cell& cell = frame.at(column, row);
      if (cell == (whole ? Cell() : shown_->at(column, row))) continue;
      if (cursor != column) {
        out += "\x1b[" + std::to_string(row + 1) + ';' + std::to_string(column + 1) + 'H';
      }
      if (style != cell.style) append_style(out, cell.style);
      style = cell.style;
      append_utf8(out, cell.glyph);
      cursor = column + 1;
    }
  }
  if (style && *style != Style::kPlain) append_style(out, Style::kPlain);
  shown_ = frame;
  return out;
}

}  // namespace cornerd::tool
