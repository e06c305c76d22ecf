// SPDX-License-Identifier: MIT
// A simulated A1, A2 or A3: turns a scene into the bytes of a scan stream.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "replay/simulator/packet_source.hpp"
#include "replay/simulator/rotating_head.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/sensor_model.hpp"
#include "replay/simulator/wire_encoder.hpp"

namespace cornerd::replay {

/// Sample period of firmware 1.29: Standard 508, Express 254, Boost and Sensitivity 127 us.
core::TimeNs nominal_sample_period_ns(rplidar::WireFormat format);

struct SimulatorConfig {
  SensorModel sensor;
  rplidar::WireFormat wire = rplidar::WireFormat::kExpress;
  core::TimeNs sample_period_ns = 0;  ///< 0: the nominal one
  double motor_hz = 7.3;              ///< an uncontrolled A1 at 5 V
  double motor_jitter = 0.007;        ///< of the rate, per revolution: 1 ms of 137
  bool inverted = false;              ///< upside down: the angle counts counter-clockwise
  /// Angle of the head at time 0, degrees; negative, so that scan 0 is the first complete one.
  double start_angle_deg = -60;
  std::uint64_t seed = 1;
};

/// As a decoder and sample clock deliver it.
core::Sample to_sample(const SimulatedSample& simulated, bool inverted = false);

/// The stream of a triangulating RPLidar: nodes, express and ultra capsules.
///
/// Within a capsule the head's angle grows linearly. An A1 triangulates: its laser sits 24 mm
/// beside the axis and points 8 degrees off, so a wall at distance d lies 8 deg - asin(24 mm / d)
/// before the head's angle. Nodes and express capsules carry angles corrected for this, to 1/64 and
/// 1/8 degree; for ultra capsules the host corrects. The simulator measures each range in exactly
/// the direction that a decoder computes, plus the sensor model's jitter.
///
/// A scan starts at the last sample before the head's angle passes 0, as in the vendor's decoder;
/// its corrected angle is 352 to 360 degrees.
class Simulator : public PacketSource {
 public:
  /// Throws std::invalid_argument if the motor's rate is not in [1, 15] Hz.
  Simulator(std::unique_ptr<Scene> scene, const SimulatorConfig& config);

  void start(core::TimeNs t_ns, rplidar::WireFormat wire, core::TimeNs sample_period_ns) override;
  WirePacket next() override;
  Scene& scene() override { return *scene_; }

  rplidar::WireFormat wire() const { return wire_; }
  DescriptorBytes descriptor() const { return scan_descriptor(wire_); }

 private:
  using Head = RotatingHead::Position;

  /// A wall as a triangulating sensor measures it.
  struct Triangulation {
    double offset_deg = 0;  ///< from the wall's direction to the head's angle
    double range_m = 0;     ///< from the axis; 0: no wall
  };

  double range_at(const Head& head, std::int64_t scan, double device_angle_deg);
  Triangulation triangulate(const Head& head, std::int64_t scan, double error_deg);
  /// Angle of incidence on the wall; nullopt at an edge, or if not needed.
  std::optional<double> incidence_at(const Head& head, std::int64_t scan, double device_angle_deg,
                                     double range_m);
  /// Whether an angle as on the wire is in the field of view.
  bool sees(double device_angle_deg) const;
  double measured_at(const Head& head, std::int64_t scan, double device_angle_deg);
  std::uint32_t measured_for_ultra(const Head& head, std::int64_t scan);

  WirePacket next_node();
  /// The head's position for the next node; advances the head.
  Head take_node();
  WirePacket next_express();
  WirePacket next_ultra();
  /// Advances the head through a capsule of `count` samples; returns the degrees between samples.
  double sweep(std::size_t count);
  WirePacket packet(std::size_t bytes, std::size_t samples, core::TimeNs ready_ns);

  std::unique_ptr<Scene> scene_;
  SimulatorConfig config_;
  rplidar::WireFormat wire_;
  SensorErrors errors_;
  RotatingHead head_;
  bool restart_ = true;
  bool swapped_ = false;             ///< the last two nodes were swapped
  Head next_first_;                  ///< first position of the next packet
  std::uint32_t next_first_mm_ = 0;  ///< its distance, which ends the previous ultra capsule

  std::array<Head, kUltraSamples> heads_;  ///< of the packet under construction
  std::array<SimulatedSample, kUltraSamples> samples_;
  std::array<std::uint8_t, 132> bytes_{};
};

}  // namespace cornerd::replay
