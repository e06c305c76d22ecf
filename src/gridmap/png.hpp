// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "gridmap/image.hpp"

namespace cornerd::gridmap {

bool is_png(std::string_view bytes);

/// False in a build without libpng: decode_png then says how to convert the picture.
bool has_png();

/// Shades are the mean of red, green and blue, as map_server takes them; values as they are in the
/// file, whatever it says of gamma. Throws GridError.
Image decode_png(std::string_view bytes);

}  // namespace cornerd::gridmap
