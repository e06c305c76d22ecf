// SPDX-License-Identifier: MIT
// Dense, ultra-dense and HQ packets: what they mean, and what a damaged one costs.
#include <gmock/gmock.h>

#include <array>
#include <numeric>

#include "wire_fixture.hpp"

namespace cornerd::rplidar {
namespace {

using namespace test;
using testing::IsEmpty;
using testing::SizeIs;

TEST(DenseCapsule, Samples_AreMillimetresAtEvenAngles) {
  const auto sink = decode(join({kDenseDescriptor, join(dense_capsules(3, 350, 20))}));
  ASSERT_THAT(sink.samples, SizeIs(80)) << "the last capsule waits for its successor";
  for (std::size_t k = 0; k < 80; ++k) {
    EXPECT_EQ(sink.samples[k].dist_q2, 4 * (1000 + k));
    EXPECT_EQ(sink.samples[k].angle_q6, (350 * 64 + 32 * k) % (360 * 64)) << k;
    EXPECT_EQ(sink.samples[k].starts_scan, k == 19) << "the sample before the angle passes 0";
  }
}

TEST(UltraDenseCapsule, EveryScale_HasItsStepAndQuality) {
  std::array<ScaledSample, 64> samples{};
  samples[0] = {0, 1023, 255};
  samples[1] = {1, 1, 127};
  samples[2] = {1, 2047, 1};
  samples[3] = {2, 1, 63};
  samples[4] = {2, 4095, 1};
  samples[5] = {3, 1, 31};
  samples[6] = {3, 8191, 1};
  const auto sink = decode(join({kUltraDenseDescriptor, ultra_dense_capsule(10, true, samples),
                                 ultra_dense_capsule(17.2, false, samples)}));
  ASSERT_THAT(sink.samples, SizeIs(64));
  constexpr std::array<std::uint32_t, 8> kMm = {2046, 2049, 8187, 8191, 24567, 24572, 65522, 0};
  constexpr std::array<int, 8> kQuality = {255, 254, 2, 252, 4, 248, 8, 0};
  for (std::size_t k = 0; k < kMm.size(); ++k) {
    EXPECT_EQ(sink.samples[k].dist_q2, 4 * kMm[k]) << k;
    EXPECT_EQ(sink.samples[k].quality, kQuality[k]) << k;
    EXPECT_NEAR(sink.samples[k].angle_q6, 64 * (10 + 7.2 * static_cast<double>(k) / 64), 1) << k;
  }
}

TEST(HqPacket, Nodes_HaveTheirOwnAnglesAndFlags) {
  const auto sink = decode(join({kHqDescriptor, join(hq_packets(3, 350))}));
  ASSERT_THAT(sink.samples, SizeIs(192));
  for (std::size_t k = 0; k < 192; ++k) {
    EXPECT_EQ(sink.samples[k].dist_q2, 4 * (1000 + k));
    EXPECT_NEAR(sink.samples[k].angle_q6, (350 * 64 + 16 * k) % (360 * 64), 1) << k;
    EXPECT_EQ(sink.samples[k].quality, 0xBC);
    EXPECT_EQ(sink.samples[k].starts_scan, k == 40);
  }
}

TEST(ScanStart, OfEveryPhase_IsToldOncePerRevolution) {
  for (const double from_deg : {0.0, 0.015625, 1.0, 2.5, 359.984375}) {
    for (const double step_deg : {4.5, 4.515625, 7.984375, 8.0, 15.0, 28.8}) {
      const int count = 2000;
      const auto revolutions = static_cast<std::size_t>((from_deg + (count - 1) * step_deg) / 360);
      const auto scans = [](const Bytes& descriptor, const std::vector<Bytes>& capsules) {
        return decode(join({descriptor, join(capsules)})).scans();
      };
      const auto where = [&] { return testing::Message() << from_deg << " + " << step_deg; };
      EXPECT_EQ(scans(kExpressDescriptor, express_capsules(count, from_deg, step_deg)), revolutions)
          << where();
      EXPECT_EQ(scans(kUltraDescriptor, ultra_capsules(count, from_deg, step_deg)), revolutions)
          << where();
      EXPECT_EQ(scans(kDenseDescriptor, dense_capsules(count, from_deg, step_deg)), revolutions)
          << where();
      EXPECT_EQ(scans(kUltraDenseDescriptor, ultra_dense_capsules(count, from_deg, step_deg)),
                revolutions)
          << where();
    }
  }
}

struct Format {
  const char* name;
  Bytes descriptor;
  std::vector<Bytes> packets;
  std::size_t samples;
};

class EveryNewFormat : public testing::TestWithParam<Format> {
 protected:
  CollectingSink decode_all(const std::vector<Bytes>& packets) {
    return decode(join({GetParam().descriptor, join(packets)}), decoder_);
  }
  Decoder decoder_;
};

TEST_P(EveryNewFormat, DamagedPacket_CostsItselfAndIsCounted) {
  const std::size_t n = GetParam().samples;
  auto packets = GetParam().packets;
  packets[5][40] ^= 0x10;
  const auto sink = decode_all(packets);
  // The one before it has lost its successor, but not its angles.
  EXPECT_THAT(sink.samples, SizeIs((packets.size() - 2) * n));
  EXPECT_THAT(sink.gaps, IsEmpty());
  EXPECT_EQ(sink.samples[5 * n].index, 6 * n) << "the lost samples have taken their time";
  const auto& counters = decoder_.counters();
  EXPECT_EQ(counters.bad_checksums, 1U);
  EXPECT_EQ(counters.lost_capsules, 0U);
  EXPECT_EQ(counters.skipped_bytes, packets[5].size());
  EXPECT_EQ(counters.used_bytes + counters.skipped_bytes, counters.bytes);
}

TEST_P(EveryNewFormat, MissingPacket_IsCountedByItsAngles) {
  const std::size_t n = GetParam().samples;
  auto packets = GetParam().packets;
  packets.erase(packets.begin() + 5);
  const auto sink = decode_all(packets);
  EXPECT_THAT(sink.samples, SizeIs((packets.size() - 1) * n));
  EXPECT_EQ(decoder_.counters().lost_capsules, 1U);
  EXPECT_EQ(decoder_.counters().skipped_bytes, 0U);
  EXPECT_EQ(sink.samples.back().index, packets.size() * n - 1);
}

TEST_P(EveryNewFormat, LostByte_CostsItsPacket) {
  const std::size_t n = GetParam().samples;
  auto packets = GetParam().packets;
  packets[5].erase(packets[5].begin() + 50);
  const auto sink = decode_all(packets);
  EXPECT_THAT(sink.samples, SizeIs((packets.size() - 2) * n));
  EXPECT_EQ(decoder_.counters().resyncs, 1U);
  EXPECT_EQ(decoder_.counters().skipped_bytes, packets[5].size());
}

TEST_P(EveryNewFormat, ByteByByte_GivesTheSame) {
  const Bytes bytes = join({from_hex("a55a00ff"), GetParam().descriptor, join(GetParam().packets)});
  const auto whole = decode(bytes);
  CollectingSink single;
  for (const std::uint8_t byte : bytes) decoder_.feed(std::span(&byte, 1), single);
  decoder_.finish(single);
  EXPECT_EQ(single.distances(), whole.distances());
  EXPECT_THAT(whole.samples, SizeIs((GetParam().packets.size() - 1) * GetParam().samples));
}

TEST_P(EveryNewFormat, LongNoise_DoesNotMakeItAnotherFormat) {
  Bytes noise(6000);
  std::uint32_t state = 1;
  for (std::uint8_t& byte : noise)
    byte = static_cast<std::uint8_t>((state = state * 69069 + 1) >> 24);
  const auto packets = join(GetParam().packets);
  const auto sink = decode(join({GetParam().descriptor, packets, noise, packets}), decoder_);
  const std::size_t whole = (GetParam().packets.size() - 1) * GetParam().samples;
  ASSERT_THAT(sink.samples, SizeIs(2 * whole));
  EXPECT_EQ(sink.samples[whole].dist_q2, sink.samples[0].dist_q2);
  EXPECT_THAT(sink.gaps, SizeIs(1));
}

INSTANTIATE_TEST_SUITE_P(
    Formats, EveryNewFormat,
    testing::Values(Format{"Dense", kDenseDescriptor, dense_capsules(12, 5), 40},
                    Format{"UltraDense", kUltraDenseDescriptor, ultra_dense_capsules(12, 5), 64},
                    Format{"Hq", kHqDescriptor, hq_packets(12, 5), 96}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace cornerd::rplidar
