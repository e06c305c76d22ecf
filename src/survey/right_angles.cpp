// SPDX-License-Identifier: MIT
#include "survey/right_angles.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::survey {
namespace {

/// Builders are this exact, and what is known of a face may be off by so many sigmas.
constexpr double kSquare_rad = core::radians(0.5);
constexpr double kSquareSigmas = 3;
/// A face that is less certain than this tells of no right angle.
constexpr double kTellingSigma_rad = core::radians(1);
constexpr double kBondSigma_rad = core::radians(0.003);
/// Shorter ones are pieces of furniture as often as walls.
constexpr double kLeast_m = 0.1;

}  // namespace

std::vector<FaceBond> right_angles(const MappedDrive& drive) {
  std::vector<FaceBond> bonds;
  if (drive.faces.empty()) return bonds;
  const auto longest = std::max_element(
      drive.faces.begin(), drive.faces.end(),
      [](const MappedFace& a, const MappedFace& b) { return a.length_m() < b.length_m(); });
  const auto reference = static_cast<std::uint32_t>(longest - drive.faces.begin());
  for (std::uint32_t i = 0; i < drive.faces.size(); ++i) {
    const MappedFace& face = drive.faces[i];
    const double sigma_rad = std::sqrt(face.covariance()(0, 0) + longest->covariance()(0, 0));
    if (i == reference || face.length_m() < kLeast_m || sigma_rad > kTellingSigma_rad) continue;
    const double turn_rad = core::angle_between(longest->normal_rad(), face.normal_rad());
    const double square_rad = std::round(turn_rad / (core::kPi / 2)) * (core::kPi / 2);
    if (std::abs(turn_rad - square_rad) > kSquare_rad + kSquareSigmas * sigma_rad) continue;
    FaceBond bond;
    bond.one = reference;
    bond.other = i;
    bond.turn_rad = square_rad;
    bond.sigma_rad = kBondSigma_rad;
    bonds.push_back(bond);
  }
  return bonds;
}

}  // namespace cornerd::survey
