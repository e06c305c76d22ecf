// SPDX-License-Identifier: MIT
#include "settings/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <string>

#include "error_of.hpp"

namespace cornerd::settings {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string document_error(std::string_view text) {
  return error_of([text] { parse_document(text, "f.json"); });
}

TEST(Document, Comments_AreAllowed) {
  const Json document = parse_document("// one\n{ \"a\": 1 /* two */ } // three", "f.json");
  EXPECT_EQ(document["a"], 1);
}

TEST(Document, OtherSyntaxes_GetTheWayOut) {
  EXPECT_THAT(document_error("{\"a\": 1,}"), HasSubstr("no comma after the last one"));
  EXPECT_THAT(document_error("{\"a\": [1, 2,]}"), HasSubstr("no comma after the last one"));
  EXPECT_THAT(document_error("# map\n{}"), HasSubstr("a comment begins with //"));
  EXPECT_THAT(document_error("{'a': 1}"), HasSubstr("in double quotes"));
  EXPECT_THAT(document_error("{a: 1}"), HasSubstr("in double quotes"));
  EXPECT_THAT(document_error("map: flat.json"), HasSubstr("in double quotes"));
  EXPECT_THAT(document_error("{\"a\": 5m}"), HasSubstr("numbers have no unit"));
  for (const char* text : {"{\"a\": 1", "{\"a\": \"it\\'s\"}", "{\"a\": \"b#", "{\"a\": ]}",
                           "{\"invalid literal\": }"}) {
    EXPECT_THAT(document_error(text),
                Not(AnyOf(HasSubstr("double quotes"), HasSubstr("//"), HasSubstr("no comma"))))
        << text;
  }
}

TEST(Document, SyntaxError_IsNamedByLineAndColumn) {
  EXPECT_THAT(document_error("{\n  \"a\": 1,\n}"), StartsWith("f.json: line 3, column 1: "));
  EXPECT_THAT(document_error(""), StartsWith("f.json: line 1, column 1: "));
  EXPECT_THAT(document_error("{\"a\": NaN}"), StartsWith("f.json: line 1, column"));
  EXPECT_THAT(document_error("{} {}"), StartsWith("f.json: line 1, column"));
  EXPECT_THAT(document_error("{\"a\": \"\xff\"}"), StartsWith("f.json: line 1, column"));
}

TEST(Document, NumberOutsideDouble_IsNamedByItsPointer) {
  EXPECT_THAT(document_error(R"({"a": {"b": 1, "c": 1e999}})"),
              AllOf(StartsWith("f.json: /a/c: "), HasSubstr("1e999")));
  EXPECT_THAT(document_error(R"({"w": [1, [2], 1e999]})"), StartsWith("f.json: /w/2: "));
}

TEST(Document, RepeatedKey_IsNamedByItsPointer) {
  EXPECT_EQ(document_error(R"({"a": {"b": 1, "c": {"b": 2}, "b": 3}})"),
            "f.json: /a/b: this key is there twice");
  EXPECT_EQ(document_error(R"({"w": [1, [2], {"x": 1, "x": 1}]})"),
            "f.json: /w/2/x: this key is there twice");
  EXPECT_NO_THROW(parse_document(R"([{"a": 1}, {"a": 1}])", "f.json"));
}

TEST(Document, NestingTooDeep_IsAnError) {
  EXPECT_THAT(document_error(std::string(100'000, '[')), HasSubstr("/0/0: nested too deep"));
}

TEST(ChildPointer, SpecialCharacters_AreEscaped) {
  EXPECT_EQ(child_pointer("/a", "b/c~d"), "/a/b~1c~0d");
}

TEST(Override, Value_IsJsonOrText) {
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

TEST(Override, AbsentObjects_AreCreated) {
  Json document = Json::parse(R"({"a": {"b": 1}})");
  apply_override(document, "/a/c/d=2");
  apply_override(document, "/e~1f/~0=3");
  EXPECT_EQ(document, Json::parse(R"({"a": {"b": 1, "c": {"d": 2}}, "e/f": {"~": 3}})"));
}

TEST(Override, WithoutPointerOrValue_IsAnError) {
  for (const char* text : {"", "=1", "a=1", "/a", "/=1"}) {
    EXPECT_THAT(error_of([text] {
                  Json document;
                  apply_override(document, text);
                }),
                HasSubstr("must be /json/pointer=value"))
        << text;
  }
}

TEST(Override, BelowANonObject_IsAnError) {
  EXPECT_THAT(error_of([] {
                Json document = Json::parse(R"({"map": "/m"})");
                apply_override(document, "/map/x=1");
              }),
              HasSubstr("/map/x"));
}

TEST(ReadFile, LimitOfOpenFiles_IsNamedWithTheWayOut) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlimit none{3, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  std::string error;
  try {
    read_file("/etc/passwd", 1 << 20, FileKind::kOrdinary);
  } catch (const SettingsError& refused) {
    error = refused.what();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_NE(error.find("of at most 3 in this process: raise `ulimit -n`"), std::string::npos)
      << error;
}

}  // namespace
}  // namespace cornerd::settings
