// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "drivers/rplidar/protocol/answers.hpp"
#include "drivers/rplidar/protocol/framing.hpp"
#include "wire_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

using testing::ElementsAreArray;
using testing::SizeIs;

Bytes bytes_of(const Request& request) { return {request.bytes().begin(), request.bytes().end()}; }

std::vector<Request> parse(const Bytes& bytes) {
  RequestParser parser;
  std::vector<Request> requests;
  for (const std::uint8_t byte : bytes) {
    if (const auto request = parser.add(byte)) requests.push_back(*request);
  }
  return requests;
}

std::vector<Descriptor> find_descriptors(const Bytes& bytes) {
  DescriptorSearch search;
  std::vector<Descriptor> found;
  for (const std::uint8_t byte : bytes) {
    if (const auto descriptor = search.add(byte)) found.push_back(*descriptor);
  }
  return found;
}

TEST(Request, Commands_HaveTheProtocolsBytes) {
  EXPECT_EQ(bytes_of(Request(Command::kStop)), from_hex("a525"));
  EXPECT_EQ(bytes_of(Request(Command::kGetInfo)), from_hex("a550"));
  EXPECT_EQ(bytes_of(Request::express_scan(0)), from_hex("a58205000000000022"));
  EXPECT_EQ(bytes_of(Request::express_scan(3)), from_hex("a58205030000000021"));
  EXPECT_EQ(bytes_of(Request::get_conf(0x70)), from_hex("a5840470000000 55"));
  EXPECT_EQ(bytes_of(Request::get_conf(0x7C)), from_hex("a584047c00000059"));
  EXPECT_EQ(bytes_of(Request::get_conf(0x71, 3)), from_hex("a5840671000000030055"));
  EXPECT_EQ(bytes_of(Request::get_conf(0x7F, 3)), from_hex("a584067f00000003005b"));
  EXPECT_EQ(bytes_of(Request(Command::kSetMotorPwm, from_hex("9402"))), from_hex("a5f0029402c1"));
}

TEST(RequestParser, SeveralRequests_AreParsed) {
  const auto requests = parse(from_hex("a525 a584067f00000003005b a520"));
  ASSERT_THAT(requests, SizeIs(3));
  EXPECT_EQ(requests[0].command(), Command::kStop);
  EXPECT_EQ(requests[1].command(), Command::kGetConf);
  const auto query = ConfQuery::decode(requests[1].payload());
  ASSERT_TRUE(query);
  EXPECT_EQ(query->type, 0x7FU);
  EXPECT_EQ(query->mode, 3);
  EXPECT_EQ(requests[2].command(), Command::kScan);
}

TEST(RequestParser, WrongChecksum_IsSkipped) {
  const auto requests = parse(from_hex("a58205000000000023 a550"));
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_EQ(requests[0].command(), Command::kGetInfo);
}

TEST(RequestParser, StraySyncAndNoise_AreSkipped) {
  EXPECT_THAT(parse(from_hex("00ff a5a525 5a")), SizeIs(1));
}

TEST(DescriptorSearch, RealExchange_IsFoundAmongEchoes) {
  const auto found = find_descriptors(from_hex("a552a520a55a0300000006000000a55a0500004081"));
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_TRUE(found[0].is(AnswerType::kHealth));
  EXPECT_EQ(found[0].size, 3U);
  EXPECT_FALSE(found[0].stream);
  EXPECT_TRUE(found[1].is(AnswerType::kStandardScan));
  EXPECT_EQ(found[1].size, 5U);
  EXPECT_TRUE(found[1].stream);
}

TEST(DescriptorSearch, SyncBeforeSync_IsSkipped) {
  EXPECT_THAT(find_descriptors(from_hex("a5a5a55a1400000004")), SizeIs(1));
}

TEST(Descriptor, UltraScan_EncodesAsOnTheWire) {
  const Descriptor descriptor{.size = 132, .stream = true, .type = 0x84};
  EXPECT_THAT(descriptor.encode(), ElementsAreArray(kUltraDescriptor));
}

TEST(Answers, InfoOfARealA1_RoundTrips) {
  const auto info = DeviceInfo::decode(from_hex("181d010792d8ed93c0ea98c9a5e698f207064669"));
  ASSERT_TRUE(info);
  EXPECT_EQ(info->model_name(), "A1M8");
  EXPECT_EQ(info->firmware, firmware_version(1, 29));
  EXPECT_EQ(info->firmware_text(), "1.29");
  EXPECT_EQ(info->hardware, 7);
  EXPECT_EQ(info->serial_text(), "92D8ED93C0EA98C9A5E698F207064669");
  EXPECT_THAT(info->encode(),
              ElementsAreArray(from_hex("181d010792d8ed93c0ea98c9a5e698f207064669")));
}

TEST(Answers, FirmwareMinorOfOneDigit_IsPadded) {
  EXPECT_EQ((DeviceInfo{.firmware = firmware_version(1, 5)}).firmware_text(), "1.05");
}

TEST(Answers, HealthCode_IsLittleEndian) {
  const auto health = Health::decode(from_hex("020180"));
  ASSERT_TRUE(health);
  EXPECT_TRUE(health->failed());
  EXPECT_EQ(health->code, 0x8001);
  EXPECT_EQ(health->text(), "error (code 0x8001)");
  EXPECT_EQ((Health{}).text(), "good");
}

TEST(Answers, ConfigurationOfARealA1_Decodes) {
  const Bytes period_bytes = from_hex("71000000007f0000");
  const auto period = ConfAnswer::decode(period_bytes);
  ASSERT_TRUE(period && period->is(ConfType::kModePeriod));
  EXPECT_EQ(period->number(4), 127U * 256);
  const Bytes name_bytes = from_hex("7f00000053656e736974697669747900");
  const auto name = ConfAnswer::decode(name_bytes);
  ASSERT_TRUE(name && name->is(ConfType::kModeName));
  EXPECT_EQ(name->text(), "Sensitivity");
}

TEST(Answers, TooFewBytes_GiveNullopt) {
  EXPECT_FALSE(DeviceInfo::decode(from_hex("181d0107")));
  EXPECT_FALSE(Health::decode(from_hex("0000")));
  EXPECT_FALSE(SampleRate::decode(from_hex("fc01fe")));
  EXPECT_FALSE(ConfAnswer::decode(from_hex("710000")));
  const Bytes no_value = from_hex("71000000");
  EXPECT_EQ(ConfAnswer::decode(no_value)->number(4), std::nullopt);
}

}  // namespace
}  // namespace cornerd::rplidar::test
