// SPDX-License-Identifier: MIT
#include "core/estimate/face_offsets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/linear_solve.hpp"
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

double shown_direction_share(std::span<const FaceResidual> residuals, const WallMap& map,
                             double sigma_m, const Eigen::Matrix3d& information,
                             const Eigen::Vector3d& gradient) {
  constexpr std::array kShares{0.0, 1 / 64.0, 1 / 16.0, 1 / 4.0, 1.0};
  // Of the heading, the place marginalised: what directions take is of the heading alone.
  const Eigen::Vector2d cross = information.topRightCorner<2, 1>();
  const Eigen::Vector2d by_place =
      inverse(Eigen::Matrix2d(information.topLeftCorner<2, 2>())) * cross;
  const double heading_weight = information(2, 2) - by_place.dot(cross);
  const double heading = gradient.z() - by_place.dot(gradient.head<2>());
  const auto log_likelihood = [&](double share) {
    double reduced_weight = heading_weight;
    double reduced = heading;
    double chi_square = 0;
    double log_determinant = 0;
    for (const FaceResidual& face : residuals) {
      const double face_sigma_m = std::max(sigma_m, map.faces()[face.face].sigma_m);
      const double variance = share * face.direction_variance(face_sigma_m);
      const LineSums::Eliminated eliminated = face.eliminate_direction(variance);
      reduced_weight -= eliminated.information;
      reduced -= eliminated.gradient;
      chi_square -= eliminated.chi_square;
      log_determinant += std::log1p(variance * face.direction_weight());
    }
    chi_square -= squared(reduced) / reduced_weight;
    return -(chi_square + log_determinant + std::log(reduced_weight)) / 2;
  };
  std::array<double, kShares.size()> nats{};
  std::transform(kShares.begin(), kShares.end(), nats.begin(), log_likelihood);
  const double most = *std::max_element(nats.begin(), nats.end());
  double sum = 0;
  double mean = 0;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    const double likelihood = std::exp(nats[i] - most);
    sum += likelihood;
    mean += kShares[i] * likelihood;
  }
  return sum > 0 ? mean / sum : 0;
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
      line->add({face.weight, side * face.lever, face.lever_squared, side * face.distance,
                 face.distance_lever});
      line->length_m = std::max(line->length_m, face.length_m);
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
