// SPDX-License-Identifier: MIT
#include "replay/simulator/wire_encoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/replay/hex.hpp"

namespace cornerd::replay {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

/// Distance of a code, from the protocol's table.
std::uint32_t decode_major(std::uint32_t code) {
  if (code < 512) return code;
  if (code < 1280) return 512 + (code - 512) * 2;
  if (code < 1792) return 2048 + (code - 1280) * 4;
  if (code < 3328) return 4096 + (code - 1792) * 8;
  return 16384 + (code - 3328) * 16;
}

std::uint32_t word_of(const UltraCapsule& capsule, std::size_t cabin) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= capsule.bytes[4 + 4 * cabin + i] << (8 * i);
  return word;
}

TEST(WireEncoder, Node_HasTheBytesOfARealDevice) {
  EXPECT_THAT(encode_node(false, 0, 12743, 0), ElementsAreArray(from_hex("028f630000")));
  EXPECT_THAT(encode_node(false, 15, 12877, 0), ElementsAreArray(from_hex("3e9b640000")));
  EXPECT_THAT(encode_node(true, 15, 0, 4660), ElementsAreArray(from_hex("3d01003412")));
}

TEST(WireEncoder, Express_HasTheVendorsTestVector) {
  // 350 degrees, distances 1000 + k mm, offsets 2k.
  std::array<ExpressSample, kExpressSamples> samples;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k] = {static_cast<std::uint16_t>(1000 + k), static_cast<std::uint8_t>(2 * k)};
  }
  EXPECT_THAT(encode_express(350 * 64, true, samples),
              ElementsAreArray(from_hex("a75580d7"
                                        "a00fa40f20a80fac0f64b00fb40fa8b80fbc0fecc10fc50f20"
                                        "c90fcd0f64d10fd50fa8d90fdd0fece20fe60f20ea0fee0f64"
                                        "f20ff60fa8fa0ffe0fec03100710200b100f106413101710a8"
                                        "1b101f10ec")));
}

TEST(WireEncoder, Ultra_HasTheVendorsTestVector) {
  // Majors 1300, 1300, 0, 400 with predictions (5,-5), (511,-512), (3,3), (7,-7).
  std::array<std::uint32_t, kUltraSamples + 1> dist_mm{};
  const std::array<std::uint32_t, 12> repeated{2128, 2148, 2108, 2128, 0,   0,
                                               0,    403,  403,  400,  407, 2100};
  for (std::size_t k = 0; k < dist_mm.size(); ++k) dist_mm[k] = repeated[k % repeated.size()];
  const UltraCapsule capsule = encode_ultra(0, true, dist_mm);
  for (std::size_t k = 0; k < kUltraSamples; ++k) EXPECT_EQ(capsule.carried_mm[k], dist_mm[k]) << k;
  EXPECT_EQ(word_of(capsule, 0), 1300u | 5u << 12 | (1024u - 5) << 22);
  EXPECT_EQ(word_of(capsule, 1), 1300u | 512u << 12 | 512u << 22);
  EXPECT_EQ(word_of(capsule, 2), 0u | 3u << 12 | 3u << 22);
  EXPECT_EQ(word_of(capsule, 3), 400u | 7u << 12 | (1024u - 7) << 22);
}

TEST(WireEncoder, Ultra_EncodesEveryDistanceToItsResolution) {
  for (std::uint32_t mm = 1; mm <= 12000; ++mm) {
    std::array<std::uint32_t, kUltraSamples + 1> dist_mm{};
    dist_mm[0] = mm;
    const UltraCapsule capsule = encode_ultra(0, false, dist_mm);
    EXPECT_EQ(capsule.carried_mm[0], decode_major(word_of(capsule, 0) & 0xFFF));
    const std::uint32_t step = mm < 512 ? 1 : mm < 2048 ? 2 : mm < 4096 ? 4 : 8;
    EXPECT_LE(capsule.carried_mm[0], mm);
    EXPECT_GT(capsule.carried_mm[0] + step, mm);
  }
}

TEST(WireEncoder, UltraDifferenceOutOfRange_IsInvalid) {
  std::array<std::uint32_t, kUltraSamples + 1> dist_mm{};
  dist_mm[0] = 300;
  dist_mm[1] = 300 + 510;
  dist_mm[3] = 300;
  dist_mm[4] = 300 + 511;
  dist_mm[6] = 600;
  dist_mm[7] = 89;  // 256 steps of 2 mm below, within the 10 bits
  const UltraCapsule capsule = encode_ultra(0, false, dist_mm);
  EXPECT_EQ(capsule.carried_mm[1], 810u);
  EXPECT_EQ(capsule.carried_mm[4], 0u);
  EXPECT_EQ(word_of(capsule, 1) >> 12 & 0x3FF, 0x200u);
  EXPECT_EQ(capsule.carried_mm[7], 88u);
}

TEST(WireEncoder, Checksum_CoversAllButItself) {
  std::array<ExpressSample, kExpressSamples> samples{};
  samples[7] = {1234, 17};
  const ExpressBytes bytes = encode_express(0x5A3C, false, samples);
  const std::uint8_t sum = std::accumulate(
      bytes.begin() + 2, bytes.end(), std::uint8_t{0},
      [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a ^ b); });
  EXPECT_EQ(bytes[0] >> 4, 0xA);
  EXPECT_EQ(bytes[1] >> 4, 0x5);
  EXPECT_EQ((bytes[0] & 0xF) | (bytes[1] & 0xF) << 4, sum);
  EXPECT_EQ(bytes[3] & 0x80, 0);
}

TEST(WireEncoder, Descriptor_MatchesTheProtocol) {
  EXPECT_THAT(scan_descriptor(rplidar::WireFormat::kStandard),
              ElementsAre(0xA5, 0x5A, 0x05, 0, 0, 0x40, 0x81));
  EXPECT_THAT(scan_descriptor(rplidar::WireFormat::kExpress),
              ElementsAre(0xA5, 0x5A, 0x54, 0, 0, 0x40, 0x82));
  EXPECT_THAT(scan_descriptor(rplidar::WireFormat::kUltra),
              ElementsAre(0xA5, 0x5A, 0x84, 0, 0, 0x40, 0x84));
}

}  // namespace
}  // namespace cornerd::replay
