// SPDX-License-Identifier: MIT
#include "tool/monitor/frame.hpp"

#include <algorithm>

#include "message/json_text.hpp"

namespace cornerd::tool {

namespace {

/// Takes the first character off the text; U+FFFD where it is none.
char32_t take_glyph(std::string_view& text) {
  const std::size_t length = std::max<std::size_t>(message::utf8_length(text), 1);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  char32_t glyph = byte(0);
  if (length == 1 && glyph >= 0x80) glyph = 0xfffd;
  if (length > 1) {
    glyph &= 0x7fU >> length;
    for (std::size_t i = 1; i < length; ++i) glyph = glyph << 6 | (byte(i) & 0x3fU);
  }
  text.remove_prefix(length);
  return glyph;
}

/// The scripts that every terminal gives one cell a character: Latin, Greek, Cyrillic.
bool fits_one_cell(char32_t glyph) {
  return (glyph >= 0x20 && glyph < 0x7f) || (glyph >= 0xa1 && glyph < 0x300 && glyph != 0xad) ||
         (glyph >= 0x370 && glyph < 0x483);
}

std::size_t count_glyphs(std::string_view text) {
  std::size_t count = 0;
  for (; !text.empty(); ++count) take_glyph(text);
  return count;
}

/// Takes at most so many characters off the text.
std::string_view take_glyphs(std::string_view& text, std::size_t count) {
  std::string_view rest = text;
  for (; count > 0 && !rest.empty(); --count) take_glyph(rest);
  const std::string_view taken = text.substr(0, text.size() - rest.size());
  text = rest;
  return taken;
}

}  // namespace

Frame::Frame(std::size_t columns, std::size_t rows)
    : columns_(std::max<std::size_t>(columns, 1)),
      cells_(columns_ * std::max<std::size_t>(rows, 1)) {}

void Frame::put(std::size_t column, std::size_t row, Cell cell) {
  if (column < columns_ && row < rows()) cells_[row * columns_ + column] = cell;
}

std::size_t Frame::write(std::size_t column, std::size_t row, std::string_view text, Style style,
                         std::size_t end) {
  for (; !text.empty() && column < std::min(end, columns_); ++column) {
    const char32_t glyph = take_glyph(text);
    put(column, row, {fits_one_cell(glyph) ? glyph : U'?', style});
  }
  return column;
}

std::string Frame::text() const {
  std::string out;
  for (std::size_t row = 0; row < rows(); ++row) {
    std::string line;
    for (std::size_t column = 0; column < columns_; ++column) {
      append_utf8(line, at(column, row).glyph);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

void append_utf8(std::string& text, char32_t glyph) {
  const auto append = [&](char32_t byte) { text += static_cast<char>(byte); };
  if (glyph < 0x80) {
    append(glyph);
  } else if (glyph < 0x800) {
    append(0xc0 | glyph >> 6);
    append(0x80 | (glyph & 0x3f));
  } else {
    append(0xe0 | (glyph >> 12 & 0x0f));
    append(0x80 | (glyph >> 6 & 0x3f));
    append(0x80 | (glyph & 0x3f));
  }
}

std::vector<std::string> wrap_text(std::string_view text, std::size_t width) {
  width = std::max<std::size_t>(width, 1);
  std::vector<std::string> lines;
  std::size_t used = 0;
  while (!text.empty()) {
    std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (word.empty()) continue;
    if (!lines.empty() && used + 1 + count_glyphs(word) <= width) {
      lines.back() += ' ';
      ++used;
    } else {
      lines.emplace_back();
      used = 0;
    }
    while (!word.empty()) {
      if (used == width) {
        lines.emplace_back();
        used = 0;
      }
      const std::string_view piece = take_glyphs(word, width - used);
      lines.back() += piece;
      used += count_glyphs(piece);
    }
  }
  return lines;
}

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
    case Style::kWarning:
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
