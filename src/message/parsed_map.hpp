// SPDX-License-Identifier: MIT
// Parses MAP. Internal to src/message.
#pragma once

#include "core/map/wall_map.hpp"
#include "message/field_reader.hpp"

namespace cornerd::message {

/// Walls without a thickness of their own get the map's.
core::FloorPlan read_map(FieldReader& fields);

}  // namespace cornerd::message
