// SPDX-License-Identifier: MIT
#include "daemon/odometry_reader.hpp"

#include <pthread.h>

#include <string>
#include <utility>

#include "daemon/log.hpp"
#include "drivers/odometry/kernel_odometry.hpp"

namespace cornerd::daemon {
namespace {

using drivers::SensorState;

bool is_running(SensorState state) { return state == SensorState::kRunning; }
/// More than the different texts of the sensors.
constexpr std::size_t kMaxSensorTexts = 64;

/// A single bad value or failed read does not mean that the device was lost.
bool is_transient(SensorState state) {
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
    : driver_(std::move(driver)), sink_(localization), thread_([this](const std::stop_token& stop) {
        ::pthread_setname_np(::pthread_self(), "odometry");
        driver_->run(stop, sink_);
      }) {}

bool OdometryReader::publish_changes(MessageServer& server, core::TimeNs t_ns) {
  newest_ = driver_->status();
  bool changed = false;
  for (Sensor& sensor : sensors_) {
    const drivers::SensorStatus& status = newest_.*sensor.member;
    if (sensor.published == status.state) continue;
    const bool was_transient = sensor.published && is_transient(*sensor.published);
    sensor.published = status.state;
    changed = true;
    if (status.state == SensorState::kNone) continue;
    std::string text(sensor.name);
    text.append(" ").append(to_string(status.state));
    if (!status.detail.view().empty()) text.append(": ").append(status.detail.view());
    log_once(status.state, text);
    if (is_transient(status.state) || was_transient) continue;
    const char* what = is_running(status.state) ? "device found" : "device lost";
    server.publish(message::MessageClass::kEvent, line_.event(t_ns, what, text));
  }
  return changed;
}

void OdometryReader::log_once(SensorState state, const std::string& text) {
  if (logged_.size() >= kMaxSensorTexts) logged_.clear();
  if (!logged_.insert(text).second) return;
  log(is_running(state) ? LogLevel::kInfo : LogLevel::kWarning, "odometry " + text);
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
