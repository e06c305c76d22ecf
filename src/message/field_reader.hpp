// SPDX-License-Identifier: MIT
// Reads untrusted JSON objects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/types.hpp"
#include "message/request.hpp"

namespace cornerd::message {

using Json = nlohmann::json;

struct Limits {
  double low = 0;
  double high = 0;
  const char* unit = "";  ///< for a message, after the numbers
};

/// UNIX time or time since the start of a recording; in nanoseconds it fits 64 bits.
inline constexpr Limits kTimeLimitsS{-9e9, 9e9, " seconds"};
inline constexpr Limits kCoordinateLimitsM{-1e5, 1e5, " metres"};
/// Slightly more than 2 pi, so that most angles in degrees are refused.
inline constexpr Limits kAngleLimitsRad{-6.3, 6.3, " radians"};

/// Parses one line. Returns nullopt and sets `error` if the line is too long, nested too deeply,
/// not a JSON object, or one with a key twice, of which the library would keep one value.
std::optional<Json> parse_object(std::string_view line, std::size_t max_bytes, RequestError& error);

/// Reads fields of an object. Keeps the first error; values read after it are unspecified.
class FieldReader {
 public:
  explicit FieldReader(const Json& object) : object_(object) {}

  bool has(const char* name) const { return object_.contains(name); }
  double number(const char* name, Limits limits);
  std::optional<double> optional_number(const char* name, Limits limits);
  std::optional<std::int64_t> optional_integer(const char* name);
  core::TimeNs time(const char* name) { return core::from_seconds(number(name, kTimeLimitsS)); }
  std::string_view text(const char* name);
  /// Empty if absent.
  std::string_view optional_text(const char* name);
  /// An empty object if absent or wrong.
  const Json& optional_object(const char* name);
  /// An empty array if wrong.
  const Json& array(const char* name, std::size_t max_size);

  /// array[index], a finite number within limits.
  double element(const char* name, const Json& array, std::size_t index, Limits limits);

  /// Why a field is wrong, for counters.
  static constexpr std::string_view kMissing = "missing";
  static constexpr std::string_view kNotANumber = "not_a_number";
  static constexpr std::string_view kNotWhole = "not_whole";
  static constexpr std::string_view kOutOfRange = "out_of_range";
  static constexpr std::string_view kOther = "other";

  void fail(const std::string& reason, std::string_view cause = kOther);
  const std::optional<RequestError>& error() const { return error_; }

 private:
  const Json* find(const char* name);
  void refuse_range(const std::string& name, Limits limits, double number);
  double check(const std::string& name, const Json& value, Limits limits);

  const Json& object_;
  std::optional<RequestError> error_;
};

/// Parses one line and calls `read(class, fields)`. `Line`: a variant with RequestError.
template <typename Line>
Line parse_by_class(std::string_view line, std::size_t max_bytes, const auto& read) {
  RequestError error;
  const auto object = parse_object(line, max_bytes, error);
  if (!object) return error;
  FieldReader fields(*object);
  const std::string_view name = fields.text("class");
  if (fields.error()) return RequestError{"class", fields.error()->text};
  Line result = read(name, fields);
  if (!fields.error()) return result;
  error = *fields.error();
  error.class_name = name;
  return error;
}

}  // namespace cornerd::message
