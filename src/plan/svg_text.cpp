// SPDX-License-Identifier: MIT
#include "plan/svg_text.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "plan/drawing.hpp"

namespace cornerd::plan {

namespace {

using core::Vec2;

/// "100.25mm": what is longer is a list of numbers.
constexpr std::size_t kLongestLength = 12;

std::string excerpt(std::string_view text) {
  std::string shown(text.substr(0, 20));
  for (char& c : shown) {
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = ' ';
  }
  return "\"" + shown + "\"";
}

bool is_separator(char c) {
  return c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

Affine one_transform(std::string_view name, const std::vector<double>& values) {
  const auto require = [&](std::size_t low, std::size_t high) {
    if (values.size() < low || values.size() > high)
      throw PlanError("transform " + excerpt(name) + " has a wrong number of values");
  };
  Affine result;
  if (name == "matrix") {
    require(6, 6);
    result.matrix << values[0], values[2], values[1], values[3];
    result.offset = {values[4], values[5]};
  } else if (name == "translate") {
    require(1, 2);
    result.offset = {values[0], values.size() > 1 ? values[1] : 0};
  } else if (name == "scale") {
    require(1, 2);
    result.matrix = Vec2(values[0], values.back()).asDiagonal();
  } else if (name == "rotate") {
    require(1, 3);
    if (values.size() == 2) require(3, 3);
    const Vec2 x = core::unit_vector(core::radians(values[0]));
    result.matrix << x.x(), -x.y(), x.y(), x.x();
    if (values.size() == 3) {
      const Vec2 centre(values[1], values[2]);
      result.offset = centre - result.matrix * centre;
    }
  } else if (name == "skewX" || name == "skewY") {
    require(1, 1);
    result.matrix(name == "skewX" ? 0 : 1, name == "skewX" ? 1 : 0) =
        std::tan(core::radians(values[0]));
  } else {
    throw PlanError("transform " + excerpt(name) + " is unknown");
  }
  return result;
}

}  // namespace

char NumberReader::peek() {
  while (!text_.empty() && is_separator(text_.front())) text_.remove_prefix(1);
  return text_.empty() ? '\0' : text_.front();
}

bool NumberReader::has_number() {
  const char c = peek();
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

double NumberReader::number() {
  std::string_view digits = text_;
  if (peek() == '+') text_.remove_prefix(1);
  digits = text_;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) {
    const bool is_unit = digits.size() < whole_.size() && whole_.size() <= kLongestLength;
    throw PlanError(excerpt(digits) + (is_unit ? " in " + excerpt(whole_) : "") +
                    " is not a number; shapes are in user units, without one of their own");
  }
  text_.remove_prefix(static_cast<std::size_t>(end - digits.data()));
  return value;
}

bool NumberReader::flag() {
  const char c = peek();
  if (c != '0' && c != '1') throw PlanError(excerpt(text_) + " is not a flag of an arc");
  skip();
  return c == '1';
}

std::vector<double> number_list(std::string_view text) {
  NumberReader reader(text);
  std::vector<double> values;
  while (reader.peek() != '\0') values.push_back(reader.number());
  return values;
}

Affine parse_transform(std::string_view text) {
  Affine result;
  while (true) {
    while (!text.empty() && is_separator(text.front())) text.remove_prefix(1);
    if (text.empty() || text == "none") return result;
    const std::size_t open = text.find('(');
    const std::size_t close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open)
      throw PlanError("transform " + excerpt(text) + " has no value in parentheses");
    std::string_view name = text.substr(0, open);
    while (!name.empty() && is_separator(name.back())) name.remove_suffix(1);
    result = result * one_transform(name, number_list(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
  }
}

std::optional<double> parse_length(std::string_view text) {
  constexpr double kInch_m = 0.0254;
  constexpr std::pair<std::string_view, double> kUnits_m[] = {
      {"mm", 1e-3},         {"cm", 1e-2},        {"m", 1},      {"in", kInch_m},
      {"pt", kInch_m / 72}, {"pc", kInch_m / 6}, {"Q", 0.25e-3}};
  NumberReader reader(text);
  if (!reader.has_number()) return std::nullopt;
  const double value = reader.number();
  reader.peek();
  std::string_view unit = reader.rest();
  while (!unit.empty() && is_separator(unit.back())) unit.remove_suffix(1);
  for (const auto& [name, metres] : kUnits_m) {
    if (unit == name && value > 0) return value * metres;
  }
  return std::nullopt;
}

}  // namespace cornerd::plan
