// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/sensor_bias.hpp"
#include "settings/object_reader.hpp"

namespace cornerd::settings {

/// The keys of lidar.bias. Throws SettingsError.
void read_bias(ObjectReader bias, core::SensorBias& config);
nlohmann::ordered_json json_of(const core::SensorBias& bias);

}  // namespace cornerd::settings
