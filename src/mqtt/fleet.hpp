// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mqtt/broker_link.hpp"
#include "mqtt/robot_report.hpp"

namespace cornerd::mqtt {

/// The robots of a site, as their reports say.
class Fleet {
 public:
  /// Bounds the memory that a hostile broker takes.
  static constexpr std::size_t kMaxRobots = 10'000;
  using UnixTime = std::chrono::system_clock::time_point;

  explicit Fleet(std::string site) : site_(std::move(site)) {}

  /// The filter to subscribe to.
  std::string filter() const { return "cornerd/" + site_ + "/robot/+/+"; }
  /// Ignores what is no report, and one that is not its topic's robot. `now_s`: steady time.
  void take(const Message& message, double now_s, UnixTime now);

  struct Robot {
    RobotReport report;
    double age_s = 0;  ///< of the report: since it came, or by its own time where it was retained
  };
  /// In the order of manufacturer and serial.
  std::vector<Robot> robots(double now_s) const;

 private:
  struct Entry {
    RobotReport report;
    double written_s = 0;  ///< steady time
  };
  std::string site_;
  std::map<std::string, Entry> robots_;  ///< by topic
};

}  // namespace cornerd::mqtt
