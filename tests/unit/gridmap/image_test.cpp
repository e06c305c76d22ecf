// SPDX-License-Identifier: MIT
#include "gridmap/image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cornerd::gridmap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string pgm_error(const std::string& bytes) {
  try {
    decode_image(bytes);
  } catch (const GridError& error) {
    return error.what();
  }
  return "none";
}

TEST(DecodePgm, Bytes_AreShadesFromTopDown) {
  const Image image =
      decode_image(std::string("P5\n# GIMP\n3 2\n255\n\x00\x80\xff\x01\x02\x03", 24));
  EXPECT_EQ(image.width, 3U);
  EXPECT_EQ(image.height, 2U);
  EXPECT_EQ(image.white, 255);
  EXPECT_THAT(image.shades, ElementsAre(0, 128, 255, 1, 2, 3));
}

TEST(DecodePgm, TwoBytePixels_AreBigEndian) {
  const Image image = decode_image(std::string("P5 2 1 1000\n\x03\xe8\x00\x07", 16));
  EXPECT_EQ(image.white, 1000);
  EXPECT_THAT(image.shades, ElementsAre(1000, 7));
}

TEST(DecodePgm, Digits_AcceptAnyWhiteSpace) {
  const Image image = decode_image("P2\n# a comment\n2 # another\n2\n15\n0 15\n\n  7\t8\n");
  EXPECT_THAT(image.shades, ElementsAre(0, 15, 7, 8));
}

TEST(DecodePgm, FirstPixelWithValueOfSpace_IsPixel) {
  EXPECT_THAT(decode_image("P5\n2 1\n255\n \n").shades, ElementsAre(' ', '\n'));
}

TEST(DecodePgm, WrongFile_ThrowsWithReason) {
  EXPECT_THAT(pgm_error("P6\n1 1\n255\nabc"), HasSubstr("neither PGM"));
  EXPECT_THAT(pgm_error(""), HasSubstr("neither PGM"));
  EXPECT_THAT(pgm_error("P5\n2 2\n255\nabc"), HasSubstr("ends early"));
  EXPECT_THAT(pgm_error("P2\n2 2\n255\n1 2 3"), HasSubstr("no number as a pixel"));
  EXPECT_THAT(pgm_error("P2\n2 1\n7\n1 8"), HasSubstr("above the largest"));
  EXPECT_THAT(pgm_error("P5\n2 1\n7\n\x01\x08"), HasSubstr("above the largest"));
  EXPECT_THAT(pgm_error("P5\nx 1\n7\n"), HasSubstr("as the width"));
  EXPECT_THAT(pgm_error("P5\n0 1\n7\n"), HasSubstr("empty"));
  EXPECT_THAT(pgm_error("P5\n1 1\n65536\na"), HasSubstr("from 1 to 65535"));
  EXPECT_THAT(pgm_error("P5\n1 1\n0\na"), HasSubstr("from 1 to 65535"));
  EXPECT_THAT(pgm_error("P5\n99999999 99999999\n255\n"), HasSubstr("more than"));
  EXPECT_THAT(pgm_error("P2\n8000 8000\n255\n1 2"), HasSubstr("ends early"));
}

/// 2 x 2, grey, with linear gamma: 0, 205 above 254, 100.
constexpr char kGrey[] =
    "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02"
    "\x00\x00\x00\x02\x08\x00\x00\x00\x00\x57\xdd\x52\xf8\x00\x00\x00\x04\x67\x41\x4d"
    "\x41\x00\x01\x86\xa0\x31\xe8\x96\x5f\x00\x00\x00\x0e\x49\x44\x41\x54\x78\x9c\x63"
    "\x60\x38\xcb\xf0\x2f\x05\x00\x05\x9a\x02\x30\xd3\x81\xb0\xab\x00\x00\x00\x00\x49"
    "\x45\x4e\x44\xae\x42\x60\x82";
/// 2 x 1 with transparency: (30, 60, 90) and half transparent black.
constexpr char kColoured[] =
    "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02"
    "\x00\x00\x00\x01\x08\x06\x00\x00\x00\xf4\x22\x7f\x8a\x00\x00\x00\x11\x49\x44\x41"
    "\x54\x78\x9c\x63\x90\xb3\x89\xfa\xcf\xc0\xc0\xd0\x00\x00\x0a\x34\x02\x34\x6b\xfa"
    "\x44\xee\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82";

/// Red, nearly grey, black.
constexpr char kMarked[] =
    "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x03"
    "\x00\x00\x00\x01\x08\x02\x00\x00\x00\x94\x82\x83\xe3\x00\x00\x00\x12\x49\x44\x41"
    "\x54\x78\x9c\x63\xf8\xcf\xc0\x70\x62\xdf\x16\x06\x06\x06\x00\x14\x37\x03\x3a\x08"
    "\x9d\x38\x3f\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82";

template <std::size_t n>
std::string bytes_of(const char (&text)[n]) {
  return {text, n - 1};
}

std::string png_error(const std::string& bytes) {
  try {
    decode_image(bytes);
  } catch (const GridError& error) {
    return error.what();
  }
  return "none";
}

class Png : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_png()) GTEST_SKIP() << "built without libpng";
  }
};

TEST_F(Png, GreyWithGamma_KeepsValues) {
  const Image image = decode_image(bytes_of(kGrey));
  EXPECT_EQ(image.width, 2U);
  EXPECT_EQ(image.height, 2U);
  EXPECT_THAT(image.shades, ElementsAre(0, 205, 254, 100));
  EXPECT_TRUE(image.alphas.empty());
}

TEST_F(Png, Colours_GiveMeanAndTransparency) {
  const Image image = decode_image(bytes_of(kColoured));
  EXPECT_THAT(image.shades, ElementsAre(60, 0));
  EXPECT_THAT(image.alphas, ElementsAre(255, 128));
}

TEST_F(Png, BrightColours_AreTransparent) {
  const Image image = decode_image(bytes_of(kMarked));
  EXPECT_THAT(image.shades, ElementsAre(85, 190, 0));
  EXPECT_THAT(image.alphas, ElementsAre(0, 255, 255));
}

TEST_F(Png, TruncatedOrDamaged_Throws) {
  const std::string whole = bytes_of(kGrey);
  for (std::size_t size = 8; size < whole.size() - 12; ++size) {
    EXPECT_THAT(png_error(whole.substr(0, size)), HasSubstr("PNG: ")) << size;
  }
  std::string damaged = whole;
  damaged[20] ^= 1;
  EXPECT_THAT(png_error(damaged), HasSubstr("PNG: "));
}

TEST(PngWithoutLibpng, Decode_AnyPng_FailsWithRemedy) {
  if (has_png()) GTEST_SKIP() << "built with libpng";
  EXPECT_THAT(png_error(bytes_of(kGrey)), HasSubstr("pngtopnm"));
}

}  // namespace
}  // namespace cornerd::gridmap
