// SPDX-License-Identifier: MIT
#include "drivers/rplidar/scan_mode.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cornerd::rplidar {
namespace {

const std::vector<ScanMode> kFirmware129{{0, "Standard", WireFormat::kStandard, 508e-6},
                                         {1, "Express", WireFormat::kExpress, 254e-6},
                                         {2, "Boost", WireFormat::kUltra, 127e-6},
                                         {3, "Sensitivity", WireFormat::kUltra, 127e-6},
                                         {4, "Stability", WireFormat::kUltra, 201e-6}};

TEST(ScanMode, Auto_PrefersExpress) {
  EXPECT_EQ(choose_mode(kFirmware129, "auto")->name, "Express");
  EXPECT_EQ(choose_mode(std::span(kFirmware129).first(1), "auto")->name, "Standard");
}

TEST(ScanMode, Name_IsCaseInsensitive) {
  EXPECT_EQ(choose_mode(kFirmware129, "sensitivity")->id, 3);
  EXPECT_EQ(choose_mode(kFirmware129, "STANDARD")->id, 0);
}

TEST(ScanMode, UnknownName_GivesNull) {
  EXPECT_EQ(choose_mode(kFirmware129, "Turbo"), nullptr);
  EXPECT_EQ(choose_mode(kFirmware129, ""), nullptr);
  EXPECT_EQ(choose_mode({}, "auto"), nullptr);
  EXPECT_EQ(list_names(std::span(kFirmware129).first(3)), "Standard, Express, Boost");
}

TEST(ScanMode, Request_IsScanForStandardElseExpressScan) {
  EXPECT_EQ(kFirmware129[0].request().command(), Command::kScan);
  EXPECT_EQ(kFirmware129[1].request().command(), Command::kExpressScan);
  EXPECT_EQ(kFirmware129[3].request().payload()[0], 3);
}

}  // namespace
}  // namespace cornerd::rplidar
