// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tool/monitor/frame.hpp"

namespace cornerd::tool {

/// The look of a cell, in the terminal's eight colours.
enum class Style : std::uint8_t {
  kPlain,
  kDim,
  kBold,
  kTitle,
  kGood,
  kWarning,
  kBad,
  kWall,
  kReturn,
  kMark,
  kRobot
};

struct Cell {
  char32_t glyph = U' ';
  Style style = Style::kPlain;
  bool operator==(const Cell&) const = default;
};

/// The content of a terminal's screen: cells by column and row from the upper left.
class Frame {
 public:
  /// At least one column and one row.
  Frame(std::size_t columns, std::size_t rows);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return cells_.size() / columns_; }
  const Cell& at(std::size_t column, std::size_t row) const {
    return cells_[row * columns_ + column];
  }

  /// Ignores cells outside.
  void put(std::size_t column, std::size_t row, Cell cell);
  /// Writes text up to the column `end`. Control characters, wide characters and invalid UTF-8
  /// become '?'. Returns the column behind the text.
  std::size_t write(std::size_t column, std::size_t row, std::string_view text,
                    Style style = Style::kPlain, std::size_t end = SIZE_MAX);

  /// Its lines without styles and without the blanks at their ends, each with a newline.
  std::string text() const;

  bool operator==(const Frame&) const = default;

 private:
  std::size_t columns_;
  std::vector<Cell> cells_;
};

/// Appends a character as UTF-8.
void append_utf8(std::string& text, char32_t glyph);

/// Lines of at most `width` characters, broken between words where that is possible.
std::vector<std::string> wrap_text(std::string_view text, std::size_t width);

/// Encodes frames as ECMA-48 sequences (xterm, tmux, the Linux console):
/// only the cells that differ from the frame before.
class FrameEncoder {
 public:
  explicit FrameEncoder(bool colours) : colours_(colours) {}

  std::string encode(const Frame& frame);
  /// The next frame is drawn completely.
  void forget() { shown_.reset(); }

 private:
  void append_style(std::string& out, Style style) const;

  bool colours_;
  std::optional<Frame> shown_;
};

}  // namespace cornerd::tool
