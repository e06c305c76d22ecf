// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <stop_token>

#include "core/ring_buffer.hpp"
#include "core/triple_buffer.hpp"
#include "drivers/lidar_driver.hpp"
#include "replay/recording.hpp"

namespace cornerd::replay {

struct ReplayDriverConfig {
  std::filesystem::path file;
  double speed = 1;   ///< relative to real time; 0: as fast as the sink takes it
  bool loop = false;  ///< restart at the end
  RecordingOptions recording;
};

/// Plays a recording in place of a device. Samples keep their recorded times; with `loop` time
/// keeps growing over passes. An unplayable file is state kFaulty, its end kEnded; run() then
/// returns.
class ReplayDriver : public drivers::LidarDriver {
 public:
  explicit ReplayDriver(ReplayDriverConfig config);

  void run(std::stop_token stop, drivers::SampleSink& sink) override;
  drivers::LidarStatus status() override { return published_.read(); }
  bool take_change(drivers::LidarChange& change) override { return changes_.pop(change); }

 private:
  class Pacer;

  void publish(const RecordingPlayer& player, const Pacer& pacer);
  void publish(const drivers::LidarStatus& now);
  void play(const std::stop_token& stop, Pacer& pacer);

  ReplayDriverConfig config_;
  drivers::LidarStatus status_;  ///< run()'s own copy
  core::TripleBuffer<drivers::LidarStatus> published_;
  static constexpr std::size_t kChanges = 16;  ///< a recording has at most four
  core::RingBuffer<drivers::LidarChange> changes_{kChanges};
  drivers::LidarChange last_change_;
};

}  // namespace cornerd::replay
