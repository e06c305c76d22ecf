// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/breakpoint/breakpoint.hpp"
#include "core/scan.hpp"

namespace cornerd::tool {

/// A scan as the lidar saw it, to scale and without any map: its returns as dots, the walls that
/// were found in them as lines, corners as rings, terminals as squares, the lidar as a cross at
/// (0, 0) looking to the right. Returns far beyond the others are dots at the edge. An SVG
/// document.
std::string draw_scan(const core::Scan& scan, const core::Detection& detection);

}  // namespace cornerd::tool
