// SPDX-License-Identifier: MIT
// Writing recordings: .bin (a port's bytes) and .ndjson (timed messages).
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

/// Writes what came from a port. A name that ends in .ndjson gives timed lines, any other the bare
/// bytes, which have no place for anything else. All methods throw RecordingError where the file
/// cannot be written.
class RecordingWriter {
 public:
  explicit RecordingWriter(const std::filesystem::path& file);

  /// `t_ns`: when the last of the bytes arrived.
  void received(core::TimeNs t_ns, std::span<const std::uint8_t> bytes);
  void sent(core::TimeNs t_ns, std::span<const std::uint8_t> bytes);
  void odometry(const message::LineWriter::OdometryFields& odometry);
  /// After this all that was written is in the file.
  void flush();

  /// Whether a file of this name gets lines.
  static bool has_lines(const std::filesystem::path& file) { return file.extension() == ".ndjson"; }
  bool has_lines() const { return has_lines_; }

 private:
  void put(std::string_view text);

  std::filesystem::path file_;
  bool has_lines_;
  std::ofstream stream_;
  message::LineWriter line_;
};

/// Writes a --truth file: as few poses as tell the same when they are interpolated.
class TruthWriter {
 public:
  /// Throws RecordingError, as do all methods.
  explicit TruthWriter(const std::filesystem::path& file);

  void add(core::TimeNs t_ns, const core::Pose2& T_map_base);
  /// Writes the last pose too, and all of it into the file.
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
  std::optional<Entry> held_back_;  ///< the newest pose that was like the one before it
};

}  // namespace cornerd::replay
