// SPDX-License-Identifier: MIT
#include "survey/face_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cornerd::survey {
namespace {

/// A return within this distance, plus this many sigmas, is on the face.
constexpr double kOnFace_m = 0.01;
constexpr double kRaySigmas = 3;
/// A ray that ends this far behind a face went through it.
constexpr double kBehind_m = 0.06;
/// Cosine of the incidence angle; grazing rays are not counted.
constexpr double kMinApproach = 0.1;
/// Fewer rays are outliers and mixed pixels.
constexpr std::uint32_t kFewRays = 3;

class RayCounter {
 public:
  explicit RayCounter(const core::SensorNoise& noise) : noise_(noise) {}

  void begin(std::span<const DeskewedPoint> points) {
    points_ = points;
    taken_.assign(points.size(), false);
  }

  void count(const LineLandmark& face, const core::Pose2& T_map_lidar, FaceEvidence& evidence) {
    face_ = &face;
    const double height_m = face.height_of(T_map_lidar.translation());
    if (height_m <= kOnFace_m || points_.empty()) return;
    const double own_m = face.along_of(T_map_lidar.translation());
    const double normal_rad = face.normal_rad() - T_map_lidar.theta_rad;
    // Bearing of the perpendicular's foot; bearings along the face grow counter-clockwise.
    const double foot_rad = core::normalize_angle(normal_rad + core::kPi);
    const double from_rad = foot_rad + std::atan2(evidence.begin_m() - own_m, height_m);
    const double to_rad = foot_rad + std::atan2(evidence.end_m() - own_m, height_m);
    for (const double rotation_rad : {-core::kTwoPi, 0.0, core::kTwoPi}) {
      const auto first = std::partition_point(
          points_.begin(), points_.end(),
          [&](const DeskewedPoint& point) { return point.bearing_rad < from_rad + rotation_rad; });
      for (auto i = static_cast<std::size_t>(first - points_.begin()); i < points_.size(); ++i) {
        if (points_[i].bearing_rad > to_rad + rotation_rad) break;
        count(i, points_[i].bearing_rad - rotation_rad - foot_rad, height_m, own_m, evidence);
      }
    }
  }

 private:
  void count(std::size_t index, double aside_rad, double height_m, double own_m,
             FaceEvidence& evidence) {
    const DeskewedPoint& point = points_[index];
    const double approach = std::cos(aside_rad);
    if (approach < kMinApproach) return;
    const double across_m = point.range_m * approach - height_m;  // positive behind the face
    const double sigma_m = std::sqrt(noise_.variance_across_m2(point.range_m, approach));
    const double gate_m = kOnFace_m + kRaySigmas * sigma_m;
    if (std::abs(across_m) < gate_m) {
      if (taken_[index]) return;
      const double along_m = own_m + point.range_m * std::sin(aside_rad);
      evidence.add_hit(along_m);
      taken_[index] = along_m > face_->begin_m() && along_m < face_->end_m();
    } else if (across_m > kBehind_m + gate_m) {
      evidence.add_pass(own_m + height_m * std::tan(aside_rad));
    }
  }

  const core::SensorNoise& noise_;
  std::span<const DeskewedPoint> points_;
  std::vector<bool> taken_;  ///< by a face with more observations
  const LineLandmark* face_ = nullptr;
};

}  // namespace

FaceEvidence::FaceEvidence(const LineLandmark& face)
    : begin_m_(face.begin_m() - kBeyond_m),
      cells_(static_cast<std::size_t>(std::ceil((face.length_m() + 2 * kBeyond_m) / kCell_m))) {}

void FaceEvidence::add(double along_m, std::uint32_t Cell::*count) {
  const double cell = (along_m - begin_m_) / kCell_m;
  if (cell >= 0 && cell < static_cast<double>(cells_.size())) {
    ++(cells_[static_cast<std::size_t>(cell)].*count);
  }
}

std::uint32_t FaceEvidence::hits_at(double along_m) const {
  const double cell = (along_m - begin_m_) / kCell_m;
  if (!(cell >= 0 && cell < static_cast<double>(cells_.size()))) return 0;
  return hits(static_cast<std::size_t>(cell));
}

bool FaceEvidence::is_wall(std::size_t cell) const {
  return hits(cell) >= kFewRays && hits(cell) > passes(cell);
}

bool FaceEvidence::is_open(std::size_t cell) const {
  return passes(cell) >= kFewRays && passes(cell) >= hits(cell);
}

double FaceEvidence::open_between(double from_m, double to_m) const {
  if (from_m > to_m) std::swap(from_m, to_m);
  double open_m = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double low_m = std::max(from_m, along_of(i));
    const double high_m = std::min(to_m, along_of(i) + kCell_m);
    if (high_m > low_m && is_open(i)) open_m += high_m - low_m;
  }
  return open_m;
}

std::vector<FaceEvidence> gather_evidence(const MappedDrive& drive, const core::SensorNoise& noise,
                                          const Progress& progress) {
  std::vector<FaceEvidence> evidence(drive.faces.begin(), drive.faces.end());
  // A return counts as a hit of one face only: the one with the most observations.
  std::vector<std::uint32_t> order(drive.faces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return drive.faces[a].observations > drive.faces[b].observations;
  });
  RayCounter rays(noise);
  for (std::size_t scan = 0; scan < drive.T_map_lidar.size(); ++scan) {
    rays.begin(drive.points_of(scan));
    for (const std::uint32_t i : order) {
      rays.count(drive.faces[i], drive.T_map_lidar[scan], evidence[i]);
    }
    if (progress) progress(scan);
  }
  return evidence;
}

}  // namespace cornerd::survey
