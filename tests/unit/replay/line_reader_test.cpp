// SPDX-License-Identifier: MIT
#include "replay/line_reader.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace cornerd::replay {
namespace {

using Result = LineReader::Result;

TEST(LineReader, Lines_HaveNoLineEnds) {
  std::istringstream stream("one\n\nthree\r\nfour");
  LineReader reader(stream, 100);
  EXPECT_EQ(reader.next(), Result::kLine);
  EXPECT_EQ(reader.line(), "one");
  EXPECT_EQ(reader.next(), Result::kLine);
  EXPECT_EQ(reader.line(), "");
  EXPECT_EQ(reader.next(), Result::kLine);
  EXPECT_EQ(reader.line(), "three");
  EXPECT_EQ(reader.next(), Result::kTornLine);
  EXPECT_EQ(reader.line(), "four");
  EXPECT_EQ(reader.number(), 4u);
  EXPECT_EQ(reader.next(), Result::kEnd);
  EXPECT_EQ(reader.next(), Result::kEnd);
}

TEST(LineReader, LineBeyondTheLimit_IsSkipped) {
  std::istringstream stream("12345\n123456\n1\n1234567");
  LineReader reader(stream, 5);
  EXPECT_EQ(reader.next(), Result::kLine);
  EXPECT_EQ(reader.next(), Result::kTooLong);
  EXPECT_EQ(reader.line(), "");
  EXPECT_EQ(reader.next(), Result::kLine);
  EXPECT_EQ(reader.line(), "1");
  EXPECT_EQ(reader.next(), Result::kTooLong);
  EXPECT_EQ(reader.next(), Result::kEnd);
}

}  // namespace
}  // namespace cornerd::replay
