// SPDX-License-Identifier: MIT
#include "replay/emulator/emulator.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host.hpp"

namespace cornerd::replay {
namespace {

// Answers of real devices, but for the serial number.
TEST(Emulator, Firmware129_AnswersAsARealDevice) {
  Host host("1.29");
  EXPECT_EQ(host.ask("a550").substr(0, 22), "a55a1400000004181d0107");
  EXPECT_EQ(host.ask("a550").size(), 2u * 27);
  EXPECT_EQ(host.ask("a552"), "a55a0300000006000000");
  EXPECT_EQ(host.ask("a559"), "a55a0400000015fc01fe00");
  EXPECT_EQ(host.ask("a5840470000000"
                     "55"),
            "a55a0600000020"
            "700000000500");
  EXPECT_EQ(host.ask("a584047c000000"
                     "59"),
            "a55a0600000020"
            "7c0000000300");
  EXPECT_EQ(host.ask("a5840671000000030055"), "a55a080000002071000000007f0000");
  EXPECT_EQ(host.ask("a5840674000000030050"), "a55a080000002074000000000c0000");
  EXPECT_EQ(host.ask("a5840675000000030051"), "a55a05000000207500000084");
  EXPECT_EQ(host.ask("a584067f00000003005b"), "a55a10000000207f00000053656e736974697669747900");
  EXPECT_EQ(host.ask("a5840671000000000056"), "a55a08000000207100000000fc0100");
}

TEST(Emulator, Firmware124_HasThreeModes) {
  Host host("1.24");
  EXPECT_EQ(host.ask("a550").substr(14, 8), "18180105");
  EXPECT_EQ(host.ask("a584047000000055"), "a55a0600000020700000000300");
  EXPECT_EQ(host.ask("a584067f00000002005a"), "a55a0a000000207f000000426f6f737400");
  EXPECT_EQ(host.ask("a584067f00000003005b"), "");
  EXPECT_EQ(host.ask_for_scan("a58205030000000021"), "");
  EXPECT_EQ(host.ask_for_scan("a58205020000000020"), "a55a8400004084");
}

TEST(Emulator, Firmware117_IgnoresConfigurationAndHasLegacyExpress) {
  Host host("1.17");
  EXPECT_EQ(host.ask("a550").substr(14, 8), "00110100");
  EXPECT_EQ(host.ask("a559"), "a55a0400000015f401f401");
  EXPECT_EQ(host.ask("a584047000000055"), "");
  EXPECT_EQ(host.ask("a584040100000024"), "");
  EXPECT_EQ(host.ask_for_scan("a58205000000000022"), "a55a5400004082");
  EXPECT_EQ(Host("1.17").ask_for_scan("a58205010000000023"), "");
}

TEST(Emulator, RotationRequest_IsAnsweredIfConfigured) {
  EXPECT_EQ(Host("1.29").ask("a584040100000024").size(), 2u * (7 + 4 + 4));
  EmulatorConfig silent;
  silent.answers_rotation_request = false;
  EXPECT_EQ(Host("1.29", silent).ask("a584040100000024"), "");
}

TEST(Emulator, VendorsStartSequence_IsAnswered) {
  // The requests of the vendor's program for firmware 1.24 and later.
  Host host("1.29");
  for (const char* request : {"a550", "a550", "a552", "a584040100000024"}) {
    EXPECT_EQ(host.ask(request).substr(0, 4), "a55a") << request;
  }
  EXPECT_EQ(host.ask("a525"), "");
  for (const char* request : {"a550", "a550", "a584047c00000059"}) {
    EXPECT_EQ(host.ask(request).substr(0, 4), "a55a") << request;
  }
  EXPECT_EQ(host.ask("a525"), "");
  for (const char* request : {"a550", "a5840671000000030055", "a5840674000000030050",
                              "a5840675000000030051", "a584067f00000003005b", "a584040100000024"}) {
    EXPECT_EQ(host.ask(request).substr(0, 4), "a55a") << request;
  }
  EXPECT_EQ(host.ask_for_scan("a58205030000000021"), "a55a8400004084");
  const Samples samples = decode(host.receive_for(core::kNsPerSecond));
  EXPECT_GE(samples.scans, 6);
  host.send("a525");
  host.receive_for(20 * kMs);
  EXPECT_EQ(to_hex(host.receive_for(100 * kMs)), "");
}

TEST(Emulator, VendorsLegacyStartSequence_IsAnswered) {
  Host host("1.17");
  for (const char* request : {"a550", "a550", "a552"}) {
    EXPECT_EQ(host.ask(request).substr(0, 4), "a55a") << request;
  }
  EXPECT_EQ(host.ask("a584040100000024"), "");
  EXPECT_EQ(host.ask("a525"), "");
  for (const char* request : {"a550", "a559"}) {
    EXPECT_EQ(host.ask(request).substr(0, 4), "a55a") << request;
  }
  EXPECT_EQ(host.ask_for_scan("a58205000000000022"), "a55a5400004082");
  EXPECT_GE(decode(host.receive_for(core::kNsPerSecond)).scans, 6);
}

struct ModeCase {
  const char* request;
  const char* descriptor;
  double samples_hz;
};

class EmulatorModes : public ::testing::TestWithParam<ModeCase> {};
INSTANTIATE_TEST_SUITE_P(
    Firmware129, EmulatorModes,
    ::testing::Values(ModeCase{"a520", "a55a0500004081", 1 / 508e-6},
                      ModeCase{"a521", "a55a0500004081", 1 / 508e-6},
                      ModeCase{"a58205000000000022", "a55a5400004082", 1 / 254e-6},
                      ModeCase{"a58205010000000023", "a55a5400004082", 1 / 254e-6},
                      ModeCase{"a58205020000000020", "a55a8400004084", 1 / 127e-6},
                      ModeCase{"a58205030000000021", "a55a8400004084", 1 / 127e-6},
                      ModeCase{"a58205040000000026", "a55a8400004084", 1 / 201e-6}));

TEST_P(EmulatorModes, Scan_HasTheModesFormatAndRate) {
  Host host("1.29");
  host.send(GetParam().request);
  const std::vector<std::uint8_t> bytes = host.receive_for(4 * core::kNsPerSecond);
  EXPECT_EQ(to_hex(bytes).substr(0, 14), GetParam().descriptor);
  const Samples samples = decode(bytes);
  EXPECT_NEAR(samples.count / 4.0, GetParam().samples_hz, 0.03 * GetParam().samples_hz);
  EXPECT_GT(samples.valid, samples.count * 9 / 10);
  // The steps of Stability's capsules exceed a decoder's first limit, so it accepts the fourth.
  EXPECT_LE(samples.gaps, 3);
  EXPECT_NEAR(samples.scans, 4 * 7.3, 1.5);
}

TEST(Emulator, Answer_ArrivesAtLineSpeed) {
  Host host("1.29");
  host.send("a550");
  std::vector<std::uint8_t> bytes;
  host.emulator().take(1 * kMs, bytes);
  EXPECT_TRUE(bytes.empty());
  const core::TimeNs byte_ns = 86'806;
  host.emulator().take(1 * kMs + 5 * byte_ns, bytes);
  EXPECT_EQ(bytes.size(), 5u);
  EXPECT_NEAR(static_cast<double>(*host.emulator().next_ns()), 1 * kMs + 6.0 * 86'805, 10);
  host.emulator().take(1 * kMs + 27 * byte_ns, bytes);
  EXPECT_EQ(bytes.size(), 27u);
  EXPECT_FALSE(host.emulator().next_ns());
}

TEST(Emulator, Stop_CompletesThePacketOnTheLine) {
  for (int offset_ms = 0; offset_ms < 16; ++offset_ms) {
    Host host("1.29");
    host.send("a58205010000000023");
    std::vector<std::uint8_t> bytes = host.receive_for((200 + offset_ms) * kMs);
    host.send("a525");
    const auto rest = host.receive_for(100 * kMs);
    EXPECT_LE(rest.size(), 84u);
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    EXPECT_EQ((bytes.size() - 7) % 84, 0u);
    EXPECT_FALSE(host.emulator().scanning());
  }
}

TEST(Emulator, RequestDuringAScan_EndsIt) {
  Host host("1.29");
  host.send("a520");
  host.receive_for(100 * kMs);
  EXPECT_NE(host.ask("a552").find("a55a0300000006000000"), std::string::npos);
  EXPECT_FALSE(host.emulator().scanning());
}

TEST(Emulator, InvalidRequest_HasNoEffect) {
  Host host("1.29");
  host.send("a520");
  host.receive_for(100 * kMs);
  host.send("a584047000000056");  // checksum off by one
  host.send("a55f");              // no such command
  EXPECT_TRUE(host.emulator().scanning());
}

TEST(Emulator, RequestInPieces_TimesOutAfterFiveSeconds) {
  Host host("1.29");
  host.send("a5");
  host.receive_for(4900 * kMs);
  EXPECT_EQ(host.ask("52"), "a55a0300000006000000");
  host.send("a5");
  host.receive_for(5100 * kMs);
  EXPECT_EQ(host.ask("52"), "");
  EXPECT_EQ(host.ask("a5a552"), "a55a0300000006000000");
}

TEST(Emulator, Reset_IgnoresRequestsUntilTheBanner) {
  Host host("1.29");
  host.send("a520");
  host.receive_for(100 * kMs);
  host.send("a540");
  EXPECT_TRUE(host.receive_for(300 * kMs).empty());
  EXPECT_EQ(host.ask("a550"), "");
  host.receive_for(340 * kMs);
  const auto banner = host.receive_for(30 * kMs);
  EXPECT_EQ(std::string(banner.begin(), banner.end()),
            "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm, HW Ver 7\r\nModel: 18\r\n");
  EXPECT_EQ(banner.size(), 64u);
  EXPECT_EQ(host.ask("a552"), "a55a0300000006000000");
}

TEST(Emulator, FailedHealth_PreventsScansUntilReset) {
  EmulatorConfig config;
  config.health = {2, 0x8001};
  Host host("1.29", config);
  EXPECT_EQ(host.ask("a552"), "a55a0300000006020180");
  EXPECT_EQ(host.ask("a520"), "");
  host.send("a540");
  host.receive_for(core::kNsPerSecond);
  EXPECT_EQ(host.ask("a552"), "a55a0300000006000000");
  EXPECT_EQ(host.ask_for_scan("a520"), "a55a0500004081");

  config.reset_restores_health = false;
  Host broken("1.29", config);
  broken.send("a540");
  broken.receive_for(core::kNsPerSecond);
  EXPECT_EQ(broken.ask("a552"), "a55a0300000006020180");
}

TEST(Emulator, SpinUp_DelaysDataButNotTheDescriptor) {
  EmulatorConfig config;
  config.spin_up_s = 1;
  Host host("1.29", config);
  host.send("a520");
  EXPECT_EQ(to_hex(host.receive_for(900 * kMs)), "a55a0500004081");
  EXPECT_GT(host.receive_for(200 * kMs).size(), 500u);
  host.send("a521");
  EXPECT_GT(host.receive_for(100 * kMs).size(), 500u);
}

TEST(Emulator, StalledCaller_GetsANewStreamInsteadOfTheBacklog) {
  Host host("1.29");
  host.send("a58205010000000023");
  host.receive_for(100 * kMs);
  std::vector<std::uint8_t> bytes;
  host.emulator().take(host.now_ns() + 3600 * core::kNsPerSecond, bytes);
  EXPECT_LT(bytes.size(), 200u);
}

}  // namespace
}  // namespace cornerd::replay
