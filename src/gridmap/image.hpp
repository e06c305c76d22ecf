// SPDX-License-Identifier: MIT
// Pictures of maps: PGM (https://netpbm.sourceforge.net/doc/pgm.html) and PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::gridmap {

/// A picture, or its YAML, that is wrong. what() is the reason.
class GridError : public std::runtime_error {
 public:
  /// `pointer`: where, as a JSON pointer into the YAML; empty for a picture.
  explicit GridError(const std::string& reason, std::string pointer = {})
      : std::runtime_error(reason), pointer_(std::move(pointer)) {}

  const std::string& pointer() const { return pointer_; }

 private:
  std::string pointer_;
};

/// A greyscale picture, rows from the top down.
struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  std::uint16_t white = 255;          ///< the largest value of a pixel
  std::vector<std::uint16_t> shades;  ///< 0 is black
  std::vector<std::uint8_t> alphas;   ///< 0 is transparent, 255 opaque; empty: all opaque
};

/// A building of 800 x 800 m at 10 cm. Larger pictures are rejected before memory is allocated.
inline constexpr std::size_t kMaxPixels = std::size_t{1} << 26;

/// Throws GridError where the picture is empty or too large.
void check_size(std::size_t width, std::size_t height);

/// PGM (P2, P5) or PNG, by the first bytes. Throws GridError.
Image decode_image(std::string_view bytes);

bool is_pgm(std::string_view bytes);

/// P5 (one byte a pixel, or two, big endian, where the largest value is above 255) and P2 (digits).
/// Ignores what follows the first picture. Throws GridError.
Image decode_pgm(std::string_view bytes);

bool is_png(std::string_view bytes);

/// False in a build without libpng: decode_png() then throws.
bool has_png();

/// Shades are the mean of red, green and blue, as in map_server; gamma is ignored. Pixels of bright
/// colours are transparent: a path or a marker drawn over the map. Throws GridError.
Image decode_png(std::string_view bytes);

}  // namespace cornerd::gridmap
