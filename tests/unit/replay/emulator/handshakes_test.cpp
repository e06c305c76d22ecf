// SPDX-License-Identifier: MIT
// Compares the emulator with recorded exchanges of real devices in $CORNERD_RECORDINGS.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "replay/emulator/emulator.hpp"
#include "replay/simulator/simulator.hpp"
#include "tests/unit/replay/hex.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

std::string exchange(const std::string& request) {
  Emulator emulator(
      {}, std::make_unique<Simulator>(
              std::make_unique<MapScene>(make_room(), stand_still({1, 1, 0})), SimulatorConfig{}));
  emulator.receive(from_hex(request), 0);
  std::vector<std::uint8_t> answer;
  emulator.take(core::kNsPerSecond / 50, answer);
  return to_hex(answer);
}

TEST(RecordedHandshakes, Firmware129_AnswersByteForByte) {
  const char* folder = std::getenv("CORNERD_RECORDINGS");
  if (folder == nullptr) GTEST_SKIP() << "CORNERD_RECORDINGS is not set";
  const auto file = std::filesystem::path(folder) / "a1-wire" / "handshakes.json";
  std::ifstream stream(file);
  if (!stream) GTEST_SKIP() << file << " is not there";

  int compared = 0;
  for (const auto& entry : nlohmann::json::parse(stream)) {
    const std::string id = entry.at("id");
    if (!id.starts_with("a1_") || !entry.contains("rx")) continue;
    std::string expected = entry.at("rx");
    std::string answer = exchange(entry.at("tx"));
    // The last 16 bytes are the serial number.
    constexpr std::size_t kInfoWithoutSerial = 2 * (7 + 4);
    if (entry.at("tx") == "a550") {
      EXPECT_EQ(answer.size(), expected.size()) << id;
      expected.resize(kInfoWithoutSerial);
    }
    // Only the beginning of a scan was recorded.
    answer.resize(std::min(answer.size(), expected.size()));
    EXPECT_EQ(answer, expected) << id;
    ++compared;
  }
  EXPECT_GE(compared, 8);
}

}  // namespace
}  // namespace cornerd::replay
