// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "plan/drawing.hpp"

namespace cornerd::plan {

/// False in a build without dxflib: read_dxf() then throws.
bool has_dxf();

/// LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE and the blocks that INSERT places, of an ASCII DXF.
/// What is on layer 0 of a block is on the layer of its INSERT. metres_per_unit is that of
/// $INSUNITS. Throws PlanError, also where a chosen layer does not exist.
Drawing read_dxf(std::string_view text, const LayerChoice& layers);

}  // namespace cornerd::plan
