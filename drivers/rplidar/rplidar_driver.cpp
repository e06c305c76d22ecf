// SPDX-License-Identifier: MIT
#include "drivers/rplidar/rplidar_driver.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "drivers/rplidar/device.hpp"
#include "drivers/rplidar/live_sink.hpp"
#include "drivers/rplidar/sample_stream.hpp"

namespace cornerd::rplidar {
namespace {

using drivers::LidarState;
using std::chrono::milliseconds;

constexpr milliseconds kFirstBackoff{100};
constexpr milliseconds kLongestBackoff{2000};
constexpr milliseconds kReadSlice{100};  // how long a stop may stay unnoticed
// A head that spins up sends nothing before it turns evenly.
constexpr core::TimeNs kSpinUpLimitNs = 6 * core::kNsPerSecond;
constexpr core::TimeNs kSilenceLimitNs = 2 * core::kNsPerSecond;

LidarState state_after(drivers::OpenError error) {
  return error == drivers::OpenError::kAbsent ? LidarState::kAbsent : LidarState::kOpening;
}

/// However a session ends, the device is left quiet and its motor off.
class Shutdown {
 public:
  Shutdown(drivers::ByteStream& port, Motor& motor) : port_(port), motor_(motor) {}
  ~Shutdown() {
    port_.write(Request(Command::kStop).bytes());
    motor_.stop(port_);
  }
  Shutdown(const Shutdown&) = delete;
  Shutdown& operator=(const Shutdown&) = delete;

 private:
  drivers::ByteStream& port_;
  Motor& motor_;
};

}  // namespace

RplidarDriver::RplidarDriver(RplidarDriverConfig config, PortOpener open_port,
                             drivers::Clock& clock)
    : config_(std::move(config)),
      open_port_(std::move(open_port)),
      clock_(clock),
      motor_(make_motor(config_.motor)) {
  if (open_port_) return;
  open_port_ = [this] { return drivers::open_serial_port(config_.device, config_.baud); };
}

void RplidarDriver::run(std::stop_token stop, drivers::SampleSink& sink) {
  milliseconds backoff = kFirstBackoff;
  while (!stop.stop_requested()) {
    drivers::OpenResult opened = open_port_();
    if (opened.stream) {
      has_run_ = false;
      const Fault fault = session(*opened.stream, stop, sink);
      opened.stream.reset();
      if (has_run_) {
        backoff = kFirstBackoff;
        sink.on_gap();
      }
      if (stop.stop_requested()) break;
      board_.set_state(fault.state, fault.detail);
    } else {
      board_.set_state(state_after(opened.error), opened.message + "; waiting for it");
    }
    clock_.wait(backoff, stop);
    backoff = std::min(2 * backoff, kLongestBackoff);
  }
  board_.set_state(LidarState::kAbsent, config_.device + ": closed");
}

RplidarDriver::Fault RplidarDriver::session(drivers::ByteStream& port, const std::stop_token& stop,
                                            drivers::SampleSink& sink) {
  const Shutdown shutdown(port, *motor_);
  Device device(port, clock_, stop);
  board_.set_state(LidarState::kIdentifying, config_.device + ": asking who it is");
  if (!device.quiet()) return lost();
  if (std::exchange(reset_first_, false)) device.reset();

  const auto info = device.info();
  if (device.lost()) return lost();
  if (!info) {
    return {LidarState::kBackoff, config_.device + ": no answer; is it an RPLidar with " +
                                      std::to_string(config_.baud) +
                                      " baud, and has it 5 V enough?"};
  }
  board_.set_device(info->model_name(), info->firmware_text());

  auto health = device.health();
  if (health && health->failed()) {
    board_.set_state(LidarState::kFaulty, config_.device + ": " + health->text() + "; resetting");
    device.reset();
    health = device.health();
  }
  if (device.lost()) return lost();
  if (!health) return {LidarState::kBackoff, config_.device + ": does not tell its health"};
  board_.set_health(health->text());
  if (health->failed()) {
    return {LidarState::kFaulty, config_.device + ": reports a hardware fault, " + health->text() +
                                     "; check that its head turns freely and its supply holds 5 V"};
  }

  const auto modes = device.modes(*info);
  if (device.lost()) return lost();
  const ScanMode* const mode = choose_mode(modes, config_.mode);
  if (mode == nullptr) {
    return {LidarState::kFaulty,
            config_.device + ": has no mode \"" + config_.mode + "\", but " + list_names(modes)};
  }
  board_.set_mode(mode->name);

  board_.set_state(LidarState::kStarting, config_.device + ": waiting for its head to turn");
  if (!motor_->start(port)) return {LidarState::kFaulty, "motor: " + motor_->error()};
  if (!device.start(*mode)) return lost();
  return measure(port, *mode, stop, sink);
}

RplidarDriver::Fault RplidarDriver::measure(drivers::ByteStream& port, const ScanMode& mode,
                                            const std::stop_token& stop,
                                            drivers::SampleSink& sink) {
  SampleStream stream({.format = mode.format,
                       .inverted = config_.inverted,
                       .sample_period_s = mode.period_s,
                       .baud = config_.baud});
  LiveSink live(sink, board_, clock_);
  board_.begin_stream();
  std::array<std::uint8_t, 512> buffer;
  core::TimeNs heard_ns = clock_.monotonic_ns();
  while (!stop.stop_requested()) {
    const auto [status, count] = port.read(buffer, kReadSlice);
    const core::TimeNs now_ns = clock_.monotonic_ns();
    if (status == drivers::ByteStream::ReadStatus::kLost) return lost();
    stream.feed(std::span(buffer).first(count), now_ns, live);
    board_.update(stream.counters(), now_ns);

    if (live.take_count() > 0) {
      heard_ns = now_ns;
      has_run_ = true;
      const LidarState state = live.blind() ? LidarState::kFaulty : LidarState::kRunning;
      if (board_.state() != state) {
        board_.set_state(state, live.blind() ? "its head turns, but nothing returns: is the laser "
                                               "covered, or dead?"
                                             : "");
      }
    } else if (now_ns - heard_ns > (has_run_ ? kSilenceLimitNs : kSpinUpLimitNs)) {
      reset_first_ = true;
      return {LidarState::kBackoff,
              config_.device + ": sends no measurements; does its motor turn? Starting it anew"};
    }
  }
  return {};
}

RplidarDriver::Fault RplidarDriver::lost() const {
  return {LidarState::kBackoff, config_.device + ": the port is gone; waiting for it"};
}

}  // namespace cornerd::rplidar
