// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cornerd::drivers {

/// The bytes of a device, both ways: a serial port, or something that stands in for one (a test's
/// device, a port with injected faults, a recorder in between). One thread at a time.
/// Errors are results, never exceptions.
class ByteStream {
 public:
  enum class ReadStatus : std::uint8_t {
    kData,
    kTimeout,  ///< nothing came in time
    kLost,     ///< the device is gone; every later call says so too
  };

  struct ReadResult {
    ReadStatus status = ReadStatus::kTimeout;
    std::size_t count = 0;  ///< bytes put into the buffer
  };

  virtual ~ByteStream() = default;

  /// Waits until there is something to read, and takes what there is.
  virtual ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) = 0;
  /// True where all bytes were taken.
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;
  /// Throws away what was received and not read.
  virtual void discard_input() = 0;
  /// Sets or clears the DTR line. False where there is none, as on a pseudo-terminal.
  virtual bool set_dtr(bool asserted) = 0;
};

}  // namespace cornerd::drivers
