// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/types.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "replay/simulator/scene.hpp"

namespace cornerd::replay {

/// A sample as on the wire, with its true time and scan.
struct SimulatedSample {
  core::TimeNs t_ns = 0;
  std::int64_t scan = 0;
  bool starts_scan = false;
  double device_angle_deg = 0;  ///< as on the wire, clockwise, in [0, 360)
  std::uint32_t dist_q2 = 0;    ///< as on the wire, millimetres * 4; 0: no return
};

/// One packet of a stream: a node or a capsule.
struct WirePacket {
  core::TimeNs ready_ns = 0;                 ///< its last sample has been measured
  std::span<const std::uint8_t> bytes;       ///< valid until the next packet
  std::span<const SimulatedSample> samples;  ///< likewise
};

/// The scan stream of an RPLidar: endless, deterministic for config and scene.
class PacketSource {
 public:
  virtual ~PacketSource() = default;
  /// Begins a new stream at `t_ns` (not before the current time), as after a scan request. The head
  /// keeps rotating; the config's start angle is that of the first stream.
  virtual void start(core::TimeNs t_ns, rplidar::WireFormat wire,
                     core::TimeNs sample_period_ns) = 0;
  virtual WirePacket next() = 0;
  virtual Scene& scene() = 0;
};

}  // namespace cornerd::replay
