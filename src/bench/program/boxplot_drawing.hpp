// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

namespace cornerd::bench {

struct BoxplotSeries {
  std::string name;
  std::vector<double> values;
};

struct BoxplotTexts {
  std::string title;
  std::string subtitle;  ///< empty: none
  std::string axis;      ///< with its unit
};

/// Boxplots side by side over one axis from 0, as SVG. A series without values has a name only.
std::string draw_boxplots(const BoxplotTexts& texts, std::span<const BoxplotSeries> series);

}  // namespace cornerd::bench
