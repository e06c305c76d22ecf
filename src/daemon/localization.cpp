// SPDX-License-Identifier: MIT
#include "daemon/localization.hpp"

#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <memory>
#include <utility>

#include "daemon/posix_clock.hpp"
#include "daemon/realtime.hpp"

namespace cornerd::daemon {
namespace {

/// More than a second of scans, while the server is busy.
constexpr std::size_t kReportSlots = 16;
/// Two seconds at 500 Hz; a scan takes at most one second.
constexpr std::size_t kReadingSlots = 1024;
constexpr std::size_t kHashDigits = 64;
constexpr std::size_t kInitialPoseSlots = 4;
/// More than a tenth of a second of readings.
constexpr std::size_t kPredictionSlots = 64;

}  // namespace

Localization::Localization(drivers::LidarDriver& driver, std::unique_ptr<core::Pipeline> pipeline,
                           SourceKind source)
    : driver_(driver),
      source_(source),
      current_(new Generation{std::move(pipeline)}),
      channel_(source == SourceKind::kDevice ? SampleChannel::WhenFull::kLose
                                             : SampleChannel::WhenFull::kWait),
      readings_(kReadingSlots),
      taken_(kReadingSlots),
      initial_poses_(kInitialPoseSlots),
      reports_(kReportSlots),
      predictions_(kPredictionSlots),
      odometry_poses_(kPredictionSlots),
      reported_(require_fd(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd")) {}

Localization::~Localization() {
  localizer_.request_stop();
  reader_.request_stop();
  channel_.close();
  localizer_ = {};
  reader_ = {};
  delete next_.load();
  delete retired_.load();
  delete walls_wanted_.load();
  delete walls_filled_.load();
}

void Localization::start() {
  localizer_ = std::jthread([this](const std::stop_token& stop) { localize(stop); });
  reader_ = std::jthread([this](const std::stop_token& stop) { read(stop); });
}

int Localization::prioritize_reader(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return ::pthread_setschedparam(reader_.native_handle(), SCHED_FIFO, &parameters);
}

void Localization::read(const std::stop_token& stop) {
  ::pthread_setname_np(::pthread_self(), "reader");
  driver_.run(stop, channel_);
  // At the end of a recording no further sample completes the last scan.
  channel_.on_gap();
  reader_has_ended_.store(true, std::memory_order_relaxed);
}

void Localization::localize(const std::stop_token& stop) {
  ::pthread_setname_np(::pthread_self(), "localizer");
  SampleChannel::Item item;
  while (true) {
    // Read wakes() first: a stop requested after the check below changes it.
    const std::uint32_t seen = channel_.wakes();
    if (stop.stop_requested()) return;
    while (!stop.stop_requested() && channel_.pop(item)) process(item);
    if (wants_every_reading()) take_readings();
    rounds_.fetch_add(1, std::memory_order_relaxed);
    channel_.wait(seen);
  }
}

std::uint32_t Localization::replace_pipeline(std::unique_ptr<core::Pipeline> pipeline) {
  delete next_.exchange(nullptr);
  delete retired_.exchange(nullptr);
  next_.store(new Generation{std::move(pipeline), ++newest_, lidar()});
  return newest_;
}

void Localization::request_walls() {
  if (walls_wanted_.load() != nullptr) return;
  constexpr std::size_t kSize = core::WallOffsetFilter::kMaxWalls;
  auto report = std::make_unique<WallReport>();
  report->walls.offsets.reserve(kSize);
  // Touched here, so that the localizer meets no page fault.
  report->walls.covariance_m2.resize(kSize * (kSize + 1) / 2);
  report->walls.covariance_m2.clear();
  report->map_hash.reserve(kHashDigits);
  report->changes.reserve(core::MapChanges::kMaxChanges);
  walls_wanted_.store(report.release());
}

void Localization::report_walls(const core::Localizer& localizer) {
  // The server thread has not yet taken the last one.
  if (walls_filled_.load() != nullptr) return;
  WallReport* const report = walls_wanted_.exchange(nullptr);
  if (report == nullptr) return;
  if (localizer.walls() != nullptr) localizer.walls()->copy_to(report->walls);
  const auto changes = localizer.map_changes();
  report->changes.assign(changes.begin(), changes.end());
  if (localizer.map() != nullptr) report->map_hash = localizer.map()->plan().hash;
  walls_filled_.store(report);
}

void Localization::process(const SampleChannel::Item& item) {
  if (item.passed_ns != 0) own_health_.latency.add(monotonic_ns() - item.passed_ns);
  process(*current_->pipeline, item);
  if (item.arrival_ns != 0) swap_pipeline(item);
}

void Localization::swap_pipeline(const SampleChannel::Item& item) {
  // The server thread has not yet freed the previous pipeline.
  if (next_.load() == nullptr || retired_.load() != nullptr) return;
  Generation* const next = next_.exchange(nullptr);
  if (next == nullptr) return;
  next->pipeline->maps().resume_odometry(current_->pipeline->maps());
  retired_.store(current_.release());
  current_.reset(next);
  // The sample that ended the last scan is the first of the next.
  const bool begins = item.kind == SampleChannel::Kind::kSample && item.sample.starts_scan;
  if (begins) next->pipeline->add(item.sample);
}

void Localization::process(core::Pipeline& pipeline, const SampleChannel::Item& item) {
  if (relocalize_.exchange(false, std::memory_order_relaxed)) pipeline.maps().relocalize();
  if (const std::uint32_t now = lidar(); current_->lidar != now) {
    pipeline.maps().forget_lidar();
    current_->lidar = now;
  }
  // A pose set after a change of the map is in the new one.
  const bool is_replaced = next_.load(std::memory_order_relaxed) != nullptr;
  core::Pose2 T_map_base;
  while (!is_replaced && initial_poses_.pop(T_map_base)) {
    pipeline.localizer().set_pose(T_map_base);
    has_initial_pose_ = true;
  }
  take_readings();
  if (item.kind == SampleChannel::Kind::kReading) return process(item.reading);
  const core::ScanResult* result =
      item.kind == SampleChannel::Kind::kGap ? pipeline.finish() : pipeline.add(item.sample);
  if (result != nullptr) {
    report(pipeline, *result, item.arrival_ns);
    report_walls(pipeline.localizer());
  }
  if (item.kind == SampleChannel::Kind::kSample) report(pipeline.partial_pose());
}

void Localization::report(core::Pipeline& pipeline, const core::ScanResult& result,
                          std::int64_t arrival_ns) {
  rounds_.fetch_add(1, std::memory_order_relaxed);
  ++scans_;
  ++poses_;
  const bool handed_over = reports_.put([&](ScanReport& report) {
    report.result = result;
    report.scan = pipeline.scan();
    report.number = scans_;
    report.follows_initial_pose = std::exchange(has_initial_pose_, false);
    report.result.pose.seq = poses_;  // continues across pipelines
    report.to_unix_ns = source_ == SourceKind::kDevice ? unix_ns() - monotonic_ns() : 0;
    report.result.pose.t_ns += report.to_unix_ns;
    report.scan.shift(report.to_unix_ns);
    report.latency_ns = monotonic_ns() - arrival_ns;
    report.generation = current_->number;
    report.map = pipeline.maps().map();
    report.lidar = current_->lidar;
  });
  if (!handed_over) lost_reports_.fetch_add(1, std::memory_order_relaxed);
  ::eventfd_write(reported_.get(), 1);
  own_health_.page_faults = page_faults_of_thread();
  health_.publish(own_health_);
}

void Localization::take_readings() {
  core::OdometryReading reading;
  while (readings_.pop(reading)) process(reading);
}

void Localization::process(const core::OdometryReading& reading) {
  taken_.push(reading);
  report(current_->pipeline->add(reading));
  if (const auto& moved = current_->pipeline->localizer().measured_motion()) report(*moved);
}

void Localization::report(const core::MeasuredMotion& moved) {
  odometry_pose_.add(moved);
  odometry_poses_.put([&](core::OdometryPose& slot) {
    slot = odometry_pose_;
    if (source_ == SourceKind::kDevice) slot.t_ns += unix_ns() - monotonic_ns();
  });
  if (hurries_odometry_.load(std::memory_order_relaxed)) ::eventfd_write(reported_.get(), 1);
}

void Localization::report(const core::PoseEstimate* prediction) {
  if (prediction == nullptr) return;
  // A prediction that finds no room is lost; a newer one follows.
  ++poses_;
  predictions_.put([&](core::PoseEstimate& pose) {
    pose = *prediction;
    pose.seq = poses_;
    if (source_ == SourceKind::kDevice) pose.t_ns += unix_ns() - monotonic_ns();
  });
  ::eventfd_write(reported_.get(), 1);
}

void Localization::clear_event() const {
  eventfd_t count = 0;
  ::eventfd_read(reported_.get(), &count);
}

bool Localization::has_progressed() {
  const std::uint32_t progress_count = rounds_.load(std::memory_order_relaxed);
  const std::uint32_t driver_rounds = driver_.progress_count();
  const bool reader_lives =
      driver_rounds != driver_rounds_seen_ || reader_has_ended_.load(std::memory_order_relaxed);
  channel_.wake();
  if (progress_count == rounds_seen_ || !reader_lives) return false;
  rounds_seen_ = progress_count;
  driver_rounds_seen_ = driver_rounds;
  return true;
}

}  // namespace cornerd::daemon
