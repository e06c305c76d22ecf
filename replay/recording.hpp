// SPDX-License-Identifier: MIT
// Reads recordings: .bin (a port's bytes) and .ndjson (timed messages).
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "drivers/lidar_driver.hpp"
#include "drivers/make_driver.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "message/request.hpp"

namespace cornerd::replay {

/// A file cannot be read or written, or is no recording. what() is one line with the file's name.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class RecordingKind : std::uint8_t { kBytes, kMessages };

/// By the extension .bin or .ndjson, else by the first character: a message begins with '{', which
/// no answer of an A1 does. Throws RecordingError if the file cannot be read or is compressed.
RecordingKind kind_of_recording(const std::filesystem::path& file);

struct RecordingOptions {
  drivers::RecordedWire wire;
  bool inverted = false;  ///< the lidar was upside down
};

/// Receives a recording: SERIAL and SCAN as samples, and ODOMETRY.
class RecordingSink : public drivers::SampleSink {
 public:
  virtual void on_odometry(const message::OdometryReading& reading) = 0;
  /// An ODOMETRY line that cannot be read; it counts as a bad line, too.
  virtual void on_refused_odometry(const message::RequestError& /*error*/) {}
};

/// Plays a recording in the order of its lines. Damaged lines and bytes are counted and skipped,
/// also an incomplete last line, as a killed recorder leaves one. Memory is bounded: a line of more
/// than message::kMaxRecordedBytes is damaged.
///
/// Where t of SERIAL or SCAN goes back by more than a second (a set clock, two recordings in a
/// file), all times go on from the newest one.
///
/// Each SCAN is one scan, whatever its angles. Of SERIAL and SCAN only the kind that comes first is
/// played, as both hold the same samples.
class RecordingPlayer {
 public:
  /// Throws RecordingError.
  RecordingPlayer(const std::filesystem::path& file, const RecordingOptions& options);
  /// `stream` must outlive the player.
  RecordingPlayer(std::istream& stream, RecordingKind kind, const RecordingOptions& options);
  ~RecordingPlayer();

  /// Plays the next line or block of bytes; false at the end. Calls on_gap() where bytes are
  /// missing, never between SCANs. Throws RecordingError on a read error.
  bool step(RecordingSink& sink);

  /// Time of the last piece played; for .bin since its start.
  core::TimeNs time_ns() const;
  const drivers::StreamCounters& counters() const;
  std::uint64_t bad_lines() const;
  /// One line about the first bad line, else about times that do not advance; empty if there are
  /// neither.
  const std::string& first_problem() const;
  /// For standard error: a line about bad lines, and one about times.
  std::string report() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace cornerd::replay
