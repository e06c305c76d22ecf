// SPDX-License-Identifier: MIT
// Reading what was recorded: .bin (a port's bytes) and .ndjson (timed messages).
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "drivers/lidar_driver.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "message/request.hpp"

namespace cornerd::replay {

/// A file that cannot be read or written, or is no recording. what() is one line with its name.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class RecordingKind : std::uint8_t { kBytes, kMessages };

/// By the name where it ends in .bin or .ndjson, else by the first character: a message begins
/// with '{', which no answer of an A1 does.
/// Throws RecordingError where the file cannot be read or is compressed.
RecordingKind kind_of_recording(const std::filesystem::path& file);

struct RecordingOptions {
  std::optional<rplidar::WireFormat> wire;  ///< of bytes that begin without a descriptor
  bool inverted = false;                    ///< the lidar hung upside down
};

/// Where a recording is played to. Bytes arrive as samples, SCAN messages likewise.
class RecordingSink : public drivers::SampleSink {
 public:
  virtual void on_odometry(const message::OdometryReading& reading) = 0;
};

/// Plays one recording in the order of its lines. Damaged lines and bytes are counted and passed
/// over; a last line that was torn off is not even counted, as a recorder that was ended leaves
/// one. Memory does not grow with the file: a line of over message::kMaxRecordedBytes is damaged.
///
/// Each SCAN is one turn, whatever its angles: its first sample starts it, its last one ends it. A
/// recording that has both SERIAL and SCAN tells everything
/// twice; the kind that comes first is played, the other is not.
class RecordingPlayer {
 public:
  /// Throws RecordingError.
  RecordingPlayer(const std::filesystem::path& file, const RecordingOptions& options);
  /// `stream` must outlive the player.
  RecordingPlayer(std::istream& stream, RecordingKind kind, const RecordingOptions& options);
  ~RecordingPlayer();

  /// Plays the next piece: a line, or a block of bytes. False at the end, when all that was held
  /// back has been delivered too. `on_gap` is called where bytes are missing, never between SCANs.
  /// Throws RecordingError where the file can no longer be read.
  bool step(RecordingSink& sink);

  /// Time of the last piece that was played. Bytes without a clock: since the first of them.
  core::TimeNs time_ns() const;
  const drivers::StreamCounters& counters() const;
  std::uint64_t bad_lines() const;
  /// One line about the first bad line; empty where there was none.
  const std::string& first_problem() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace cornerd::replay
