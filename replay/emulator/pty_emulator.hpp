// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>

#include "replay/emulator/device_emulator.hpp"
#include "replay/emulator/pseudo_terminal.hpp"

namespace cornerd::replay {

/// An emulated lidar on a pseudo-terminal in real time: bytes leave at the speed of the serial
/// line, read or not. Clients may come and go. Its motor always runs, as a pseudo-terminal has no
/// DTR.
class PtyEmulator {
 public:
  /// Called about every 10 ms with the emulator's time and UNIX time, to write the truth.
  using OnTime = std::function<void(core::TimeNs t_ns, core::TimeNs unix_ns)>;

  /// `baud`: as PseudoTerminal. Throws std::system_error if the pseudo-terminal or its link cannot
  /// be made.
  explicit PtyEmulator(std::unique_ptr<DeviceEmulator> emulator,
                       const std::filesystem::path& link = {}, std::uint32_t baud = 115200);

  const std::filesystem::path& path() const { return terminal_.path(); }
  void set_on_time(OnTime on_time) { on_time_ = std::move(on_time); }
  /// A client at another speed is ignored and gets noise. 0: any speed. Any thread.
  void expect_speed(std::uint32_t baud) { expected_baud_.store(baud); }

  /// Returns within 20 ms of a stop request.
  void run(const std::stop_token& stop);

  /// Bytes lost so far, as the client did not read in time.
  std::uint64_t lost_bytes() const { return lost_bytes_; }

 private:
  void exchange(core::TimeNs now_ns, bool has_client);

  std::unique_ptr<DeviceEmulator> emulator_;
  PseudoTerminal terminal_;
  OnTime on_time_;
  std::vector<std::uint8_t> out_;
  std::atomic<std::uint32_t> expected_baud_{0};
  std::uint64_t lost_bytes_ = 0;
};

}  // namespace cornerd::replay
