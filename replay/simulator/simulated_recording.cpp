// SPDX-License-Identifier: MIT
#include "replay/simulator/simulated_recording.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "replay/simulator/serial_line.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::replay {
namespace {

/// Size of a read: about one express capsule, or sixteen nodes.
constexpr std::size_t kReadBytes = 80;
constexpr core::TimeNs kTruthPeriodNs = 10'000'000;
/// Share of a scan that a decoder needs to complete the one before: an ultra capsule spans up to 44
/// degrees and waits for its successor.
constexpr double kLeadOutShare = 0.3;

constexpr std::uint64_t kOdometrySeed = 0xA0761D6478BD642Fu;
constexpr std::uint64_t kFaultSeed = 0xD1B54A32D192ED03u;
constexpr std::uint64_t kJitterSeed = 0x8CB92BA72F3D8DD7u;

/// Samples the true pose.
class TruthSampler {
 public:
  TruthSampler(const Motion& motion, TruthWriter* writer) : motion_(motion), writer_(writer) {}

  void add(const SimulatedSample& sample) {
    if (writer_ == nullptr) return;
    const bool new_scan = sample.scan != last_.scan;
    if (new_scan && has_last_) write(last_);
    if (new_scan || !has_last_ || sample.t_ns >= written_ns_ + kTruthPeriodNs) write(sample);
    last_ = sample;
    has_last_ = true;
  }

  void finish() {
    if (writer_ == nullptr) return;
    if (has_last_) write(last_);
    writer_->flush();
  }

 private:
  void write(const SimulatedSample& sample) {
    if (sample.t_ns == written_ns_) return;
    writer_->add(sample.t_ns, motion_(sample.t_ns, sample.scan));
    written_ns_ = sample.t_ns;
  }

  const Motion& motion_;
  TruthWriter* writer_;
  SimulatedSample last_;
  bool has_last_ = false;
  core::TimeNs written_ns_ = -1;
};

/// Covered for an interval.
class CoveredScene final : public MapScene {
 public:
  CoveredScene(std::shared_ptr<const core::WallMap> map, const Motion& motion,
               const SimulatedRecordingConfig& config)
      : MapScene(std::move(map), motion, config.T_base_lidar),
        from_ns_(config.covered_from_ns),
        to_ns_(config.covered_to_ns) {}

  double range_along(core::TimeNs t_ns, std::int64_t scan, const core::Vec2& origin,
                     double bearing_rad) override {
    if (t_ns >= from_ns_ && t_ns < to_ns_) return 0;
    return MapScene::range_along(t_ns, scan, origin, bearing_rad);
  }

 private:
  core::TimeNs from_ns_;
  core::TimeNs to_ns_;
};

/// ODOMETRY lines up to the time of a read.
class OdometryInputMonitor {
 public:
  OdometryInputMonitor(const SimulatedRecordingConfig& config, const Motion& motion,
                       RecordingWriter& recording)
      : recording_(recording) {
    if (config.robot) {
      odometry_.emplace(motion, *config.robot, config.simulator.seed ^ kOdometrySeed);
    }
  }

  void write_until(core::TimeNs t_ns) {
    while (odometry_ && odometry_->next_ns() <= t_ns) {
      recording_.odometry(odometry_->next());
    }
  }

 private:
  RecordingWriter& recording_;
  std::optional<SimulatedOdometry> odometry_;
};

/// Portions of bytes as read from the port: damaged and delayed.
class Reads {
 public:
  Reads(const SimulatedRecordingConfig& config, RecordingWriter& recording,
        OdometryInputMonitor& odometry)
      : faults_(config.byte_fault_share, config.simulator.seed ^ kFaultSeed),
        random_(config.simulator.seed ^ kJitterSeed),
        jitter_s_(config.arrival_jitter_s),
        recording_(recording),
        odometry_(odometry) {}

  void send(core::TimeNs ready_ns, std::span<const std::uint8_t> bytes) {
    line_.send(ready_ns, bytes.size());
    portion_.insert(portion_.end(), bytes.begin(), bytes.end());
    if (portion_.size() >= kReadBytes) flush();
  }

  void flush() {
    const core::TimeNs late_ns = core::from_seconds(random_.uniform(0, jitter_s_));
    arrival_ns_ = std::max(arrival_ns_, line_.free_ns() + late_ns);
    const std::span<const std::uint8_t> arrived = faults_.pass(portion_);
    odometry_.write_until(arrival_ns_);
    recording_.received(arrival_ns_, arrived);
    bytes_ += arrived.size();
    portion_.clear();
  }

  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t faults() const { return faults_.faults(); }

 private:
  SerialLine line_;
  ByteFaults faults_;
  Random random_;
  double jitter_s_;
  RecordingWriter& recording_;
  OdometryInputMonitor& odometry_;
  std::vector<std::uint8_t> portion_;
  core::TimeNs arrival_ns_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace

SimulatedRecordingSummary simulate_recording(std::shared_ptr<const core::WallMap> map,
                                             const Motion& motion,
                                             const SimulatedRecordingConfig& config,
                                             RecordingWriter& recording, TruthWriter* truth) {
  if (config.scans < 1) throw std::invalid_argument("simulated recording: needs at least one scan");
  if (!(config.byte_fault_share >= 0 && config.byte_fault_share < 1)) {
    throw std::invalid_argument(
        "simulated recording: the share of damaged bytes must be in [0, 1)");
  }
  Simulator simulator(std::make_unique<CoveredScene>(std::move(map), motion, config),
                      config.simulator);
  TruthSampler truth_sampler(motion, truth);
  OdometryInputMonitor odometry(config, motion, recording);
  Reads reads(config, recording, odometry);
  if (config.with_descriptor) {
    const DescriptorBytes descriptor = simulator.descriptor();
    reads.send(0, descriptor);
    reads.flush();
  }

  SimulatedRecordingSummary summary;
  const auto lead_out_ns = core::from_seconds(kLeadOutShare / config.simulator.motor_hz);
  core::TimeNs end_ns = 0;
  while (end_ns == 0 || summary.duration_s < core::to_seconds(end_ns)) {
    const WirePacket packet = simulator.next();
    reads.send(packet.ready_ns, packet.bytes);
    for (const SimulatedSample& sample : packet.samples) {
      truth_sampler.add(sample);
      summary.returns += sample.dist_q2 != 0;
      if (end_ns == 0 && sample.scan >= config.scans) end_ns = sample.t_ns + lead_out_ns;
      summary.duration_s = core::to_seconds(sample.t_ns);
    }
    summary.samples += packet.samples.size();
  }
  reads.flush();
  recording.flush();
  truth_sampler.finish();
  summary.bytes = reads.bytes();
  summary.byte_faults = reads.faults();
  return summary;
}

}  // namespace cornerd::replay
