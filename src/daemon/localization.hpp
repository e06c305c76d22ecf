// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/latency_histogram.hpp"
#include "core/odometry/odometry_frame.hpp"
#include "core/pipeline.hpp"
#include "core/ring_buffer.hpp"
#include "core/triple_buffer.hpp"
#include "daemon/require_fd.hpp"
#include "daemon/sample_channel.hpp"
#include "daemon/slot_exchange.hpp"
#include "drivers/lidar_driver.hpp"
#include "settings/learned_walls.hpp"

namespace cornerd::daemon {

/// A device does not wait, and its samples have monotonic time, which clock steps do not affect. A
/// recording waits for the localizer and has its own time.
enum class SourceKind : std::uint8_t { kDevice, kRecording };

/// Result of one scan for the server thread. Its times are UNIX time, or the recording's time.
struct ScanReport {
  core::ScanResult result;
  core::Scan scan;
  core::TimeNs to_unix_ns = 0;  ///< added to the times of `result` and `scan`
  std::uint64_t number = 0;     ///< counts scans; POSE.seq also counts predictions
  /// From the arrival of the scan's last byte to its pose; of a recording, from its last sample.
  std::int64_t latency_ns = 0;
  bool follows_initial_pose = false;  ///< SET_POSE came since the scan before
  std::uint32_t generation = 0;       ///< of the pipeline, see Localization::replace_pipeline()
  std::optional<std::size_t> map;     ///< of the pipeline's; nullopt until it is known
  std::uint32_t lidar = 0;            ///< to which result.bias belongs, see Localization::lidar()
};

/// What the localizer has learned of the walls.
using WallReport = settings::LearnedWallsOfMap;

/// Timing of a thread.
struct LoopHealth {
  core::LatencyHistogram latency;
  std::uint64_t page_faults = 0;
};

/// The two real-time threads: the reader runs the driver, the localizer runs the pipeline. They do
/// not lock, log or allocate (tests/unit/daemon/realtime_allocation_test.cpp); results go to the
/// server thread.
class Localization {
 public:
  /// `driver` must outlive this.
  Localization(drivers::LidarDriver& driver, std::unique_ptr<core::Pipeline> pipeline,
               SourceKind source);
  /// Stops both threads; the driver stops its device in the reader thread.
  ~Localization();
  Localization(const Localization&) = delete;
  Localization& operator=(const Localization&) = delete;

  // The members below are for the server thread, except add().

  /// Throws std::system_error.
  void start();
  /// Gives the reader thread SCHED_FIFO. Returns 0 or an errno.
  int prioritize_reader(int priority);

  /// Readable when reports or predictions wait.
  int event_fd() const { return reported_.get(); }
  /// Calls `use_report` with each waiting ScanReport and `use_pose` with each pose between scans,
  /// in the order of their POSE.seq.
  void take(const auto& use_report, const auto& use_pose) {
    clear_event();
    delete retired_.exchange(nullptr);
    while (true) {
      const ScanReport* report = reports_.front();
      const core::PoseEstimate* const pose = predictions_.front();
      // A report may have come before this pose, since the first look.
      if (report == nullptr && pose != nullptr) report = reports_.front();
      if (report != nullptr && (pose == nullptr || report->result.pose.seq < pose->seq)) {
        reports_.take(use_report);
      } else if (!predictions_.take(use_pose)) {
        return;
      }
    }
  }
  /// Calls `use` with each odometry reading that the localizer has taken, in the samples' time.
  void take_odometry_readings(const auto& use) {
    core::OdometryReading reading;
    while (taken_.pop(reading)) use(reading);
  }
  /// An odometry reading with the time base of the samples. Call it from one thread only. A reading
  /// that finds no room is lost; the next encoder counts contain its motion.
  void add(const core::OdometryReading& reading) {
    readings_.push(reading);
    if (wants_every_reading()) channel_.wake();
  }
  /// Time of the newest sample, which may belong to an incomplete scan.
  core::TimeNs newest_sample_ns() const { return channel_.newest_ns(); }
  /// Publish a pose for each reading: /advanced/odometry/publish_predictions.
  void publish_predictions(bool every) {
    publishes_predictions_.store(every, std::memory_order_relaxed);
  }
  /// Localize partial scans as they come: /advanced/localizer/updates_per_scan.
  void localize_parts(bool parts) { channel_.wake_for_parts(parts); }
  /// Wake for each reading, since somebody watches ODOM or ODOMETRY.
  void hurry_odometry(bool every) { hurries_odometry_.store(every, std::memory_order_relaxed); }
  /// Calls `use` with each waiting pose in the frame `odom`, oldest first. Call it after take(),
  /// and ten times a second: they wake nobody unless hurry_odometry().
  void take_odometry_poses(const auto& use) {
    while (odometry_poses_.take(use)) {
    }
  }
  /// An approximate pose from a client (SET_POSE).
  void set_initial_pose(const core::Pose2& T_map_base) { initial_poses_.push(T_map_base); }
  /// Replaces the pipeline after the current scan. Returns the generation of the new one.
  std::uint32_t replace_pipeline(std::unique_ptr<core::Pipeline> pipeline);
  /// Asks for a WallReport, which is there after the next scan.
  void request_walls();
  /// The one asked for; null until it is there.
  std::unique_ptr<WallReport> take_walls() {
    return std::unique_ptr<WallReport>(walls_filled_.exchange(nullptr));
  }
  /// The next scan is matched without a prior; where there are several maps, in all of them.
  void relocalize() { relocalize_.store(true, std::memory_order_relaxed); }
  /// Forgets the estimated bias after a change of the lidar. Later reports have a new lidar().
  void forget_lidar() { lidar_.fetch_add(1, std::memory_order_relaxed); }
  std::uint32_t lidar() const { return lidar_.load(std::memory_order_relaxed); }

  /// True if reader and localizer have both made progress since the last call that returned true.
  /// Wakes the localizer.
  bool has_progressed();

  /// Latency from the arrival of a scan's last sample to its processing.
  LoopHealth localizer_health() { return health_.read(); }
  std::uint64_t reader_page_faults() const { return channel_.producer_page_faults(); }

  std::uint64_t lost_samples() const { return channel_.lost(); }
  std::uint64_t lost_reports() const { return lost_reports_.load(std::memory_order_relaxed); }

 private:
  struct Generation {
    std::unique_ptr<core::Pipeline> pipeline;
    std::uint32_t number = 0;
    std::uint32_t lidar = 0;  ///< whose bias it estimates
  };

  void read(const std::stop_token& stop);
  void localize(const std::stop_token& stop);
  void process(const SampleChannel::Item& item);
  void process(core::Pipeline& pipeline, const SampleChannel::Item& item);
  void report(core::Pipeline& pipeline, const core::ScanResult& result, std::int64_t arrival_ns);
  void report_walls(const core::Localizer& localizer);
  /// Installs the next pipeline, if there is one, between two scans.
  void swap_pipeline(const SampleChannel::Item& item);
  bool wants_every_reading() const {
    return publishes_predictions_.load(std::memory_order_relaxed) ||
           hurries_odometry_.load(std::memory_order_relaxed);
  }
  void take_readings();
  void process(const core::OdometryReading& reading);
  void report(const core::PoseEstimate* prediction);
  void report(const core::MeasuredMotion& moved);
  void clear_event() const;

  drivers::LidarDriver& driver_;
  const SourceKind source_;
  std::unique_ptr<Generation> current_;  ///< owned by the localizer thread, like the two counters
  std::uint64_t scans_ = 0;
  std::uint64_t poses_ = 0;        ///< including those between scans
  bool has_initial_pose_ = false;  ///< since the last scan
  /// Pipelines go to the localizer thread and back, so that it neither allocates nor frees.
  std::atomic<Generation*> next_{nullptr};
  std::atomic<Generation*> retired_{nullptr};
  /// Goes to the localizer thread empty and comes back filled.
  std::atomic<WallReport*> walls_wanted_{nullptr};
  std::atomic<WallReport*> walls_filled_{nullptr};
  std::uint32_t newest_ = 0;  ///< number of the last pipeline handed over
  SampleChannel channel_;
  core::RingBuffer<core::OdometryReading> readings_;
  core::RingBuffer<core::OdometryReading> taken_;  ///< back to the server thread
  core::RingBuffer<core::Pose2> initial_poses_;
  SlotExchange<ScanReport> reports_;
  SlotExchange<core::PoseEstimate> predictions_;
  std::atomic<bool> publishes_predictions_{false};
  std::atomic<bool> hurries_odometry_{false};
  /// Owned by the localizer thread. It outlives pipelines: another map moves no robot.
  core::OdometryPose odometry_pose_;
  SlotExchange<core::OdometryPose> odometry_poses_;
  FileDescriptor reported_;
  LoopHealth own_health_;  ///< owned by the localizer thread
  core::TripleBuffer<LoopHealth> health_;
  std::atomic<bool> relocalize_{false};
  std::atomic<std::uint32_t> lidar_{0};  ///< counts changes of the lidar
  std::atomic<std::uint32_t> lost_reports_{0};
  std::atomic<std::uint32_t> rounds_{0};
  std::atomic<bool> reader_has_ended_{false};
  std::uint32_t rounds_seen_ = 0;
  std::uint32_t driver_rounds_seen_ = 0;
  std::jthread localizer_;
  std::jthread reader_;
};

}  // namespace cornerd::daemon
