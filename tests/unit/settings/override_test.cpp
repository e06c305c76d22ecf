// SPDX-License-Identifier: MIT
#include "settings/override.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "error_of.hpp"

namespace cornerd::settings {
namespace {

using ::testing::HasSubstr;

TEST(Override, Value_IsJsonOrElseText) {
  Json document = Json::object();
  EXPECT_EQ(apply_override(document, "/a=1.5"), "/a");
  apply_override(document, "/b=true");
  apply_override(document, "/c=/dev/ttyS1");
  apply_override(document, "/d=\"12\"");
  apply_override(document, "/e={\"f\": 1}");
  apply_override(document, "/g=x=y");
  EXPECT_EQ(document, Json::parse(R"({"a": 1.5, "b": true, "c": "/dev/ttyS1", "d": "12",
                                      "e": {"f": 1}, "g": "x=y"})"));
}

TEST(Override, AbsentObjects_AreMadeOnTheWay) {
  Json document = Json::parse(R"({"a": {"b": 1}})");
  apply_override(document, "/a/c/d=2");
  apply_override(document, "/e~1f/~0=3");
  EXPECT_EQ(document, Json::parse(R"({"a": {"b": 1, "c": {"d": 2}}, "e/f": {"~": 3}})"));
}

TEST(Override, WhatIsNoPointerAndValue_IsAnError) {
  for (const char* text : {"", "=1", "a=1", "/a", "/=1"}) {
    EXPECT_THAT(error_of([text] {
                  Json document;
                  apply_override(document, text);
                }),
                HasSubstr("must be /json/pointer=value"))
        << text;
  }
}

TEST(Override, InsideAValueThatIsNoObject_IsAnError) {
  EXPECT_THAT(error_of([] {
                Json document = Json::parse(R"({"map": "/m"})");
                apply_override(document, "/map/x=1");
              }),
              HasSubstr("/map/x"));
}

}  // namespace
}  // namespace cornerd::settings
