// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <utility>

#include "core/scan.hpp"
#include "message/field_reader.hpp"
#include "message/odometry_fields.hpp"
#include "message/request.hpp"

namespace cornerd::message {
namespace {

constexpr Limits kDurationLimitsS{0, 60};
constexpr Limits kRangeLimitsM{-1000, 1000};

/// Null is how some writers put the infinity that stands for no return elsewhere (REP 117).
double read_range(FieldReader& fields, const Json& ranges, std::size_t index) {
  if (ranges[index].is_null()) return 0;
  return std::max(0.0, fields.element("ranges", ranges, index, kRangeLimitsM));
}

/// The array, or nullptr where there is none; of another length it is an error.
const Json* optional_array(FieldReader& fields, const char* name, std::size_t size) {
  if (!fields.has(name)) return nullptr;
  const Json& array = fields.array(name, core::kMaxSamplesPerTurn);
  if (array.size() != size) {
    fields.fail("\"" + std::string(name) + "\" must be as long as \"angles\"");
    return nullptr;
  }
  return &array;
}

RecordedLine read_scan(FieldReader& fields) {
  RecordedScan scan;
  scan.t_ns = fields.time("t");
  const double duration_s = fields.optional_number("duration", kDurationLimitsS).value_or(0);
  scan.duration_ns = core::from_seconds(duration_s);
  const Json& angles = fields.array("angles", core::kMaxSamplesPerTurn);
  const Json& ranges = fields.array("ranges", core::kMaxSamplesPerTurn);
  const std::size_t count = angles.size();
  if (ranges.size() != count) fields.fail("\"angles\" and \"ranges\" must be equally long");
  const Json* quality = optional_array(fields, "quality", count);
  const Json* times = optional_array(fields, "times", count);

  scan.samples.reserve(count);
  for (std::size_t i = 0; i < count && !fields.error(); ++i) {
    const double offset_s = times != nullptr
                                ? fields.element("times", *times, i, kDurationLimitsS)
                                : duration_s * static_cast<double>(i) / static_cast<double>(count);
    core::Sample& sample = scan.samples.emplace_back();
    sample.t_ns = scan.t_ns + core::from_seconds(offset_s);
    sample.bearing_rad = static_cast<float>(
        core::normalize_angle(fields.element("angles", angles, i, kAngleLimitsRad)));
    sample.range_m = static_cast<float>(read_range(fields, ranges, i));
    if (quality != nullptr) {
      sample.quality = static_cast<std::uint8_t>(fields.element("quality", *quality, i, {0, 255}));
    }
    sample.starts_turn = i == 0;
    sample.ends_turn = i + 1 == count;
  }
  return scan;
}

int hex_value(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

RecordedLine read_serial(FieldReader& fields) {
  RecordedBytes serial;
  serial.t_ns = fields.time("t");
  serial.received = fields.has("rx");
  if (serial.received && fields.has("tx")) fields.fail("\"rx\" or \"tx\", not both");
  const char* name = serial.received ? "rx" : "tx";
  const std::string_view digits = fields.text(name);
  if (digits.size() % 2 != 0) fields.fail("\"" + std::string(name) + "\" ends in half a byte");
  serial.bytes.reserve(digits.size() / 2);
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    const int high = hex_value(digits[i]);
    const int low = hex_value(digits[i + 1]);
    if (high < 0 || low < 0) {
      fields.fail("\"" + std::string(name) + "\" must be hexadecimal digits");
      break;
    }
    serial.bytes.push_back(static_cast<std::uint8_t>(high * 16 + low));
  }
  return serial;
}

RecordedLine read_recorded_odometry(FieldReader& fields) {
  OdometryReading reading = read_odometry(fields);
  if (!reading.timed) fields.fail("\"t\" is missing");
  return reading;
}

RecordedLine read_line(std::string_view name, FieldReader& fields) {
  if (name == "SCAN") return read_scan(fields);
  if (name == "SERIAL") return read_serial(fields);
  if (name == "ODOMETRY") return read_recorded_odometry(fields);
  return OtherLine{std::string(name)};
}

}  // namespace

RecordedLine parse_recorded_line(std::string_view line) {
  RequestError error;
  const auto object = parse_object(line, kMaxRecordedBytes, error);
  if (!object) return error;
  FieldReader fields(*object);
  const std::string_view name = fields.text("class");
  if (fields.error()) return RequestError{"class", fields.error()->text};
  RecordedLine recorded = read_line(name, fields);
  if (fields.error()) return *fields.error();
  return recorded;
}

std::variant<RequestError, RecordedTruth> parse_truth_line(std::string_view line) {
  RequestError error;
  const auto object = parse_object(line, kMaxRequestBytes, error);
  if (!object) return error;
  FieldReader fields(*object);
  RecordedTruth truth;
  truth.t_ns = fields.time("t");
  truth.T_map_base.x_m = fields.number("x", kCoordinateLimitsM);
  truth.T_map_base.y_m = fields.number("y", kCoordinateLimitsM);
  truth.T_map_base.theta_rad = core::normalize_angle(fields.number("theta", kAngleLimitsRad));
  if (fields.error()) return *fields.error();
  return truth;
}

}  // namespace cornerd::message
