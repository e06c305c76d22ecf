// SPDX-License-Identifier: MIT
// Reading what was recorded: .bin (a port's bytes) and .ndjson (timed messages).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "drivers/lidar_driver.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "message/request.hpp"

namespace cornerd::replay {

/// A file that cannot be opened or is no recording at all. what() is one line with the file's name.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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
/// over. Memory does not grow with the file.
class RecordingPlayer {
 public:
  /// Throws RecordingError.
  RecordingPlayer(const std::filesystem::path& file, const RecordingOptions& options);
  ~RecordingPlayer();

  /// Plays the next piece (a line, or a block of bytes). False at the end. `on_gap` of the sink is
  /// called between a SCAN message's samples and those of the next.
  bool step(RecordingSink& sink);

  /// Time of the last piece that was played.
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
