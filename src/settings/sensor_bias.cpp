// SPDX-License-Identifier: MIT
#include "settings/sensor_bias.hpp"

#include <nlohmann/json.hpp>

namespace cornerd::settings {

void read_bias(ObjectReader bias, core::SensorBias& config) {
  bias.number("range_scale", config.range_scale, {-0.1, 0.1});
  bias.number("range_offset", config.range_offset_m, {-0.1, 0.1});
  bias.number("bearing_sine", config.bearing_sine_rad, {-0.1, 0.1});
  bias.number("bearing_cosine", config.bearing_cosine_rad, {-0.1, 0.1});
  bias.finish();
}

nlohmann::ordered_json json_of(const core::SensorBias& bias) {
  return {{"range_scale", bias.range_scale},
          {"range_offset", bias.range_offset_m},
          {"bearing_sine", bias.bearing_sine_rad},
          {"bearing_cosine", bias.bearing_cosine_rad}};
}

}  // namespace cornerd::settings
