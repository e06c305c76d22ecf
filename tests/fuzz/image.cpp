// SPDX-License-Identifier: MIT
// Any bytes give a complete picture with shades up to its maximum, or a GridError of one line.
#include "gridmap/image.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::gridmap;
  try {
    const Image image = decode_image({reinterpret_cast<const char*>(data), size});
    if (image.shades.size() != image.width * image.height || image.shades.empty()) std::abort();
    if (!image.alphas.empty() && image.alphas.size() != image.shades.size()) std::abort();
    for (const std::uint16_t shade : image.shades) {
      if (shade > image.white) std::abort();
    }
  } catch (const GridError& error) {
    if (std::strchr(error.what(), '\n') != nullptr) std::abort();
  }
  return 0;
}
