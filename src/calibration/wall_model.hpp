// SPDX-License-Identifier: MIT
// The noise model of El Amin, Priandana and Hardhienata (section V.A): what a lidar that stands in
// front of a straight wall measures, as polynomials of the ray whose coefficients are polynomials
// of the wall's distance, and a normally distributed rest.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace cornerd::calibration {

inline constexpr std::size_t kMaxRayOrder = 6;
inline constexpr std::size_t kMaxDistanceOrder = 3;
inline constexpr std::size_t kMaxWallPieces = 8;

/// What holds for walls between two distances.
struct WallPiece {
  double from_m = 0;
  double to_m = 0;
  double ray_rad = 0;  ///< farthest ray from the wall's normal that was measured
  double sigma_m = 0;  ///< of the rest
  /// [i][j]: of ray^i * distance^j, in radians and metres.
  std::array<std::array<double, kMaxDistanceOrder + 1>, kMaxRayOrder + 1> coefficients{};
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

/// A return of a wall whose distance is known.
struct WallReturn {
  double distance_m = 0;  ///< of the wall: along its normal
  double ray_rad = 0;     ///< from the wall's normal, counter-clockwise
  double error_m = 0;     ///< measured less true range
};

/// One piece of the model, and how well it was told.
struct WallPieceFit {
  WallPiece piece;
  std::size_t ray_order = 0;
  std::size_t distance_order = 0;  ///< lower than the paper's where too few distances were measured
  std::size_t distances = 0;
  std::size_t returns = 0;
  double rms_m = 0;           ///< of the errors, before anything is fitted
  double beyond_3_sigma = 0;  ///< share of the rest; 0.0027 of a normal distribution
};

/// The three pieces of the paper, less those without measurements: to 0.6 m of order 6 in the ray
/// and 3 in the distance, to 1 m of orders 2 and 3, to 2.25 m of orders 2 and 1. Least squares over
/// all returns of a piece at once; what lies off by more than four sigmas is left out.
std::vector<WallPieceFit> fit_wall_model(std::span<const WallReturn> returns);

}  // namespace cornerd::calibration
