// SPDX-License-Identifier: MIT
#include "tool/monitor/frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Frame, Text_IsClippedAtEveryEdge) {
  Frame frame(5, 2);
  EXPECT_EQ(frame.write(2, 0, "hello"), 5U);
  EXPECT_EQ(frame.write(0, 1, "hello", Style::kPlain, 3), 3U);
  frame.write(0, 2, "below");
  frame.put(9, 0, {U'!'});
  EXPECT_EQ(frame.text(), "  hel\nhel\n");
}

TEST(Frame, WithoutSize_HasOneCell) {
  const Frame frame(0, 0);
  EXPECT_EQ(frame.columns(), 1U);
  EXPECT_EQ(frame.rows(), 1U);
}

TEST(Frame, WhatWouldMoveTheCursor_IsAQuestionMark) {
  Frame frame(12, 1);
  frame.write(0, 0, "a\x1b[2J\n\x7fé\xff漢Ж");
  EXPECT_EQ(frame.text(), "a?[2J??é??Ж\n");
}

TEST(WrapText, Words_StayWholeWhereTheyFit) {
  EXPECT_THAT(wrap_text("one two three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(wrap_text("  one   two ", 20), ElementsAre("one two"));
  EXPECT_THAT(wrap_text("a abcdefgh b", 3), ElementsAre("a", "abc", "def", "gh", "b"));
  EXPECT_THAT(wrap_text("äöü äö", 3), ElementsAre("äöü", "äö"));
  EXPECT_THAT(wrap_text("", 3), IsEmpty());
}

}  // namespace
}  // namespace cornerd::tool
