// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::tool {

/// Lines of a label and cells, each column as wide as its widest cell.
class TextTable {
 public:
  void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  /// Every line indented by two spaces; the first column is flush left, the others too unless
  /// `numbers`.
  std::string text(bool numbers = false) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// printf to a string of at most 255 bytes.
__attribute__((format(printf, 1, 2))) inline std::string formatted(const char* format, ...) {
  std::array<char, 256> text{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return text.data();
}

}  // namespace cornerd::tool
