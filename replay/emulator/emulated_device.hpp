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

/// What befalls the bytes of a port on their way to the host; to be changed between two reads.
struct StreamFaults {
  explicit StreamFaults(std::uint64_t seed) : random(seed) {}

  /// Of each byte: to be lost, or changed.
  double damaged_share = 0;
  /// So many of the next bytes are lost, come twice, or come after others that nobody sent.
  std::size_t to_lose = 0;
  std::size_t to_repeat = 0;
  std::size_t to_insert = 0;

  std::uint64_t delivered = 0;  ///< bytes that the host has got
  Random random;
};

/// A port with a bad cable. Writing is not damaged. Of one thread.
class FaultStream : public drivers::ByteStream {
 public:
  /// `faults` must outlive it: they go on over a port that is opened again.
  FaultStream(std::unique_ptr<drivers::ByteStream> stream, StreamFaults& faults)
      : stream_(std::move(stream)), faults_(faults) {}

  /// `buffer`: of at least 4 bytes. It may come back with no data although there was some.
  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override;
  bool write(std::span<const std::uint8_t> bytes) override { return stream_->write(bytes); }
  void discard_input() override { stream_->discard_input(); }
  bool set_dtr(bool asserted) override { return stream_->set_dtr(asserted); }

 private:
  std::unique_ptr<drivers::ByteStream> stream_;
  StreamFaults& faults_;
};

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
