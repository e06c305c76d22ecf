// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "replay/emulator/device_emulator.hpp"
#include "replay/emulator/transmitter.hpp"
#include "replay/simulator/packet_simulator.hpp"

namespace cornerd::replay {

/// A lidar that sends packets at its own rate while it measures. The packets are a subclass's.
class PacketEmulator : public DeviceEmulator {
 public:
  void receive(std::span<const std::uint8_t> bytes, core::TimeNs now_ns) override;
  void take(core::TimeNs now_ns, std::vector<std::uint8_t>& out) override;
  std::optional<core::TimeNs> next_ns() const override;
  void set_stalled(bool stalled, core::TimeNs now_ns) override;

 protected:
  PacketEmulator(PacketSimulator simulator, std::uint32_t baud)
      : simulator_(std::move(simulator)), transmitter_(baud) {}

  /// Appends the next packet to `out`; returns the time when its last sample has been measured.
  virtual core::TimeNs make_packet(PacketSimulator& simulator, std::vector<std::uint8_t>& out) = 0;
  /// One byte from the host.
  virtual void handle(std::uint8_t /*byte*/, core::TimeNs /*now_ns*/) {}

  void send(core::TimeNs ready_ns, std::span<const std::uint8_t> bytes);
  void start(core::TimeNs now_ns);
  void stop(core::TimeNs now_ns);

 private:
  void prepare();
  void measure_until(core::TimeNs now_ns);

  PacketSimulator simulator_;
  Transmitter transmitter_;
  bool measuring_ = false;
  bool stalled_ = false;
  core::TimeNs ready_ns_ = 0;  ///< of packet_
  std::vector<std::uint8_t> packet_;
};

}  // namespace cornerd::replay
