// SPDX-License-Identifier: MIT
// A simulated A1: a scene in, the bytes of its scan stream out.
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
#include "replay/simulator/rotating_head.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/sensor_model.hpp"
#include "replay/simulator/wire_encoder.hpp"

namespace cornerd::replay {

/// Sample period of an A1 of firmware 1.29 in the mode that is usual for a format: Standard 508,
/// Express 254, Boost and Sensitivity 127 us.
core::TimeNs nominal_sample_period_ns(rplidar::WireFormat format);

struct SimulatorConfig {
  SensorModel sensor;
  rplidar::WireFormat wire = rplidar::WireFormat::kExpress;
  core::TimeNs sample_period_ns = 0;  ///< 0: the format's usual one
  double motor_hz = 7.3;              ///< as an A1 runs free on 5 V
  double motor_jitter = 0.007;        ///< of the rate, from turn to turn: 1 ms of 137
  bool inverted = false;              ///< hung upside down: its angle then counts counter-clockwise
  /// Where the head stands at time 0, degrees; negative, so that turn 0 is the first whole one.
  double start_angle_deg = -60;
  std::uint64_t seed = 1;
};

/// A sample as the wire carries it, with what the wire does not carry.
struct SimulatedSample {
  core::TimeNs t_ns = 0;
  std::int64_t scan = 0;
  bool starts_scan = false;
  double device_angle_deg = 0;  ///< what the wire claims, clockwise, in [0, 360)
  std::uint32_t dist_q2 = 0;    ///< what the wire claims, millimetres * 4; 0: nothing returned
};

/// The same as a decoder and its clock would deliver it.
core::Sample to_sample(const SimulatedSample& simulated, bool inverted = false);

/// One packet of the stream: a node or a capsule.
struct WirePacket {
  core::TimeNs ready_ns = 0;                 ///< when all that it tells of has been measured
  std::span<const std::uint8_t> bytes;       ///< valid until the next packet is asked for
  std::span<const SimulatedSample> samples;  ///< likewise
};

/// Endless; as fast as it is asked. Same config, same scene: same bytes.
///
/// The head's own angle grows evenly through a capsule, from its start angle to the next one's. An
/// A1 measures by triangulation: its laser sits 24 mm beside the axis and looks 8 degrees off, so a
/// wall at distance d is seen 8 - asin(24 mm / d) degrees before the head's own angle. Nodes and
/// express capsules carry angles that the device has corrected for this, to 1/64 and 1/8 degree;
/// ultra capsules leave the correction to the host. A range is therefore taken in exactly the
/// direction that a decoder will compute; the sensor model's jitter comes on top.
///
/// A turn starts at the last sample before the head's own angle passes 0, as the vendor's decoder
/// has it; its corrected angle is 352 to 360 degrees, as start flags of real devices have.
class Simulator {
 public:
  /// Throws std::invalid_argument where a rate is out of the device's reach (1 to 15 Hz).
  Simulator(std::unique_ptr<Scene> scene, const SimulatorConfig& config);

  /// Begins a new stream at `t_ns` (at least the time reached), as after a scan request. The head
  /// goes on turning; only the first start of all takes the config's start angle.
  void start(core::TimeNs t_ns, rplidar::WireFormat wire, core::TimeNs sample_period_ns);

  WirePacket next();

  rplidar::WireFormat wire() const { return wire_; }
  DescriptorBytes descriptor() const { return scan_descriptor(wire_); }
  Scene& scene() { return *scene_; }

 private:
  using Head = RotatingHead::Position;

  /// Where a triangulating sensor sees the wall.
  struct Triangulation {
    double offset_deg = 0;  ///< from the head's own angle back to the wall's direction
    double range_m = 0;     ///< from the axis; 0: no wall
  };

  double range_at(const Head& head, std::int64_t scan, double device_angle_deg);
  Triangulation triangulate(const Head& head, std::int64_t scan, double error_deg);
  /// Of a ray to the normal of the wall that it meets; nullopt at an edge, or where nobody asks.
  std::optional<double> incidence_at(const Head& head, std::int64_t scan, double device_angle_deg,
                                     double range_m);
  double measured_at(const Head& head, std::int64_t scan, double device_angle_deg);
  std::uint32_t measured_for_ultra(const Head& head, std::int64_t scan);

  WirePacket next_node();
  /// The head's position that the next node tells of; moves the head on.
  Head take_node();
  WirePacket next_express();
  WirePacket next_ultra();
  /// Moves the head through a capsule of `count` samples. Returns the degrees between two of them.
  double sweep(std::size_t count);
  WirePacket packet(std::size_t bytes, std::size_t samples, core::TimeNs ready_ns);

  std::unique_ptr<Scene> scene_;
  SimulatorConfig config_;
  rplidar::WireFormat wire_;
  SensorErrors errors_;
  RotatingHead head_;
  bool restart_ = true;
  bool swapped_ = false;             ///< the node to come was due before the last one
  Head next_first_;                  ///< first position of the packet to come
  std::uint32_t next_first_mm_ = 0;  ///< its distance: an ultra capsule needs the next one's

  std::array<Head, kUltraSamples> heads_;  ///< of the packet under construction
  std::array<SimulatedSample, kUltraSamples> samples_;
  std::array<std::uint8_t, 132> bytes_{};
};

}  // namespace cornerd::replay
