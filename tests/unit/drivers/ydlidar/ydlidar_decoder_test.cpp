// SPDX-License-Identifier: MIT
#include "drivers/ydlidar/ydlidar_decoder.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "core/geometry/angle.hpp"
#include "frame_collector.hpp"

namespace cornerd::ydlidar {
namespace {

using frame_test::Bytes;
using frame_test::decode_all;
using frame_test::FrameCollector;

/// A packet with its check code.
Bytes packet(bool is_zero, unsigned first_q6, unsigned last_q6, const std::vector<int>& dist_q2,
             unsigned rate_dHz = 0) {
  Bytes bytes = {0xAA, 0x55, static_cast<std::uint8_t>((is_zero ? 1 : 0) | rate_dHz << 1),
                 static_cast<std::uint8_t>(dist_q2.size())};
  const auto put = [&bytes](unsigned word) {
    bytes.push_back(static_cast<std::uint8_t>(word));
    bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  };
  put(first_q6 << 1 | 1);
  put(last_q6 << 1 | 1);
  unsigned code = 0x55AA ^ (bytes[2] | static_cast<unsigned>(bytes[3]) << 8) ^ (first_q6 << 1 | 1) ^
                  (last_q6 << 1 | 1);
  for (const int distance : dist_q2) code ^= static_cast<unsigned>(distance);
  put(code);
  for (const int distance : dist_q2) put(static_cast<unsigned>(distance));
  return bytes;
}

/// Revolutions of 18 packets of 40 samples each, half a degree apart, after the zero packet.
Bytes revolutions(int count) {
  Bytes all;
  const auto add = [&all](const Bytes& more) { all.insert(all.end(), more.begin(), more.end()); };
  for (int i = 0; i < count; ++i) {
    add(packet(true, 0, 0, {4000}));
    for (unsigned k = 0; k < 18; ++k) {
      const unsigned first = 32 * (1 + 40 * k);
      const unsigned samples = k < 17 ? 40 : 39;
      add(packet(false, first, first + 32 * (samples - 1), std::vector<int>(samples, 4000)));
    }
  }
  return all;
}

TEST(YdlidarPacket, ManualsAngles_AreCorrected) {
  // FSA 6FE5 and LSA 79BD of the X4's manual: 223.78 and 243.47 degrees; 1000 mm: -6.76 degrees.
  YdlidarDecoder decoder;
  std::vector<int> ranges(40, 4000);
  ranges[1] = 0;
  const FrameCollector got = decode_all(decoder, packet(false, 0x6FE5 >> 1, 0x79BD >> 1, ranges));
  ASSERT_EQ(got.samples.size(), 40U);
  EXPECT_NEAR(core::degrees(got.samples[0].device_rad) + 360, 223.78 - 6.7622, 0.01);
  EXPECT_NEAR(core::degrees(got.samples[39].device_rad) + 360, 243.47 - 6.7622, 0.01);
  EXPECT_NEAR(core::degrees(got.samples[1].device_rad) + 360, 223.78 + 19.69 / 39, 0.01)
      << "no return, no correction";
  EXPECT_FLOAT_EQ(got.samples[0].range_m, 1.0F);
}

TEST(YdlidarPacket, ManualsDistance_IsAQuarterMillimetre) {
  YdlidarDecoder decoder;
  const FrameCollector got = decode_all(decoder, packet(true, 0, 0, {0x6FE5}));
  EXPECT_FLOAT_EQ(got.samples.at(0).range_m, 7.16125F);
}

TEST(YdlidarDecoder, Revolutions_StartAtTheZeroMark) {
  YdlidarDecoder decoder;
  const FrameCollector got = decode_all(decoder, revolutions(5), 13);
  EXPECT_EQ(got.samples.size(), 5U * 720);
  EXPECT_EQ(got.scans(), 4U) << "the first one begins before the recording";
  for (std::size_t i = 1; i < 5; ++i) EXPECT_TRUE(got.samples[720 * i].starts_scan);
  EXPECT_EQ(decoder.counters().skipped_bytes, 0U);
}

TEST(YdlidarDecoder, AnyDamagedByte_CostsItsPacketAlone) {
  const Bytes clean = revolutions(3);
  const std::size_t size = kHeaderSize + 80;
  const std::size_t begin = (kHeaderSize + 2) + 5 * size;
  for (std::size_t at = begin; at < begin + size; ++at) {
    Bytes bytes = clean;
    bytes[at] ^= 0x10;
    YdlidarDecoder decoder;
    const FrameCollector got = decode_all(decoder, bytes);
    ASSERT_EQ(got.samples.size(), 3U * 720 - 40) << at - begin;
    EXPECT_EQ(got.samples.back().index, 3U * 720 - 1) << "the gap must be counted";
    EXPECT_EQ(decoder.counters().skipped_bytes, size) << at - begin;
    EXPECT_EQ(got.scans(), 2U);
  }
}

TEST(YdlidarDecoder, LostZeroPacket_KeepsTheMark) {
  Bytes bytes = revolutions(3);
  const std::size_t revolution = bytes.size() / 3;
  const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(revolution);
  bytes.erase(at, at + kHeaderSize + 2);
  YdlidarDecoder decoder;
  EXPECT_EQ(decode_all(decoder, bytes).scans(), 2U);
}

TEST(YdlidarDecoder, ToldRate_GivesThePeriod) {
  // 6 Hz and 0.72 degrees: 3000 samples a second, an X2's.
  Bytes bytes = packet(false, 64 * 20, 64 * 20 + 46 * 19, std::vector<int>(20, 400));
  const Bytes zero = packet(true, 0, 0, {400}, 60);
  YdlidarDecoder decoder;
  decode_all(decoder, bytes);
  EXPECT_DOUBLE_EQ(decoder.timing().period_s, kPeriodX4S);
  decode_all(decoder, zero);
  EXPECT_DOUBLE_EQ(decoder.timing().period_s, kPeriodX2S);
}

}  // namespace
}  // namespace cornerd::ydlidar
