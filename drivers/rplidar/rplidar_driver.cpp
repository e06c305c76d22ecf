// SPDX-License-Identifier: MIT
#include "drivers/rplidar/rplidar_driver.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include "drivers/config/lidar_models.hpp"
#include "drivers/rplidar/device.hpp"
#include "drivers/rplidar/protocol/framing.hpp"
#include "drivers/rplidar/sample_stream.hpp"
#include "drivers/rplidar/shutdown.hpp"
#include "drivers/serial/byte_stream.hpp"
#include "drivers/stream/hint.hpp"
#include "drivers/stream/status_board.hpp"

namespace cornerd::rplidar {
namespace {

using drivers::LidarFault;
using drivers::LidarState;
using std::chrono::milliseconds;

// Retry of a port that is absent or busy: cheap, and finds a lidar at once when it is plugged in.
constexpr milliseconds kPortInterval{200};
// Retry of a device that answers but does not work: each try disturbs it.
constexpr milliseconds kFirstBackoff{100};
constexpr milliseconds kMaxBackoff{2000};
constexpr milliseconds kReadSlice{100};  // longest delay of a stop, and between progress counts
// A head that spins up sends nothing before its speed is stable.
constexpr core::TimeNs kSpinUpLimitNs = 6 * core::kNsPerSecond;
// A blocked head resumes by itself when it is released, so a stall is reported before a restart.
constexpr core::TimeNs kStallNs = core::kNsPerSecond;
constexpr core::TimeNs kSilenceLimitNs = 3 * core::kNsPerSecond;
// A line that is switched on may give a byte or two; more bytes are a sender.
constexpr std::uint64_t kStrayBytes = 8;
// A head that stops leaves a part of a packet, an answered request some bytes; a line full of noise
// brings a multiple of it in a second.
constexpr std::size_t kNoiseBytes = 2048;
// A request may be lost; where other speeds wait, less time is spent on it.
constexpr int kInfoTries = 5;
constexpr int kInfoTriesOfRates = 2;

}  // namespace

RplidarDriver::RplidarDriver(RplidarDriverConfig config, PortOpener open_port,
                             drivers::Clock& clock)
    : config_(std::move(config)),
      rates_(config_.baud_rates),
      open_port_(std::move(open_port)),
      clock_(clock),
      motor_(make_motor(config_.motor)) {
  if (open_port_) return;
  open_port_ = [this](std::uint32_t baud) {
    return drivers::open_serial_port(config_.device, baud);
  };
}

void RplidarDriver::run(std::stop_token stop, drivers::SampleSink& sink) {
  milliseconds backoff = kFirstBackoff;
  while (!stop.stop_requested()) {
    drivers::OpenResult opened = open_port_(rates_.current());
    count_progress();
    if (!opened.stream) {
      const auto [state, fault] = drivers::failure_of(opened.error);
      report(state, fault, opened.message);
      wait(kPortInterval, stop);
      continue;
    }
    has_run_ = false;
    Failure failure = session(*opened.stream, stop, sink);
    opened.stream.reset();
    if (has_run_) {
      backoff = kFirstBackoff;
      sink.on_gap();
    }
    if (stop.stop_requested()) break;
    if (failure.fault == LidarFault::kWrongBaud || failure.fault == LidarFault::kNoAnswer) {
      const auto fault = rates_.fail(failure.fault);
      if (!fault) continue;
      failure.fault = *fault;
      if (const auto other = answering_baud(stop)) {
        failure.fault = LidarFault::kWrongBaud;
        failure.extra =
            "no answer at the configured speed, but one at " + std::to_string(*other) + " baud";
      }
    }
    report(failure.state, failure.fault, failure.extra);
    wait(backoff, stop);
    backoff = std::min(2 * backoff, kMaxBackoff);
  }
  board_.set_state(LidarState::kAbsent, LidarFault::kNone, config_.device + ": closed");
}

RplidarDriver::Failure RplidarDriver::session(drivers::ByteStream& opened,
                                              const std::stop_token& stop,
                                              drivers::SampleSink& sink) {
  drivers::MonitoredByteStream port(opened, [this] { count_progress(); });
  const Shutdown shutdown(port, *motor_, motor_request_, clock_);
  Device device(port, clock_, stop);
  ScanMode mode;
  const Failure failure = identify(device, port, mode);
  board_.count_answers(device.received_bytes(), device.used_bytes());
  if (device.lost()) return {};
  if (failure.fault != LidarFault::kNone) return failure;
  return measure(port, mode, stop, sink);
}

RplidarDriver::Failure RplidarDriver::identify(Device& device, drivers::ByteStream& port,
                                               ScanMode& mode) {
  board_.set_state(LidarState::kIdentifying, LidarFault::kNone,
                   config_.device + ": asking for its model and health");
  MeasurementSearch search;
  device.listen(search);
  device.stop_scan();
  if (device.booted()) {
    report(LidarState::kIdentifying, LidarFault::kBooting);
  } else if (search.found()) {
    report(LidarState::kIdentifying, LidarFault::kStreamRunning);
  } else if (device.received_bytes() > kStrayBytes && rates_.is_single()) {
    report(LidarState::kIdentifying, LidarFault::kUnexpectedData);
  }
  if (std::exchange(reset_first_, false)) {
    const auto health = device.health();
    if (health && health->failed()) {
      report(LidarState::kFaulty, LidarFault::kProtectionStop, health->text());
    }
    device.reset();
  }

  const std::uint64_t received_before = device.received_bytes();
  const auto info = query_info(device);
  if (!info) {
    if (device.received_bytes() > received_before) {
      return {LidarState::kBackoff, LidarFault::kWrongBaud,
              "no answer at the configured speed, but noise"};
    }
    return {LidarState::kBackoff, LidarFault::kNoAnswer, described()};
  }
  // The answer has no checksum; a damaged serial number would name another lidar.
  const bool agrees = device.info() == info;
  const drivers::LidarModel* const known = drivers::find_rplidar(info->model);
  board_.set_device(info->model_name(), info->firmware_text(),
                    agrees ? info->serial_text() : std::string(), known);

  auto health = device.health();
  if (health && health->failed()) {
    report(LidarState::kFaulty, LidarFault::kProtectionStop, health->text());
    device.reset();
    health = device.health();
  }
  if (!health) return {LidarState::kBackoff, LidarFault::kNoAnswer, described()};
  board_.set_health(health->text());
  if (health->failed()) return {LidarState::kFaulty, LidarFault::kHealthError, health->text()};

  const auto modes = device.modes(*info);
  const ScanMode* const chosen = choose_mode(modes, config_.mode);
  if (chosen == nullptr) {
    return {LidarState::kFaulty, LidarFault::kNoSuchMode,
            "\"" + config_.mode + "\"; set advanced.lidar.mode to one of " + list_names(modes)};
  }
  mode = *chosen;
  // A pseudo-terminal answers at any speed; its bytes still come at the device's.
  wire_baud_ = std::max(rates_.current(), known != nullptr ? known->baud : 0);
  // Some firmwares of the S3 report none.
  if (mode.period_s <= 0 && known != nullptr) mode.period_s = 1 / known->samples_hz;
  board_.set_mode(mode.name);
  board_.set_state(LidarState::kStarting, LidarFault::kNone,
                   config_.device + ": waiting for the motor");
  if (!start_motor(device, *info, port)) {
    return {LidarState::kFaulty, LidarFault::kMotorControl, motor_->error()};
  }
  device.start(mode);
  return {.fault = LidarFault::kNone};
}

std::optional<DeviceInfo> RplidarDriver::query_info(Device& device) {
  const bool had_booted = device.booted();
  auto info = device.info(rates_.is_single() ? kInfoTries : kInfoTriesOfRates);
  if (!device.booted()) return info;
  if (!had_booted) report(LidarState::kIdentifying, LidarFault::kBooting);
  return info ? info : device.info();
}

bool RplidarDriver::start_motor(Device& device, const DeviceInfo& info, drivers::ByteStream& port) {
  if (!motor_->start(port)) return false;
  if (config_.motor.kind == MotorKind::kNone) return true;
  motor_request_ = device.motor_request(info);
  return !motor_request_ || device.send(motor_request_->start());
}

RplidarDriver::Failure RplidarDriver::measure(drivers::ByteStream& port, const ScanMode& mode,
                                              const std::stop_token& stop,
                                              drivers::SampleSink& sink) {
  SampleStream stream({.format = mode.format,
                       .inverted = config_.inverted,
                       .sample_period_s = mode.period_s,
                       .baud = wire_baud_});
  drivers::SampleMonitor monitor(sink, board_);
  BannerSearch banner;
  board_.begin_stream();
  Failure failure;
  std::array<std::uint8_t, 2048> buffer;  // more than the fastest lidar sends meanwhile
  core::TimeNs last_sample_ns = clock_.monotonic_ns();
  std::size_t bytes_since_sample = 0;
  while (!stop.stop_requested()) {
    port.collect_for(monitor.collecting_time(clock_.monotonic_ns()));
    const auto [status, count] = port.read(buffer, kReadSlice);
    const core::TimeNs now_ns = clock_.monotonic_ns();
    if (status == drivers::ByteStream::ReadStatus::kLost) break;
    const auto bytes = std::span(buffer).first(count);
    const std::uint64_t samples = stream.samples();
    stream.feed(bytes, now_ns, monitor, /*more_pending=*/count == buffer.size());
    board_.update(stream.counters(), stream.latency(), now_ns);
    const bool measured = stream.samples() > samples;
    has_run_ = has_run_ || measured;
    if (banner.add(bytes)) {
      failure.fault = LidarFault::kRestarted;
      break;
    }
    const core::TimeNs silent_ns = now_ns - last_sample_ns;
    bytes_since_sample = measured ? 0 : bytes_since_sample + count;
    if (measured) {
      last_sample_ns = now_ns;
      const LidarFault fault = monitor.fault();
      const bool is_faulty = fault != LidarFault::kNone;
      const LidarState state = is_faulty ? LidarState::kFaulty : LidarState::kRunning;
      if (board_.state() != state || board_.fault() != fault) {
        is_faulty ? report(state, fault) : board_.set_state(state, fault, "");
      }
    } else if (silent_ns > (has_run_ ? kSilenceLimitNs : kSpinUpLimitNs)) {
      reset_first_ = true;
      failure.fault = has_run_ ? LidarFault::kMotorStalled : LidarFault::kNoData;
      break;
    } else if (has_run_ && silent_ns > kStallNs && bytes_since_sample > kNoiseBytes) {
      failure.fault = LidarFault::kUnexpectedData;
      break;
    } else if (has_run_ && silent_ns > kStallNs && board_.fault() != LidarFault::kMotorStalled) {
      report(LidarState::kFaulty, LidarFault::kMotorStalled);
      const auto health = query_health_after_silence(port, mode, stop);
      if (!health || !health->failed()) continue;
      failure = {LidarState::kFaulty, LidarFault::kProtectionStop, health->text()};
      break;
    }
  }
  board_.end_stream(stream.counters());
  return failure;
}

std::optional<Health> RplidarDriver::query_health_after_silence(drivers::ByteStream& port,
                                                                const ScanMode& mode,
                                                                const std::stop_token& stop) {
  Device device(port, clock_, stop);
  device.stop_scan();
  const auto health = device.health();
  // The request ended the scan.
  device.start(mode);
  board_.count_answers(device.received_bytes(), device.used_bytes());
  return health;
}

std::optional<std::uint32_t> RplidarDriver::answering_baud(const std::stop_token& stop) {
  if (!rates_.is_single()) return std::nullopt;
  for (const std::uint32_t other : drivers::baud_rates_of(drivers::DriverKind::kRplidar)) {
    if (other == rates_.current() || stop.stop_requested()) continue;
    const drivers::OpenResult opened = open_port_(other);
    if (!opened.stream) return std::nullopt;
    drivers::MonitoredByteStream port(*opened.stream, [this] { count_progress(); });
    Device device(port, clock_, stop);
    const bool answers = device.stop_scan() && device.info(1).has_value();
    board_.count_answers(device.received_bytes(), device.used_bytes());
    if (answers) return other;
  }
  return std::nullopt;
}

void RplidarDriver::wait(milliseconds duration, const std::stop_token& stop) {
  for (; duration.count() > 0 && !stop.stop_requested(); duration -= kReadSlice) {
    clock_.wait(std::min(duration, kReadSlice), stop);
    count_progress();
  }
}

void RplidarDriver::report(LidarState state, LidarFault fault, std::string_view extra) {
  const std::string text = drivers::hint(fault, config_.device, extra);
  if (board_.state() == state && board_.fault() == fault && board_.detail() == text) return;
  board_.set_state(state, fault, text);
}

}  // namespace cornerd::rplidar
