// SPDX-License-Identifier: MIT
#include "tool/monitor/terminal.hpp"

#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

TEST(PlainKeys, Sequences_AreIgnored) {
  EXPECT_EQ(plain_keys("q"), "q");
  EXPECT_EQ(plain_keys("\x1b[Aq\x1b[1;5Q+\x1bOP-"), "q+-");
  EXPECT_EQ(plain_keys("\x1b[12"), "");
  EXPECT_EQ(plain_keys("\x1bq"), "\x1bq");
  EXPECT_EQ(plain_keys(""), "");
}

}  // namespace
}  // namespace cornerd::tool
