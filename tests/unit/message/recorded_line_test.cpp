// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/scan.hpp"
#include "message/request.hpp"

namespace cornerd::message {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

RecordedScan scan_of(std::string_view line) {
  const RecordedLine recorded = parse_recorded_line(line);
  const auto* scan = std::get_if<RecordedScan>(&recorded);
  EXPECT_NE(scan, nullptr) << line;
  return scan != nullptr ? *scan : RecordedScan{};
}

std::string error_of(std::string_view line) {
  const RecordedLine recorded = parse_recorded_line(line);
  const auto* error = std::get_if<RequestError>(&recorded);
  EXPECT_NE(error, nullptr) << line;
  return error != nullptr ? error->text : std::string();
}

TEST(RecordedScan, WithoutTimes_SamplesEvenlySpaced) {
  const RecordedScan scan =
      scan_of(R"({"class":"SCAN","t":2,"duration":0.4,"angles":[0,-1,-2,-3],"ranges":[1,2,0,4]})");
  ASSERT_EQ(scan.samples.size(), 4u);
  EXPECT_EQ(scan.t_ns, 2'000'000'000);
  EXPECT_EQ(scan.duration_ns, 400'000'000);
  EXPECT_EQ(scan.samples[0].t_ns, 2'000'000'000);
  EXPECT_EQ(scan.samples[3].t_ns, 2'300'000'000);
  EXPECT_TRUE(scan.samples[0].starts_scan);
  EXPECT_FALSE(scan.samples[1].starts_scan);
  EXPECT_FALSE(scan.samples[2].ends_scan);
  EXPECT_TRUE(scan.samples[3].ends_scan);
  EXPECT_EQ(scan.samples[1].bearing_rad, -1);
  EXPECT_EQ(scan.samples[1].range_m, 2);
}

TEST(RecordedScan, WithTimes_TimesUsed) {
  const RecordedScan scan = scan_of(
      R"({"class":"SCAN","t":1,"duration":9,"angles":[0,1],"ranges":[1,1],"times":[0.5,0.25]})");
  EXPECT_EQ(scan.samples[0].t_ns, 1'500'000'000);
  EXPECT_EQ(scan.samples[1].t_ns, 1'250'000'000);
}

TEST(RecordedScan, WithoutDuration_AllSamplesAtSameTime) {
  const RecordedScan scan = scan_of(R"({"class":"SCAN","t":1,"angles":[0,1],"ranges":[1,1]})");
  EXPECT_EQ(scan.duration_ns, 0);
  EXPECT_EQ(scan.samples[1].t_ns, 1'000'000'000);
}

TEST(RecordedScan, RangeNullOrNegative_NoReturn) {
  const RecordedScan scan =
      scan_of(R"({"class":"SCAN","t":1,"angles":[0,1,2],"ranges":[null,-1,0]})");
  for (const core::Sample& sample : scan.samples) EXPECT_EQ(sample.range_m, 0);
}

TEST(RecordedScan, BearingsBeyondPi_Normalized) {
  const RecordedScan scan =
      scan_of(R"({"class":"SCAN","t":0,"angles":[6.2,-6.2],"ranges":[1,1],"quality":[15,255]})");
  EXPECT_NEAR(scan.samples[0].bearing_rad, 6.2 - core::kTwoPi, 1e-6);
  EXPECT_NEAR(scan.samples[1].bearing_rad, core::kTwoPi - 6.2, 1e-6);
  EXPECT_EQ(scan.samples[0].quality, 15);
  EXPECT_EQ(scan.samples[1].quality, 255);
}

TEST(RecordedScan, ArraysOfUnequalLength_Error) {
  EXPECT_THAT(error_of(R"({"class":"SCAN","t":1,"angles":[0,1],"ranges":[1]})"),
              HasSubstr("equally long"));
  EXPECT_THAT(error_of(R"({"class":"SCAN","t":1,"angles":[0],"ranges":[1],"quality":[]})"),
              HasSubstr("\"quality\""));
  EXPECT_THAT(error_of(R"({"class":"SCAN","t":1,"angles":[0],"ranges":[1],"times":[0,1]})"),
              HasSubstr("\"times\""));
}

TEST(RecordedScan, WrongElement_IndexInError) {
  EXPECT_THAT(error_of(R"({"class":"SCAN","t":1,"angles":[0,"1"],"ranges":[1,1]})"),
              HasSubstr("\"angles\"[1] must be a number"));
  EXPECT_THAT(error_of(R"({"class":"SCAN","t":1,"angles":[0,90],"ranges":[1,1]})"),
              HasSubstr("\"angles\"[1] must be from -6.3 to 6.3"));
  EXPECT_THAT(error_of(R"({"class":"SCAN","t":1,"angles":[0],"ranges":[1],"quality":[256]})"),
              HasSubstr("\"quality\"[0]"));
}

TEST(RecordedScan, MissingField_NamedInError) {
  EXPECT_EQ(error_of(R"({"class":"SCAN","angles":[],"ranges":[]})"), "\"t\" is missing");
  EXPECT_EQ(error_of(R"({"class":"SCAN","t":1,"ranges":[]})"), "\"angles\" is missing");
}

TEST(RecordedScan, TooManySamples_Refused) {
  const auto line_of = [](std::size_t count) {
    std::string zeros = "0";
    for (std::size_t i = 1; i < count; ++i) zeros += ",0";
    return R"({"class":"SCAN","t":1,"angles":[)" + zeros + R"(],"ranges":[)" + zeros + "]}";
  };
  EXPECT_EQ(scan_of(line_of(core::kMaxSamplesPerScan)).samples.size(), core::kMaxSamplesPerScan);
  EXPECT_THAT(error_of(line_of(core::kMaxSamplesPerScan + 1)), HasSubstr("10240"));
}

TEST(RecordedSerial, HexDigits_Decoded) {
  const auto serial =
      std::get<RecordedBytes>(parse_recorded_line(R"({"class":"SERIAL","t":0.5,"rx":"A55a00"})"));
  EXPECT_TRUE(serial.received);
  EXPECT_EQ(serial.t_ns, 500'000'000);
  EXPECT_THAT(serial.bytes, ElementsAre(0xa5, 0x5a, 0x00));
}

TEST(RecordedSerial, DamagedHex_Error) {
  EXPECT_THAT(error_of(R"({"class":"SERIAL","t":0,"rx":"a5f"})"), HasSubstr("half a byte"));
  EXPECT_THAT(error_of(R"({"class":"SERIAL","t":0,"tx":"zz"})"), HasSubstr("hexadecimal"));
  EXPECT_THAT(error_of(R"({"class":"SERIAL","t":0})"), HasSubstr("\"tx\" is missing"));
  EXPECT_THAT(error_of(R"({"class":"SERIAL","t":0,"rx":"","tx":""})"), HasSubstr("not both"));
}

TEST(RecordedOdometry, WithoutTime_Error) {
  EXPECT_EQ(error_of(R"({"class":"ODOMETRY","left":1})"), "\"t\" is missing");
}

TEST(RecordedLine, OtherClasses_Skipped) {
  const auto other = std::get<OtherLine>(parse_recorded_line(R"({"class":"POSE","x":"junk"})"));
  EXPECT_EQ(other.name, "POSE");
}

TEST(RecordedLine, DamagedLine_Error) {
  EXPECT_THAT(error_of("{\"class\":\"SCAN\",\"angles\":[0.1,"), HasSubstr("JSON"));
  EXPECT_THAT(error_of("{}"), HasSubstr("\"class\""));
  EXPECT_THAT(error_of(std::string(kMaxRecordedBytes + 1, '[')), HasSubstr("at most"));
}

TEST(TruthLine, WrongOrMissingNumber_NamedInError) {
  const auto error = [](std::string_view line) {
    return std::get<RequestError>(parse_truth_line(line)).text;
  };
  EXPECT_EQ(error(R"({"t":0,"x":1,"theta":0})"), "\"y\" is missing");
  EXPECT_EQ(error(R"({"t":0,"x":null,"y":0,"theta":0})"), "\"x\" must be a number");
}

}  // namespace
}  // namespace cornerd::message
