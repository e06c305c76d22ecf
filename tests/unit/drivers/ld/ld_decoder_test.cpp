// SPDX-License-Identifier: MIT
#include "drivers/ld/ld_decoder.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "core/geometry/angle.hpp"
#include "frame_collector.hpp"

namespace cornerd::ld {
namespace {

using frame_test::Bytes;
using frame_test::decode_all;
using frame_test::FrameCollector;

/// The example of the LD06's development manual.
const Bytes kExample = {0x54, 0x2C, 0x68, 0x08, 0xAB, 0x7E, 0xE0, 0x00, 0xE4, 0xDC, 0x00, 0xE2,
                        0xD9, 0x00, 0xE5, 0xD5, 0x00, 0xE3, 0xD3, 0x00, 0xE4, 0xD0, 0x00, 0xE9,
                        0xCD, 0x00, 0xE4, 0xCA, 0x00, 0xE2, 0xC7, 0x00, 0xE9, 0xC5, 0x00, 0xE5,
                        0xC2, 0x00, 0xE5, 0xC0, 0x00, 0xE5, 0xBE, 0x82, 0x3A, 0x1A, 0x50};

/// Packets of a head of 10 Hz and 4500 samples a second; ranges are 1000 mm.
class Head {
 public:
  Bytes next() {
    Bytes bytes = {0x54, 0x2C};
    put(bytes, 3600);
    put(bytes, angle_cdeg());
    for (int i = 0; i < 12; ++i) {
      put(bytes, 1000);
      bytes.push_back(200);
    }
    sample_ += 11;
    put(bytes, angle_cdeg());
    put(bytes, static_cast<int>(static_cast<double>(++sample_) / 4.5) % 30'000);
    unsigned crc = 0;
    for (const std::uint8_t byte : bytes) {
      crc ^= byte;
      for (int bit = 0; bit < 8; ++bit) crc = (crc << 1 ^ ((crc & 0x80) != 0 ? 0x4D : 0)) & 0xFF;
    }
    bytes.push_back(static_cast<std::uint8_t>(crc));
    return bytes;
  }
  Bytes next(int count) {
    Bytes all;
    for (int i = 0; i < count; ++i) {
      const Bytes packet = next();
      all.insert(all.end(), packet.begin(), packet.end());
    }
    return all;
  }

 private:
  static void put(Bytes& bytes, int word) {
    bytes.push_back(static_cast<std::uint8_t>(word));
    bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  }
  int angle_cdeg() const { return static_cast<int>(sample_ * 80 % 36'000); }

  std::int64_t sample_ = 100;
};

TEST(LdDecoder, ManualsExample_IsDecoded) {
  LdDecoder decoder;
  const FrameCollector got = decode_all(decoder, kExample);
  ASSERT_EQ(got.samples.size(), 12U);
  EXPECT_NEAR(got.samples[0].device_rad, core::radians(324.27 - 360), 1e-5);
  EXPECT_NEAR(got.samples[11].device_rad, core::radians(334.70 - 360), 1e-5);
  EXPECT_FLOAT_EQ(got.samples[0].range_m, 0.224F);
  EXPECT_EQ(got.samples[0].quality, 228);
  EXPECT_FLOAT_EQ(got.samples[11].range_m, 0.192F);
  EXPECT_EQ(parse_packet(std::span(kExample).first<kPacketSize>()).speed_deg_s, 2152);
  EXPECT_EQ(parse_packet(std::span(kExample).first<kPacketSize>()).t_ms, 6714);
}

TEST(LdDecoder, Portions_DoNotChangeSamples) {
  const Bytes bytes = Head().next(100);
  LdDecoder whole;
  const FrameCollector expected = decode_all(whole, bytes);
  ASSERT_EQ(expected.samples.size(), 1200U);
  for (const std::size_t portion : {1U, 7U, 47U, 100U}) {
    LdDecoder decoder;
    const FrameCollector got = decode_all(decoder, bytes, portion);
    ASSERT_EQ(got.samples.size(), expected.samples.size()) << portion;
    EXPECT_EQ(got.samples.back().device_rad, expected.samples.back().device_rad);
  }
}

TEST(LdDecoder, AnyDamagedByte_CostsItsPacketAlone) {
  const Bytes clean = Head().next(40);
  for (std::size_t at = 10 * kPacketSize; at < 11 * kPacketSize; ++at) {
    Bytes bytes = clean;
    bytes[at] ^= 0x10;
    LdDecoder decoder;
    const FrameCollector got = decode_all(decoder, bytes);
    ASSERT_EQ(got.samples.size(), 39 * kPacketSamples) << at;
    EXPECT_EQ(got.samples.back().index, 40 * kPacketSamples - 1) << "the gap must be counted";
    EXPECT_TRUE(got.gaps.empty());
    EXPECT_EQ(decoder.counters().skipped_bytes, kPacketSize);
    EXPECT_EQ(decoder.counters().used_bytes, 39 * kPacketSize);
    EXPECT_EQ(decoder.counters().bad_checksums + decoder.counters().resyncs, 1U) << at;
  }
}

TEST(LdDecoder, LostBytes_CostTheirPacketAlone) {
  const Bytes clean = Head().next(40);
  for (const std::size_t count : {1U, 5U, 23U, 46U}) {
    Bytes bytes = clean;
    const auto from = bytes.begin() + 10 * kPacketSize + 1;
    bytes.erase(from, from + static_cast<std::ptrdiff_t>(count));
    LdDecoder decoder;
    const FrameCollector got = decode_all(decoder, bytes);
    EXPECT_EQ(got.samples.size(), 39 * kPacketSamples) << count;
    EXPECT_EQ(got.samples.back().index, 40 * kPacketSamples - 1);
    EXPECT_EQ(decoder.counters().skipped_bytes, kPacketSize - count);
  }
}

TEST(LdDecoder, FalseHeaderBetweenPackets_IsNoLostPacket) {
  for (const std::size_t count : {2U, 10U, 44U, 60U, 130U}) {
    Head head;
    Bytes bytes = head.next(20);
    bytes.insert(bytes.end(), {0x54, 0x2C});
    bytes.insert(bytes.end(), count - 2, 0x7B);
    const Bytes after = head.next(20);
    bytes.insert(bytes.end(), after.begin(), after.end());
    LdDecoder decoder;
    const FrameCollector got = decode_all(decoder, bytes);
    ASSERT_EQ(got.samples.size(), 40 * kPacketSamples) << count;
    EXPECT_EQ(got.samples.back().index, 40 * kPacketSamples - 1) << count;
    EXPECT_EQ(decoder.counters().lost_capsules, 0U) << count;
    EXPECT_EQ(decoder.counters().skipped_bytes, count);
  }
}

TEST(LdDecoder, LostPackets_AreCountedByAngleAndClock) {
  Head head;
  Bytes bytes = head.next(20);
  head.next(5);
  const Bytes after = head.next(20);
  bytes.insert(bytes.end(), after.begin(), after.end());
  LdDecoder decoder;
  const FrameCollector got = decode_all(decoder, bytes);
  EXPECT_EQ(decoder.counters().lost_capsules, 5U);
  EXPECT_EQ(got.samples.back().index, 45 * kPacketSamples - 1);
  EXPECT_TRUE(got.gaps.empty());
}

TEST(LdDecoder, LostRevolutions_AreAGapOfKnownLength) {
  Head head;
  Bytes bytes = head.next(20);
  head.next(375 * 3);  // 30 revolutions, 3 s
  const Bytes after = head.next(20);
  bytes.insert(bytes.end(), after.begin(), after.end());
  LdDecoder decoder;
  const FrameCollector got = decode_all(decoder, bytes);
  EXPECT_EQ(decoder.counters().lost_capsules, 1125U);
  EXPECT_THAT(got.gaps, testing::ElementsAre(20 * kPacketSamples));
}

TEST(LdDecoder, DevicesClock_WrapsAt30000) {
  Head head;
  head.next(11'240);  // 29.97 s
  LdDecoder decoder;
  const FrameCollector got = decode_all(decoder, head.next(100));
  EXPECT_EQ(decoder.counters().lost_capsules, 0U);
  EXPECT_EQ(got.samples.size(), 1200U);
}

TEST(LdDecoder, Garbage_IsSkippedAndCounted) {
  Bytes bytes(1000, 0x54);
  const Bytes good = Head().next(38);
  bytes.insert(bytes.end(), good.begin(), good.end());
  LdDecoder decoder;
  EXPECT_EQ(decode_all(decoder, bytes).samples.size(), 38 * kPacketSamples);
  EXPECT_EQ(decoder.counters().skipped_bytes, 1000U);
  EXPECT_EQ(decoder.counters().scans, 1U);
}

}  // namespace
}  // namespace cornerd::ld
