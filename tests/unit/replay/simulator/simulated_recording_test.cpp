// SPDX-License-Identifier: MIT
#include "replay/simulator/simulated_recording.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "message/request.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(SimulateRecording, BinAndNdjson_HoldTheSameBytes) {
  const test::TemporaryFolder folder;
  SimulatedRecordingConfig config;
  config.scans = 2;
  config.byte_fault_share = 1e-3;
  SimulatedRecordingSummary summary;
  for (const char* name : {"a.bin", "a.ndjson"}) {
    RecordingWriter writer(folder.path() / name);
    summary = simulate_recording(make_room(), stand_still({1, 1, 0}), config, writer, nullptr);
  }
  std::ifstream bin(folder.path() / "a.bin", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(bin), {}};
  std::string joined;
  core::TimeNs last_ns = 0;
  for (const std::string& line : lines_of(folder.path() / "a.ndjson")) {
    const auto parsed = message::parse_recorded_line(line);
    const auto* serial = std::get_if<message::RecordedBytes>(&parsed);
    ASSERT_NE(serial, nullptr) << line;
    EXPECT_GE(serial->t_ns, last_ns);
    last_ns = serial->t_ns;
    joined.append(serial->bytes.begin(), serial->bytes.end());
  }
  EXPECT_EQ(joined, bytes);
  EXPECT_EQ(summary.bytes, bytes.size());
  EXPECT_GT(summary.byte_faults, 0u);
  EXPECT_GT(summary.duration_s, 2 / 7.3);
  EXPECT_LT(summary.duration_s, 3 / 7.3);
}

TEST(SimulateRecording, TruthOfVisits_HasEachArrivalAndDeparture) {
  const test::TemporaryFolder folder;
  SimulatedRecordingConfig config;
  config.scans = 6;
  {
    RecordingWriter writer(folder.path() / "a.bin");
    TruthWriter truth(folder.path() / "truth.ndjson");
    simulate_recording(make_room(), visit_poses({{0.5, 0.5, 0}, {1, 1, 1}, {1.5, 2, 2}}, 2), config,
                       writer, &truth);
  }
  std::vector<message::RecordedTruth> truths;
  for (const std::string& line : lines_of(folder.path() / "truth.ndjson")) {
    const auto parsed = message::parse_truth_line(line);
    ASSERT_TRUE(std::holds_alternative<message::RecordedTruth>(parsed)) << line;
    truths.push_back(std::get<message::RecordedTruth>(parsed));
  }
  ASSERT_EQ(truths.size(), 6u);
  for (std::size_t i = 0; i < 6; i += 2) {
    EXPECT_EQ(truths[i].T_map_base.x_m, 0.5 + 0.25 * static_cast<double>(i));
    EXPECT_EQ(truths[i + 1].T_map_base.x_m, truths[i].T_map_base.x_m);
    EXPECT_NEAR(core::to_seconds(truths[i + 1].t_ns - truths[i].t_ns), 2 / 7.3, 0.08);
  }
}

TEST(SimulateRecording, UnwritableFile_IsNamed) {
  try {
    RecordingWriter writer("/nonexistent/a.bin");
    FAIL();
  } catch (const RecordingError& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/a.bin"), std::string::npos);
  }
}

}  // namespace
}  // namespace cornerd::replay
