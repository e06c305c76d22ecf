// SPDX-License-Identifier: MIT
#include "daemon/odometry_reader.hpp"

#include <spdlog/spdlog.h>

#include <string>
#include <utility>

#include "drivers/odometry/kernel_odometry.hpp"

namespace cornerd::daemon {
namespace {

using drivers::SensorState;

bool runs(SensorState state) { return state == SensorState::kRunning; }
/// A sensor has fewer different things to say.
constexpr std::size_t kMaxTexts = 64;

/// A value that is no number, or a read that failed once, is nothing that a device was lost by.
bool passes(SensorState state) {
  return state == SensorState::kInvalid || state == SensorState::kUnreadable;
}

}  // namespace

std::unique_ptr<drivers::OdometryDriver> make_odometry(const settings::OdometryConfig& config) {
  if (config.source != settings::OdometrySource::kKernel) return nullptr;
  drivers::KernelOdometryConfig kernel = config.kernel;
  kernel.geometry = config.core.geometry;
  return std::make_unique<drivers::KernelOdometry>(kernel);
}

OdometryReader::OdometryReader(std::unique_ptr<drivers::OdometryDriver> driver,
                               Localization& localization)
    : driver_(std::move(driver)),
      sink_(localization),
      thread_([this](const std::stop_token& stop) { driver_->run(stop, sink_); }) {}

bool OdometryReader::publish_changes(MessageServer& server, core::TimeNs t_ns) {
  newest_ = driver_->status();
  bool changed = false;
  for (Sensor& sensor : sensors_) {
    const drivers::SensorStatus& status = newest_.*sensor.member;
    if (sensor.said == status.state) continue;
    const bool passed = sensor.said && passes(*sensor.said);
    sensor.said = status.state;
    changed = true;
    if (status.state == SensorState::kNone) continue;
    std::string text(sensor.name);
    text.append(" ").append(to_string(status.state));
    if (!status.detail.view().empty()) text.append(": ").append(status.detail.view());
    log_once(status.state, text);
    if (passes(status.state) || passed) continue;
    const char* what = runs(status.state) ? "device found" : "device lost";
    server.publish(message::MessageClass::kEvent, line_.event(t_ns, what, text));
  }
  return changed;
}

void OdometryReader::log_once(SensorState state, const std::string& text) {
  if (logged_.size() >= kMaxTexts) logged_.clear();
  if (!logged_.insert(text).second) return;
  spdlog::log(runs(state) ? spdlog::level::info : spdlog::level::warn, "odometry {}", text);
}

void OdometryReader::describe(message::StatusFields& status) {
  for (std::size_t i = 0; i < kSensors; ++i) {
    const drivers::SensorStatus& sensor = newest_.*sensors_[i].member;
    described_[i] = {sensors_[i].name, to_string(sensor.state), sensor.detail.view()};
  }
  const drivers::OdometryCounters& counters = newest_.counters;
  counters_ = {message::StatusFields::Counter{"readings", counters.readings},
               {"failed_reads", counters.failed_reads},
               {"invalid_values", counters.invalid_values},
               {"wraps", counters.wraps},
               {"late", counters.late}};
  status.odometry_sensors = described_;
  status.odometry_counters = counters_;
}

}  // namespace cornerd::daemon
