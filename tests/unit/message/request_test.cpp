// SPDX-License-Identifier: MIT
#include "message/request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "message/field_reader.hpp"

namespace cornerd::message {
namespace {

using ::testing::HasSubstr;

RequestError request_error(std::string_view line) {
  const Request request = parse_request(line);
  const auto* error = std::get_if<RequestError>(&request.body);
  EXPECT_NE(error, nullptr) << line;
  return error != nullptr ? *error : RequestError{};
}

TEST(ParseRequest, WatchWithClasses_ClassesSelected) {
  const Request request = parse_request(R"({"class":"WATCH","classes":["POSE","SCAN"],"id":7})");
  const auto& classes = std::get<WatchRequest>(request.body).classes;
  EXPECT_TRUE(classes.contains(MessageClass::kPose));
  EXPECT_TRUE(classes.contains(MessageClass::kScan));
  EXPECT_FALSE(classes.contains(MessageClass::kStatus));
  EXPECT_EQ(request.name, "WATCH");
  EXPECT_EQ(request.id_json, "7");
}

TEST(ParseRequest, WatchWithoutNames_EmptySet) {
  const Request request = parse_request(R"({"class":"WATCH","classes":[]})");
  EXPECT_TRUE(std::get<WatchRequest>(request.body).classes.empty());
}

TEST(ParseRequest, WatchOfUnknownClass_NamedInError) {
  const RequestError error = request_error(R"({"class":"WATCH","classes":["POSE","pose"]})");
  EXPECT_EQ(error.code, "field");
  EXPECT_THAT(error.text, HasSubstr("pose"));
}

TEST(ParseRequest, WatchWithInvalidClasses_Error) {
  for (const char* line : {R"({"class":"WATCH"})", R"({"class":"WATCH","classes":"POSE"})",
                           R"({"class":"WATCH","classes":[1]})"}) {
    EXPECT_THAT(request_error(line).text, HasSubstr("\"classes\"")) << line;
  }
}

TEST(ParseRequest, RequestsWithoutFields_Accepted) {
  EXPECT_TRUE(std::holds_alternative<PollRequest>(parse_request(R"({"class":"POLL"})").body));
  EXPECT_TRUE(std::holds_alternative<RelocalizeRequest>(
      parse_request(R"({"class":"RELOCALIZE","later":"field"})").body));
}

TEST(ParseRequest, PollWithoutClasses_PoseAndStatus) {
  const auto classes = std::get<PollRequest>(parse_request(R"({"class":"POLL"})").body).classes;
  for (const MessageClass polled : kPolled) {
    EXPECT_EQ(classes.contains(polled),
              polled == MessageClass::kPose || polled == MessageClass::kStatus)
        << to_string(polled);
  }
}

TEST(ParseRequest, PollWithClasses_TheseOnly) {
  const Request request = parse_request(R"({"class":"POLL","classes":["MAP"]})");
  const auto classes = std::get<PollRequest>(request.body).classes;
  EXPECT_TRUE(classes.contains(MessageClass::kMap));
  EXPECT_FALSE(classes.contains(MessageClass::kPose));
  EXPECT_THAT(request_error(R"({"class":"POLL","classes":["MAP","SCAN"]})").text,
              HasSubstr("POSE, STATUS, EVENT, MAP and ODOM"));
}

TEST(ParseRequest, SetMap_NameOrFile) {
  const auto by_name = parse_request(R"({"class":"SET_MAP","name":"floor 2"})");
  EXPECT_EQ(std::get<SetMapRequest>(by_name.body).name, "floor 2");
  const auto by_file = parse_request(R"({"class":"SET_MAP","file":"/maps/a.json"})");
  EXPECT_EQ(std::get<SetMapRequest>(by_file.body).file, "/maps/a.json");
  for (const char* wrong :
       {R"({"class":"SET_MAP"})", R"({"class":"SET_MAP","name":"a","file":"b"})",
        R"({"class":"SET_MAP","name":""})", R"({"class":"SET_MAP","file":7})",
        R"({"class":"SET_MAP","file":"a\u0000b"})"}) {
    EXPECT_EQ(request_error(wrong).code, "field") << wrong;
  }
}

TEST(ParseRequest, SetPose_ThetaNormalized) {
  const Request request = parse_request(R"({"class":"SET_POSE","x":1,"y":-2.5,"theta":4})");
  const auto& pose = std::get<SetPoseRequest>(request.body).T_map_base;
  EXPECT_EQ(pose.x_m, 1);
  EXPECT_EQ(pose.y_m, -2.5);
  EXPECT_NEAR(pose.theta_rad, 4 - core::kTwoPi, 1e-12);
}

TEST(ParseRequest, SetPoseInDegrees_Refused) {
  EXPECT_THAT(request_error(R"({"class":"SET_POSE","x":1,"y":0,"theta":90})").text,
              HasSubstr("\"theta\" must be from -6.3 to 6.3 radians, not degrees"));
}

TEST(ParseRequest, SetPoseWithoutField_NamedInError) {
  EXPECT_EQ(request_error(R"({"class":"SET_POSE","x":1,"theta":0})").text, "\"y\" is missing");
  EXPECT_EQ(request_error(R"({"class":"SET_POSE","x":"1","y":0,"theta":0})").text,
            "\"x\" must be a number");
}

TEST(ParseRequest, OdometryWithoutValues_Refused) {
  const RequestError error = request_error(R"({"class":"ODOMETRY","t":1})");
  EXPECT_THAT(error.text, HasSubstr("needs \"left\" and \"right\""));
  EXPECT_EQ(error.cause, FieldReader::kMissing);
}

TEST(ParseRequest, OdometryFields_Read) {
  const auto bare =
      std::get<OdometryReading>(parse_request(R"({"class":"ODOMETRY","left":1})").body);
  EXPECT_FALSE(bare.timed);
  EXPECT_EQ(bare.right, std::nullopt);
  const auto full = std::get<OdometryReading>(
      parse_request(R"({"class":"ODOMETRY","t":1.5,"left":-3,"right":4.0,"gyro":0.1})").body);
  EXPECT_TRUE(full.timed);
  EXPECT_EQ(full.t_ns, 1'500'000'000);
  EXPECT_EQ(full.left, -3);
  EXPECT_EQ(full.right, 4);
  EXPECT_EQ(full.gyro_rad_s, 0.1);
}

TEST(ParseRequest, OdometryWithInvalidCounts_Refused) {
  EXPECT_THAT(request_error(R"({"class":"ODOMETRY","left":1.5})").text, HasSubstr("whole number"));
  EXPECT_THAT(request_error(R"({"class":"ODOMETRY","left":18446744073709551615})").text,
              HasSubstr("64 bits"));
  EXPECT_THAT(request_error(R"({"class":"ODOMETRY","left":true})").text, HasSubstr("a number"));
  EXPECT_THAT(request_error(R"({"class":"ODOMETRY","t":1795161601180,"left":1,"right":1})").text,
              HasSubstr("seconds, not thousandths of them"));
}

TEST(ParseRequest, IdOfAnyScalarType_Repeated) {
  const auto id_of = [](const std::string& id) {
    return parse_request(R"({"class":"POLL","id":)" + id + "}").id_json;
  };
  for (const char* id :
       {"0", "-7", "18446744073709551615", "2.5", "true", "null", "\"a\\\"b\"", "\"\xc3\xbc\""}) {
    EXPECT_EQ(id_of(id), id);
  }
  EXPECT_EQ(parse_request(R"({"class":"POLL"})").id_json, "");
}

TEST(ParseRequest, IdNotScalarOrTooLong_Error) {
  EXPECT_THAT(request_error(R"({"class":"POLL","id":[1]})").text, HasSubstr("\"id\""));
  EXPECT_THAT(request_error(R"({"class":"POLL","id":")" + std::string(300, 'x') + "\"}").text,
              HasSubstr("\"id\""));
}

TEST(ParseRequest, ErrorInOtherField_KeepsId) {
  const Request request = parse_request(R"({"class":"WATCH","id":"mine"})");
  EXPECT_TRUE(std::holds_alternative<RequestError>(request.body));
  EXPECT_EQ(request.id_json, "\"mine\"");
  EXPECT_EQ(request.name, "WATCH");
}

TEST(ParseRequest, UnknownOrMissingClass_OwnErrorCode) {
  EXPECT_EQ(request_error(R"({"class":"FLY"})").code, "class");
  EXPECT_THAT(request_error(R"({"class":"FLY"})").text, HasSubstr("FLY"));
  EXPECT_EQ(request_error("{}").code, "class");
  EXPECT_EQ(request_error(R"({"class":3})").code, "field");
}

TEST(ParseRequest, NotAnObject_JsonError) {
  for (const char* line : {"", " ", "hello", "[]", "1", "{\"class\":\"POLL\"", "{}{}", "\xff",
                           "{\"class\":\"\xff\"}", "{\"class\":\"POLL\",\"n\":1e999}", "null"}) {
    EXPECT_EQ(request_error(line).code, "json") << line;
  }
}

TEST(ParseRequest, NotANumber_SaysThatJsonHasNone) {
  EXPECT_THAT(request_error(R"({"class":"SET_POSE","x":NaN})").text, HasSubstr("JSON has no NaN"));
}

TEST(ParseRequest, TooLongOrTooDeep_RefusedBeforeParsing) {
  EXPECT_EQ(request_error(std::string(kMaxRequestBytes + 1, ' ')).code, "too-long");
  EXPECT_EQ(request_error(std::string(kMaxRequestBytes, '[')).code, "json");
  EXPECT_THAT(request_error(R"({"a":[[[[[[[[1]]]]]]]]})").text, HasSubstr("nested"));
}

TEST(ParseRequest, BracketsInString_NotCountedAsDepth) {
  const Request request = parse_request(R"({"class":"POLL","id":"[[[[[[[[[[\"[[[["})");
  EXPECT_TRUE(std::holds_alternative<PollRequest>(request.body));
}

TEST(MessageClass, EveryName_ConvertsBackToItsClass) {
  for (int i = 0; i < static_cast<int>(kMessageClasses); ++i) {
    const auto message_class = static_cast<MessageClass>(i);
    EXPECT_EQ(message_class_from(to_string(message_class)), message_class);
  }
  EXPECT_EQ(to_string(MessageClass::kBreakpoints), "BREAKPOINTS");
  EXPECT_EQ(message_class_from("TRUTH"), std::nullopt);
}

TEST(ParseRequest, KeyTwice_NamedInError) {
  for (const char* line :
       {R"({"class":"SET_POSE","x":1,"y":2,"theta":0,"x":3})",
        R"({"class":"SET_POSE","x":{"x":1},"y":"\\\"x\":","theta":0,"\u0078":3})"}) {
    const RequestError error = request_error(line);
    EXPECT_EQ(error.code, "json") << line;
    EXPECT_EQ(error.text, "the key \"x\" is there twice") << line;
  }
  EXPECT_EQ(request_error(R"({"class":"POLL","class":"WATCH"})").text,
            "the key \"class\" is there twice");
  EXPECT_TRUE(std::holds_alternative<PollRequest>(
      parse_request(R"({"class":"POLL","a":{"b":1,"b":2},"b":[":",{"c":1}],"c":":{\"c\":"})")
          .body));
}

}  // namespace
}  // namespace cornerd::message
