// SPDX-License-Identifier: MIT
#include <string>
#include <utility>

#include "message/field_reader.hpp"
#include "message/input_fields.hpp"
#include "message/request.hpp"

namespace cornerd::message {
namespace {

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
  return parse_by_class<RecordedLine>(line, kMaxRecordedBytes, read_line);
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
