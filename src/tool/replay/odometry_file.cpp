// SPDX-License-Identifier: MIT
#include "tool/replay/odometry_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <variant>

#include "message/request.hpp"
#include "replay/line_reader.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

std::vector<core::OdometryReading> load_odometry(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Failure(file.string() + ": " + std::strerror(errno));
  std::vector<core::OdometryReading> readings;
  replay::LineReader lines(stream, message::kMaxRecordedBytes);
  using Result = replay::LineReader::Result;
  for (Result result = lines.next(); result != Result::kEnd; result = lines.next()) {
    const auto fail = [&](const std::string& reason) {
      throw Failure(file.string() + ":" + std::to_string(lines.number()) + ": " + reason);
    };
    if (result == Result::kTooLong) fail("too long for a message");
    if (lines.line().empty()) continue;
    const message::RecordedLine line = message::parse_recorded_line(lines.line());
    if (const auto* error = std::get_if<message::RequestError>(&line)) {
      if (result == Result::kLine) fail(error->text);
    } else if (const auto* reading = std::get_if<message::OdometryReading>(&line)) {
      readings.push_back(*reading);
    }
  }
  if (readings.empty()) throw Failure(file.string() + ": not one ODOMETRY line in it");
  return readings;
}

}  // namespace cornerd::tool
