// SPDX-License-Identifier: MIT
#include "message/input_fields.hpp"

#include <algorithm>
#include <string>

#include "core/scan.hpp"

namespace cornerd::message {
namespace {

constexpr Limits kDurationLimitsS{0, 60};
constexpr Limits kRangeLimitsM{-1000, 1000};

/// null stands for no return: some writers convert the infinity of REP 117 to it.
double read_range(FieldReader& fields, const Json& ranges, std::size_t index) {
  if (ranges[index].is_null()) return 0;
  return std::max(0.0, fields.element("ranges", ranges, index, kRangeLimitsM));
}

/// nullptr if the array is absent. Another length than `size` is an error.
const Json* optional_array(FieldReader& fields, const char* name, std::size_t size) {
  if (!fields.has(name)) return nullptr;
  const Json& array = fields.array(name, core::kMaxSamplesPerScan);
  if (array.size() != size) {
    fields.fail("\"" + std::string(name) + "\" must be as long as \"angles\"");
    return nullptr;
  }
  return &array;
}

}  // namespace

RecordedScan read_scan(FieldReader& fields) {
  RecordedScan scan;
  scan.t_ns = fields.time("t");
  const double duration_s = fields.optional_number("duration", kDurationLimitsS).value_or(0);
  scan.duration_ns = core::from_seconds(duration_s);
  const Json& angles = fields.array("angles", core::kMaxSamplesPerScan);
  const Json& ranges = fields.array("ranges", core::kMaxSamplesPerScan);
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
    sample.starts_scan = i == 0;
    sample.ends_scan = i + 1 == count;
  }
  return scan;
}

OdometryReading read_odometry(FieldReader& fields) {
  // As raw counts or millidegrees too: what is wrong with those, the motion tells.
  constexpr Limits kGyroLimitsRadS{-1e6, 1e6};
  OdometryReading reading;
  reading.timed = fields.has("t");
  if (reading.timed) reading.t_ns = fields.time("t");
  reading.left = fields.optional_integer("left");
  reading.right = fields.optional_integer("right");
  reading.gyro_rad_s = fields.optional_number("gyro", kGyroLimitsRadS);
  if (!fields.error() && !reading.left && !reading.right && !reading.gyro_rad_s) {
    fields.fail("ODOMETRY needs \"left\" and \"right\", \"gyro\", or all of them",
                FieldReader::kMissing);
  }
  return reading;
}

}  // namespace cornerd::message
