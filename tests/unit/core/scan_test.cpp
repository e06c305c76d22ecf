// SPDX-License-Identifier: MIT
#include "core/scan.hpp"

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace cornerd::core {
namespace {

Sample sample_at(double bearing_rad, bool starts_scan = false) {
  Sample sample;
  sample.bearing_rad = static_cast<float>(normalize_angle(bearing_rad));
  sample.range_m = 1;
  sample.starts_scan = starts_scan;
  return sample;
}

TEST(Scan, Reversed_LastBearingComesAtTheFirstTime) {
  Scan scan;
  for (int i = 0; i < 3; ++i) scan.add({.t_ns = 10 * i * i, .bearing_rad = static_cast<float>(i)});
  Scan reversed;
  reversed.assign_reversed(scan);
  ASSERT_EQ(reversed.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(reversed.samples()[i].t_ns, scan.samples()[i].t_ns);
    EXPECT_EQ(reversed.samples()[i].bearing_rad, scan.samples()[2 - i].bearing_rad);
  }
}

TEST(ScanAssembler, StreamJoinedMidScan_OnlyWholeScans) {
  ScanAssembler assembler;
  Scan scan;
  int scans = 0;
  for (int i = 37; i < 500; ++i) {
    if (!assembler.add(sample_at(-kTwoPi * i / 100, i % 100 == 0), scan)) continue;
    ++scans;
    EXPECT_EQ(scan.size(), 100U);
    EXPECT_TRUE(scan.samples().front().starts_scan);
  }
  EXPECT_EQ(scans, 3);
  EXPECT_EQ(assembler.dropped(), 63U);
}

TEST(ScanAssembler, Finish_WholeRevolution_IsHandedOut) {
  ScanAssembler assembler;
  Scan scan;
  for (int i = 0; i < 99; ++i) assembler.add(sample_at(-kTwoPi * i / 100, i == 0), scan);
  EXPECT_TRUE(assembler.finish(scan));
  EXPECT_EQ(scan.size(), 99U);
  EXPECT_FALSE(assembler.finish(scan));
}

TEST(ScanAssembler, Finish_PartialRevolution_IsDropped) {
  ScanAssembler assembler;
  Scan scan;
  for (int i = 0; i < 60; ++i) assembler.add(sample_at(-kTwoPi * i / 100, i == 0), scan);
  EXPECT_FALSE(assembler.finish(scan));
  EXPECT_EQ(assembler.dropped(), 60U);
}

TEST(ScanAssembler, SampleEndsScan_CompletesAtOnce) {
  ScanAssembler assembler;
  Scan scan;
  EXPECT_FALSE(assembler.add(sample_at(0, true), scan));
  EXPECT_FALSE(assembler.add(sample_at(1), scan));
  Sample last = sample_at(2);
  last.ends_scan = true;
  EXPECT_TRUE(assembler.add(last, scan));
  EXPECT_EQ(scan.size(), 3U);
  EXPECT_FALSE(assembler.add(sample_at(0, true), scan)) << "nothing was collected in between";
}

TEST(ScanAssembler, EndlessScan_IsCutAtCapacityAndCounted) {
  ScanAssembler assembler;
  Scan scan;
  assembler.add(sample_at(0, true), scan);
  for (std::size_t i = 1; i < kMaxSamplesPerScan + 100; ++i) assembler.add(sample_at(0.1), scan);
  EXPECT_EQ(assembler.dropped(), 100U);
  ASSERT_TRUE(assembler.add(sample_at(0, true), scan));
  EXPECT_EQ(scan.size(), kMaxSamplesPerScan);
}

TEST(ScanAssembler, Reset_DropsScanInProgress) {
  ScanAssembler assembler;
  Scan scan;
  for (int i = 0; i < 99; ++i) assembler.add(sample_at(-kTwoPi * i / 100, i == 0), scan);
  assembler.reset();
  EXPECT_FALSE(assembler.add(sample_at(0, true), scan));
}

}  // namespace
}  // namespace cornerd::core
