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

/// What a cell looks like besides its character. Colours are the terminal's own eight.
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

/// A terminal's screen as it is to be: cells by column and row from the upper left one.
class Frame {
 public:
  /// At least one cell each way.
  Frame(std::size_t columns, std::size_t rows);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return cells_.size() / columns_; }
  const Cell& at(std::size_t column, std::size_t row) const {
    return cells_[row * columns_ + column];
  }

  /// Nothing where it lies outside.
  void put(std::size_t column, std::size_t row, Cell cell);
  /// Text as far as there is room, to at most `end`. What would move the cursor, is wider than a
  /// cell or no UTF-8 is a '?'. Returns the column behind it.
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
  /// The screen has been lost or has another size: the next frame is drawn whole.
  void forget() { shown_.reset(); }

 private:
  void append_style(std::string& out, Style style) const;

  bool colours_;
  std::optional<Frame> shown_;
};

}  // namespace cornerd::tool
