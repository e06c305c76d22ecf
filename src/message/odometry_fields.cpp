// SPDX-License-Identifier: MIT
#include "message/odometry_fields.hpp"

namespace cornerd::message {

OdometryReading read_odometry(FieldReader& fields) {
  constexpr Limits kGyroLimitsRadS{-1000, 1000};
  OdometryReading reading;
  reading.timed = fields.has("t");
  if (reading.timed) reading.t_ns = fields.time("t");
  reading.left = fields.optional_integer("left");
  reading.right = fields.optional_integer("right");
  reading.gyro_rad_s = fields.optional_number("gyro", kGyroLimitsRadS);
  return reading;
}

}  // namespace cornerd::message
