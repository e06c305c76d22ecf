// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>

#include "replay/emulator/emulator.hpp"
#include "replay/emulator/pseudo_terminal.hpp"

namespace cornerd::replay {

/// An emulated A1 on a pseudo-terminal, in real time: bytes leave at the pace of the serial line,
/// whether somebody reads them or not. Clients may come and go. Its motor always runs: the lines
/// that switch a real one do not exist on a pseudo-terminal.
class PtyEmulator {
 public:
  /// Called about every 10 ms with the emulator's own time and the UNIX time of that moment: where
  /// the truth is written down.
  using OnTime = std::function<void(core::TimeNs t_ns, core::TimeNs unix_ns)>;

  /// Throws std::system_error where the pseudo-terminal or the link to it cannot be made.
  PtyEmulator(Emulator emulator, const std::filesystem::path& link = {});

  const std::filesystem::path& path() const { return terminal_.path(); }
  void set_on_time(OnTime on_time) { on_time_ = std::move(on_time); }
  /// The device itself, for what is called by on_time.
  Emulator& emulator() { return emulator_; }
  /// A client that sets another speed is not understood, and hears noise. 0: any will do, as on
  /// every pseudo-terminal. Any thread.
  void expect_speed(std::uint32_t baud) { expected_baud_.store(baud); }

  /// Until a stop is asked for, which is honoured within 20 ms.
  void run(const std::stop_token& stop);

  /// Bytes that nobody read in time so far.
  std::uint64_t lost_bytes() const { return lost_bytes_; }

 private:
  void exchange(core::TimeNs now_ns, bool has_client);

  Emulator emulator_;
  PseudoTerminal terminal_;
  OnTime on_time_;
  std::vector<std::uint8_t> out_;
  std::atomic<std::uint32_t> expected_baud_{0};
  std::uint64_t lost_bytes_ = 0;
};

}  // namespace cornerd::replay
