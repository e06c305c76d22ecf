// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/serial/serial_port.hpp"
#include "replay/emulator/emulator.hpp"
#include "replay/emulator/fault_stream.hpp"
#include "replay/emulator/virtual_clock.hpp"

namespace cornerd::replay {

/// An emulated A1 on a cable that can be pulled out, and that damages what passes as its faults
/// say; in virtual time, without a pseudo-terminal. Its motor always runs. Of one thread.
class EmulatedDevice {
 public:
  /// `clock` must outlive it.
  EmulatedDevice(Emulator emulator, VirtualClock& clock, std::uint64_t seed);

  /// What a driver opens, as an rplidar::RplidarDriver::PortOpener. It must not outlive this.
  drivers::OpenResult open();

  /// Pulled out, what is open is lost for good.
  void plug(bool plugged);
  Emulator& emulator() { return emulator_; }
  StreamFaults& faults() { return faults_; }
  /// Bytes that the host has read so far.
  std::uint64_t read_bytes() const { return faults_.delivered; }

 private:
  class Port;

  Emulator emulator_;
  VirtualClock& clock_;
  StreamFaults faults_;
  bool plugged_ = true;
  std::uint64_t plugs_ = 0;  ///< times that it was pulled out
  std::vector<std::uint8_t> received_;
};

}  // namespace cornerd::replay
