// SPDX-License-Identifier: MIT
#include "replay/recording.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/scan.hpp"
#include "replay/simulator/simulated_recording.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

struct Played : RecordingSink {
  void on_sample(const core::Sample& sample) override {
    samples.push_back(sample);
    core::Scan scan;
    if (assembler.add(sample, scan)) scan_sizes.push_back(scan.size());
  }
  void on_gap() override { ++gaps; }
  void on_odometry(const message::OdometryReading& reading) override {
    odometry.push_back(reading);
  }
  std::vector<core::Sample> samples;
  std::vector<std::size_t> scan_sizes;
  std::vector<message::OdometryReading> odometry;
  core::ScanAssembler assembler;
  int gaps = 0;
};

Played play(RecordingPlayer& player) {
  Played played;
  while (player.step(played)) {
  }
  return played;
}

Played play_lines(const std::string& lines, std::uint64_t* bad_lines = nullptr,
                  std::string* problem = nullptr) {
  std::istringstream stream(lines);
  RecordingPlayer player(stream, RecordingKind::kMessages, {});
  Played played = play(player);
  if (bad_lines != nullptr) *bad_lines = player.bad_lines();
  if (problem != nullptr) *problem = player.first_problem();
  return played;
}

std::string scan_line(double t_s, const std::string& angles = "[1,0.5,0,-0.5]") {
  return R"({"class":"SCAN","t":)" + std::to_string(t_s) + R"(,"duration":0.1,"angles":)" + angles +
         R"(,"ranges":[1,0,2,3]})" + "\n";
}

void simulate(const std::filesystem::path& file, double byte_faults = 0) {
  SimulatedRecordingConfig config;
  config.scans = 5;
  config.byte_fault_share = byte_faults;
  RecordingWriter writer(file);
  simulate_recording(make_room(), stand_still({1, 1, 0}), config, writer, nullptr);
}

TEST(RecordingPlayer, ScanLines_AreOneScanEachWithoutGaps) {
  const Played played = play_lines(scan_line(10) + scan_line(10.1) + scan_line(10.2));
  EXPECT_EQ(played.scan_sizes, (std::vector<std::size_t>{4, 4, 4}));
  EXPECT_EQ(played.gaps, 0);
  ASSERT_EQ(played.samples.size(), 12u);
  EXPECT_TRUE(played.samples[4].starts_scan);
  EXPECT_TRUE(played.samples[7].ends_scan);
  EXPECT_FALSE(played.samples[5].starts_scan);
  EXPECT_EQ(played.samples[1].range_m, 0);
  EXPECT_NEAR(core::to_seconds(played.samples[5].t_ns), 10.125, 1e-9);
}

TEST(RecordingPlayer, OtherMessages_AreSkipped) {
  std::uint64_t bad_lines = 0;
  const Played played = play_lines(R"({"class":"VERSION","program":"cornerd"})"
                                   "\n\n" +
                                       scan_line(1) +
                                       R"({"class":"ODOMETRY","t":1.05,"left":-7,"right":9})"
                                       "\n" +
                                       R"({"class":"NEWER","what":1})"
                                       "\r\n" +
                                       scan_line(2),
                                   &bad_lines);
  EXPECT_EQ(bad_lines, 0u);
  EXPECT_EQ(played.scan_sizes.size(), 2u);
  ASSERT_EQ(played.odometry.size(), 1u);
  EXPECT_EQ(played.odometry[0].left, -7);
}

TEST(RecordingPlayer, DamagedLines_AreCountedAndSkipped) {
  std::uint64_t bad_lines = 0;
  std::string problem;
  const std::string endless(message::kMaxRecordedBytes + 10, 'x');
  const Played played = play_lines(
      scan_line(1) + "{\"class\":\"SCAN\",\n" + scan_line(2) + endless + "\n" + scan_line(3),
      &bad_lines, &problem);
  EXPECT_EQ(bad_lines, 2u);
  EXPECT_NE(problem.find("line 2:"), std::string::npos) << problem;
  EXPECT_EQ(played.scan_sizes.size(), 3u);
}

TEST(RecordingPlayer, IncompleteLastLine_IsCountedAndNamed) {
  std::uint64_t bad_lines = 0;
  std::string problem;
  const std::string whole = scan_line(2);
  EXPECT_EQ(play_lines(scan_line(1) + whole.substr(0, 40), &bad_lines, &problem).scan_sizes.size(),
            1u);
  EXPECT_EQ(bad_lines, 1u);
  EXPECT_NE(problem.find("line 2: the last line is cut"), std::string::npos) << problem;
  // A last line that lacks only its newline is complete.
  EXPECT_EQ(play_lines(scan_line(1) + whole.substr(0, whole.size() - 1)).scan_sizes.size(), 2u);
}

std::string odometry_line(double t_s) {
  return R"({"class":"ODOMETRY","t":)" + std::to_string(t_s) + R"(,"left":1,"right":1})" + "\n";
}

TEST(RecordingPlayer, ClockThatIsSetBack_GoesOnAndIsNamed) {
  std::uint64_t bad_lines = 0;
  std::string problem;
  const Played played = play_lines(scan_line(3600) + scan_line(3600.1) + odometry_line(3600.2) +
                                       scan_line(0.2) + odometry_line(0.3) + scan_line(0.1),
                                   &bad_lines, &problem);
  EXPECT_EQ(bad_lines, 0u);
  // By the scans: what a client says of ODOMETRY's time tells nothing of the recorder's clock.
  EXPECT_NE(problem.find("line 4: t goes back by 3599.9 s"), std::string::npos) << problem;
  ASSERT_EQ(played.samples.size(), 16u);
  EXPECT_NEAR(core::to_seconds(played.samples[8].t_ns), 3600.1, 1e-6);
  ASSERT_EQ(played.odometry.size(), 2u);
  EXPECT_NEAR(core::to_seconds(played.odometry[1].t_ns), 3600.2, 1e-6);
  // Lines may be somewhat out of order.
  EXPECT_NEAR(core::to_seconds(played.samples[12].t_ns), 3600.0, 1e-6);
}

TEST(RecordingPlayer, TimesThatStandStill_AreNamed) {
  std::string lines;
  for (int i = 0; i < 20; ++i) lines += scan_line(0) + odometry_line(0);
  std::string problem;
  play_lines(lines, nullptr, &problem);
  EXPECT_NE(problem.find("t is the same in every line"), std::string::npos) << problem;
  play_lines(scan_line(0) + scan_line(0), nullptr, &problem);
  EXPECT_EQ(problem, "");
}

TEST(RecordingPlayer, BinAndNdjson_GiveTheSameSamples) {
  const test::TemporaryFolder folder;
  simulate(folder.path() / "a.bin");
  simulate(folder.path() / "a.ndjson");
  RecordingPlayer bytes(folder.path() / "a.bin", {});
  RecordingPlayer lines(folder.path() / "a.ndjson", {});
  const Played from_bytes = play(bytes);
  const Played from_lines = play(lines);
  ASSERT_EQ(from_bytes.samples.size(), from_lines.samples.size());
  for (std::size_t i = 0; i < from_bytes.samples.size(); ++i) {
    EXPECT_EQ(from_bytes.samples[i].bearing_rad, from_lines.samples[i].bearing_rad);
    EXPECT_EQ(from_bytes.samples[i].range_m, from_lines.samples[i].range_m);
  }
  EXPECT_EQ(from_bytes.scan_sizes.size(), 5u);
  EXPECT_EQ(bytes.counters().scans, 6u);  // the last one is partial
  EXPECT_NEAR(core::to_seconds(bytes.time_ns()), 5.5 / 7.3, 0.08);
  EXPECT_NEAR(core::to_seconds(lines.time_ns()), 5.5 / 7.3, 0.08);
}

TEST(RecordingPlayer, SerialAndScans_PlaysOneOfThem) {
  const test::TemporaryFolder folder;
  simulate(folder.path() / "a.ndjson");
  std::ifstream stream(folder.path() / "a.ndjson");
  std::string both;
  for (std::string line; std::getline(stream, line);) both += line + "\n" + scan_line(1);
  RecordingPlayer alone(folder.path() / "a.ndjson", {});
  EXPECT_EQ(play_lines(both).samples.size(), play(alone).samples.size());
}

TEST(RecordingPlayer, DamagedBytes_AreCounted) {
  const test::TemporaryFolder folder;
  simulate(folder.path() / "a.bin", 1e-3);
  RecordingPlayer player(folder.path() / "a.bin", {});
  EXPECT_GT(play(player).samples.size(), 1000u);
  EXPECT_GT(player.counters().bad_checksums, 0u);
}

TEST(RecordingPlayer, Kind_FollowsExtensionOrFirstCharacter) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return folder.path() / name;
  };
  EXPECT_EQ(kind_of_recording(write("a.ndjson", "")), RecordingKind::kMessages);
  EXPECT_EQ(kind_of_recording(write("b.bin", "{")), RecordingKind::kBytes);
  EXPECT_EQ(kind_of_recording(write("c.log", scan_line(1))), RecordingKind::kMessages);
  EXPECT_EQ(kind_of_recording(write("d.dump", "\xA5\x5A")), RecordingKind::kBytes);
}

TEST(RecordingPlayer, UnreadableFile_IsNamedWithItsReason) {
  const test::TemporaryFolder folder;
  const auto problem_with = [](const std::filesystem::path& file) -> std::string {
    try {
      RecordingPlayer(file, {});
    } catch (const RecordingError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(problem_with(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(problem_with(folder.path() / "none.bin").find("No such file"), std::string::npos);
  EXPECT_NE(problem_with(folder.path() / "drive.ndjson.gz").find("gunzip"), std::string::npos);
}

TEST(RecordingPlayer, EmptyRecording_EndsAtOnce) {
  std::istringstream stream;
  RecordingPlayer player(stream, RecordingKind::kBytes, {});
  Played played;
  EXPECT_FALSE(player.step(played));
  EXPECT_FALSE(player.step(played));
  EXPECT_TRUE(played.samples.empty());
}

}  // namespace
}  // namespace cornerd::replay
