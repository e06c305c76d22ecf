// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tool/drawing/formatted.hpp"

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

}  // namespace cornerd::tool
