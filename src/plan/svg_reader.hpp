// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "plan/drawing.hpp"

namespace cornerd::plan {

/// False in a build without pugixml: read_svg() then throws.
bool has_svg();

/// Lines, polylines, polygons, rectangles, circles, ellipses and paths, in groups with transforms.
/// A layer is a group with a label of Inkscape's, else with an id. metres_per_unit is that of the
/// user unit where `width` has an absolute unit. What is not displayed, or only defined, is left
/// out. Throws PlanError, also where a chosen layer does not exist.
Drawing read_svg(std::string_view text, const LayerChoice& layers);

}  // namespace cornerd::plan
