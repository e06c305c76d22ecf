// SPDX-License-Identifier: MIT
#include "survey/right_angles.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::survey {
namespace {

/// Builders are this exact: what is askew by more is so by intent. And what is known to be askew by
/// this many sigmas is no error of the map.
constexpr double kSquare_rad = core::radians(0.5);
constexpr double kSquareSigmas = 3;
/// What the sightings of a face err by together, however many there are: walls are a little wavy.
constexpr double kWavy_rad = core::radians(0.03);
/// A face that is less certain than this tells of no right angle.
constexpr double kTellingSigma_rad = core::radians(1);
constexpr double kBondSigma_rad = core::radians(0.003);
/// Shorter ones are pieces of furniture as often as walls.
constexpr double kLeast_m = 0.1;

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
    if (face != reference && drive.faces[face].length_m() >= kLeast_m) others.push_back(face);
  }
  const std::vector<double> variances = rotation_variances(drive, reference, others);
  for (std::size_t i = 0; i < others.size(); ++i) {
    const double sigma_rad = std::sqrt(variances[i] + 2 * squared(kWavy_rad));
    const double tolerance_rad = std::min(kSquare_rad, kSquareSigmas * sigma_rad);
    const double rotation_rad = core::angle_between(drive.faces[reference].normal_rad(),
                                                    drive.faces[others[i]].normal_rad());
    const double square_rad = std::round(rotation_rad / (core::kPi / 2)) * (core::kPi / 2);
    if (sigma_rad > kTellingSigma_rad || std::abs(rotation_rad - square_rad) > tolerance_rad) {
      ++result.askew;
      continue;
    }
    FaceBond bond;
    bond.one = reference;
    bond.other = others[i];
    bond.rotation_rad = square_rad;
    bond.sigma_rad = kBondSigma_rad;
    result.bonds.push_back(bond);
  }
  return result;
}

}  // namespace cornerd::survey
