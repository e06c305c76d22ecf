// SPDX-License-Identifier: MIT
// The noise model of El Amin, Priandana and Hardhienata (section V.A): what a lidar that stands in
// front of a straight wall measures, as polynomials of the ray whose coefficients are polynomials
// of the wall's distance, and a normally distributed rest.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace cornerd::calibration {

inline constexpr std::size_t kMostRayOrder = 6;
inline constexpr std::size_t kMostDistanceOrder = 3;
inline constexpr std::size_t kMostWallPieces = 8;

/// What holds for walls between two distances.
struct WallPiece {
  double from_m = 0;
  double to_m = 0;
  double ray_rad = 0;  ///< farthest ray from the wall's normal that was measured
  double sigma_m = 0;  ///< of the rest
  /// [i][j]: of ray^i * distance^j, in radians and metres.
  std::array<std::array<double, kMostDistanceOrder + 1>, kMostRayOrder + 1> coefficients{};
};

/// Pieces in the order of their distance. Beyond the measured rays and distances the nearest that
/// was measured holds.
class WallModel {
 public:
  WallModel() = default;
  explicit WallModel(std::vector<WallPiece> pieces);

  bool empty() const { return pieces_.empty(); }
  const std::vector<WallPiece>& pieces() const { return pieces_; }
  /// True where the model says how large the rest is: to the end of the last piece.
  bool covers(double distance_m) const;

  /// Measured less true range. `ray_rad`: from the wall's normal, counter-clockwise.
  double error_m(double distance_m, double ray_rad) const;
  double sigma_m(double distance_m) const;

 private:
  const WallPiece& piece_at(double distance_m) const;

  std::vector<WallPiece> pieces_;
};

}  // namespace cornerd::calibration
