// SPDX-License-Identifier: MIT
// The portable graymap of Netpbm: https://netpbm.sourceforge.net/doc/pgm.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::gridmap {

/// A picture or a description of one that is wrong. what() is the reason alone.
class GridError : public std::runtime_error {
 public:
  /// `pointer`: where, as a JSON pointer into the description; empty for a picture.
  explicit GridError(const std::string& reason, std::string pointer = {})
      : std::runtime_error(reason), pointer_(std::move(pointer)) {}

  const std::string& pointer() const { return pointer_; }

 private:
  std::string pointer_;
};

/// A picture of shades, rows from the top down.
struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  std::uint16_t white = 255;          ///< the largest value that a pixel can have
  std::vector<std::uint16_t> shades;  ///< 0 is black
  std::vector<std::uint8_t> alphas;   ///< 0 is transparent, 255 is not; empty: nothing is
};

/// A building of 800 x 800 m at 10 cm; pictures beyond that are refused before memory is taken.
inline constexpr std::size_t kMaxPixels = std::size_t{1} << 26;

/// Throws GridError where there is nothing or too much of it.
void check_size(std::size_t width, std::size_t height);

/// PGM (P2, P5) or PNG, told by the first bytes. Throws GridError.
Image decode_image(std::string_view bytes);

bool is_pgm(std::string_view bytes);

/// P5 (bytes; two a pixel, the higher first, where the largest value is above 255) and P2 (digits).
/// What follows the first picture is not looked at. Throws GridError.
Image decode_pgm(std::string_view bytes);

bool is_png(std::string_view bytes);

/// False in a build without libpng: decode_png then says how to convert the picture.
bool has_png();

/// Shades are the mean of red, green and blue, as map_server takes them; values as they are in the
/// file, whatever it says of gamma. Throws GridError.
Image decode_png(std::string_view bytes);

}  // namespace cornerd::gridmap
