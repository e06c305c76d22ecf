// SPDX-License-Identifier: MIT
#include "settings/lidar_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"

namespace cornerd::settings {
namespace {

using ::testing::HasSubstr;

LidarCalibration a1_calibration() {
  LidarCalibration calibration;
  calibration.serial = "9D38E1C3";
  calibration.configured.range_offset_m = 0.002;
  calibration.learned = {{0.0098, 0.0051, 0.0036, -0.0034}, {4e-4, 5e-4, 2e-4, 2e-4}, 412};
  return calibration;
}

std::string calibration_error(const std::string& text) {
  return error_of([&] { parse_lidar_calibration(text, "l.json"); });
}

TEST(LidarCalibration, Written_ReadsTheSame) {
  const LidarCalibration calibration = a1_calibration();
  const LidarCalibration again = parse_lidar_calibration(text_of(calibration), "l.json");
  EXPECT_EQ(again.serial, calibration.serial);
  EXPECT_EQ(again.configured, calibration.configured);
  EXPECT_EQ(again.learned.bias, calibration.learned.bias);
  EXPECT_EQ(again.learned.sigma, calibration.learned.sigma);
  EXPECT_EQ(again.learned.scans, 412u);
}

TEST(LidarCalibration, WithoutASerialNumber_ReadsTheSame) {
  LidarCalibration calibration = a1_calibration();
  calibration.serial.clear();
  EXPECT_EQ(parse_lidar_calibration(text_of(calibration), "l.json").serial, "");
}

TEST(LidarCalibration, TruncatedFile_IsAnError) {
  const std::string text = text_of(a1_calibration());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    EXPECT_THAT(calibration_error(text.substr(0, length)), HasSubstr("l.json")) << length;
  }
}

TEST(LidarCalibration, OldKey_IsRefusedWithItsNewName) {
  std::string text = text_of(a1_calibration());
  text.replace(text.find("\"scans\""), 7, "\"turns\"");
  EXPECT_THAT(calibration_error(text), HasSubstr("/turns: moved; write /scans instead"));
}

TEST(LidarCalibration, WrongOrMissingKey_IsNamed) {
  EXPECT_THAT(calibration_error("{}"), HasSubstr("/format"));
  EXPECT_THAT(calibration_error(R"({"format":"cornerd-map"})"), HasSubstr("/format"));
  EXPECT_THAT(calibration_error(R"({"format":"cornerd-lidar","scans":3})"), HasSubstr("/sigma"));
  LidarCalibration calibration = a1_calibration();
  calibration.learned.scans = 0;
  EXPECT_THAT(calibration_error(text_of(calibration)), HasSubstr("/scans"));
  calibration = a1_calibration();
  calibration.learned.bias.range_scale = 0.2;
  EXPECT_THAT(calibration_error(text_of(calibration)), HasSubstr("/bias/range_scale"));
  calibration = a1_calibration();
  for (const double sigma : {-1e-4, 0.0, 1e-200}) {
    calibration.learned.sigma.bearing_cosine_rad = sigma;
    EXPECT_THAT(calibration_error(text_of(calibration)), HasSubstr("/sigma")) << sigma;
  }
}

}  // namespace
}  // namespace cornerd::settings
