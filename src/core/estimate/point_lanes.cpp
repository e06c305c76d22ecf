// SPDX-License-Identifier: MIT
#include "core/estimate/point_lanes.hpp"

#include <algorithm>

#include <Eigen/Core>

namespace cornerd::core {
namespace {

constexpr std::size_t kLanes = 4;
using Lanes = Eigen::Array<float, kLanes, 1>;

/// A micrometre squared, so that a point exactly on its wall has a finite weight.
constexpr float kMinVariance = 1e-12F;

/// Masks for a last group of fewer than four points.
constexpr float kFirst[kLanes][kLanes] = {{0, 0, 0, 0}, {1, 0, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 0}};

Eigen::Map<const Lanes> lanes(const std::vector<float>& values, std::size_t at) {
  return Eigen::Map<const Lanes>(values.data() + at);
}
Eigen::Map<Lanes> lanes(std::vector<float>& values, std::size_t at) {
  return Eigen::Map<Lanes>(values.data() + at);
}

}  // namespace

PointLanes::PointLanes() {
  for (auto* values : {&x_m_, &y_m_, &inverse_range_, &across_variance_, &along_variance_}) {
    values->reserve(kMaxSamplesPerScan + kLanes);
  }
}

void PointLanes::assign(std::span<const PolarPoint> points, const SensorNoise& noise,
                        double noise_scale) {
  const std::size_t size = std::min(points.size(), kMaxSamplesPerScan) + kLanes;
  for (auto* values : {&x_m_, &y_m_, &inverse_range_, &across_variance_, &along_variance_}) {
    values->assign(size, 1);
  }
  for (std::size_t i = 0; i + kLanes < size; ++i) {
    x_m_[i] = static_cast<float>(points[i].x_m);
    y_m_[i] = static_cast<float>(points[i].y_m);
    inverse_range_[i] = static_cast<float>(points[i].range_m);
    if (!noise.table.empty()) {
      along_variance_[i] = static_cast<float>(noise.table.sigma_m(points[i].range_m));
    }
  }
  const auto floor_m = static_cast<float>(noise.floor_m);
  const auto share = static_cast<float>(noise.share);
  const auto bearing_rad = static_cast<float>(noise.bearing_rad);
  const auto scale = static_cast<float>(noise_scale);
  for (std::size_t i = 0; i + kLanes <= size; i += kLanes) {
    const Lanes range_m = lanes(inverse_range_, i);
    Lanes sigma_m = lanes(along_variance_, i);
    if (noise.table.empty()) sigma_m = (share * range_m).max(floor_m);
    const Lanes along_m = scale * sigma_m;
    const Lanes across_m = scale * bearing_rad * range_m;
    lanes(across_variance_, i) = across_m * across_m;
    lanes(along_variance_, i) = along_m * along_m - across_m * across_m;
    lanes(inverse_range_, i) = Lanes::Ones() / range_m;
  }
}

FaceSums PointLanes::sum(std::size_t begin, std::size_t end, const Vec2& normal, double height_m,
                         double extra_sigma_m, double face_sigma_m, double angle_rad) const {
  constexpr auto kPerCut = static_cast<float>(1 / (kCutSigmas * kCutSigmas));
  // Turns any positive share into 1.
  constexpr float kHuge = 1e30F;
  const auto nx = static_cast<float>(normal.x());
  const auto ny = static_cast<float>(normal.y());
  const auto height = static_cast<float>(height_m);
  const auto angle = static_cast<float>(angle_rad);
  const auto extra_variance = static_cast<float>(extra_sigma_m * extra_sigma_m) + kMinVariance;
  const auto face_variance = static_cast<float>(face_sigma_m * face_sigma_m);
  Lanes weights = Lanes::Zero();
  Lanes levers = weights;
  Lanes levers_squared = weights;
  Lanes distances = weights;
  Lanes distances_levers = weights;
  Lanes z_squares = weights;
  Lanes squared_distances = weights;
  Lanes inside = weights;
  for (std::size_t i = begin; i < end; i += kLanes) {
    const Lanes x = lanes(x_m_, i);
    const Lanes y = lanes(y_m_, i);
    const Lanes towards_m = nx * x + ny * y;
    const Lanes lever_m = ny * x - nx * y;
    const Lanes distance_m = towards_m + height - angle * lever_m;
    const Lanes sine = towards_m * lanes(inverse_range_, i);
    const Lanes variance =
        lanes(along_variance_, i) * sine * sine + lanes(across_variance_, i) + extra_variance;
    const Lanes information = Lanes::Ones() / variance;
    const Lanes z_squared = distance_m * distance_m * information;
    const Lanes cut =
        face_variance > 0 ? Lanes(distance_m * distance_m / (variance + face_variance)) : z_squared;
    Lanes share = (1 - cut * kPerCut).max(0.0F);
    if (end - i < kLanes) share *= Eigen::Map<const Lanes>(kFirst[end - i]);
    const Lanes is_inside = (share * kHuge).min(1.0F);
    const Lanes weight = share * share * information;
    weights += weight;
    levers += weight * lever_m;
    levers_squared += weight * lever_m * lever_m;
    distances += weight * distance_m;
    distances_levers += weight * distance_m * lever_m;
    z_squares +=
        face_variance > 0 ? Lanes(weight * distance_m * distance_m) : Lanes(is_inside * z_squared);
    squared_distances += is_inside * distance_m * distance_m;
    inside += is_inside;
  }
  return {
      {weights.sum(), levers.sum(), levers_squared.sum(), distances.sum(), distances_levers.sum()},
      z_squares.sum(),
      squared_distances.sum(),
      inside.sum()};
}

}  // namespace cornerd::core
