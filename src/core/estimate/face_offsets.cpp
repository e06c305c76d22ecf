// SPDX-License-Identifier: MIT
#include "core/estimate/face_offsets.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// A scan sees few walls: what the map says of their offsets counts as much as two of them.
constexpr double kPriorFaces = 2;
/// Faces that are farther off, by this standard deviation, are other things than the map's.
constexpr double kMostOff_m = 0.05;

/// Walls in a line are measured, or drawn, together or each by itself: poses are as uncertain as if
/// together. The sides of a wall are apart by its thickness.
bool are_in_line(const Face& one, const Face& other) {
  constexpr double kApart_m = 0.15;
  constexpr double kCosine = 0.999;
  const double cosine = one.normal.dot(other.normal);
  return std::abs(cosine) > kCosine &&
         std::abs(one.offset_m - (cosine > 0 ? 1 : -1) * other.offset_m) < kApart_m;
}

}  // namespace

double sigma_of_offsets(std::span<const FaceResidual> residuals, const WallMap& map,
                        double stated_m, double sigma_m) {
  double variance = kPriorFaces * squared(stated_m);
  std::size_t lines = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const FaceResidual& face = residuals[i];
    // Mean and variance of its offset, given its points.
    const double share = 1 / (face.weight + 1 / squared(sigma_m));
    variance += squared(share * face.distance) + share;
    lines += std::none_of(residuals.begin(), residuals.begin() + static_cast<std::ptrdiff_t>(i),
                          [&](const FaceResidual& other) {
                            return are_in_line(map.faces()[other.face], map.faces()[face.face]);
                          });
  }
  // The pose takes three lines.
  const double free_share = lines > 3 ? 1 - 3.0 / static_cast<double>(lines) : 0;
  const double faces = kPriorFaces + free_share * static_cast<double>(residuals.size());
  return std::min(std::sqrt(variance / faces), std::max(kMostOff_m, stated_m));
}

void merge_by_line(std::vector<FaceResidual>& residuals, const WallMap& map) {
  auto lines = residuals.begin();
  for (const FaceResidual& face : residuals) {
    const auto line = std::find_if(residuals.begin(), lines, [&](const FaceResidual& other) {
      return are_in_line(map.faces()[other.face], map.faces()[face.face]);
    });
    if (line == lines) {
      *lines++ = face;
    } else {
      const double side = std::copysign(1.0, line->normal.dot(face.normal));
      const Vec2 normals = line->weight * line->normal + side * face.weight * face.normal;
      line->add({face.face, face.normal, face.weight, side * face.lever, side * face.distance});
      if (line->weight > 0) line->normal = normals / line->weight;
    }
  }
  residuals.erase(lines, residuals.end());
}

Covariance3 variance_of_lines(std::span<const FaceResidual> residuals, const WallMap& map,
                              double sigma_m) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const auto by_offset = [&](const FaceResidual& face) -> Eigen::Vector3d {
    return face.gradient() / (1 + squared(sigma_m) * face.weight);
  };
  for (auto one = residuals.begin(); one != residuals.end(); ++one) {
    for (auto other = residuals.begin(); other != one; ++other) {
      if (!are_in_line(map.faces()[one->face], map.faces()[other->face])) continue;
      const double variance = std::copysign(squared(sigma_m), one->normal.dot(other->normal));
      const Eigen::Matrix3d product = variance * by_offset(*one) * by_offset(*other).transpose();
      sum += product + product.transpose();
    }
  }
  return sum;
}

}  // namespace cornerd::core
