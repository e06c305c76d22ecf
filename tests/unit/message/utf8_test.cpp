// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "message/json_text.hpp"

namespace cornerd::message {
namespace {

using namespace std::string_view_literals;

TEST(Utf8Length, WholeCharacters_LengthOfTheirForm) {
  EXPECT_EQ(utf8_length("a"), 1u);
  EXPECT_EQ(utf8_length("\xc3\xbc"), 2u);          // U+00FC
  EXPECT_EQ(utf8_length("\xe2\x82\xac"), 3u);      // U+20AC
  EXPECT_EQ(utf8_length("\xf0\x9f\x98\x80"), 4u);  // U+1F600
  EXPECT_EQ(utf8_length("\xf4\x8f\xbf\xbf"), 4u);  // U+10FFFF, the last code point
}

TEST(Utf8Length, NulByte_OneByte) { EXPECT_EQ(utf8_length("\0"sv), 1u); }

TEST(Utf8Length, TruncatedCharacter_Zero) {
  EXPECT_EQ(utf8_length(""), 0u);
  EXPECT_EQ(utf8_length("\xc3"), 0u);
  EXPECT_EQ(utf8_length("\xe2\x82"), 0u);
  EXPECT_EQ(utf8_length("\xf0\x9f\x98"), 0u);
  EXPECT_EQ(utf8_length("\xe2(\xa1"), 0u);
}

// RFC 3629, section 3 forbids all of these.
TEST(Utf8Length, ForbiddenForm_Zero) {
  EXPECT_EQ(utf8_length("\x80"), 0u) << "a continuation byte alone";
  EXPECT_EQ(utf8_length("\xc0\x80"), 0u) << "overlong NUL";
  EXPECT_EQ(utf8_length("\xe0\x80\xaf"), 0u) << "overlong slash";
  EXPECT_EQ(utf8_length("\xf0\x80\x80\xaf"), 0u) << "overlong slash";
  EXPECT_EQ(utf8_length("\xed\xa0\x80"), 0u) << "surrogate";
  EXPECT_EQ(utf8_length("\xf4\x90\x80\x80"), 0u) << "beyond U+10FFFF";
  EXPECT_EQ(utf8_length("\xff"), 0u);
}

}  // namespace
}  // namespace cornerd::message
