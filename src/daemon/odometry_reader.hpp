// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "daemon/localization.hpp"
#include "daemon/message_server.hpp"
#include "drivers/odometry/odometry_driver.hpp"
#include "message/line_writer.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// The driver for /odometry/source "kernel"; null for other sources.
std::unique_ptr<drivers::OdometryDriver> make_odometry(const settings::OdometryConfig& config);

/// Reads encoders and gyro of the board in a thread of its own, because a gyro's bus may be slow.
/// Its state is published by the server thread.
class OdometryReader {
 public:
  /// The only source of readings for `localization`, which must outlive this.
  OdometryReader(std::unique_ptr<drivers::OdometryDriver> driver, Localization& localization);

  /// Logs and publishes EVENT for sensors lost and found. Returns true if a state changed and
  /// STATUS should be published. Call it periodically.
  bool publish_changes(MessageServer& server, core::TimeNs t_ns);
  /// Sets the sensors' fields of STATUS; valid until the next call of a member.
  void describe(message::StatusFields& status);

 private:
  struct Sensor {
    std::string_view name;
    drivers::SensorStatus drivers::OdometryStatus::*member;
    std::optional<drivers::SensorState> published;
  };
  /// Logs each text once, because an intermittent sensor changes state often.
  void log_once(drivers::SensorState state, const std::string& text);

  static constexpr std::size_t kSensors = 3;
  static constexpr std::size_t kCounters = 5;

  class Sink : public drivers::OdometrySink {
   public:
    explicit Sink(Localization& localization) : localization_(localization) {}
    void on_reading(const core::OdometryReading& reading) override { localization_.add(reading); }

   private:
    Localization& localization_;
  };

  std::unique_ptr<drivers::OdometryDriver> driver_;
  Sink sink_;
  std::array<Sensor, kSensors> sensors_{
      Sensor{"left", &drivers::OdometryStatus::left, {}},
      Sensor{"right", &drivers::OdometryStatus::right, {}},
      Sensor{"gyro", &drivers::OdometryStatus::gyro, {}},
  };
  message::LineWriter line_;
  std::set<std::string> logged_;
  drivers::OdometryStatus newest_;
  std::array<message::StatusFields::Sensor, kSensors> described_;
  std::array<message::StatusFields::Counter, kCounters> counters_;
  std::jthread thread_;  ///< last member: joined first
};

}  // namespace cornerd::daemon
