// SPDX-License-Identifier: MIT
// Bytes of real A1s in $CORNERD_RECORDINGS/a1-wire, recorded by others and not part of the project.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "wire_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

namespace fs = std::filesystem;

struct GoldenRow {
  int start = 0;
  int quality = 0;
  int angle_q6 = 0;
  unsigned dist_q2 = 0;
};

class Recordings : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("CORNERD_RECORDINGS");
    if (folder == nullptr || !fs::exists(fs::path(folder) / "a1-wire")) {
      GTEST_SKIP() << "CORNERD_RECORDINGS names no folder with a1-wire in it";
    }
    wire_ = fs::path(folder) / "a1-wire";
  }

  static Bytes read_bytes(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::vector<GoldenRow> read_golden(const std::string& name) const {
    std::ifstream stream(wire_ / (name + ".golden.csv"));
    std::string line;
    std::getline(stream, line);
    std::vector<GoldenRow> rows;
    int offset = 0;
    char comma = 0;
    for (GoldenRow row; stream >> offset >> comma >> row.start >> comma >> row.quality >> comma >>
                        row.angle_q6 >> comma >> row.dist_q2;) {
      rows.push_back(row);
    }
    return rows;
  }

  static void expect_equal(const std::vector<RawSample>& samples,
                           const std::vector<GoldenRow>& rows) {
    ASSERT_EQ(samples.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_EQ(samples[i].quality, rows[i].quality) << "row " << i;
      ASSERT_EQ(samples[i].angle_q6, rows[i].angle_q6) << "row " << i;
      ASSERT_EQ(samples[i].dist_q2, rows[i].dist_q2) << "row " << i;
    }
  }

  fs::path wire_;
};

TEST_F(Recordings, LongestFile_MatchesNodesAndScans) {
  const auto rows = read_golden("sample_data_pyserial_1");
  const auto sink = decode(read_bytes(wire_ / "sample_data_pyserial_1.bin"));
  ASSERT_EQ(rows.size(), 10435U);
  expect_equal(sink.samples, rows);
  EXPECT_EQ(sink.scans(), 33U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(sink.samples[i].starts_scan, rows[i].start == 1) << "row " << i;
  }
}

TEST_F(Recordings, OtherFiles_MatchNodes) {
  for (const char* name : {"sample_data_motorctrl_1st_try", "capture_1", "sample_data_2"}) {
    SCOPED_TRACE(name);
    auto rows = read_golden(name);
    // Two files end within an echoed STOP, which their reference decodes as a node.
    if (rows.back().start == 1) rows.pop_back();
    expect_equal(decode(read_bytes(wire_ / (std::string(name) + ".bin"))).samples, rows);
  }
}

TEST_F(Recordings, EveryFile_HasScansOfOneRevolutionAndDistancesOfTheWire) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(wire_)) {
    if (entry.path().extension() == ".bin") files.push_back(entry.path());
  }
  ASSERT_GE(files.size(), 60U);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename());
    const Bytes bytes = read_bytes(file);
    const auto sink = decode(bytes);
    EXPECT_GE(sink.samples.size(), bytes.size() / 5 * 97 / 100);

    std::set<std::array<std::uint8_t, 4>> on_wire;  // angle and distance of each node
    for (std::size_t i = 0; i + 5 <= bytes.size(); ++i) {
      on_wire.insert({bytes[i + 1], bytes[i + 2], bytes[i + 3], bytes[i + 4]});
    }
    std::size_t in_scan = 0;
    bool scan_is_complete = false;
    auto gap = sink.gaps.begin();
    for (std::size_t i = 0; i < sink.samples.size(); ++i) {
      const RawSample& sample = sink.samples[i];
      if (gap != sink.gaps.end() && *gap == i) {
        scan_is_complete = false;
        ++gap;
      }
      if (sample.starts_scan) {
        // The recorded devices rotated at 6.1 to 6.6 Hz.
        if (scan_is_complete) {
          EXPECT_GE(in_scan, 285U);
          EXPECT_LE(in_scan, 325U);
        }
        scan_is_complete = true;
        in_scan = 0;
      }
      ++in_scan;
      EXPECT_LE(in_scan, 325U + (scan_is_complete ? 0 : 325));
      const unsigned angle = sample.angle_q6 * 2U + 1;
      const unsigned beyond = angle + 360 * 128;
      const auto node_of = [&](unsigned word) {
        return std::array{static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
                          static_cast<std::uint8_t>(sample.dist_q2),
                          static_cast<std::uint8_t>(sample.dist_q2 >> 8)};
      };
      ASSERT_TRUE(on_wire.contains(node_of(angle)) || on_wire.contains(node_of(beyond))) << i;
    }
  }
}

}  // namespace
}  // namespace cornerd::rplidar::test
