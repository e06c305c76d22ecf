// SPDX-License-Identifier: MIT
#include "replay/replay_driver.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "drivers/lidar_status.hpp"

namespace cornerd::replay {
namespace {

using Clock = std::chrono::steady_clock;

/// Longest delay of a stop.
constexpr std::chrono::milliseconds kMaxSleep{50};
/// Samples are passed on in batches of this length, as those of a capsule come: one sleep for each.
constexpr std::chrono::milliseconds kTogether{4};
/// Poll interval of a full consumer.
constexpr std::chrono::microseconds kRoomSleep{500};
/// A longer step of recorded time is a clock step or a pause, which is skipped.
constexpr core::TimeNs kMaxPauseNs = 10 * core::kNsPerSecond;

}  // namespace

/// Passes samples on at their time.
class ReplayDriver::Pacer : public RecordingSink {
 public:
  Pacer(ReplayDriver& driver, drivers::SampleSink& sink, double speed, const std::stop_token& stop)
      : driver_(driver), sink_(sink), speed_(speed), stop_(stop) {}

  void begin_pass() {
    if (samples_ > 0) sink_.on_gap();
    first_of_pass_ = true;
    samples_of_pass_ = 0;
  }

  void on_sample(const core::Sample& recorded) override {
    if (stop_.stop_requested()) return;
    core::Sample sample = recorded;
    begin_pass_at(recorded.t_ns);
    sample.t_ns += shift_ns_;
    if (samples_of_pass_ > 0) period_ns_ = std::max<core::TimeNs>(1, sample.t_ns - last_ns_);
    if (speed_ > 0) wait_until(sample.t_ns);
    while (speed_ <= 0 && !sink_.ready() && !stop_.stop_requested()) {
      std::this_thread::sleep_for(kRoomSleep);
      driver_.count_progress();
    }
    if (stop_.stop_requested()) return;
    measure_rates(sample);
    last_ns_ = sample.t_ns;
    ++samples_;
    ++samples_of_pass_;
    sink_.on_sample(sample);
  }

  void on_gap() override { sink_.on_gap(); }
  void on_odometry(const message::OdometryReading& recorded) override {
    begin_pass_at(recorded.t_ns);
    message::OdometryReading reading = recorded;
    reading.t_ns += shift_ns_;
    sink_.on_reading(reading);
  }

  std::uint64_t samples_of_pass() const { return samples_of_pass_; }
  std::uint64_t samples() const { return samples_; }
  double rate_hz() const { return rate_hz_; }
  double samples_hz() const { return samples_hz_; }

 private:
  /// A pass goes on where the last one ended: samples and odometry keep their order.
  void begin_pass_at(core::TimeNs recorded_ns) {
    if (first_of_pass_ && samples_ > 0) shift_ns_ = last_ns_ + period_ns_ - recorded_ns;
    first_of_pass_ = false;
  }
  void wait_until(core::TimeNs t_ns) {
    const core::TimeNs step_ns = t_ns - last_ns_;
    if (samples_ == 0 || step_ns < 0 || step_ns > kMaxPauseNs) {
      anchor_ = Clock::now();
      anchor_ns_ = t_ns;
    }
    const auto due = anchor_ + std::chrono::nanoseconds(static_cast<std::int64_t>(
                                   static_cast<double>(t_ns - anchor_ns_) / speed_));
    for (auto now = Clock::now(); now < due && !stop_.stop_requested(); now = Clock::now()) {
      std::this_thread::sleep_for(std::min<Clock::duration>(due + kTogether - now, kMaxSleep));
      driver_.count_progress();
    }
  }

  void measure_rates(const core::Sample& sample) {
    if (!sample.starts_scan) return;
    const double scan_s = core::to_seconds(sample.t_ns - scan_start_ns_);
    if (scan_begun_ && scan_s > 0) {
      rate_hz_ = 1 / scan_s;
      samples_hz_ = static_cast<double>(samples_ - scan_start_samples_) / scan_s;
    }
    scan_begun_ = true;
    scan_start_ns_ = sample.t_ns;
    scan_start_samples_ = samples_;
  }

  ReplayDriver& driver_;
  drivers::SampleSink& sink_;
  double speed_;
  std::stop_token stop_;
  Clock::time_point anchor_;
  core::TimeNs anchor_ns_ = 0;
  core::TimeNs last_ns_ = 0;
  core::TimeNs period_ns_ = 1;
  core::TimeNs shift_ns_ = 0;
  std::uint64_t samples_ = 0;
  std::uint64_t samples_of_pass_ = 0;
  bool first_of_pass_ = true;
  bool scan_begun_ = false;
  core::TimeNs scan_start_ns_ = 0;
  std::uint64_t scan_start_samples_ = 0;
  double rate_hz_ = 0;
  double samples_hz_ = 0;
};

ReplayDriver::ReplayDriver(ReplayDriverConfig config) : config_(std::move(config)) {
  status_.state = drivers::LidarState::kOpening;
  status_.detail.set(config_.file.string());
  status_.model.set("recording");
  publish(status_);
}

void ReplayDriver::publish(const drivers::LidarStatus& now) {
  published_.publish(now);
  count_progress();
  if (now.state == last_change_.state && now.detail.view() == last_change_.detail.view()) return;
  last_change_ = {now.state, now.fault, now.detail};
  changes_.push(last_change_);
}

void ReplayDriver::publish(const RecordingPlayer& player, const Pacer& pacer) {
  drivers::LidarStatus now = status_;
  now.counters += player.counters();
  now.rate_hz = pacer.rate_hz();
  now.samples_hz = pacer.samples_hz();
  if (!player.first_problem().empty()) now.detail.set(player.first_problem());
  publish(now);
}

void ReplayDriver::play(const std::stop_token& stop, Pacer& pacer) {
  // Opening a pipe without a writer blocks, also against a stop request.
  if (std::filesystem::is_other(config_.file)) {
    throw std::runtime_error(config_.file.string() + ": is no regular file; name a recording");
  }
  status_.state = drivers::LidarState::kRunning;
  bool again = true;
  while (again && !stop.stop_requested()) {
    RecordingPlayer player(config_.file, config_.recording);
    pacer.begin_pass();
    while (!stop.stop_requested() && player.step(pacer)) publish(player, pacer);
    again = config_.loop && pacer.samples_of_pass() > 0;
    if (!again) status_.state = drivers::LidarState::kEnded;
    publish(player, pacer);
    status_.counters += player.counters();
  }
}

void ReplayDriver::run(std::stop_token stop, drivers::SampleSink& sink) {
  Pacer pacer(*this, sink, config_.speed, stop);
  try {
    play(stop, pacer);
    if (pacer.samples() == 0 && !stop.stop_requested()) {
      throw std::runtime_error(config_.file.string() +
                               ": no sample in it; name a lidar's bytes (.bin) or messages "
                               "(.ndjson) with SERIAL or SCAN");
    }
  } catch (const std::exception& error) {
    status_.state = drivers::LidarState::kFaulty;
    status_.detail.set(error.what());
    publish(status_);
  }
}

}  // namespace cornerd::replay
