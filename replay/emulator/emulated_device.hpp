// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/serial/byte_stream.hpp"
#include "drivers/serial/serial_port.hpp"
#include "replay/emulator/emulator.hpp"
#include "replay/emulator/virtual_clock.hpp"
#include "replay/simulator/random.hpp"
#include "replay/simulator/serial_line.hpp"

namespace cornerd::replay {

/// Faults of the bytes from a port; may change between two reads.
struct StreamFaults {
  explicit StreamFaults(std::uint64_t seed) : random(seed) {}

  /// Probability of ByteFaults.
  double damaged_share = 0;
  /// Number of the next bytes to lose, to repeat, and of random bytes to insert.
  std::size_t to_lose = 0;
  std::size_t to_repeat = 0;
  std::size_t to_insert = 0;

  std::uint64_t delivered = 0;  ///< bytes read by the host
  Random random;
};

/// A port whose received bytes have faults. For one thread.
class FaultStream : public drivers::ByteStream {
 public:
  /// `faults` must outlive it; they persist when the port is reopened.
  FaultStream(std::unique_ptr<drivers::ByteStream> stream, StreamFaults& faults)
      : stream_(std::move(stream)), faults_(faults) {}

  /// `buffer`: at least 4 bytes. May return no data although there was some.
  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override;
  bool write(std::span<const std::uint8_t> bytes) override { return stream_->write(bytes); }
  void discard_input() override { stream_->discard_input(); }
  bool set_dtr(bool asserted) override { return stream_->set_dtr(asserted); }

 private:
  std::unique_ptr<drivers::ByteStream> stream_;
  StreamFaults& faults_;
};

/// An emulated A1 in virtual time, without a pseudo-terminal, that can be unplugged and whose bytes
/// can have faults. Its motor always runs. For one thread.
class EmulatedDevice {
 public:
  /// `clock` must outlive it.
  EmulatedDevice(Emulator emulator, VirtualClock& clock, std::uint64_t seed);

  /// For rplidar::RplidarDriver::PortOpener. The stream must not outlive this.
  drivers::OpenResult open();

  /// False unplugs: open streams are lost for good.
  void plug(bool plugged);
  Emulator& emulator() { return emulator_; }
  StreamFaults& faults() { return faults_; }
  /// Bytes read by the host so far.
  std::uint64_t read_bytes() const { return faults_.delivered; }

 private:
  class Port;

  Emulator emulator_;
  VirtualClock& clock_;
  StreamFaults faults_;
  bool plugged_ = true;
  std::uint64_t plugs_ = 0;  ///< times it was unplugged
  std::vector<std::uint8_t> received_;
};

}  // namespace cornerd::replay
