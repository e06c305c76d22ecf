// SPDX-License-Identifier: MIT
#include "gridmap/image.hpp"

#include "gridmap/grid_error.hpp"
#include "gridmap/pgm.hpp"
#include "gridmap/png.hpp"

namespace cornerd::gridmap {

void check_size(std::size_t width, std::size_t height) {
  if (width == 0 || height == 0) throw GridError("the picture is empty");
  if (width > kMaxPixels || height > kMaxPixels / width) {
    throw GridError("the picture has more than " + std::to_string(kMaxPixels) + " pixels");
  }
}

Image decode_image(std::string_view bytes) {
  if (is_pgm(bytes)) return decode_pgm(bytes);
  if (is_png(bytes)) return decode_png(bytes);
  throw GridError("is neither PGM (P2 or P5) nor PNG");
}

}  // namespace cornerd::gridmap
