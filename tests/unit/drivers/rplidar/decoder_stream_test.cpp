// SPDX-License-Identifier: MIT
// Descriptors, banners and stale bytes around the measurements, and arbitrary portions.
#include <gmock/gmock.h>

#include <string_view>

#include "wire_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

Bytes text(std::string_view text) { return {text.begin(), text.end()}; }

const Bytes kHealthAnswer = from_hex("a55a0300000006000000");
const Bytes kInfoAnswer = from_hex("a55a1400000004181d010792d8ed93c0ea98c9a5e698f207064669");
const Bytes kConfAnswer = from_hex("a55a10000000207f00000053656e736974697669747900");

TEST(DecoderStream, Descriptor_OverridesTheCallersFormat) {
  Decoder decoder(WireFormat::kExpress);
  EXPECT_THAT(decode(join({kStandardDescriptor, nodes(5, 30)}), decoder).samples, SizeIs(5));
  EXPECT_EQ(decoder.format(), WireFormat::kStandard);
}

TEST(DecoderStream, BootBanner_IsSkipped) {
  const auto sink =
      decode(join({text("RP LIDAR System.\r\nFirmware Ver 1.29 - rtm, HW Ver 7\r\nModel: 18\r\n"),
                   kExpressDescriptor, join(express_capsules(10, 5))}));
  EXPECT_THAT(sink.samples, SizeIs(9 * 32));
}

TEST(DecoderStream, OtherAnswersAndEchoes_AreSkipped) {
  Decoder decoder;
  const auto sink =
      decode(join({from_hex("a552a520"), kInfoAnswer, kHealthAnswer, kConfAnswer,
                   from_hex("ffffffff"), from_hex("a520"), kStandardDescriptor, nodes(50, 30)}),
             decoder);
  EXPECT_THAT(sink.samples, SizeIs(50));
  EXPECT_EQ(decoder.counters().skipped_bytes,
            decoder.counters().bytes - kStandardDescriptor.size() - 50 * 5);
}

TEST(DecoderStream, SyncByteBeforeADescriptor_DoesNotHideIt) {
  EXPECT_THAT(decode(join({from_hex("a5a5"), kStandardDescriptor, nodes(5, 30)})).samples,
              SizeIs(5));
  EXPECT_THAT(
      decode(join({from_hex("a55aa5"), kExpressDescriptor, join(express_capsules(3, 5))})).samples,
      SizeIs(2 * 32));
}

TEST(DecoderStream, StaleStreamBeforeADescriptor_EndsAtTheDescriptor) {
  // The previous scan was cut off inside a node, or a capsule.
  const Bytes old_nodes = nodes(60, 200);
  const Bytes old_capsules = join(express_capsules(6, 200));
  const Bytes fresh = join({kStandardDescriptor, nodes(50, 30)});
  for (const std::size_t cut : {1U, 2U, 3U, 4U, 5U}) {
    const auto sink = decode(join({Bytes(old_nodes.begin(), old_nodes.end() - cut), fresh}));
    ASSERT_GE(sink.samples.size(), 108U) << cut;
    EXPECT_THAT(sink.gaps, ElementsAre(sink.samples.size() - 50)) << cut;
  }
  for (const std::size_t cut : {1U, 40U, 80U, 83U}) {
    const auto sink = decode(join({Bytes(old_capsules.begin(), old_capsules.end() - cut), fresh}));
    EXPECT_THAT(sink.samples, SizeIs(4 * 32 + 50)) << cut;
    EXPECT_THAT(sink.gaps, ElementsAre(4 * 32)) << cut;
  }
}

TEST(DecoderStream, ModeChange_IsFollowed) {
  Decoder decoder;
  const auto sink =
      decode(join({kStandardDescriptor, nodes(50, 30), kUltraDescriptor, join(ultra_capsules(5, 5)),
                   kExpressDescriptor, join(express_capsules(5, 5))}),
             decoder);
  EXPECT_THAT(sink.samples, SizeIs(50 + 4 * 96 + 4 * 32));
  EXPECT_THAT(sink.gaps, ElementsAre(50, 50 + 4 * 96));
  EXPECT_EQ(decoder.format(), WireFormat::kExpress);
}

TEST(DecoderStream, DescriptorLikeBytesInACapsule_AreData) {
  auto capsules = express_capsules(10, 5);
  std::array<ExpressSample, 32> samples{};
  // u16 A and B, u8: a5 5a 05 00 00 | 40 81: six of the seven bytes at most can be chosen.
  samples[0] = {0x5AA5 >> 2, 1 << 4};
  samples[1] = {0x0005 >> 2, 1 << 4};
  capsules[5] = express_capsule(5 + 5 * 21.4, false, samples);
  EXPECT_THAT(decode(join(capsules)).samples, SizeIs(9 * 32));
}

TEST(DecoderStream, DamagedDescriptor_FormatIsDetected) {
  Bytes descriptor = kExpressDescriptor;
  descriptor[2] ^= 1;
  // The caller's format is wrong too.
  Decoder decoder(WireFormat::kStandard);
  const auto sink = decode(join({descriptor, join(express_capsules(80, 5))}), decoder);
  EXPECT_EQ(decoder.format(), WireFormat::kExpress);
  EXPECT_GE(sink.samples.size(), 20U * 32);
}

TEST(DecoderStream, AllBytes_AreUsedOrSkipped) {
  Bytes stream = join({from_hex("0102"), kStandardDescriptor, nodes(300, 30)});
  stream.erase(stream.begin() + 700);
  Decoder decoder;
  const auto sink = decode(stream, decoder);
  EXPECT_EQ(decoder.counters().bytes, stream.size());
  EXPECT_EQ(decoder.counters().samples, sink.samples.size());
  EXPECT_EQ(decoder.counters().skipped_bytes, stream.size() - 7 - sink.samples.size() * 5);
}

class Cut : public testing::TestWithParam<std::size_t> {};

TEST_P(Cut, AnyPortions_GiveTheSameSamples) {
  Bytes damaged = nodes(900, 30);
  damaged.erase(damaged.begin() + 1234);
  damaged[3000] ^= 1;
  auto capsules = express_capsules(40, 5);
  capsules[7][9] ^= 1;
  capsules.erase(capsules.begin() + 20);
  const Bytes stream =
      join({text("RP LIDAR System.\r\n"), damaged, kHealthAnswer, kExpressDescriptor,
            join(capsules), from_hex("a55a05"), kUltraDescriptor, join(ultra_capsules(9, 100))});
  const auto whole = decode(stream);

  Decoder decoder;
  CollectingSink pieces;
  std::span<const std::uint8_t> rest = stream;
  while (!rest.empty()) {
    const auto piece = rest.first(std::min(GetParam(), rest.size()));
    decoder.feed(piece, pieces);
    rest = rest.subspan(piece.size());
  }
  decoder.finish(pieces);

  ASSERT_EQ(pieces.samples.size(), whole.samples.size());
  EXPECT_EQ(pieces.gaps, whole.gaps);
  for (std::size_t i = 0; i < whole.samples.size(); ++i) {
    const RawSample& a = pieces.samples[i];
    const RawSample& b = whole.samples[i];
    ASSERT_TRUE(a.index == b.index && a.angle_q6 == b.angle_q6 && a.dist_q2 == b.dist_q2 &&
                a.quality == b.quality && a.starts_scan == b.starts_scan)
        << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Cut, testing::Values(1, 2, 3, 7, 64, 83, 1000));

}  // namespace
}  // namespace cornerd::rplidar::test
