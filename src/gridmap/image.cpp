// SPDX-License-Identifier: MIT
#include "gridmap/image.hpp"

#include <charconv>
#include <cstdint>
#include <limits>

namespace cornerd::gridmap {
namespace {

constexpr bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

/// Reads numbers between white space and comments.
class PgmText {
 public:
  explicit PgmText(std::string_view rest) : rest_(rest) {}

  std::size_t number(const char* what) {
    skip_space();
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc{}) throw GridError(std::string("PGM: no number as ") + what);
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  /// The pixels' bytes begin after exactly one white space.
  void one_space() {
    if (rest_.empty() || !is_space(rest_.front())) {
      throw GridError("PGM: no white space after the largest value");
    }
    rest_.remove_prefix(1);
  }

  std::string_view rest() const { return rest_; }

 private:
  void skip_space() {
    while (!rest_.empty()) {
      if (rest_.front() == '#') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      } else if (is_space(rest_.front())) {
        rest_.remove_prefix(1);
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
};

void read_digits(PgmText& text, Image& image) {
  // At least two characters a pixel: a wrong size allocates no memory.
  if (text.rest().size() / 2 + 1 < image.width * image.height) throw GridError("PGM: ends early");
  image.shades.reserve(image.width * image.height);
  for (std::size_t i = 0; i < image.width * image.height; ++i) {
    const std::size_t shade = text.number("a pixel");
    if (shade > image.white) throw GridError("PGM: a pixel is above the largest value");
    image.shades.push_back(static_cast<std::uint16_t>(shade));
  }
}

void read_bytes(std::string_view bytes, Image& image) {
  const bool wide = image.white > 255;
  const std::size_t count = image.width * image.height;
  if (bytes.size() / (wide ? 2 : 1) < count) throw GridError("PGM: ends early");
  image.shades.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); };
    const unsigned shade = wide ? byte(2 * i) * 256U + byte(2 * i + 1) : byte(i);
    if (shade > image.white) throw GridError("PGM: a pixel is above the largest value");
    image.shades.push_back(static_cast<std::uint16_t>(shade));
  }
}

}  // namespace

void check_size(std::size_t width, std::size_t height) {
  if (width == 0 || height == 0) throw GridError("the picture is empty");
  if (width > kMaxPixels || height > kMaxPixels / width) {
    throw GridError("the picture has more than " + std::to_string(kMaxPixels) + " pixels");
  }
}

Image decode_image(std::string_view bytes) {
  if (is_pgm(bytes)) return decode_pgm(bytes);
  if (is_png(bytes)) return decode_png(bytes);
  throw GridError("is neither PGM (P2 or P5) nor PNG: convert it");
}

bool is_pgm(std::string_view bytes) { return bytes.starts_with("P2") || bytes.starts_with("P5"); }

Image decode_pgm(std::string_view bytes) {
  if (!is_pgm(bytes)) throw GridError("PGM: begins with neither P2 nor P5");
  PgmText text(bytes.substr(2));
  Image image;
  image.width = text.number("the width");
  image.height = text.number("the height");
  check_size(image.width, image.height);
  const std::size_t white = text.number("the largest value");
  if (white == 0 || white > std::numeric_limits<std::uint16_t>::max()) {
    throw GridError("PGM: the largest value must be from 1 to 65535");
  }
  image.white = static_cast<std::uint16_t>(white);
  if (bytes[1] == '2') {
    read_digits(text, image);
  } else {
    text.one_space();
    read_bytes(text.rest(), image);
  }
  return image;
}

}  // namespace cornerd::gridmap
