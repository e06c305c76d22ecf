// SPDX-License-Identifier: MIT
// Reads a JSON object that somebody else wrote. Inside this layer alone.
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
};

/// UNIX time or time since a start, either sign; the nanoseconds fit 64 bits with room to spare.
inline constexpr Limits kTimeLimitsS{-9e9, 9e9};
inline constexpr Limits kCoordinateLimitsM{-1e5, 1e5};
/// A turn and a little: degrees by mistake are noticed.
inline constexpr Limits kAngleLimitsRad{-6.3, 6.3};

/// The object of one line; nullopt with `error` set where the line is too long, too deep, or no
/// JSON object.
std::optional<Json> parse_object(std::string_view line, std::size_t max_bytes, RequestError& error);

/// Takes fields out of an object. The first wrong one is kept as the error, named; what is read
/// after it may be anything.
class FieldReader {
 public:
  explicit FieldReader(const Json& object) : object_(object) {}

  bool has(const char* name) const { return object_.contains(name); }
  double number(const char* name, Limits limits);
  std::optional<double> optional_number(const char* name, Limits limits);
  std::optional<std::int64_t> optional_integer(const char* name);
  core::TimeNs time(const char* name) { return core::from_seconds(number(name, kTimeLimitsS)); }
  std::string_view text(const char* name);
  /// Empty where there is none.
  std::string_view optional_text(const char* name);
  /// An empty object where there is none or the field is wrong.
  const Json& optional_object(const char* name);
  /// An empty array where the field is wrong.
  const Json& array(const char* name, std::size_t max_size);

  /// A finite number within limits, as an element of an array.
  double element(const char* name, const Json& array, std::size_t index, Limits limits);

  void fail(const std::string& reason);
  const std::optional<RequestError>& error() const { return error_; }

 private:
  const Json* find(const char* name);
  double check(const std::string& name, const Json& value, Limits limits);

  const Json& object_;
  std::optional<RequestError> error_;
};

/// A line whose "class" says what it is: `read` is called with that and the fields. A `Line` can be
/// a RequestError.
template <typename Line>
Line parse_by_class(std::string_view line, std::size_t max_bytes, const auto& read) {
  RequestError error;
  const auto object = parse_object(line, max_bytes, error);
  if (!object) return error;
  FieldReader fields(*object);
  const std::string_view name = fields.text("class");
  if (fields.error()) return RequestError{"class", fields.error()->text};
  Line result = read(name, fields);
  if (fields.error()) return *fields.error();
  return result;
}

}  // namespace cornerd::message
