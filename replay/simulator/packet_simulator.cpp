// SPDX-License-Identifier: MIT
#include "replay/simulator/packet_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/geometry/angle.hpp"

namespace cornerd::replay {
namespace {

constexpr std::uint64_t kHeadSeed = 0x9E3779B97F4A7C15u;  // keeps head and noise independent

/// The correction is within 0.1 degrees of a straight beam's: one step from there is enough.
constexpr double kSameWall_m = 0.02;

}  // namespace

double Triangulation::correction_deg(double range_m) const {
  if (range_m <= 0) return 0;
  return core::degrees(std::atan(offset_mm / (1e3 * range_m) - offset_mm / crossing_mm));
}

PacketSimulator::PacketSimulator(std::unique_ptr<Scene> scene, const SimulatorConfig& config,
                                 core::TimeNs sample_period_ns, std::optional<Triangulation> optics)
    : scene_(std::move(scene)),
      config_(config),
      optics_(optics),
      errors_(config.sensor, config.seed),
      head_(config.motor_hz, config.motor_jitter, sample_period_ns, config.seed ^ kHeadSeed) {
  if (!(config.motor_hz >= 1 && config.motor_hz <= 15)) {
    throw std::invalid_argument("motor: the rate must be 1 to 15 Hz");
  }
  head_.start(0, config.start_angle_deg);
}

double PacketSimulator::bearing_rad(double device_deg) const {
  return (config_.inverted ? 1 : -1) * core::radians(device_deg);
}

double PacketSimulator::range_m(core::TimeNs t_ns, std::int64_t scan, double device_deg) {
  const double half_beam_deg = core::degrees(config_.sensor.beam_width_rad) / 2;
  const auto along = [&](double angle_deg) {
    return scene_->range_along(t_ns, scan, core::Vec2::Zero(), bearing_rad(angle_deg));
  };
  if (half_beam_deg <= 0) return along(device_deg);
  return errors_.mixed(along(device_deg - half_beam_deg), along(device_deg + half_beam_deg));
}

/// Of the wall that the beam meets: the beam leaves beside the axis, tilted towards it.
double PacketSimulator::direction_deg(core::TimeNs t_ns, std::int64_t scan, double head_deg) {
  if (!optics_) return head_deg;
  const double tilt_rad = std::atan(optics_->offset_mm / optics_->crossing_mm);
  const double aside_m = 1e-3 * optics_->offset_mm * std::cos(tilt_rad);
  const double beam_rad = bearing_rad(head_deg - core::degrees(tilt_rad));
  const double sign = config_.inverted ? 1 : -1;
  const core::Vec2 laser = sign * aside_m * core::rotate_left(core::unit_vector(beam_rad));
  const double along_m = scene_->range_along(t_ns, scan, laser, beam_rad);
  if (along_m <= 0) return head_deg;
  const double first_m = std::hypot(along_m, aside_m);
  const double direction = head_deg + optics_->correction_deg(first_m);
  const double range = range_m(t_ns, scan, direction);
  if (std::abs(range - first_m) > kSameWall_m) return direction;
  return head_deg + optics_->correction_deg(range);
}

double PacketSimulator::measure_m(core::TimeNs t_ns, double head_deg) {
  const auto scan = static_cast<std::int64_t>(std::floor(head_deg / 360));
  const double direction = direction_deg(t_ns, scan, head_deg);
  if (!errors_.sees(bearing_rad(direction))) return 0;
  const double error_rad = errors_.direction_error(core::radians(direction));
  return errors_.measured(range_m(t_ns, scan, direction + core::degrees(error_rad)));
}

}  // namespace cornerd::replay
