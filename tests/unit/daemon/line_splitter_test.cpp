// SPDX-License-Identifier: MIT
#include "daemon/line_splitter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cornerd::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class LineSplitterTest : public ::testing::Test {
 protected:
  bool feed(std::string_view bytes) {
    splitter_.feed(bytes);
    while (const auto line = splitter_.next()) lines_.emplace_back(*line);
    return !splitter_.is_too_long();
  }

  LineSplitter splitter_{8};
  std::vector<std::string> lines_;
};

TEST_F(LineSplitterTest, AnyPortions_SameLines) {
  const std::string text = "one\ntwo\r\n\n\nthree\n";
  EXPECT_TRUE(feed(text));
  for (const char c : text) EXPECT_TRUE(feed({&c, 1}));
  EXPECT_THAT(lines_, ElementsAre("one", "two", "three", "one", "two", "three"));
}

TEST_F(LineSplitterTest, RestWithoutNewline_KeptForTheEnd) {
  EXPECT_TRUE(feed("a\nrest"));
  EXPECT_THAT(lines_, ElementsAre("a"));
  EXPECT_EQ(splitter_.take_remainder(), "rest");
  EXPECT_EQ(splitter_.take_remainder(), "");
}

TEST_F(LineSplitterTest, LineAtLimit_Accepted) {
  EXPECT_TRUE(feed("12345678\n"));
  EXPECT_THAT(lines_, ElementsAre("12345678"));
}

TEST_F(LineSplitterTest, LineBeyondLimit_RefusedBeforeItsEnd) {
  EXPECT_TRUE(feed("1234"));
  EXPECT_FALSE(feed("56789"));
  EXPECT_THAT(lines_, IsEmpty());
}

TEST_F(LineSplitterTest, WaitingLines_KeptWhenMoreArrive) {
  splitter_.feed("one\n\ntwo\nth");
  EXPECT_EQ(splitter_.next(), "one");
  EXPECT_TRUE(splitter_.has_line());
  splitter_.feed("ree\n");
  EXPECT_EQ(splitter_.next(), "two");
  EXPECT_EQ(splitter_.next(), "three");
  EXPECT_FALSE(splitter_.has_line());
  EXPECT_EQ(splitter_.next(), std::nullopt);
}

TEST_F(LineSplitterTest, LinesBeforeTooLongLine_Handled) {
  EXPECT_FALSE(feed("ok\n123456789\n"));
  EXPECT_THAT(lines_, ElementsAre("ok"));
}

}  // namespace
}  // namespace cornerd::daemon
