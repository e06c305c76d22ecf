// SPDX-License-Identifier: MIT
// An RPLidar at the far end of a serial line: receives requests, sends answers and scans.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "drivers/rplidar/protocol/answers.hpp"
#include "drivers/rplidar/protocol/framing.hpp"
#include "replay/emulator/device_emulator.hpp"
#include "replay/emulator/firmware.hpp"
#include "replay/emulator/transmitter.hpp"
#include "replay/simulator/packet_source.hpp"

namespace cornerd::replay {

struct EmulatorConfig {
  const Firmware* firmware = find_firmware("1.29");
  rplidar::Health health;
  bool reset_restores_health = true;  ///< RESET clears a failed health
  double spin_up_s = 0;               ///< from a scan request to the first data; 0 for FORCE_SCAN
  /// Whether configuration type 0x01 (desired rotation) is answered. If not, vendor software waits
  /// 2 s for it.
  bool answers_rotation_request = true;
  std::uint32_t baud = 115200;
  std::array<std::uint8_t, 16> serial = {0xC0, 0x12, 0x9A, 0xE1, 0xC3, 0xE2, 0x9B, 0xD2,
                                         0xA7, 0xE7, 0x9C, 0xF3, 0x40, 0x55, 0x34, 0x12};
};

/// An RPLidar: the one of the config's firmware.
///
/// An unknown request, or one with a wrong checksum, has no effect. Any other one ends the scan;
/// the packet on the line still arrives. With a failed health no scan starts (protection stop).
class Emulator : public DeviceEmulator {
 public:
  Emulator(const EmulatorConfig& config, std::unique_ptr<PacketSource> source);

  void receive(std::span<const std::uint8_t> bytes, core::TimeNs now_ns) override;

  void take(core::TimeNs now_ns, std::vector<std::uint8_t>& out) override;
  std::optional<core::TimeNs> next_ns() const override;
  void set_stalled(bool stalled, core::TimeNs now_ns) override;
  /// The head stands and samples go on: each packet repeats the one before.
  void set_repeating(bool repeats) { repeats_ = repeats; }
  /// A failed health ends the scan.
  void set_health(const rplidar::Health& health, core::TimeNs now_ns);
  /// As after a RESET, but unasked.
  void power_cycle(core::TimeNs now_ns) { reset(now_ns); }

  bool scanning() const { return scanning_; }
  Scene& scene() { return source_->scene(); }

 private:
  void handle(const rplidar::Request& request, core::TimeNs now_ns);
  void answer(core::TimeNs now_ns, rplidar::AnswerType type, std::span<const std::uint8_t> payload);
  void answer_configuration(std::span<const std::uint8_t> request, core::TimeNs now_ns);
  void start_scan(const FirmwareScanMode& mode, bool force, core::TimeNs now_ns);
  void set_motor(bool runs, core::TimeNs now_ns);
  bool is_still() const { return stalled_ || !motor_runs_; }
  void begin_stream(core::TimeNs now_ns);
  void stop_scan(core::TimeNs now_ns);
  void reset(core::TimeNs now_ns);
  void measure_until(core::TimeNs now_ns);
  void prepare_packet();

  EmulatorConfig config_;
  std::unique_ptr<PacketSource> source_;
  rplidar::RequestParser parser_;
  core::TimeNs request_begun_ns_ = 0;
  Transmitter transmitter_;
  rplidar::Health health_;
  core::TimeNs ignores_until_ns_ = 0;

  bool scanning_ = false;
  bool stalled_ = false;
  bool repeats_ = false;
  bool motor_runs_;
  FirmwareScanMode mode_;
  core::TimeNs packet_ready_ns_ = 0;  ///< of the packet being measured
  std::vector<std::uint8_t> packet_;
};

}  // namespace cornerd::replay
