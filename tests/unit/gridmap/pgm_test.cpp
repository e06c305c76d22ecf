// SPDX-License-Identifier: MIT
#include "gridmap/pgm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "gridmap/grid_error.hpp"

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

TEST(Pgm, Bytes_AreShadesFromTheTopDown) {
  const Image image =
      decode_image(std::string("P5\n# GIMP\n3 2\n255\n\x00\x80\xff\x01\x02\x03", 24));
  EXPECT_EQ(image.width, 3U);
  EXPECT_EQ(image.height, 2U);
  EXPECT_EQ(image.white, 255);
  EXPECT_THAT(image.shades, ElementsAre(0, 128, 255, 1, 2, 3));
}

TEST(Pgm, WideBytes_HaveTheHigherFirst) {
  const Image image = decode_image(std::string("P5 2 1 1000\n\x03\xe8\x00\x07", 16));
  EXPECT_EQ(image.white, 1000);
  EXPECT_THAT(image.shades, ElementsAre(1000, 7));
}

TEST(Pgm, Digits_MayStandAnyhow) {
  const Image image = decode_image("P2\n# a comment\n2 # another\n2\n15\n0 15\n\n  7\t8\n");
  EXPECT_THAT(image.shades, ElementsAre(0, 15, 7, 8));
}

TEST(Pgm, FirstPixelLikeASpace_IsAPixel) {
  EXPECT_THAT(decode_image("P5\n2 1\n255\n \n").shades, ElementsAre(' ', '\n'));
}

TEST(Pgm, WhatIsWrong_IsSaid) {
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

}  // namespace
}  // namespace cornerd::gridmap
