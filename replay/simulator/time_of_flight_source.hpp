// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "replay/simulator/packet_simulator.hpp"
#include "replay/simulator/packet_source.hpp"

namespace cornerd::replay {

/// The stream of an RPLidar that measures time of flight (C1, S1, S2, S3), by the protocol paper
/// and the packed structs of the vendor's SDK: nodes, dense and ultra-dense capsules, HQ packets.
/// Its angles are the head's: it corrects nothing.
class TimeOfFlightSource : public PacketSource {
 public:
  /// Throws std::invalid_argument if the motor's rate is not in [1, 15] Hz.
  TimeOfFlightSource(std::unique_ptr<Scene> scene, const SimulatorConfig& config,
                     core::TimeNs sample_period_ns);

  void start(core::TimeNs t_ns, rplidar::WireFormat wire, core::TimeNs sample_period_ns) override;
  WirePacket next() override;
  Scene& scene() override { return simulator_.scene(); }

 private:
  struct Measured {
    double angle_deg = 0;  ///< not reduced
    double range_m = 0;
    bool starts_scan = false;
  };

  /// The next samples, each in the direction that a host interpolates between the packet's start
  /// and the next one's.
  const std::vector<Measured>& measure(std::size_t count);
  std::uint32_t start_word() const;
  void append_node();
  void append_dense();
  void append_ultra_dense();
  void append_hq();
  void append(std::uint64_t value, int bytes);
  /// Fills the first two bytes.
  void seal_capsule();

  PacketSimulator simulator_;
  rplidar::WireFormat wire_ = rplidar::WireFormat::kDense;
  bool is_first_ = true;         ///< of the stream
  std::int64_t revolution_ = 0;  ///< of the last sample
  core::TimeNs ready_ns_ = 0;
  std::vector<Measured> measured_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace cornerd::replay
