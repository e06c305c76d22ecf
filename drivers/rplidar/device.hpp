// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "drivers/clock.hpp"
#include "drivers/rplidar/measurement_search.hpp"
#include "drivers/rplidar/protocol/answers.hpp"
#include "drivers/rplidar/protocol/banner_search.hpp"
#include "drivers/rplidar/protocol/descriptor.hpp"
#include "drivers/rplidar/protocol/request.hpp"
#include "drivers/rplidar/scan_mode.hpp"
#include "drivers/serial/byte_stream.hpp"

namespace cornerd::rplidar {

/// A conversation with an A1 that is not scanning: one question, one answer. Every question has a
/// time limit, and ends early when a stop is asked for. Answers are searched for in what comes:
/// a device that was left scanning, or was just switched on, talks before it is asked.
class Device {
 public:
  Device(drivers::ByteStream& port, drivers::Clock& clock, std::stop_token stop)
      : port_(port), clock_(clock), stop_(std::move(stop)) {}

  /// What comes by itself, until there is nothing for 40 ms or it has been enough.
  void listen(MeasurementSearch& search);
  /// STOP, and everything that was under way read away. False where the port is lost.
  bool quiet();
  /// RESET, and the boot banner read away.
  bool reset();
  /// GET_INFO, asked up to so many times.
  std::optional<DeviceInfo> info(int tries = 5);
  std::optional<Health> health();
  /// What it can do, by its firmware: the table of modes from 1.24, the two periods from 1.17,
  /// standard alone before. Modes that no A1 has are left out.
  std::vector<ScanMode> modes(const DeviceInfo& info);
  /// Starts measuring. The answer is the decoder's to read.
  bool start(const ScanMode& mode) { return send(mode.request()); }

  /// The port is gone.
  bool lost() const { return lost_; }
  /// Bytes that came since the device was opened, and those of them that were answers.
  std::uint64_t heard_bytes() const { return heard_bytes_; }
  std::uint64_t used_bytes() const { return used_bytes_; }
  /// It has printed its banner unasked: somebody has just switched it on.
  bool booted() const { return booted_; }

 private:
  using Milliseconds = std::chrono::milliseconds;
  using Answer = std::span<const std::uint8_t>;

  bool send(const Request& request);
  std::optional<Answer> ask(const Request& request, AnswerType type);
  void wait_while_it_boots();
  std::optional<ConfAnswer> ask_conf(ConfType type, std::optional<std::uint16_t> mode = {});
  std::optional<ScanMode> conf_mode(std::uint16_t id);
  void read_until_quiet(Milliseconds quiet, Milliseconds limit, bool wait_for_first);
  drivers::ByteStream::ReadResult read(Milliseconds timeout);

  drivers::ByteStream& port_;
  drivers::Clock& clock_;
  std::stop_token stop_;
  bool lost_ = false;
  bool booted_ = false;
  bool heard_banner_ = false;  ///< and nobody has taken notice yet
  BannerSearch banner_;
  MeasurementSearch* search_ = nullptr;  ///< where what comes is to be searched
  std::uint64_t heard_bytes_ = 0;
  std::uint64_t used_bytes_ = 0;
  std::array<std::uint8_t, 256> buffer_{};
  std::array<std::uint8_t, 256> answer_{};
};

}  // namespace cornerd::rplidar
