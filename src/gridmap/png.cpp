// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>

#include "gridmap/image.hpp"

#ifdef CORNERD_HAS_PNG
#include <png.h>
#endif

namespace cornerd::gridmap {

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

#ifdef CORNERD_HAS_PNG

namespace {

/// State of libpng's callbacks.
struct Decoding {
  std::string_view rest;
  char error[160] = "";
};

void on_read(png_structp png, png_bytep out, std::size_t count) {
  auto& decoding = *static_cast<Decoding*>(png_get_io_ptr(png));
  if (count > decoding.rest.size()) png_error(png, "ends early");
  std::memcpy(out, decoding.rest.data(), count);
  decoding.rest.remove_prefix(count);
}

void on_error(png_structp png, png_const_charp reason) {
  auto& decoding = *static_cast<Decoding*>(png_get_error_ptr(png));
  std::strncpy(decoding.error, reason, sizeof decoding.error - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

/// libpng leaves by longjmp on errors: no local of read_...() has a destructor.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : decoding_{.rest = bytes} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoding_, on_error, on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw GridError("PNG: no memory");
    }
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, &decoding_, on_read);
    png_set_user_limits(png_, kMaxPixels, kMaxPixels);
    png_read_info(png_, info_);
    png_set_expand(png_);
    png_set_strip_16(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  std::size_t width() const { return png_get_image_width(png_, info_); }
  std::size_t height() const { return png_get_image_height(png_, info_); }

  /// `rgba`: four bytes a pixel.
  bool read_pixels(std::uint8_t* rgba) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    for (int pass = 0; pass < passes_; ++pass) {
      for (std::size_t row = 0; row < height(); ++row) {
        png_read_row(png_, rgba + row * width() * 4, nullptr);
      }
    }
    return true;
  }

  [[noreturn]] void fail() const { throw GridError(std::string("PNG: ") + decoding_.error); }

 private:
  Decoding decoding_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int passes_ = 1;
};

}  // namespace

/// Difference of two channels of a pixel that is no shade of a map: half of the range.
constexpr int kColoured = 127;

bool has_png() { return true; }

Image decode_png(std::string_view bytes) {
  Reader reader(bytes);
  if (!reader.read_header()) reader.fail();
  Image image;
  image.width = reader.width();
  image.height = reader.height();
  check_size(image.width, image.height);
  const std::size_t count = image.width * image.height;
  // Deflate compresses by a factor of 1032 at most: a wrong size allocates no memory.
  if (count / 8 > bytes.size() * 1040) throw GridError("PNG: ends early");
  std::vector<std::uint8_t> rgba(count * 4);
  if (!reader.read_pixels(rgba.data())) reader.fail();
  image.shades.reserve(count);
  image.alphas.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* pixel = rgba.data() + 4 * i;
    image.shades.push_back(static_cast<std::uint16_t>((pixel[0] + pixel[1] + pixel[2]) / 3));
    const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
    image.alphas.push_back(most - least > kColoured ? std::uint8_t{0} : pixel[3]);
  }
  if (std::all_of(image.alphas.begin(), image.alphas.end(), [](auto a) { return a == 255; })) {
    image.alphas.clear();
  }
  return image;
}

#else

bool has_png() { return false; }

Image decode_png(std::string_view) {
  throw GridError(
      "is a PNG, and this program was built without libpng: convert it "
      "(pngtopnm map.png >map.pgm) and name the PGM in the yaml");
}

#endif

}  // namespace cornerd::gridmap
