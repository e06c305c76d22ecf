// SPDX-License-Identifier: MIT
#include "survey/right_angles.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::survey {
namespace {

/// Building tolerance: a larger angle is intended. An angle beyond kSquareSigmas is no map error.
constexpr double kSquare_rad = core::radians(0.5);
constexpr double kSquareSigmas = 3;
/// Angle error that all observations of a face share: walls are not perfectly straight.
constexpr double kWavy_rad = core::radians(0.03);
/// Largest angle sigma of a face that gets a constraint.
constexpr double kMaxFaceSigma_rad = core::radians(1);
constexpr double kConstraintSigma_rad = core::radians(0.003);
/// Shorter faces are furniture as often as walls.
constexpr double kMin_m = 0.1;

}  // namespace

RightAngles right_angles(const MappedDrive& drive, std::span<const std::uint32_t> faces) {
  RightAngles result;
  if (faces.empty()) return result;
  const std::uint32_t reference =
      *std::max_element(faces.begin(), faces.end(), [&](std::uint32_t a, std::uint32_t b) {
        return drive.faces[a].length_m() < drive.faces[b].length_m();
      });
  std::vector<std::uint32_t> others;
  for (const std::uint32_t face : faces) {
    if (face != reference && drive.faces[face].length_m() >= kMin_m) others.push_back(face);
  }
  const std::vector<double> variances = rotation_variances(drive, reference, others);
  for (std::size_t i = 0; i < others.size(); ++i) {
    const double sigma_rad = std::sqrt(variances[i] + 2 * squared(kWavy_rad));
    const double tolerance_rad = std::min(kSquare_rad, kSquareSigmas * sigma_rad);
    const double rotation_rad = core::angle_between(drive.faces[reference].normal_rad(),
                                                    drive.faces[others[i]].normal_rad());
    const double square_rad = std::round(rotation_rad / (core::kPi / 2)) * (core::kPi / 2);
    if (sigma_rad > kMaxFaceSigma_rad || std::abs(rotation_rad - square_rad) > tolerance_rad) {
      ++result.askew;
      continue;
    }
    FaceConstraint constraint;
    constraint.one = reference;
    constraint.other = others[i];
    constraint.rotation_rad = square_rad;
    constraint.sigma_rad = kConstraintSigma_rad;
    result.constraints.push_back(constraint);
  }
  return result;
}

}  // namespace cornerd::survey
