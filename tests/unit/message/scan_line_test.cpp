// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <variant>

#include "core/scan.hpp"
#include "line_text.hpp"
#include "message/line_writer.hpp"
#include "message/request.hpp"

namespace cornerd::message {
namespace {

using nlohmann::json;

core::Scan scan_of(std::initializer_list<core::TimeNs> times_ns) {
  core::Scan scan;
  for (const core::TimeNs t_ns : times_ns) {
    const auto i = static_cast<float>(scan.size());
    scan.add({.t_ns = t_ns, .bearing_rad = 3 - i, .range_m = 1 + i / 4, .quality = 47});
  }
  return scan;
}

TEST(ScanLine, EvenlySpacedSamples_NoTimes) {
  LineWriter writer;
  EXPECT_EQ(writer.scan(scan_of({1'000'000'000, 1'100'000'000, 1'200'000'000})),
            R"({"class":"SCAN","t":1.000000,"duration":0.3,"angles":[3,2,1],)"
            R"("ranges":[1,1.25,1.5],"quality":[47,47,47]})"
            "\n");
}

TEST(ScanLine, GapInSamples_TimesWritten) {
  LineWriter writer;
  const json line = read(writer.scan(scan_of({0, 1'000'000, 2'000'000, 8'000'000, 9'000'000})));
  EXPECT_EQ(line["times"], json::parse("[0,0.001,0.002,0.008,0.009]"));
}

TEST(ScanLine, EmptyOrSingleSample_ValidLine) {
  LineWriter writer;
  EXPECT_EQ(read(writer.scan(core::Scan{}))["angles"], json::array());
  EXPECT_EQ(read(writer.scan(scan_of({5})))["duration"], 0);
}

TEST(ScanLine, NonFiniteSample_NoReturn) {
  LineWriter writer;
  core::Scan scan;
  scan.add({.bearing_rad = 1, .range_m = std::numeric_limits<float>::quiet_NaN()});
  EXPECT_EQ(read(writer.scan(scan))["ranges"], json::parse("[0]"));
}

/// The tolerances are the resolution of the line.
void expect_same_after_reading(const core::Scan& scan) {
  LineWriter writer;
  const auto parsed = parse_recorded_line(writer.scan(scan));
  ASSERT_TRUE(std::holds_alternative<RecordedScan>(parsed));
  const auto& samples = std::get<RecordedScan>(parsed).samples;
  ASSERT_EQ(samples.size(), scan.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const core::Sample& original = scan.samples()[i];
    EXPECT_NEAR(static_cast<double>(samples[i].t_ns), static_cast<double>(original.t_ns), 1500);
    EXPECT_NEAR(samples[i].bearing_rad, original.bearing_rad, 1e-6);
    EXPECT_NEAR(samples[i].range_m, original.range_m, 1e-5);
    EXPECT_EQ(samples[i].quality, original.quality);
  }
}

TEST(ScanLine, ReadBack_SameScan) {
  expect_same_after_reading(scan_of({1'000'000'000, 1'000'500'000, 1'001'000'000}));
  expect_same_after_reading(scan_of({1'000'000'000, 1'000'500'000, 1'009'000'000}));
}

}  // namespace
}  // namespace cornerd::message
