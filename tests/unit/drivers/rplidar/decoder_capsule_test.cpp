// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "wire_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// 350 degrees, start of the stream, sample k: 1000 + k mm, correction 2k / 8 degrees.
const Bytes kCapsuleA = from_hex(
    "a75580d7 a00fa40f20 a80fac0f64 b00fb40fa8 b80fbc0fec c10fc50f20 c90fcd0f64 d10fd50fa8"
    "d90fdd0fec e20fe60f20 ea0fee0f64 f20ff60fa8 fa0ffe0fec 0310071020 0b100f1064 13101710a8"
    "1b101f10ec");

double angle_deg(const RawSample& sample) { return sample.angle_q6 / 64.0; }

Bytes capsule_b() {
  std::array<ExpressSample, 32> samples{};
  samples[0] = {16383, 32};
  samples[1] = {16383, 63};
  return express_capsule(10, false, samples);
}

/// Express capsules, some of them damaged or removed.
struct ExpressRun {
  std::vector<Bytes> capsules = express_capsules(60, 5);

  ExpressRun& damage(std::size_t capsule, std::size_t byte = 40) {
    capsules[capsule][byte] ^= 0x10;
    return *this;
  }
  ExpressRun& remove(std::size_t first, std::size_t count) {
    const auto begin = capsules.begin() + static_cast<std::ptrdiff_t>(first);
    capsules.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    return *this;
  }
};

/// Each sample is the one that express_capsules() put at its index.
void expect_right_place(const CollectingSink& sink) {
  for (const RawSample& sample : sink.samples) {
    const int capsule = static_cast<int>(sample.index / 32);
    const int k = static_cast<int>(sample.index % 32);
    ASSERT_EQ(sample.dist_q2, express_dist_q2(capsule, k)) << "index " << sample.index;
    const double expected_deg = 5 + capsule * 21.4 + k * 21.4 / 32 - k / 8.0;
    const double error_deg = std::remainder(angle_deg(sample) - expected_deg, 360);
    ASSERT_NEAR(error_deg, 0, 0.05) << "index " << sample.index;
  }
}

TEST(DecoderExpress, KnownCapsule_DecodesAsBySdk) {
  const auto sink = decode(join({kExpressDescriptor, kCapsuleA, capsule_b()}));
  ASSERT_THAT(sink.samples, SizeIs(32));
  EXPECT_NEAR(angle_deg(sink.samples[0]), 350.0, 0.006);
  EXPECT_EQ(sink.samples[0].dist_q2, 1000U * 4);
  EXPECT_NEAR(angle_deg(sink.samples[1]), 350.375, 0.006);
  EXPECT_EQ(sink.samples[1].dist_q2, 1001U * 4);
  EXPECT_NEAR(angle_deg(sink.samples[15]), 355.625, 0.006);
  EXPECT_NEAR(angle_deg(sink.samples[31]), 1.625, 0.006);
  EXPECT_EQ(sink.samples[31].dist_q2, 1031U * 4);
  for (std::size_t k = 0; k < 32; ++k) EXPECT_EQ(sink.samples[k].starts_scan, k == 15) << k;
  EXPECT_EQ(sink.samples[0].quality, 47);
}

TEST(DecoderExpress, AngleCorrection_IsUnsigned) {
  const auto sink =
      decode(join({kExpressDescriptor, kCapsuleA, capsule_b(), express_capsule(32.5, false, {})}));
  ASSERT_THAT(sink.samples, SizeIs(64));
  EXPECT_NEAR(angle_deg(sink.samples[32]), 6.0, 0.006);
  EXPECT_EQ(sink.samples[32].dist_q2, 16383U * 4);
  EXPECT_NEAR(angle_deg(sink.samples[33]), 2.828, 0.006);
  EXPECT_EQ(sink.samples[34].quality, 0) << "no return";
}

TEST(DecoderExpress, UndamagedStream_DecodesEverySample) {
  const auto sink = decode(join(ExpressRun().capsules));
  EXPECT_THAT(sink.samples, SizeIs(59 * 32));
  expect_right_place(sink);
  EXPECT_EQ(sink.scans(), 3U);
  EXPECT_THAT(sink.gaps, IsEmpty());
}

TEST(DecoderExpress, LostCapsule_IsCountedAndLeavesItsIndices) {
  Decoder decoder;
  const auto sink = decode(join(ExpressRun().remove(20, 1).capsules), decoder);
  EXPECT_THAT(sink.samples, SizeIs(58 * 32));
  expect_right_place(sink);
  EXPECT_EQ(decoder.counters().lost_capsules, 1U);
  EXPECT_EQ(decoder.counters().unpaired_capsules, 1U) << "the last one only";
  EXPECT_THAT(sink.gaps, IsEmpty()) << "the number of missing samples is known";
}

TEST(DecoderExpress, CapsuleLostAcrossZero_StillStartsAScan) {
  // Capsule 16 begins at 347.4 degrees and sweeps through zero.
  for (const std::size_t lost : {15U, 16U, 17U}) {
    const auto sink = decode(join(ExpressRun().remove(lost, 1).capsules));
    EXPECT_EQ(sink.scans(), 3U) << lost;
    expect_right_place(sink);
  }
}

TEST(DecoderExpress, FiveLostCapsules_AreCounted) {
  Decoder decoder;
  const auto sink = decode(join(ExpressRun().remove(20, 5).capsules), decoder);
  EXPECT_EQ(decoder.counters().lost_capsules, 5U);
  expect_right_place(sink);
  EXPECT_THAT(sink.gaps, IsEmpty());
}

TEST(DecoderExpress, MoreThanHalfARevolutionLost_IsAGap) {
  const auto sink = decode(join(ExpressRun().remove(20, 12).capsules));
  EXPECT_THAT(sink.gaps, ElementsAre(19 * 32));
}

TEST(DecoderExpress, BadChecksum_DropsOneCapsule) {
  Decoder decoder;
  const auto sink = decode(join(ExpressRun().damage(20).capsules), decoder);
  EXPECT_THAT(sink.samples, SizeIs(58 * 32));
  expect_right_place(sink);
  EXPECT_EQ(sink.scans(), 3U);
  EXPECT_EQ(decoder.counters().bad_checksums, 1U);
  EXPECT_EQ(decoder.counters().lost_capsules, 0U);
  EXPECT_EQ(decoder.counters().resyncs, 0U);
  EXPECT_THAT(sink.gaps, IsEmpty());
}

TEST(DecoderExpress, BadChecksumAcrossZero_MergesNoScans) {
  const auto sink = decode(join(ExpressRun().damage(16).capsules));
  EXPECT_EQ(sink.scans(), 3U);
  expect_right_place(sink);
}

TEST(DecoderExpress, LostByte_DropsOneCapsule) {
  for (const std::size_t byte : {0U, 1U, 2U, 3U, 40U, 83U}) {
    Bytes stream = join(ExpressRun().capsules);
    stream.erase(stream.begin() + static_cast<std::ptrdiff_t>(20 * 84 + byte));
    Decoder decoder;
    const auto sink = decode(stream, decoder);
    EXPECT_THAT(sink.samples, SizeIs(58 * 32)) << byte;
    expect_right_place(sink);
    EXPECT_EQ(decoder.counters().resyncs, 1U) << byte;
  }
}

TEST(DecoderExpress, FalseHeader_IsSearchedAgain) {
  // The sync nibbles, then too few bytes for a capsule.
  Bytes stream = from_hex("a35600a05a0011a5");
  stream = join({stream, join(ExpressRun().capsules)});
  const auto sink = decode(stream);
  EXPECT_THAT(sink.samples, SizeIs(59 * 32));
  expect_right_place(sink);
}

TEST(DecoderExpress, NewStream_DropsTheCapsuleBefore) {
  auto capsules = express_capsules(20, 5);
  const auto again = express_capsules(20, 200);
  capsules.insert(capsules.end(), again.begin(), again.end());
  Decoder decoder;
  const auto sink = decode(join(capsules), decoder);
  EXPECT_THAT(sink.samples, SizeIs(38 * 32));
  EXPECT_THAT(sink.gaps, ElementsAre(19 * 32));
  EXPECT_EQ(decoder.counters().unpaired_capsules, 2U);
}

TEST(DecoderExpress, ChangingSpeed_LosesNoCapsule) {
  std::vector<Bytes> capsules;
  double angle = 0;
  double step = 8;
  for (int c = 0; c < 100; ++c) {
    capsules.push_back(express_capsule(std::fmod(angle, 360), c == 0, {}));
    angle += step;
    step = std::min(29.0, step * 1.1);
  }
  Decoder decoder;
  EXPECT_THAT(decode(join(capsules), decoder).samples, SizeIs(99 * 32));
  EXPECT_EQ(decoder.counters().lost_capsules, 0U);
}

TEST(DecoderExpress, HalfSpeedHead_DropsOneCapsule) {
  Decoder decoder;
  EXPECT_THAT(decode(join(express_capsules(40, 5, 42.8)), decoder).samples, SizeIs(38 * 32));
  EXPECT_EQ(decoder.counters().lost_capsules, 0U);
}

TEST(DecoderExpress, OneByteInTenThousandLost_FalsifiesNoSample) {
  std::mt19937 random(3);
  for (int run = 0; run < 20; ++run) {
    Bytes stream = join(express_capsules(460, 5));
    for (std::size_t i = 0; i < stream.size(); ++i) {
      if (random() % 10000 == 0) stream.erase(stream.begin() + static_cast<std::ptrdiff_t>(i));
    }
    const auto sink = decode(stream);
    expect_right_place(sink);
    EXPECT_GE(sink.samples.size(), 430U * 32);
    EXPECT_EQ(sink.scans(), 27U);
  }
}

TEST(DecoderUltra, MajorsAndPredictions_DecodeAsBySdk) {
  // Codes 1300, 1300, 0, 400 with predictions (5,-5), (511,-512), (3,3), (7,-7), and again.
  std::array<UltraCabin, 32> cabins;
  constexpr std::array<UltraCabin, 4> kPattern{
      {{1300, 5, -5}, {1300, 511, -512}, {0, 3, 3}, {400, 7, -7}}};
  for (std::size_t n = 0; n < cabins.size(); ++n) cabins[n] = kPattern[n % kPattern.size()];
  const auto sink = decode(join(
      {kUltraDescriptor, ultra_capsule(100, true, cabins), ultra_capsule(132, false, cabins)}));
  ASSERT_THAT(sink.samples, SizeIs(96));
  constexpr std::array<std::uint32_t, 12> kExpected{2128, 2148, 2108, 2128, 0,   0,
                                                    0,    403,  403,  400,  407, 2100};
  for (std::size_t i = 0; i < 96; ++i) {
    EXPECT_EQ(sink.samples[i].dist_q2, kExpected[i % 12] * 4) << i;
  }
}

TEST(DecoderUltra, OpticalCorrection_DependsOnTheDistance) {
  std::array<UltraCabin, 32> cabins{};
  cabins[0] = {100, -512, -512};
  cabins[1] = {1300, -512, -512};
  cabins[2] = {49, -512, -512};
  const auto sink = decode(join(
      {kUltraDescriptor, ultra_capsule(100, true, cabins), ultra_capsule(132, false, cabins)}));
  ASSERT_THAT(sink.samples, SizeIs(96));
  const auto correction = [&](std::size_t k) {
    return 100 + static_cast<double>(k) * 32 / 96 - angle_deg(sink.samples[k]);
  };
  EXPECT_NEAR(correction(0), 8 - std::asin(24.0 / 100) * 180 / M_PI, 0.1);
  EXPECT_NEAR(correction(3), 8 - std::asin(24.0 / 2128) * 180 / M_PI, 0.1);
  EXPECT_NEAR(correction(6), 7.5, 0.03) << "too near";
  EXPECT_NEAR(correction(1), 7.5, 0.03) << "no return";
}

TEST(DecoderUltra, LostCapsule_IsCounted) {
  auto capsules = ultra_capsules(40, 5);
  capsules.erase(capsules.begin() + 20);
  Decoder decoder;
  const auto sink = decode(join(capsules), decoder);
  EXPECT_THAT(sink.samples, SizeIs(38 * 96));
  EXPECT_EQ(decoder.counters().lost_capsules, 1U);
  EXPECT_EQ(sink.samples.back().index, 39U * 96 - 1);
  EXPECT_EQ(decoder.format(), WireFormat::kUltra);
  // The capsule before the gap is decoded, but for the two ranges predicted from the missing one.
  const auto whole = decode(join(ultra_capsules(40, 5)));
  for (std::size_t i = 0; i < 20 * 96 - 2; ++i) {
    EXPECT_EQ(sink.samples[i].dist_q2, whole.samples[i].dist_q2) << i;
    EXPECT_NEAR(sink.samples[i].angle_q6, whole.samples[i].angle_q6, 1) << i;
  }
  EXPECT_EQ(sink.samples[20 * 96 - 2].dist_q2, 0U);
  EXPECT_EQ(sink.samples[20 * 96 - 1].dist_q2, 0U);
}

TEST(DecoderUltra, LostByte_DropsOneCapsule) {
  Bytes stream = join(ultra_capsules(40, 5));
  stream.erase(stream.begin() + 20 * 132 + 50);
  EXPECT_THAT(decode(stream).samples, SizeIs(38 * 96));
}

}  // namespace
}  // namespace cornerd::rplidar::test
