// SPDX-License-Identifier: MIT
#include "settings/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "error_of.hpp"

namespace cornerd::settings {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string document_error(std::string_view text) {
  return error_of([text] { parse_document(text, "f.json"); });
}

TEST(Document, Comments_AreAllowed) {
  const Json document = parse_document("// one\n{ \"a\": 1 /* two */ } // three", "f.json");
  EXPECT_EQ(document["a"], 1);
}

TEST(Document, NoJson_IsNamedByLineAndColumn) {
  EXPECT_THAT(document_error("{\n  \"a\": 1,\n}"), StartsWith("f.json: line 3, column 1: "));
  EXPECT_THAT(document_error(""), StartsWith("f.json: line 1, column 1: "));
  EXPECT_THAT(document_error("{\"a\": NaN}"), StartsWith("f.json: line 1, column"));
  EXPECT_THAT(document_error("{} {}"), StartsWith("f.json: line 1, column"));
  EXPECT_THAT(document_error("{\"a\": \"\xff\"}"), StartsWith("f.json: line 1, column"));
}

TEST(Document, NumberBeyondADouble_IsNamedByItsPointer) {
  EXPECT_THAT(document_error(R"({"a": {"b": 1, "c": 1e999}})"),
              AllOf(StartsWith("f.json: /a/c: "), HasSubstr("1e999")));
  EXPECT_THAT(document_error(R"({"w": [1, [2], 1e999]})"), StartsWith("f.json: /w/2: "));
}

TEST(Document, KeyTwice_IsNamedByItsPointer) {
  EXPECT_EQ(document_error(R"({"a": {"b": 1, "c": {"b": 2}, "b": 3}})"),
            "f.json: /a/b: this key is there twice");
  EXPECT_EQ(document_error(R"({"w": [1, [2], {"x": 1, "x": 1}]})"),
            "f.json: /w/2/x: this key is there twice");
  EXPECT_NO_THROW(parse_document(R"([{"a": 1}, {"a": 1}])", "f.json"));
}

TEST(Document, TooDeep_IsAnError) {
  EXPECT_THAT(document_error(std::string(100'000, '[')), HasSubstr("nested too deep"));
}

TEST(ChildPointer, SpecialCharacters_AreEscaped) {
  EXPECT_EQ(child_pointer("/a", "b/c~d"), "/a/b~1c~0d");
}

}  // namespace
}  // namespace cornerd::settings
