// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "drivers/serial/byte_stream.hpp"

namespace cornerd::drivers {

enum class OpenError : std::uint8_t {
  kNone,
  kAbsent,  ///< the port does not exist
  kDenied,  ///< no rights
  kBusy,    ///< another process holds it
  kFailed,  ///< any other error: no terminal, a rate that the port lacks
};

struct OpenResult {
  std::unique_ptr<ByteStream> stream;  ///< null on failure
  OpenError error = OpenError::kNone;
  std::string message;  ///< for a person, with the port's path
};

/// Opens a serial port (or pseudo-terminal) raw, 8N1, without flow control, exclusively: by
/// TIOCEXCL, which binds everyone but root, and by flock, which binds programs that use it. DTR
/// keeps its state on close (no HUPCL).
OpenResult open_serial_port(const std::string& path, std::uint32_t baud);

}  // namespace cornerd::drivers
