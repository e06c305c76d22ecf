// SPDX-License-Identifier: MIT
#include "drivers/odometry/sysfs.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace cornerd::drivers {
namespace {

TEST(Sysfs, Integer_IsParsed) {
  EXPECT_EQ(parse_integer("0\n"), 0);
  EXPECT_EQ(parse_integer("4294967295\n"), 4294967295);
  EXPECT_EQ(parse_integer("-128"), -128);
  EXPECT_EQ(parse_integer("9223372036854775807\n"), std::numeric_limits<std::int64_t>::max());
}

TEST(Sysfs, NoInteger_GivesNullopt) {
  for (const char* text : {"", "\n", "-", "+5", " 5", "5 ", "5\n\n", "5x", "0x10", "1.5", "1e3",
                           "9223372036854775808", "quadrature x4"}) {
    EXPECT_EQ(parse_integer(text), std::nullopt) << text;
  }
  EXPECT_EQ(parse_integer(std::string("5\0", 2)), std::nullopt);
}

TEST(Sysfs, Decimal_IsParsed) {
  EXPECT_EQ(parse_decimal("0.001064724\n"), 0.001064724);
  EXPECT_EQ(parse_decimal("-3\n"), -3);
  EXPECT_EQ(parse_decimal("-0.000001"), -0.000001);
}

TEST(Sysfs, NoDecimal_GivesNullopt) {
  for (const char* text : {"", "\n", ".", "-", "+1", "1e3", "inf", "-inf", "nan", "0x1p3", "1,5",
                           "1.5 dB", "1.5\n\n", " 1.5"}) {
    EXPECT_EQ(parse_decimal(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace cornerd::drivers
