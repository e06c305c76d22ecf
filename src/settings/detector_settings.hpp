// SPDX-License-Identifier: MIT
#pragma once

#include "core/detector_config.hpp"
#include "settings/object_reader.hpp"

namespace cornerd::settings {

/// Reads the section `detector`: config/cornerd.full.json says what each key means.
void read_detector(ObjectReader detector, core::DetectorConfig& config);

}  // namespace cornerd::settings
