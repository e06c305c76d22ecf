// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "wire_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Distances that no node of nodes(count) has.
std::vector<std::uint32_t> unknown_distances(const CollectingSink& sink, int count) {
  std::vector<std::uint32_t> known;
  for (int n = 0; n < count; ++n) known.push_back(node_dist_q2(n));
  std::sort(known.begin(), known.end());
  std::vector<std::uint32_t> unknown;
  for (const std::uint32_t dist_q2 : sink.distances()) {
    if (!std::binary_search(known.begin(), known.end(), dist_q2)) unknown.push_back(dist_q2);
  }
  return unknown;
}

TEST(DecoderStandard, RealNodes_DecodeAsBySdk) {
  const auto sink = decode(join({kStandardDescriptor, from_hex("028f630000"),
                                 from_hex("0223640000"), from_hex("3e9b640000")}));
  ASSERT_THAT(sink.samples, SizeIs(3));
  EXPECT_NEAR(sink.samples[0].angle_q6 / 64.0, 199.109, 0.001);
  EXPECT_EQ(sink.samples[0].dist_q2, 0U);
  EXPECT_EQ(sink.samples[0].quality, 0);
  EXPECT_NEAR(sink.samples[2].angle_q6 / 64.0, 201.203, 0.001);
  EXPECT_EQ(sink.samples[2].dist_q2, 0U);
  EXPECT_EQ(sink.samples[2].quality, 15) << "real nodes have a quality without a return";
}

TEST(DecoderStandard, AngleBeyondOneRevolution_IsReduced) {
  const auto sink =
      decode(join({kStandardDescriptor, from_hex("3d01003412"), from_hex("3e03b4e803")}));
  ASSERT_THAT(sink.samples, SizeIs(2));
  EXPECT_TRUE(sink.samples[0].starts_scan);
  EXPECT_EQ(sink.samples[0].angle_q6, 0);
  EXPECT_EQ(sink.samples[0].dist_q2, 1165U * 4);
  EXPECT_EQ(sink.samples[1].angle_q6, 1);
  EXPECT_EQ(sink.samples[1].dist_q2, 250U * 4);
}

TEST(DecoderStandard, StreamWithoutDescriptor_LosesNoNodeToTheLock) {
  const Bytes stream = nodes(100, 30);
  const auto sink = decode(std::span(stream).subspan(3));
  ASSERT_THAT(sink.samples, SizeIs(99));
  EXPECT_EQ(sink.samples.front().dist_q2, node_dist_q2(1));
}

TEST(DecoderStandard, FewerNodesThanALockNeeds_GiveNothing) {
  EXPECT_THAT(decode(nodes(9, 30)).samples, IsEmpty());
}

TEST(DecoderStandard, ConstantAngle_GivesNothing) {
  Bytes stream;
  for (int n = 0; n < 200; ++n) stream = join({stream, node(false, 15, 124, 1000)});
  EXPECT_THAT(decode(stream).samples, IsEmpty());
}

TEST(DecoderStandard, RandomBytes_GiveNothing) {
  std::mt19937 random(1);
  Bytes noise(100000);
  std::generate(noise.begin(), noise.end(),
                [&] { return static_cast<std::uint8_t>(random() & 0xFF); });
  EXPECT_THAT(decode(noise).samples, IsEmpty());
}

class LostByte : public testing::TestWithParam<int> {};

TEST_P(LostByte, InANode_DropsOneNode) {
  Bytes stream = nodes(400, 30);
  stream.erase(stream.begin() + 200 * 5 + GetParam());
  Decoder decoder;
  const auto sink = decode(stream, decoder);
  EXPECT_GE(sink.samples.size(), 398U);
  EXPECT_THAT(unknown_distances(sink, 400), IsEmpty());
  EXPECT_THAT(sink.gaps, IsEmpty());
  EXPECT_EQ(decoder.counters().resyncs, 1U);
  EXPECT_EQ(sink.samples.back().index, 399U) << "a lost node takes a sample period";
  EXPECT_EQ(sink.samples.back().dist_q2, node_dist_q2(399));
}

INSTANTIATE_TEST_SUITE_P(EachByte, LostByte, testing::Range(0, 5));

TEST(DecoderStandard, DamagedAngle_DropsOneNode) {
  Bytes stream = nodes(400, 30);
  stream[200 * 5 + 2] ^= 0x40;
  Decoder decoder;
  const auto sink = decode(stream, decoder);
  EXPECT_THAT(sink.samples, SizeIs(399));
  EXPECT_EQ(decoder.counters().bad_nodes, 1U);
  EXPECT_EQ(decoder.counters().resyncs, 0U);
  EXPECT_EQ(sink.samples.back().index, 399U);
}

TEST(DecoderStandard, DamagedCheckBits_DropOneNodeEach) {
  Bytes stream = nodes(400, 30);
  stream[200 * 5 + 1] ^= 0x01;
  stream[300 * 5] ^= 0x01;
  Decoder decoder;
  EXPECT_THAT(decode(stream, decoder).samples, SizeIs(398));
  EXPECT_EQ(decoder.counters().bad_nodes, 2U);
}

TEST(DecoderStandard, InsertedBytes_DropAtMostTwoNodes) {
  Bytes stream = nodes(400, 30);
  const Bytes echo{0xA5, 0x25};
  stream.insert(stream.begin() + 200 * 5 + 3, echo.begin(), echo.end());
  const auto sink = decode(stream);
  EXPECT_GE(sink.samples.size(), 398U);
  EXPECT_THAT(unknown_distances(sink, 400), IsEmpty());
  EXPECT_THAT(sink.gaps, IsEmpty());
}

TEST(DecoderStandard, ManyBytesLost_AreAGap) {
  Bytes stream = nodes(700, 30);
  stream.erase(stream.begin() + 1001, stream.begin() + 1001 + 1713);
  const auto sink = decode(stream);
  EXPECT_THAT(sink.gaps, SizeIs(1));
  EXPECT_GE(sink.samples.size(), 700U - 1713 / 5 - 4);
  EXPECT_THAT(unknown_distances(sink, 700), IsEmpty());
}

TEST(DecoderStandard, OneByteInTenThousandDamaged_FalsifiesNoScan) {
  constexpr int kNodes = 30 * 316;
  std::mt19937 random(7);
  std::size_t unknown = 0;
  for (int run = 0; run < 20; ++run) {
    Bytes stream = nodes(kNodes, 30);
    for (std::size_t i = 0; i < stream.size(); ++i) {
      if (random() % 10000 != 0) continue;
      if (random() % 2 == 0) {
        stream.erase(stream.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        stream[i] ^= static_cast<std::uint8_t>(1U << random() % 8);
      }
    }
    const auto sink = decode(stream);
    EXPECT_GE(sink.samples.size(), kNodes - 30U);
    EXPECT_EQ(sink.scans(), 30U);
    EXPECT_THAT(sink.gaps, IsEmpty());
    unknown += unknown_distances(sink, kNodes).size();
  }
  // Flipped bits in distances are undetectable: two bytes of five, half of the faults.
  EXPECT_LE(unknown, 20 * 10U);
}

TEST(DecoderStandard, StartFlags_StartScans) {
  const auto sink = decode(nodes(1000, 30));
  std::vector<std::uint64_t> starts;
  for (const RawSample& sample : sink.samples) {
    if (sample.starts_scan) starts.push_back(sample.index);
  }
  EXPECT_THAT(starts, ElementsAre(290, 606, 922));
}

TEST(DecoderStandard, MissingStartFlag_IsReplacedByTheAngle) {
  Bytes stream = nodes(1300, 30);
  for (std::size_t n = 500; n < 700; ++n) {  // the second start flag, of node 606
    if ((stream[n * 5] & 3) == 1) stream[n * 5] ^= 3;
  }
  const auto sink = decode(stream);
  std::vector<std::uint64_t> starts;
  for (const RawSample& sample : sink.samples) {
    if (sample.starts_scan) starts.push_back(sample.index);
  }
  ASSERT_THAT(starts, SizeIs(4));
  EXPECT_GT(starts[1], 606U);
  EXPECT_LT(starts[1], 620U);
  EXPECT_EQ(starts[2], 922U);
}

TEST(DecoderStandard, StartFlagFarFromZero_IsIgnoredAndCounted) {
  Bytes stream = nodes(1000, 30);
  stream[450 * 5] ^= 3;
  Decoder decoder;
  const auto sink = decode(stream, decoder);
  EXPECT_THAT(sink.samples, SizeIs(1000));
  EXPECT_EQ(sink.scans(), 3U);
  EXPECT_EQ(decoder.counters().scans, 3U);
  EXPECT_EQ(decoder.counters().false_scan_starts, 1U);
}

TEST(DecoderStandard, SlowAndFastHeads_LoseNoNode) {
  for (const double scan_rate_hz : {1.0, 5.5, 10.0, 13.0}) {
    const double step_deg = 360 * scan_rate_hz * 508e-6;
    const int count = static_cast<int>(std::lround(4 * 360 / step_deg));
    const auto sink = decode(nodes(count, 180, step_deg));
    EXPECT_EQ(sink.samples.size(), static_cast<std::size_t>(count)) << scan_rate_hz << " Hz";
    EXPECT_EQ(sink.scans(), 4U) << scan_rate_hz << " Hz";
  }
}

TEST(DecoderStandard, StaleFirstNode_IsDelivered) {
  const auto sink = decode(join({kStandardDescriptor, node(false, 15, 174.8, 0), nodes(400, 344)}));
  EXPECT_THAT(sink.samples, SizeIs(401));
  EXPECT_EQ(sink.scans(), 2U);
}

TEST(DecoderStandard, StaleFirstNodeWithAStartFlag_StartsNoScan) {
  const auto sink = decode(join({kStandardDescriptor, node(true, 15, 10, 0), nodes(40, 340)}));
  EXPECT_THAT(sink.samples, SizeIs(41));
  EXPECT_FALSE(sink.samples[0].starts_scan);
  EXPECT_EQ(sink.scans(), 1U);
}

}  // namespace
}  // namespace cornerd::rplidar::test
