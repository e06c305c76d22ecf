// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "drivers/serial/byte_stream.hpp"
#include "replay/simulator/byte_faults.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::replay {

/// What befalls the bytes of a port on their way to the host; to be changed between two reads.
struct StreamFaults {
  explicit StreamFaults(std::uint64_t seed) : random(seed) {}

  /// Of each byte: to be lost, or changed.
  double damaged_share = 0;
  /// So many of the next bytes are lost, come twice, or come after others that nobody sent.
  std::size_t to_lose = 0;
  std::size_t to_repeat = 0;
  std::size_t to_invent = 0;

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

}  // namespace cornerd::replay
