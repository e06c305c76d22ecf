// SPDX-License-Identifier: MIT
#include "tool/monitor/frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Frame, Text_IsClippedAtEachEdge) {
  Frame frame(5, 2);
  EXPECT_EQ(frame.write(2, 0, "hello"), 5U);
  EXPECT_EQ(frame.write(0, 1, "hello", Style::kPlain, 3), 3U);
  frame.write(0, 2, "below");
  frame.put(9, 0, {U'!'});
  EXPECT_EQ(frame.text(), "  hel\nhel\n");
}

TEST(Frame, ZeroSize_HasOneCell) {
  const Frame frame(0, 0);
  EXPECT_EQ(frame.columns(), 1U);
  EXPECT_EQ(frame.rows(), 1U);
}

TEST(Frame, ControlOrWideCharacter_IsQuestionMark) {
  Frame frame(12, 1);
  frame.write(0, 0, "a\x1b[2J\n\x7fé\xff漢Ж");
  EXPECT_EQ(frame.text(), "a?[2J??é??Ж\n");
}

TEST(WrapText, FittingWords_AreNotSplit) {
  EXPECT_THAT(wrap_text("one two three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(wrap_text("  one   two ", 20), ElementsAre("one two"));
  EXPECT_THAT(wrap_text("a abcdefgh b", 3), ElementsAre("a", "abc", "def", "gh", "b"));
  EXPECT_THAT(wrap_text("äöü äö", 3), ElementsAre("äöü", "äö"));
  EXPECT_THAT(wrap_text("", 3), IsEmpty());
}

}  // namespace

namespace {

TEST(FrameEncoder, FirstFrame_ClearsTheScreen) {
  Frame frame(4, 2);
  frame.write(1, 1, "ab", Style::kBad);
  EXPECT_EQ(FrameEncoder(true).encode(frame), "\x1b[0m\x1b[2J\x1b[2;2H\x1b[0;1;31mab\x1b[0m");
}

TEST(FrameEncoder, NextFrame_HasOnlyChangedCells) {
  FrameEncoder encoder(true);
  Frame frame(6, 2);
  frame.write(0, 0, "abcdef");
  encoder.encode(frame);
  EXPECT_EQ(encoder.encode(frame), "");
  frame.write(2, 0, "X");
  frame.write(5, 0, "Y");
  frame.write(0, 1, "é");
  EXPECT_EQ(encoder.encode(frame), "\x1b[1;3H\x1b[0mX\x1b[1;6HY\x1b[2;1Hé");
}

TEST(FrameEncoder, AfterForget_AllIsDrawnAgain) {
  FrameEncoder encoder(true);
  Frame frame(3, 1);
  frame.write(0, 0, "abc");
  const std::string whole = encoder.encode(frame);
  encoder.forget();
  EXPECT_EQ(encoder.encode(frame), whole);
  EXPECT_EQ(encoder.encode(Frame(2, 1)), "\x1b[0m\x1b[2J");
}

TEST(FrameEncoder, NoColours_BadIsBold) {
  Frame frame(2, 1);
  frame.write(0, 0, "a", Style::kBad);
  frame.write(1, 0, "b", Style::kGood);
  EXPECT_EQ(FrameEncoder(false).encode(frame), "\x1b[0m\x1b[2J\x1b[1;1H\x1b[0;1ma\x1b[0mb\x1b[0m");
}

}  // namespace
}  // namespace cornerd::tool
