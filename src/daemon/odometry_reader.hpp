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

/// The driver of wheels and gyro that the settings name; null where readings come otherwise.
std::unique_ptr<drivers::OdometryDriver> make_odometry(const settings::OdometryConfig& config);

/// Wheels and gyro of the board itself: read in a thread of its own, as a gyro's bus may take its
/// time, and told of by the server's.
class OdometryReader {
 public:
  /// Nothing else may add readings to `localization`, which must outlive this.
  OdometryReader(std::unique_ptr<drivers::OdometryDriver> driver, Localization& localization);

  /// To be called often. Logs, and publishes EVENT, where a sensor was lost or found; true where
  /// any state changed: time for a STATUS.
  bool publish_changes(MessageServer& server, core::TimeNs t_ns);
  /// What STATUS says of it; valid until the next call of this or the above.
  void describe(message::StatusFields& status);

 private:
  struct Sensor {
    std::string_view name;
    drivers::SensorStatus drivers::OdometryStatus::*member;
    std::optional<drivers::SensorState> said;
  };
  /// What comes and goes is worth a line the first time.
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
  std::jthread thread_;  ///< last: it ends first
};

}  // namespace cornerd::daemon
