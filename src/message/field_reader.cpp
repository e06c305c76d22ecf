// SPDX-License-Identifier: MIT
#include "message/field_reader.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace cornerd::message {
namespace {

/// The messages nest at most three levels. The limit bounds the memory that parsing takes.
constexpr int kMaxDepth = 8;

bool nests_deeper(std::string_view text, int max_depth) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > max_depth) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

std::string shortest(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr};
}

std::string in_quotes(std::string_view name) { return "\"" + std::string(name) + "\""; }

}  // namespace

std::optional<Json> parse_object(std::string_view line, std::size_t max_bytes,
                                 RequestError& error) {
  if (line.size() > max_bytes) {
    error = {"too-long", "a line has at most " + std::to_string(max_bytes) + " bytes"};
    return std::nullopt;
  }
  if (nests_deeper(line, kMaxDepth)) {
    error = {"json", "nested deeper than " + std::to_string(kMaxDepth) + " levels"};
    return std::nullopt;
  }
  std::set<std::string> keys;
  std::string repeated;
  const auto note_key = [&](int depth, Json::parse_event_t event, const Json& key) {
    if (event != Json::parse_event_t::key || depth != 1) return true;
    if (!keys.insert(key).second) repeated = in_quotes(key.get<std::string>().substr(0, 64));
    return true;
  };
  Json parsed = Json::parse(line, note_key, /*allow_exceptions=*/false);
  if (!parsed.is_object()) {
    const bool has_nan = line.find("NaN") != line.npos || line.find("nan") != line.npos;
    error = {"json", std::string("not one JSON object in UTF-8 on a line of its own") +
                         (has_nan ? ": JSON has no NaN" : "")};
    return std::nullopt;
  }
  if (!repeated.empty()) {
    error = {"json", "the key " + repeated + " is there twice"};
    return std::nullopt;
  }
  return parsed;
}

void FieldReader::fail(const std::string& reason, std::string_view cause) {
  if (!error_) error_ = {"field", reason, cause};
}

const Json* FieldReader::find(const char* name) {
  const auto found = object_.find(name);
  if (found == object_.end()) {
    fail(in_quotes(name) + " is missing", kMissing);
    return nullptr;
  }
  return &*found;
}

void FieldReader::refuse_range(const std::string& name, Limits limits, double number) {
  // A thousand times too much is another unit: milliseconds, millimetres.
  const double share = std::abs(number) / 1000;
  const char* hint = "";
  if (limits.unit == std::string_view(kAngleLimitsRad.unit)) {
    hint = ", not degrees";
  } else if (*limits.unit != 0 && share > limits.high / 1000 && share <= limits.high) {
    hint = ", not thousandths of them";
  }
  fail(name + " must be from " + shortest(limits.low) + " to " + shortest(limits.high) +
           limits.unit + hint,
       kOutOfRange);
}

double FieldReader::check(const std::string& name, const Json& value, Limits limits) {
  if (!value.is_number()) {
    fail(name + " must be a number", kNotANumber);
    return 0;
  }
  const double number = value.get<double>();
  if (!(number >= limits.low && number <= limits.high)) {
    refuse_range(name, limits, number);
    return 0;
  }
  return number;
}

double FieldReader::number(const char* name, Limits limits) {
  const Json* value = find(name);
  return value == nullptr ? 0 : check(in_quotes(name), *value, limits);
}

std::optional<double> FieldReader::optional_number(const char* name, Limits limits) {
  if (!has(name)) return std::nullopt;
  return number(name, limits);
}

std::optional<std::int64_t> FieldReader::optional_integer(const char* name) {
  if (!has(name)) return std::nullopt;
  const Json& value = object_[name];
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(kMax)) {
    fail(in_quotes(name) + " must fit 64 bits", kOutOfRange);
    return std::nullopt;
  }
  if (value.is_number_integer()) return value.get<std::int64_t>();
  // JavaScript and Lua may write 12.0 or 1e6. Above 2^53 a double is not exact.
  constexpr double kLargestExact = 9007199254740992.0;
  const double number = check(in_quotes(name), value, {-kLargestExact, kLargestExact});
  if (number != std::floor(number)) fail(in_quotes(name) + " must be a whole number", kNotWhole);
  return error_ ? std::nullopt : std::optional(static_cast<std::int64_t>(number));
}

std::string_view FieldReader::text(const char* name) {
  const Json* value = find(name);
  if (value == nullptr) return {};
  if (!value->is_string()) {
    fail(in_quotes(name) + " must be a string");
    return {};
  }
  return value->get_ref<const std::string&>();
}

std::string_view FieldReader::optional_text(const char* name) {
  return has(name) ? text(name) : std::string_view();
}

const Json& FieldReader::optional_object(const char* name) {
  static const Json kEmpty = Json::object();
  if (!has(name)) return kEmpty;
  const Json& value = object_[name];
  if (value.is_object()) return value;
  fail(in_quotes(name) + " must be an object");
  return kEmpty;
}

const Json& FieldReader::array(const char* name, std::size_t max_size) {
  static const Json kEmpty = Json::array();
  const Json* value = find(name);
  if (value == nullptr) return kEmpty;
  if (!value->is_array()) {
    fail(in_quotes(name) + " must be an array");
    return kEmpty;
  }
  if (value->size() > max_size) {
    fail(in_quotes(name) + " has more than " + std::to_string(max_size) + " elements");
    return kEmpty;
  }
  return *value;
}

double FieldReader::element(const char* name, const Json& array, std::size_t index, Limits limits) {
  const Json& value = array[index];
  if (value.is_number()) {
    const double number = value.get<double>();
    if (number >= limits.low && number <= limits.high) return number;
  }
  return check(in_quotes(name) + "[" + std::to_string(index) + "]", value, limits);
}

}  // namespace cornerd::message
