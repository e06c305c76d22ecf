// SPDX-License-Identifier: MIT
// An A1 in memory, on a clock that advances only on waits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/driver_clock.hpp"
#include "drivers/rplidar/protocol/answers.hpp"
#include "drivers/rplidar/protocol/framing.hpp"
#include "drivers/serial/serial_port.hpp"
#include "wire_fixture.hpp"

namespace cornerd::rplidar::test {

class ManualClock : public drivers::Clock {
 public:
  core::TimeNs monotonic_ns() override { return now_ns; }
  core::TimeNs unix_offset_ns() override { return offset_ns; }
  void wait(std::chrono::milliseconds duration, const std::stop_token&) override {
    advance(duration);
  }
  void advance(std::chrono::nanoseconds duration) {
    now_ns += duration.count();
    if (on_advance) on_advance();
  }

  core::TimeNs now_ns = core::kNsPerSecond;
  core::TimeNs offset_ns = 0;
  std::function<void()> on_advance;
};

/// Answers requests as a real A1, with faults to switch on.
struct ScriptedA1 {
  explicit ScriptedA1(ManualClock& its_clock) : clock(its_clock) {}

  drivers::OpenResult open(std::uint32_t at_baud);

  ManualClock& clock;
  DeviceInfo info{.model = 0x18, .firmware = firmware_version(1, 29), .hardware = 7};
  std::deque<Health> health{Health{}};  ///< the last one stays
  std::vector<std::string> mode_names{"Standard", "Express", "Boost", "Sensitivity", "Stability"};
  bool counts_modes = true;  ///< else GET_LIDAR_CONF knows the typical mode alone, "Express"
  bool answers = true;
  bool noise = false;  ///< is sent in place of answers
  bool measures = true;
  bool blind = false;      ///< no sample has a return
  std::uint32_t baud = 0;  ///< at any other it is silent; 0: any is right
  int wrong_periods = 0;   ///< this many answers about the express period have a wrong bit
  int lost_answers = 0;    ///< this many answers are lost
  int resets_to_measure = 0;
  Bytes chatter;  ///< unsolicited bytes at opening
  drivers::OpenError open_error = drivers::OpenError::kNone;
  std::optional<core::TimeNs> unplugged_at_ns;

  std::vector<Request> requests;
  bool motor_runs = false;
  bool scanning = false;
  int resets = 0;
  int opened = 0;
  std::uint64_t read_bytes = 0;

  void receive(const Request& request);
  bool unplugged() const { return unplugged_at_ns && clock.now_ns >= *unplugged_at_ns; }

  std::deque<std::uint8_t> output;
  core::TimeNs output_from_ns = 0;  ///< no byte is available earlier
  int capsule = 0;
  bool understood = true;  ///< opened at the right speed

 private:
  void answer(std::uint8_t type, const Bytes& payload);
  void answer_conf(const Request& request);
};

/// Names of requests: "STOP", "INFO", "HEALTH", "CONF", "RATE", "RESET", "SCAN", "EXPRESS 1".
std::vector<std::string> names(const std::vector<Request>& requests);

}  // namespace cornerd::rplidar::test
