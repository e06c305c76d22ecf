// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "drivers/serial/byte_stream.hpp"

namespace cornerd::drivers {

enum class OpenError : std::uint8_t {
  kNone,
  kAbsent,  ///< no such port
  kDenied,  ///< no rights
  kBusy,    ///< another process holds it
  kFailed,  ///< anything else: no terminal, a speed that is not supported
};

struct OpenResult {
  std::unique_ptr<ByteStream> stream;  ///< null where it failed
  OpenError error = OpenError::kNone;
  std::string message;  ///< for a person, naming the port
};

/// Opens a serial port (or pseudo-terminal) raw, 8N1, without flow control, for this process alone:
/// by TIOCEXCL, which the kernel enforces on everyone but root, and by flock, which well-behaved
/// programs ask for. The DTR line is cleared on close by nobody (no HUPCL).
/// `baud`: one of the standard rates.
OpenResult open_serial_port(const std::string& path, std::uint32_t baud);

}  // namespace cornerd::drivers
