// SPDX-License-Identifier: MIT
#include "survey/scan_matcher.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/linear_solve.hpp"

namespace cornerd::survey {
namespace {

/// An observation may continue a face across a gap of this length.
constexpr double kMaxGap_m = 0.15;
/// Association gate, beside the search radius.
constexpr double kMatchSigmas = 4;
/// Added to the sigmas: walls are not perfectly straight, and the map is still incomplete.
constexpr double kSlack_m = 0.001;
constexpr double kSlack_rad = core::radians(0.03);
constexpr int kSteps = 8;
/// Share of the samples on lines that must be on known faces.
constexpr double kMinShare = 0.25;
constexpr double kSureSigma_m = 0.05;

struct Deviation {
  double angle_rad;
  double height_m;
  double angle_variance;
  double height_variance;
};

Deviation deviation_of(const LineObservation& seen, const PlacedObservation& placed,
                       const LineLandmark& face) {
  const double along_m = face.along_of(placed.centroid);
  return {core::angle_between(face.normal_rad(), placed.normal_rad),
          face.height_of(placed.centroid),
          squared(seen.sigma_angle_rad) + face.covariance()(0, 0) + squared(kSlack_rad),
          squared(seen.sigma_offset_m) + face.variance_at(along_m) + squared(kSlack_m)};
}

double overlap_of(const PlacedObservation& placed, const LineLandmark& face) {
  const double begin_m = face.along_of(placed.first);
  const double end_m = face.along_of(placed.last);
  return std::min(end_m, face.end_m()) - std::max(begin_m, face.begin_m());
}

std::uint32_t best_face(const LineObservation& seen, const PlacedObservation& placed,
                        std::span<const LineLandmark> faces, const SearchRadius& radius) {
  std::uint32_t best = kNoFace;
  double least = 1;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const LineLandmark& face = faces[i];
    if (face.normal().dot(core::unit_vector(placed.normal_rad)) < 0.7) continue;
    if (overlap_of(placed, face) < -kMaxGap_m - radius.place_m) continue;
    const Deviation off = deviation_of(seen, placed, face);
    const double gate_rad = radius.heading_rad + kMatchSigmas * std::sqrt(off.angle_variance);
    const double gate_m = radius.place_m + kMatchSigmas * std::sqrt(off.height_variance);
    const double cost = squared(off.angle_rad / gate_rad) + squared(off.height_m / gate_m);
    if (cost < least) {
      least = cost;
      best = static_cast<std::uint32_t>(i);
    }
  }
  return best;
}

/// Cauchy weight: a wrong association loses its influence.
double weight_of(const Deviation& off) {
  const double chi2 =
      squared(off.angle_rad) / off.angle_variance + squared(off.height_m) / off.height_variance;
  return 1 / (1 + chi2 / 9);
}

/// Position sigma in the weakest direction, with the heading marginalised out.
double weakest_sigma_m(const Eigen::Matrix3d& information) {
  if (!(information(2, 2) > 0)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d shared = information.block<2, 1>(0, 2);
  const Eigen::Matrix2d place =
      information.topLeftCorner<2, 2>() - shared * shared.transpose() / information(2, 2);
  // The lesser eigenvalue of a symmetric matrix.
  const double least =
      (place(0, 0) + place(1, 1)) / 2 - std::hypot((place(0, 0) - place(1, 1)) / 2, place(0, 1));
  return least > 0 ? 1 / std::sqrt(least) : std::numeric_limits<double>::infinity();
}

}  // namespace

bool ScanMatch::is_constrained() const { return valid && weakest_sigma_m < kSureSigma_m; }

double ScanMatcher::assign(std::span<const LineObservation> observations,
                           std::span<const LineLandmark> faces, const core::Pose2& T_map_lidar,
                           const SearchRadius& radius, std::vector<std::uint32_t>& faces_of) {
  faces_of.clear();
  double matched = 0;
  double all = 0;
  for (const LineObservation& seen : observations) {
    faces_of.push_back(best_face(seen, PlacedObservation(seen, T_map_lidar), faces, radius));
    all += seen.support;
    if (faces_of.back() != kNoFace) matched += seen.support;
  }
  return all > 0 ? matched / all : 0;
}

ScanMatch ScanMatcher::match(std::span<const LineObservation> observations,
                             std::span<const LineLandmark> faces, const core::Pose2& prior,
                             const core::Covariance3& covariance, const SearchRadius& radius,
                             std::vector<std::uint32_t>& faces_of) const {
  ScanMatch result;
  core::Pose2 pose = prior;
  const Eigen::Matrix3d prior_information = core::inverse(covariance);
  Eigen::Matrix3d information = prior_information;
  SearchRadius gate = radius;
  for (int step = 0; step < kSteps; ++step) {
    assign(observations, faces, pose, gate, faces_of);
    const bool rough = gate.place_m > 2 * kExactRadius.place_m;
    information = prior_information;
    const Eigen::Vector3d from_prior(pose.x_m - prior.x_m, pose.y_m - prior.y_m,
                                     core::angle_between(prior.theta_rad, pose.theta_rad));
    Eigen::Vector3d right_hand_side = -prior_information * from_prior;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (faces_of[i] == kNoFace) continue;
      const LineLandmark& face = faces[faces_of[i]];
      const PlacedObservation placed(observations[i], pose);
      if (requires_overlap_ && overlap_of(placed, face) < 0) continue;
      const Deviation off = deviation_of(observations[i], placed, face);
      const double weight = rough ? 1 : weight_of(off);
      const core::Vec2 arm = core::rotate_left(placed.centroid - pose.translation());
      const Eigen::Vector3d jacobian(face.normal().x(), face.normal().y(), face.normal().dot(arm));
      information += weight / off.height_variance * jacobian * jacobian.transpose();
      right_hand_side -= weight / off.height_variance * off.height_m * jacobian;
      information(2, 2) += weight / off.angle_variance;
      right_hand_side[2] -= weight / off.angle_variance * off.angle_rad;
    }
    const Eigen::Vector3d move = core::SymmetricSolver<3>(information).solve(right_hand_side);
    if (!move.allFinite()) return result;
    pose = {pose.x_m + move.x(), pose.y_m + move.y(),
            core::normalize_angle(pose.theta_rad + move.z())};
    gate.place_m = std::max(gate.place_m * 0.5, kExactRadius.place_m);
    gate.heading_rad = std::max(gate.heading_rad * 0.5, kExactRadius.heading_rad);
    if (!rough && move.head<2>().norm() < 1e-5 && std::abs(move.z()) < 1e-6) break;
  }

  result.matched_share = assign(observations, faces, pose, kExactRadius, faces_of);
  result.T_map_lidar = pose;
  result.covariance = core::inverse(information);
  result.weakest_sigma_m = weakest_sigma_m(information - prior_information);
  const double worst_m2 = std::max(result.covariance(0, 0), result.covariance(1, 1));
  result.valid = result.matched_share > kMinShare && worst_m2 < squared(kSureSigma_m);
  return result;
}

}  // namespace cornerd::survey
