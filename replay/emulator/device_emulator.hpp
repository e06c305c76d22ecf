// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace cornerd::replay {

/// A lidar's side of its serial line, without port or clock: the caller passes the time (from 0,
/// not decreasing) and the host's bytes, and takes the bytes sent by then. Not safe for concurrent
/// calls.
class DeviceEmulator {
 public:
  virtual ~DeviceEmulator() = default;

  virtual void receive(std::span<const std::uint8_t> bytes, core::TimeNs now_ns) = 0;

  /// Appends the bytes that have left the device by `now_ns`.
  virtual void take(core::TimeNs now_ns, std::vector<std::uint8_t>& out) = 0;

  /// Time of the next byte; nullopt if none comes without a request.
  virtual std::optional<core::TimeNs> next_ns() const = 0;

  /// Blocks or releases the head: the stream pauses, and resumes by itself.
  virtual void set_stalled(bool stalled, core::TimeNs now_ns) = 0;
};

}  // namespace cornerd::replay
