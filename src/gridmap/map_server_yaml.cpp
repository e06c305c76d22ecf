// SPDX-License-Identifier: MIT
#include "gridmap/map_server_yaml.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>

#include "gridmap/image.hpp"

namespace cornerd::gridmap {
namespace {

struct Value {
  std::string scalar;
  std::vector<std::string> items;
  bool is_list = false;
};
using Keys = std::map<std::string, Value, std::less<>>;

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

[[noreturn]] void fail_at(std::size_t line, const std::string& reason) {
  throw GridError("line " + std::to_string(line) + ": " + reason);
}

/// The text without its comment: a # at the beginning or after white space, outside of quotes.
std::string_view without_comment(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '#' && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '\t')) {
      return text.substr(0, i);
    }
  }
  return text;
}

std::string read_scalar(std::string_view text, std::size_t line) {
  text = trim(text);
  if (text.empty()) return {};
  const char first = text.front();
  if (first == '"' || first == '\'') {
    const std::string_view inside =
        text.substr(1, text.size() - std::min<std::size_t>(2, text.size()));
    if (text.size() < 2 || text.back() != first) fail_at(line, "the quote is not closed");
    if (inside.find_first_of(first == '"' ? "\"\\" : "'") != std::string_view::npos) {
      fail_at(line, "escapes within quotes are not read");
    }
    return std::string(inside);
  }
  if (std::string_view("{}&*!|>%@`").find(first) != std::string_view::npos) {
    fail_at(line, "more YAML than a map_server's file is made of");
  }
  return std::string(text);
}

Value read_value(std::string_view text, std::size_t line) {
  text = trim(text);
  if (!text.starts_with('[')) return {.scalar = read_scalar(text, line), .items = {}};
  if (!text.ends_with(']')) fail_at(line, "more than a list");
  text = trim(text.substr(1, text.size() - 2));
  Value value{.scalar = {}, .items = {}, .is_list = true};
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    value.items.push_back(read_scalar(text.substr(0, comma), line));
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return value;
}

/// The lines of a text, without comments.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  bool is_end() const { return rest_.empty(); }
  std::string_view next() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = without_comment(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return line;
  }
  /// Of the line that came last, from 1 on.
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// A value that begins on the line that came last, and goes on until its brackets are closed.
Value read_value(std::string_view begin, Lines& lines) {
  const std::size_t number = lines.number();
  std::string text(trim(begin));
  if (text.starts_with('[')) {
    for (std::size_t searched = 0; text.find(']', searched) == std::string::npos;) {
      if (lines.is_end()) fail_at(number, "the list is not closed");
      searched = text.size();
      text.append(" ").append(trim(lines.next()));
    }
  }
  return read_value(text, number);
}

Keys read_keys(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Keys keys;
  Value* open = nullptr;  // a key without a value yet: its list may follow
  for (Lines lines(text); !lines.is_end();) {
    const std::string_view line = lines.next();
    const std::size_t number = lines.number();
    const std::string_view content = trim(line);
    if (content.empty() || content == "---" || content.starts_with("%YAML")) continue;
    if (content == "...") break;
    const bool is_indented = line.front() == ' ' || line.front() == '\t';
    if (is_indented && content.front() == '[' && open != nullptr && !open->is_list) {
      *open = read_value(content, lines);
      open = nullptr;
      continue;
    }
    if (content.starts_with("- ") || content.starts_with("-\t")) {
      if (open == nullptr) fail_at(number, "a list that belongs to no key");
      open->is_list = true;
      open->items.push_back(read_scalar(content.substr(2), number));
      continue;
    }
    if (is_indented) fail_at(number, "is indented");
    const std::size_t colon = content.find(':');
    if (colon == std::string_view::npos) fail_at(number, "is no `key: value`");
    if (colon + 1 < content.size() && content[colon + 1] != ' ' && content[colon + 1] != '\t') {
      fail_at(number, "no space after the colon");
    }
    std::string key = read_scalar(content.substr(0, colon), number);
    const auto [place, is_new] = keys.emplace(key, read_value(content.substr(colon + 1), lines));
    if (!is_new) throw GridError("this key is there twice", "/" + key);
    const bool is_empty = !place->second.is_list && place->second.scalar.empty();
    open = is_empty ? &place->second : nullptr;
  }
  return keys;
}

/// Takes known keys out and complains by their names.
class KeyReader {
 public:
  explicit KeyReader(Keys keys) : keys_(std::move(keys)) {}

  std::string text(const std::string& key) {
    const Value value = take(key);
    if (value.is_list || value.scalar.empty()) throw GridError("must be text", "/" + key);
    return value.scalar;
  }

  double number(const std::string& key, double low, double high) {
    const Value value = take(key);
    if (value.is_list) throw GridError("must be a number", "/" + key);
    return to_number(value.scalar, "/" + key, low, high);
  }

  bool flag(const std::string& key) {
    const std::string value = text(key);
    const auto is_any = [&](std::initializer_list<std::string_view> words) {
      return std::find(words.begin(), words.end(), value) != words.end();
    };
    // YAML 1.1's booleans, and the numbers that map_saver writes.
    if (is_any({"0", "n", "N", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"})) {
      return false;
    }
    if (is_any({"1", "y", "Y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"})) {
      return true;
    }
    throw GridError("must be 0 or 1, or a boolean", "/" + key);
  }

  core::Pose2 pose(const std::string& key) {
    const Value value = take(key);
    if (!value.is_list || value.items.size() != 3) {
      throw GridError("must be a list of x, y and yaw", "/" + key);
    }
    constexpr double kFarM = 10'000;
    double numbers[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const double limit = i < 2 ? kFarM : 1000;
      numbers[i] = to_number(value.items[i], "/" + key + "/" + std::to_string(i), -limit, limit);
    }
    return {numbers[0], numbers[1], core::normalize_angle(numbers[2])};
  }

  bool has(std::string_view key) const { return keys_.contains(key); }

  std::vector<std::string> rest() const {
    std::vector<std::string> names;
    for (const auto& [key, value] : keys_) names.push_back(key);
    return names;
  }

 private:
  Value take(const std::string& key) {
    const auto place = keys_.find(key);
    if (place == keys_.end()) throw GridError("is missing", "/" + key);
    Value value = std::move(place->second);
    keys_.erase(place);
    return value;
  }

  static double to_number(std::string_view text, const std::string& pointer, double low,
                          double high) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
      throw GridError("must be a number", pointer);
    }
    if (value < low || value > high) {
      char range[80];
      std::snprintf(range, sizeof range, "must be from %g to %g", low, high);
      throw GridError(range, pointer);
    }
    return value;
  }

  Keys keys_;
};

ShadeMode to_mode(const std::string& name) {
  if (name == "trinary") return ShadeMode::kTrinary;
  if (name == "scale") return ShadeMode::kScale;
  if (name == "raw") return ShadeMode::kRaw;
  throw GridError("must be trinary, scale or raw", "/mode");
}

}  // namespace

MapServerYaml parse_map_server_yaml(std::string_view text) {
  KeyReader keys(read_keys(text));
  MapServerYaml yaml;
  yaml.image = keys.text("image");
  yaml.resolution_m = keys.number("resolution", 1e-3, 10);
  yaml.T_map_picture = keys.pose("origin");
  yaml.negate = keys.flag("negate");
  yaml.occupied_threshold = keys.number("occupied_thresh", 0, 1);
  yaml.free_threshold = keys.number("free_thresh", 0, 1);
  if (yaml.free_threshold >= yaml.occupied_threshold) {
    throw GridError("must be below occupied_thresh", "/free_thresh");
  }
  if (keys.has("mode")) yaml.mode = to_mode(keys.text("mode"));
  yaml.unknown_keys = keys.rest();
  return yaml;
}

}  // namespace cornerd::gridmap
