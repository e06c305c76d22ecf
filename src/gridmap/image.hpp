// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cornerd::gridmap {

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

}  // namespace cornerd::gridmap
