// SPDX-License-Identifier: MIT
#include "replay/simulator/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace cornerd::replay {
namespace {

/// The A1's optics, as in the vendor's correction of ultra capsules.
constexpr double kLaserOffsetM = 0.024;
constexpr double kLaserAngleDeg = 8.0;
constexpr double kMinCorrectedM = 0.050;
constexpr double kNearOffsetDeg = 7.5;  ///< if nearer, or without a return

/// Quality of a standard node with a return; 0 without.
constexpr std::uint8_t kQuality = 15;

constexpr std::uint64_t kHeadSeed = 0x9E3779B97F4A7C15u;  ///< keeps head and noise independent

double optical_offset_deg(double range_m) {
  if (range_m < kMinCorrectedM) return kNearOffsetDeg;
  return kLaserAngleDeg - core::degrees(std::asin(kLaserOffsetM / range_m));
}

double wrap_degrees(double angle_deg) { return angle_deg - 360 * std::floor(angle_deg / 360); }

std::int64_t to_q6(double angle_deg) { return std::llround(angle_deg * 64); }
std::uint16_t wrap_q6(std::int64_t angle_q6) {
  constexpr std::int64_t kRevolution = 360 * 64;
  return static_cast<std::uint16_t>(((angle_q6 % kRevolution) + kRevolution) % kRevolution);
}

/// The last sample before the zero angle belongs to the next scan.
std::int64_t scan_of(double angle_deg, double step_deg) {
  return static_cast<std::int64_t>(std::floor((angle_deg + step_deg) / 360));
}
bool is_last_before_mark(double angle_deg, double step_deg) {
  return scan_of(angle_deg, step_deg) > scan_of(angle_deg, 0);
}

std::uint32_t to_units(double range_m, double units_per_m, std::uint32_t max_value) {
  return static_cast<std::uint32_t>(
      std::clamp(std::round(range_m * units_per_m), 0.0, static_cast<double>(max_value)));
}

}  // namespace

core::TimeNs nominal_sample_period_ns(rplidar::WireFormat format) {
  switch (format) {
    case rplidar::WireFormat::kStandard:
      return 508'000;
    case rplidar::WireFormat::kExpress:
      return 254'000;
    default:
      break;
  }
  return 127'000;
}

core::Sample to_sample(const SimulatedSample& simulated, bool inverted) {
  const double bearing_rad = (inverted ? 1 : -1) * core::radians(simulated.device_angle_deg);
  core::Sample sample;
  sample.t_ns = simulated.t_ns;
  sample.bearing_rad = static_cast<float>(core::normalize_angle(bearing_rad));
  sample.range_m = static_cast<float>(simulated.dist_q2) / 4000.0f;
  sample.quality = simulated.dist_q2 != 0 ? kQuality : 0;
  sample.starts_scan = simulated.starts_scan;
  return sample;
}

Simulator::Simulator(std::unique_ptr<Scene> scene, const SimulatorConfig& config)
    : scene_(std::move(scene)),
      config_(config),
      wire_(config.wire),
      errors_(config.sensor, config.seed),
      head_(config.motor_hz, config.motor_jitter, nominal_sample_period_ns(config.wire),
            config.seed ^ kHeadSeed) {
  if (!(config.motor_hz >= 1 && config.motor_hz <= 15) ||
      !(config.motor_jitter >= 0 && config.motor_jitter <= 0.1)) {
    throw std::invalid_argument("motor: the rate must be 1 to 15 Hz and the jitter 0 to 0.1");
  }
  head_.start(0, config.start_angle_deg);
  start(0, config.wire, config.sample_period_ns);
}

void Simulator::start(core::TimeNs t_ns, rplidar::WireFormat wire, core::TimeNs sample_period_ns) {
  wire_ = wire;
  head_.resume(t_ns, sample_period_ns > 0 ? sample_period_ns : nominal_sample_period_ns(wire));
  restart_ = true;
  swapped_ = false;
  next_first_ = head_.next();
  if (wire == rplidar::WireFormat::kUltra) {
    next_first_mm_ = measured_for_ultra(next_first_, scan_of(next_first_.angle_deg, 0));
  }
}

WirePacket Simulator::next() {
  switch (wire_) {
    case rplidar::WireFormat::kStandard:
      return next_node();
    case rplidar::WireFormat::kExpress:
      return next_express();
    default:  // no triangulating lidar sends another
      break;
  }
  return next_ultra();
}

double Simulator::range_at(const Head& head, std::int64_t scan, double device_angle_deg) {
  const double sign = config_.inverted ? 1 : -1;
  return scene_->range_along(head.t_ns, scan, core::Vec2::Zero(),
                             sign * core::radians(device_angle_deg));
}

Simulator::Triangulation Simulator::triangulate(const Head& head, std::int64_t scan,
                                                double error_deg) {
  const double sign = config_.inverted ? 1 : -1;
  const double bearing_rad = sign * core::radians(head.angle_deg - kLaserAngleDeg + error_deg);
  const core::Vec2 laser = sign * kLaserOffsetM * core::rotate_left(core::unit_vector(bearing_rad));
  const double along_m = scene_->range_along(head.t_ns, scan, laser, bearing_rad);
  if (along_m <= 0) return {kNearOffsetDeg, 0};
  const double range_m = std::hypot(along_m, kLaserOffsetM);
  return {optical_offset_deg(range_m), range_m};
}

std::optional<double> Simulator::incidence_at(const Head& head, std::int64_t scan,
                                              double device_angle_deg, double range_m) {
  if (!errors_.needs_incidence() || range_m <= 0) return std::nullopt;
  constexpr double kAsideDeg = 0.05;
  constexpr double kGrazing = 20;  // (dr/dangle) / r at 87 degrees of incidence
  const double before_m = range_at(head, scan, device_angle_deg - kAsideDeg);
  const double after_m = range_at(head, scan, device_angle_deg + kAsideDeg);
  if (before_m <= 0 || after_m <= 0) return std::nullopt;
  const double growth = (after_m - before_m) / (2 * core::radians(kAsideDeg) * range_m);
  const bool straight = std::abs(before_m + after_m - 2 * range_m) < 1e-3 * range_m;
  if (!straight || std::abs(growth) > kGrazing) return std::nullopt;
  return (config_.inverted ? 1 : -1) * std::atan(growth);
}

bool Simulator::sees(double device_angle_deg) const {
  return errors_.sees((config_.inverted ? 1 : -1) * core::radians(device_angle_deg));
}

double Simulator::measured_at(const Head& head, std::int64_t scan, double device_angle_deg) {
  if (!sees(device_angle_deg)) return 0;
  const double error_rad = errors_.direction_error(core::radians(device_angle_deg));
  const double angle_deg = device_angle_deg + core::degrees(error_rad);
  const double half_beam_deg = core::degrees(config_.sensor.beam_width_rad) / 2;
  const double range_m = half_beam_deg <= 0
                             ? range_at(head, scan, angle_deg)
                             : errors_.mixed(range_at(head, scan, angle_deg - half_beam_deg),
                                             range_at(head, scan, angle_deg + half_beam_deg));
  return errors_.measured(range_m, incidence_at(head, scan, angle_deg, range_m));
}

std::uint32_t Simulator::measured_for_ultra(const Head& head, std::int64_t scan) {
  const double error_deg =
      core::degrees(errors_.direction_error(core::radians(head.angle_deg - kLaserAngleDeg)));
  const double half_beam_deg = core::degrees(config_.sensor.beam_width_rad) / 2;
  double range_m = triangulate(head, scan, error_deg - half_beam_deg).range_m;
  if (half_beam_deg > 0) {
    range_m = errors_.mixed(range_m, triangulate(head, scan, error_deg + half_beam_deg).range_m);
  }
  const double angle_deg = head.angle_deg + error_deg - optical_offset_deg(range_m);
  const std::uint32_t measured_mm = to_units(
      errors_.measured(range_m, incidence_at(head, scan, angle_deg, range_m)), 1e3, 28'656);
  // The host computes the direction from the measured distance.
  return sees(head.angle_deg - optical_offset_deg(measured_mm * 1e-3)) ? measured_mm : 0;
}

double Simulator::sweep(std::size_t count) {
  heads_[0] = next_first_;
  for (std::size_t k = 1; k < count; ++k) heads_[k] = head_.next();
  next_first_ = head_.next();
  const std::int64_t start_q6 = to_q6(heads_[0].angle_deg);
  const double step_deg = static_cast<double>(to_q6(next_first_.angle_deg) - start_q6) / 64.0 /
                          static_cast<double>(count);
  // From here on angles are interpolated between start angles, as a decoder does.
  for (std::size_t k = 0; k < count; ++k) {
    heads_[k].angle_deg = static_cast<double>(start_q6) / 64.0 + static_cast<double>(k) * step_deg;
    samples_[k] = {heads_[k].t_ns, scan_of(heads_[k].angle_deg, step_deg),
                   is_last_before_mark(heads_[k].angle_deg, step_deg), 0, 0};
  }
  return step_deg;
}

WirePacket Simulator::packet(std::size_t bytes, std::size_t samples, core::TimeNs ready_ns) {
  restart_ = false;
  return {ready_ns, std::span(bytes_).first(bytes), std::span(samples_).first(samples)};
}

Simulator::Head Simulator::take_node() {
  const double step_deg = head_.step_deg();
  Head head = next_first_;
  next_first_ = head_.next();
  // A swap must not move the scan start.
  const bool same_scan = scan_of(head.angle_deg, 0) == scan_of(next_first_.angle_deg, step_deg);
  swapped_ = !swapped_ && same_scan && errors_.swaps_nodes();
  if (swapped_) std::swap(head.angle_deg, next_first_.angle_deg);
  return head;
}

WirePacket Simulator::next_node() {
  const double step_deg = head_.step_deg();
  const Head head = take_node();
  SimulatedSample& sample = samples_[0];
  sample = {head.t_ns, scan_of(head.angle_deg, step_deg),
            is_last_before_mark(head.angle_deg, step_deg), 0, 0};

  const double offset_deg = triangulate(head, sample.scan, 0).offset_deg;
  std::uint16_t angle_q6 = wrap_q6(to_q6(head.angle_deg - offset_deg));
  sample.dist_q2 = to_units(measured_at(head, sample.scan, angle_q6 / 64.0), 4e3, 0xFFFF);
  // A node without a return has no angle correction.
  if (sample.dist_q2 == 0) angle_q6 = wrap_q6(to_q6(head.angle_deg));
  sample.device_angle_deg = angle_q6 / 64.0;

  const NodeBytes node = encode_node(sample.starts_scan, sample.dist_q2 != 0 ? kQuality : 0,
                                     angle_q6, static_cast<std::uint16_t>(sample.dist_q2));
  std::copy(node.begin(), node.end(), bytes_.begin());
  return packet(node.size(), 1, head.t_ns + head_.period_ns());
}

WirePacket Simulator::next_express() {
  sweep(kExpressSamples);
  std::array<ExpressSample, kExpressSamples> wire;
  for (std::size_t k = 0; k < kExpressSamples; ++k) {
    const Head& head = heads_[k];
    SimulatedSample& sample = samples_[k];
    const double offset_deg = triangulate(head, sample.scan, 0).offset_deg;
    std::uint32_t offset_q3 = to_units(offset_deg, 8, 63);
    const double range_m = measured_at(head, sample.scan, head.angle_deg - offset_q3 / 8.0);
    const std::uint32_t dist_mm = to_units(range_m, 1e3, 0x3FFF);
    if (dist_mm == 0) offset_q3 = 0;
    wire[k] = {static_cast<std::uint16_t>(dist_mm), static_cast<std::uint8_t>(offset_q3)};
    sample.device_angle_deg = wrap_degrees(head.angle_deg - offset_q3 / 8.0);
    sample.dist_q2 = 4 * dist_mm;
  }
  const std::uint16_t start_q6 = wrap_q6(to_q6(heads_[0].angle_deg));
  const ExpressBytes capsule = encode_express(start_q6, restart_, wire);
  std::copy(capsule.begin(), capsule.end(), bytes_.begin());
  return packet(capsule.size(), kExpressSamples,
                heads_[kExpressSamples - 1].t_ns + head_.period_ns());
}

WirePacket Simulator::next_ultra() {
  const double step_deg = sweep(kUltraSamples);
  std::array<std::uint32_t, kUltraSamples + 1> dist_mm{};
  dist_mm[0] = next_first_mm_;
  for (std::size_t k = 1; k < kUltraSamples; ++k) {
    dist_mm[k] = measured_for_ultra(heads_[k], samples_[k].scan);
  }
  next_first_mm_ = measured_for_ultra(next_first_, scan_of(next_first_.angle_deg, step_deg));
  dist_mm[kUltraSamples] = next_first_mm_;

  const std::uint16_t start_q6 = wrap_q6(to_q6(heads_[0].angle_deg));
  const UltraCapsule capsule = encode_ultra(start_q6, restart_, dist_mm);
  for (std::size_t k = 0; k < kUltraSamples; ++k) {
    const double offset_deg = optical_offset_deg(capsule.carried_mm[k] * 1e-3);
    samples_[k].device_angle_deg = wrap_degrees(heads_[k].angle_deg - offset_deg);
    samples_[k].dist_q2 = 4 * capsule.carried_mm[k];
  }
  std::copy(capsule.bytes.begin(), capsule.bytes.end(), bytes_.begin());
  return packet(capsule.bytes.size(), kUltraSamples, next_first_.t_ns + head_.period_ns());
}

}  // namespace cornerd::replay
