// SPDX-License-Identifier: MIT
// Writes recordings: .bin (a port's bytes) and .ndjson (timed messages).
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>

#include "core/geometry/pose2.hpp"
#include "message/line_writer.hpp"
#include "replay/recording.hpp"

namespace cornerd::replay {

/// Records a port. A file *.ndjson gets timed lines, any other the received bytes alone. All
/// methods throw RecordingError if the file cannot be written.
class RecordingWriter {
 public:
  explicit RecordingWriter(const std::filesystem::path& file);

  /// `t_ns`: arrival of the last byte.
  void received(core::TimeNs t_ns, std::span<const std::uint8_t> bytes);
  void sent(core::TimeNs t_ns, std::span<const std::uint8_t> bytes);
  void odometry(const core::OdometryReading& reading);
  /// Writes buffered data to the file.
  void flush();

  /// Whether this file gets lines.
  static bool has_lines(const std::filesystem::path& file) { return file.extension() == ".ndjson"; }
  bool has_lines() const { return has_lines_; }

 private:
  void put(std::string_view text);

  std::filesystem::path file_;
  bool has_lines_;
  std::ofstream stream_;
  message::LineWriter line_;
};

/// Writes a --truth file, without poses that interpolation restores.
class TruthWriter {
 public:
  /// Throws RecordingError, as do all methods.
  explicit TruthWriter(const std::filesystem::path& file);

  void add(core::TimeNs t_ns, const core::Pose2& T_map_base);
  /// Writes the last pose and all buffered data.
  void flush();

 private:
  struct Entry {
    core::TimeNs t_ns = 0;
    core::Pose2 T_map_base;
  };
  void put(const Entry& entry);

  std::filesystem::path file_;
  std::ofstream stream_;
  message::LineWriter line_;
  std::optional<core::Pose2> written_;
  std::optional<Entry> held_back_;  ///< the newest pose, if equal to the one before
};

}  // namespace cornerd::replay
