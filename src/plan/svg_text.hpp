// SPDX-License-Identifier: MIT
// Values of SVG's attributes: https://www.w3.org/TR/SVG2/
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace cornerd::plan {

/// x' = matrix * x + offset
struct Affine {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
  core::Vec2 offset = core::Vec2::Zero();

  core::Vec2 operator*(const core::Vec2& point) const { return matrix * point + offset; }
  Affine operator*(const Affine& inner) const {
    return {matrix * inner.matrix, matrix * inner.offset + offset};
  }
};

/// Reads numbers one after the other, as they may stand in attributes: "1-2.5.5e1,3".
class NumberReader {
 public:
  explicit NumberReader(std::string_view text) : whole_(text), text_(text) {}

  /// Without spaces and commas; 0 at the end.
  char peek();
  void skip() { text_.remove_prefix(text_.empty() ? 0 : 1); }
  /// Throws PlanError.
  double number();
  /// "0" or "1", which need no separator behind them.
  bool flag();
  bool has_number();
  std::string_view rest() const { return text_; }

 private:
  std::string_view whole_;
  std::string_view text_;
};

/// A list of numbers, as of `points` and `viewBox`. Throws PlanError.
std::vector<double> number_list(std::string_view text);

/// The attribute `transform`: any number of matrix, translate, scale, rotate, skewX and skewY.
/// Throws PlanError.
Affine parse_transform(std::string_view text);

/// A length with one of CSS's absolute units, metres; nullopt for another unit or none. "px" counts
/// as none: it is what programs write that do not know the size.
std::optional<double> parse_length(std::string_view text);

/// The attribute `d`: the points of each subpath, closed ones ending where they begin. Curves are
/// chords. Throws PlanError.
std::vector<std::vector<core::Vec2>> parse_path(std::string_view text);

}  // namespace cornerd::plan
