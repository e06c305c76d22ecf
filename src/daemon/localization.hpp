// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "core/latency_histogram.hpp"
#include "core/pipeline.hpp"
#include "core/ring_buffer.hpp"
#include "core/triple_buffer.hpp"
#include "daemon/require_fd.hpp"
#include "daemon/sample_channel.hpp"
#include "daemon/slot_exchange.hpp"
#include "drivers/lidar_driver.hpp"

namespace cornerd::daemon {

/// What the samples come from. A device does not wait, and its samples bear monotonic time, so that
/// nobody who sets the clock disturbs it; a recording waits for the localizer, and bears its own.
enum class SourceKind : std::uint8_t { kDevice, kRecording };

/// What one turn gave, for the server's thread. Its times are UNIX time, or the recording's own.
struct ScanReport {
  core::ScanResult result;
  core::Scan scan;
  std::uint64_t number = 0;  ///< of the turn; POSE.seq counts poses between turns as well
  /// From when the turn's end was handed over by the driver to when the pose was there.
  std::int64_t latency_ns = 0;
  /// Of the pipeline that made it: grows with each that is put in another's place.
  std::uint32_t generation = 0;
  std::uint32_t lidar = 0;  ///< that result.bias is of: Localization::lidar()
};

/// How a thread keeps its time.
struct LoopHealth {
  core::LatencyHistogram latency;
  std::uint64_t page_faults = 0;
};

/// The two threads that must not be late: one runs the driver, one the pipeline. Once they run,
/// neither locks, logs or allocates; what they have to say goes through the server's thread.
class Localization {
 public:
  /// `driver` must outlive this.
  Localization(drivers::LidarDriver& driver, std::unique_ptr<core::Pipeline> pipeline,
               SourceKind source);
  /// Stops both: the driver ends its device's work in its own thread.
  ~Localization();
  Localization(const Localization&) = delete;
  Localization& operator=(const Localization&) = delete;

  // All that follows is for the server's thread.

  /// Throws std::system_error.
  void start();
  /// SCHED_FIFO for the thread that reads the port. Returns errno of a refusal, or 0.
  int prioritize_reader(int priority);

  /// Readable when there are reports.
  int event_fd() const { return reported_.get(); }
  /// Calls `use` with every ScanReport there is, oldest first.
  void take(const auto& use) {
    clear_event();
    delete retired_.exchange(nullptr);
    while (reports_.take(use)) {
    }
  }
  /// The same with every pose between turns. After take().
  void take_predictions(const auto& use) {
    while (predictions_.take(use)) {
    }
  }
  /// What wheels and gyro say, on the clock of the samples; of one thread, be it the server's or
  /// another. One that finds no room is lost; the next one's counts make up for it.
  void add(const core::OdometryReading& reading) {
    readings_.push(reading);
    if (publishes_predictions_.load(std::memory_order_relaxed)) channel_.wake();
  }
  /// Now by the clock of the samples: the newest one's time, whose turn may still be going on.
  core::TimeNs newest_sample_ns() const { return channel_.newest_ns(); }
  /// A pose for every reading, be there turns or not: odometry.publish_predictions.
  void publish_predictions(bool every) {
    publishes_predictions_.store(every, std::memory_order_relaxed);
  }
  /// The robot is about there.
  void set_initial_pose(const core::Pose2& T_map_base) { initial_poses_.push(T_map_base); }
  /// From the next turn on this one localizes; it knows nothing yet. Returns its generation.
  std::uint32_t replace_pipeline(std::unique_ptr<core::Pipeline> pipeline);
  /// The next turn is recognised without a prior.
  void relocalize() { relocalize_.store(true, std::memory_order_relaxed); }
  /// Another lidar, or one that is taken for another: what was learnt of the last one is forgotten.
  /// The reports of turns that know nothing of it bear its new lidar().
  void forget_lidar() { lidar_.fetch_add(1, std::memory_order_relaxed); }
  std::uint32_t lidar() const { return lidar_.load(std::memory_order_relaxed); }

  /// True where reader and localizer have both come round since this was last true. Asks the
  /// localizer to.
  bool has_progressed();

  /// LatencyHistogram: from when a turn's last sample was handed over to when the localizer looks
  /// at it.
  LoopHealth localizer_health() { return health_.read(); }
  std::uint64_t reader_page_faults() const { return channel_.producer_page_faults(); }

  std::uint64_t lost_samples() const { return channel_.lost(); }
  std::uint64_t lost_reports() const { return lost_reports_.load(std::memory_order_relaxed); }

 private:
  struct Generation {
    std::unique_ptr<core::Pipeline> pipeline;
    std::uint32_t number = 0;
    std::uint32_t lidar = 0;  ///< that it learns of
  };

  void read(const std::stop_token& stop);
  void localize(const std::stop_token& stop);
  void process(const SampleChannel::Item& item);
  void process(core::Pipeline& pipeline, const SampleChannel::Item& item);
  void report(const core::Pipeline& pipeline, const core::ScanResult& result,
              std::int64_t arrival_ns);
  /// Puts the next pipeline, where there is one, in the place of this, between two turns.
  void swap_pipeline(const SampleChannel::Item& item);
  void take_readings();
  void report(const core::PoseEstimate* prediction);
  void clear_event() const;

  drivers::LidarDriver& driver_;
  const SourceKind source_;
  std::unique_ptr<Generation> current_;  ///< the localizer's thread's, as is the next
  std::uint64_t scans_ = 0;
  std::uint64_t poses_ = 0;  ///< those between the turns included
  /// To that thread and back: it takes no memory and gives none away.
  std::atomic<Generation*> next_{nullptr};
  std::atomic<Generation*> retired_{nullptr};
  std::uint32_t newest_ = 0;  ///< number of the last one that was handed over
  SampleChannel channel_;
  core::RingBuffer<core::OdometryReading> readings_;
  core::RingBuffer<core::Pose2> initial_poses_;
  SlotExchange<ScanReport> reports_;
  SlotExchange<core::PoseEstimate> predictions_;
  std::atomic<bool> publishes_predictions_{false};
  FileDescriptor reported_;
  LoopHealth own_health_;  ///< the localizer's thread's
  core::TripleBuffer<LoopHealth> health_;
  std::atomic<bool> relocalize_{false};
  std::atomic<std::uint32_t> lidar_{0};  ///< counts them
  std::atomic<std::uint32_t> lost_reports_{0};
  std::atomic<std::uint32_t> rounds_{0};
  std::atomic<bool> reader_has_ended_{false};
  std::uint32_t rounds_seen_ = 0;
  std::uint32_t driver_rounds_seen_ = 0;
  std::jthread localizer_;
  std::jthread reader_;
};

}  // namespace cornerd::daemon
