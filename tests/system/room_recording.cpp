// SPDX-License-Identifier: MIT
#include "room_recording.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "core/geometry/angle.hpp"
#include "core/scan.hpp"
#include "message/line_writer.hpp"
#include "settings/map_file.hpp"

namespace cornerd::system_test {
namespace {

constexpr const char* kMap = R"({
  "format": "cornerd-map", "version": 1, "name": "test-room", "thickness": 0.02,
  "walls": [ { "from": [0, 0], "to": [2.4, 0] }, { "from": [2.4, 0], "to": [2.4, 1.1] },
             { "from": [2.4, 1.1], "to": [1.5, 1.1] }, { "from": [1.5, 1.1], "to": [1.5, 1.7] },
             { "from": [1.5, 1.7], "to": [0, 1.7] }, { "from": [0, 1.7], "to": [0, 0] },
             { "from": [0, 1.2], "to": [0.4, 1.2] } ],
  "rooms": [ { "name": "only", "polygon": [[0, 0], [2.4, 0], [2.4, 1.7], [0, 1.7]] } ] })";

constexpr int kSamplesPerScan = 720;
constexpr core::TimeNs kScanNs = core::kNsPerSecond / 10;

}  // namespace

void write_map(const std::filesystem::path& file, const std::string& room) {
  std::string text = kMap;
  const std::string name = "only";
  text.replace(text.find(name), name.size(), room);
  std::ofstream(file) << text;
}

void write_other_map(const std::filesystem::path& file) {
  std::string text = kMap;
  for (std::size_t at; (at = text.find("[1.5, ")) != std::string::npos;) {
    text.replace(at, 6, "[1.1, ");
  }
  std::ofstream(file) << text;
}

void write_recording(const std::filesystem::path& file, int scans, bool drives) {
  constexpr double kWay_m = 1.2;
  const core::WallMap map(settings::parse_floor_plan(kMap, file));
  core::Scan scan;
  message::LineWriter line;
  std::ofstream stream(file);
  for (int i = 0; i < (drives ? 2 * scans : scans); ++i) {
    const double x_m = kTrueX + kWay_m * std::max(0, i - scans) / scans;
    scan.clear();
    for (int k = 0; k < kSamplesPerScan; ++k) {
      // An RPLidar rotates clockwise.
      const double bearing_rad = core::kPi - core::kTwoPi * k / kSamplesPerScan;
      const double range_m = map.range_along({x_m, kTrueY}, kTrueTheta + bearing_rad, 12);
      scan.add({.t_ns = i * kScanNs + k * kScanNs / kSamplesPerScan,
                .bearing_rad = static_cast<float>(bearing_rad),
                .range_m = static_cast<float>(range_m),
                .quality = 47});
    }
    stream << line.scan(scan);
  }
}

}  // namespace cornerd::system_test
