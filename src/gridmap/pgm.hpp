// SPDX-License-Identifier: MIT
// The portable graymap of Netpbm: https://netpbm.sourceforge.net/doc/pgm.html
#pragma once

#include <string_view>

#include "gridmap/image.hpp"

namespace cornerd::gridmap {

bool is_pgm(std::string_view bytes);

/// P5 (bytes; two a pixel, the higher first, where the largest value is above 255) and P2 (digits).
/// What follows the first picture is not looked at. Throws GridError.
Image decode_pgm(std::string_view bytes);

}  // namespace cornerd::gridmap
