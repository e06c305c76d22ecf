// SPDX-License-Identifier: MIT
#include "replay/recording_writer.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/temporary_folder.hpp"

namespace cornerd::replay {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

constexpr std::array<std::uint8_t, 3> kBytes = {0xA5, 0x00, 0x5A};

TEST(RecordingWriter, Ndjson_HoldsBothDirectionsAndOdometry) {
  const test::TemporaryFolder folder;
  RecordingWriter writer(folder.path() / "a.ndjson");
  writer.sent(1'500'000'000, kBytes);
  writer.received(2'000'000'000, kBytes);
  writer.received(2'000'000'000, {});
  core::OdometryReading odometry;
  odometry.t_ns = 3'000'000'000;
  odometry.left = -5;
  writer.odometry(odometry);
  writer.flush();
  const std::string text = text_of(folder.path() / "a.ndjson");
  EXPECT_NE(text.find(R"("tx":"a5005a")"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("rx":"a5005a")"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("left":-5)"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

TEST(RecordingWriter, Bin_HoldsReceivedBytesOnly) {
  const test::TemporaryFolder folder;
  RecordingWriter writer(folder.path() / "a.bin");
  writer.sent(1, kBytes);
  writer.received(2, kBytes);
  writer.odometry({});
  writer.flush();
  EXPECT_EQ(text_of(folder.path() / "a.bin"), std::string("\xA5\x00\x5A", 3));
}

TEST(TruthWriter, ConstantPose_TakesTwoLines) {
  const test::TemporaryFolder folder;
  TruthWriter writer(folder.path() / "truth.ndjson");
  for (int i = 0; i < 10; ++i) writer.add(i * core::kNsPerSecond, {1, 2, 0.5});
  writer.add(10 * core::kNsPerSecond, {1.5, 2, 0.5});
  writer.flush();
  std::istringstream lines(text_of(folder.path() / "truth.ndjson"));
  std::vector<message::RecordedTruth> truths;
  for (std::string line; std::getline(lines, line);) {
    truths.push_back(std::get<message::RecordedTruth>(message::parse_truth_line(line)));
  }
  ASSERT_EQ(truths.size(), 3u);
  EXPECT_EQ(truths[0].t_ns, 0);
  EXPECT_EQ(truths[1].t_ns, 9 * core::kNsPerSecond);
  EXPECT_EQ(truths[1].T_map_base.x_m, 1);
  EXPECT_EQ(truths[2].T_map_base.x_m, 1.5);
}

}  // namespace
}  // namespace cornerd::replay
