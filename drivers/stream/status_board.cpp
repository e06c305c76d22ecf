// SPDX-License-Identifier: MIT
#include "drivers/stream/status_board.hpp"

namespace cornerd::drivers {
namespace {

constexpr core::TimeNs kUpdateNs = core::kNsPerSecond / 2;

double rate_hz(std::uint64_t intervals, core::TimeNs duration_ns) {
  return duration_ns > 0 ? static_cast<double>(intervals) / core::to_seconds(duration_ns) : 0;
}

}  // namespace

void StatusBoard::set_state(LidarState state, LidarFault fault, std::string_view detail) {
  status_.state = state;
  status_.fault = fault;
  status_.detail.set(detail);
  publish();
  changes_.push({state, fault, status_.detail});
}

void StatusBoard::count_answers(std::uint64_t bytes, std::uint64_t used_bytes) {
  for (StreamCounters* const counters : {&status_.counters, &before_}) {
    counters->bytes += bytes;
    counters->used_bytes += used_bytes;
    counters->skipped_bytes += bytes - used_bytes;
  }
  publish();
}

void StatusBoard::set_device(std::string_view model, std::string_view firmware,
                             std::string_view serial, const LidarModel* known) {
  status_.model.set(model);
  status_.known_model = known;
  status_.firmware.set(firmware);
  status_.serial.set(serial);
  publish();
}

void StatusBoard::set_health(std::string_view health) {
  status_.health.set(health);
  publish();
}

void StatusBoard::set_mode(std::string_view mode) {
  status_.mode.set(mode);
  publish();
}

void StatusBoard::begin_stream() {
  before_ = status_.counters;
  status_.rate_hz = 0;
  status_.samples_hz = 0;
  samples_ = 0;
  scans_ = 0;
}

void StatusBoard::end_stream(StreamCounters of_stream) {
  of_stream.skipped_bytes = of_stream.bytes - of_stream.used_bytes;
  status_.counters = before_;
  status_.counters += of_stream;
  status_.rate_hz = 0;
  status_.samples_hz = 0;
  publish();
}

void StatusBoard::count(const core::Sample& sample) {
  if (samples_++ == 0) first_ns_ = sample.t_ns;
  last_ns_ = sample.t_ns;
  if (!sample.starts_scan) return;
  if (scans_++ == 0) first_scan_ns_ = sample.t_ns;
  last_scan_ns_ = sample.t_ns;
}

void StatusBoard::update(const StreamCounters& of_stream, const core::LatencyHistogram& latency,
                         core::TimeNs now_ns) {
  if (now_ns - updated_ns_ < kUpdateNs) return;
  updated_ns_ = now_ns;
  status_.counters = before_;
  status_.counters += of_stream;
  status_.latency = latency;
  measure_rates();
  publish();
}

// Counted from start to start, so that a head of 1 Hz gets a rate too.
void StatusBoard::measure_rates() {
  if (samples_ == 0) {
    status_.samples_hz = 0;
    status_.rate_hz = 0;
    return;
  }
  status_.samples_hz = rate_hz(samples_ - 1, last_ns_ - first_ns_);
  samples_ = 0;
  if (scans_ < 2) return;
  status_.rate_hz = rate_hz(scans_ - 1, last_scan_ns_ - first_scan_ns_);
  scans_ = 1;
  first_scan_ns_ = last_scan_ns_;
}

namespace {

constexpr int kMaxEmptyScans = 20;
/// The slowest heads need a second.
constexpr core::TimeNs kLongestScan_ns = 3 * core::kNsPerSecond;
constexpr std::size_t kMinReturnsPercent = 1;

/// An A1's express capsule takes 8 ms.
constexpr std::chrono::milliseconds kLongCollection{10};
/// The latency that a pose may cost.
constexpr std::chrono::milliseconds kShortCollection{3};
/// A head's speed is steadier than this from one revolution to the next.
constexpr double kSteadyShare = 0.95;

}  // namespace

void SampleMonitor::on_sample(const core::Sample& sample) {
  if (sample.starts_scan) {
    end_scan();
    time_scan(sample.t_ns);
  }
  last_ns_ = sample.t_ns;
  if (sample.starts_scan || !turned_ns_) turned_ns_ = sample.t_ns;
  ++scan_samples_;
  if (sample.range_m > 0) ++scan_returns_;
  board_.count(sample);
  next_.on_sample(sample);
}

void SampleMonitor::on_gap() {
  scan_start_ns_ = 0;
  scan_duration_ns_ = 0;
  next_.on_gap();
}

void SampleMonitor::time_scan(core::TimeNs start_ns) {
  if (scan_start_ns_ != 0) scan_duration_ns_ = start_ns - scan_start_ns_;
  scan_start_ns_ = start_ns;
  scan_arrival_ns_ = arrival_ns_ != 0 ? arrival_ns_ : start_ns;
}

std::chrono::milliseconds SampleMonitor::collecting_time(core::TimeNs now_ns) const {
  const auto due_ns = scan_arrival_ns_ + static_cast<core::TimeNs>(
                                             kSteadyShare * static_cast<double>(scan_duration_ns_));
  const auto left =
      std::chrono::floor<std::chrono::milliseconds>(std::chrono::nanoseconds(due_ns - now_ns));
  return std::clamp(left, kShortCollection, kLongCollection);
}

LidarFault SampleMonitor::fault() const {
  if (turned_ns_ && last_ns_ - *turned_ns_ > kLongestScan_ns) return LidarFault::kNoScan;
  return empty_scans_ >= kMaxEmptyScans ? LidarFault::kDeadLaser : LidarFault::kNone;
}

void SampleMonitor::end_scan() {
  const bool sees = scan_returns_ * 100 >= scan_samples_ * kMinReturnsPercent;
  empty_scans_ = sees ? 0 : empty_scans_ + 1;
  scan_samples_ = 0;
  scan_returns_ = 0;
}

}  // namespace cornerd::drivers
