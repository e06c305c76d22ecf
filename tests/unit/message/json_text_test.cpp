// SPDX-License-Identifier: MIT
#include "message/json_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"

namespace cornerd::message {
namespace {

std::string fixed(double value, int decimals) {
  JsonText text(64);
  text.fixed(value, decimals);
  return std::string(text.view());
}

std::string seconds(core::TimeNs t_ns) {
  JsonText text(64);
  text.seconds(t_ns);
  return std::string(text.view());
}

std::string in_quotes(std::string_view value) {
  JsonText text(64);
  text.string(value);
  return std::string(text.view());
}

TEST(JsonText, Fixed_FiniteValue_RoundedWithoutTrailingZeros) {
  EXPECT_EQ(fixed(1.23456789, 5), "1.23457");
  EXPECT_EQ(fixed(-1.23456789, 5), "-1.23457");
  EXPECT_EQ(fixed(0.5, 5), "0.5");
  EXPECT_EQ(fixed(-0.05, 5), "-0.05");
  EXPECT_EQ(fixed(12, 5), "12");
  EXPECT_EQ(fixed(7.6, 0), "8");
  EXPECT_EQ(fixed(0.999999999, 5), "1");
}

TEST(JsonText, Fixed_ValueBelowResolution_ZeroWithoutSign) {
  EXPECT_EQ(fixed(-1e-9, 5), "0");
  EXPECT_EQ(fixed(-0.0, 5), "0");
}

TEST(JsonText, Fixed_HugeValue_WrittenWithSignificantDigits) {
  EXPECT_EQ(nlohmann::json::parse(fixed(1e300, 5)).get<double>(), 1e300);
  EXPECT_EQ(nlohmann::json::parse(fixed(-1e18, 9)).get<double>(), -1e18);
}

TEST(JsonText, Significant_AnyMagnitude_SixDigits) {
  const auto significant = [](double value) {
    JsonText text(64);
    text.significant(value);
    return std::string(text.view());
  };
  EXPECT_EQ(significant(1.23456789e-7), "1.23457e-07");
  EXPECT_EQ(significant(-0.0), "0");
  EXPECT_EQ(significant(0.25), "0.25");
}

TEST(JsonText, Seconds_UnixTime_KeepsMicroseconds) {
  EXPECT_EQ(seconds(1'700'000'000'123'456'789), "1700000000.123457");
  EXPECT_EQ(seconds(0), "0.000000");
  EXPECT_EQ(seconds(1'499), "0.000001");
  EXPECT_EQ(seconds(-1'500), "-0.000002");
  EXPECT_EQ(seconds(-499), "0.000000");
  EXPECT_EQ(seconds(999'999'500), "1.000000");
}

TEST(JsonText, Seconds_LimitsOfType_Written) {
  EXPECT_EQ(seconds(std::numeric_limits<core::TimeNs>::max()), "9223372036.854776");
  EXPECT_EQ(seconds(std::numeric_limits<core::TimeNs>::min()), "-9223372036.854776");
}

TEST(JsonText, Angle_NearPi_ReadBackWithinInterval) {
  for (const double angle_rad :
       {core::kPi, -core::kPi, std::nextafter(-core::kPi, 0.0), 3.1415925}) {
    JsonText text(64);
    text.angle(angle_rad);
    const double read_back = nlohmann::json::parse(text.view()).get<double>();
    EXPECT_LE(read_back, core::kPi);
    EXPECT_GT(read_back, -core::kPi);
    EXPECT_NEAR(read_back, angle_rad, 1e-6);
  }
}

TEST(JsonText, String_SpecialCharacters_Escaped) {
  EXPECT_EQ(in_quotes("plain"), "\"plain\"");
  EXPECT_EQ(in_quotes("a\"b\\c\n\x01"), R"("a\"b\\c\n\u0001")");
  EXPECT_EQ(in_quotes("T\xc3\xbcr"), "\"T\xc3\xbcr\"");
}

TEST(JsonText, String_AnyBytes_ParsesAsJson) {
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  const auto parsed = nlohmann::json::parse(in_quotes(all));
  EXPECT_EQ(parsed.get<std::string>().substr(0, 128), all.substr(0, 128));
  EXPECT_EQ(parsed.get<std::string>().substr(128, 3), "\xef\xbf\xbd");
}

TEST(JsonText, Commas_NestedValues_Separated) {
  JsonText text(256);
  text.open_object();
  text.key("a");
  text.open_array();
  text.integer(1);
  text.integer(std::uint64_t{18446744073709551615u});
  text.open_object();
  text.close_object();
  text.close_array();
  text.key("b");
  text.boolean(false);
  text.close_object();
  EXPECT_EQ(text.view(), R"({"a":[1,18446744073709551615,{}],"b":false})");
}

TEST(JsonText, Commas_StringEndingInBracket_Separated) {
  JsonText text(64);
  text.open_array();
  text.string("[");
  text.string("x:");
  text.string("");
  text.close_array();
  EXPECT_EQ(text.view(), R"(["[","x:",""])");
}

}  // namespace
}  // namespace cornerd::message
