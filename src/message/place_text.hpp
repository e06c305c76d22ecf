// SPDX-License-Identifier: MIT
// Lengths, angles and places as LineWriter writes them. Inside this layer alone.
#pragma once

#include <cmath>
#include <string_view>

#include "core/geometry/angle.hpp"
#include "core/geometry/pose2.hpp"
#include "message/json_text.hpp"

namespace cornerd::message {

/// A microsecond, and a millionth of what has no unit.
inline constexpr int kTimeDecimals = 6;
/// A hundredth of a millimetre: the wire's own step is a quarter of one.
inline constexpr int kMetreDecimals = 5;

inline void write_metres(JsonText& json, std::string_view name, double value_m) {
  json.number(name, value_m, kMetreDecimals);
}

inline void write_angle(JsonText& json, std::string_view name, double value_rad) {
  if (!std::isfinite(value_rad)) return;
  json.key(name);
  json.angle(core::normalize_angle(value_rad));
}

inline void write_place(JsonText& json, const core::Pose2& T_map_base) {
  write_metres(json, "x", T_map_base.x_m);
  write_metres(json, "y", T_map_base.y_m);
  write_angle(json, "theta", T_map_base.theta_rad);
}

}  // namespace cornerd::message
