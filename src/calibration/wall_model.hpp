// SPDX-License-Identifier: MIT
// The noise model of El Amin, Priandana and Hardhienata (section V.A): the range error in front of
// a straight wall as a polynomial of the ray angle, whose coefficients are polynomials of the
// wall's distance, plus Gaussian noise.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace cornerd::calibration {

inline constexpr std::size_t kMaxRayOrder = 6;
inline constexpr std::size_t kMaxDistanceOrder = 3;
inline constexpr std::size_t kMaxWallPieces = 8;

/// The model for walls between two distances.
struct WallPiece {
  double from_m = 0;
  double to_m = 0;
  double ray_rad = 0;  ///< largest measured angle from the wall's normal
  double sigma_m = 0;  ///< of the Gaussian noise
  /// [i][j]: coefficient of ray^i * distance^j, in radians and metres.
  std::array<std::array<double, kMaxDistanceOrder + 1>, kMaxRayOrder + 1> coefficients{};
};

/// Pieces sorted by distance. Rays and distances outside the measured range are clamped to it.
class WallModel {
 public:
  WallModel() = default;
  explicit WallModel(std::vector<WallPiece> pieces);

  bool empty() const { return pieces_.empty(); }
  const std::vector<WallPiece>& pieces() const { return pieces_; }
  /// True up to the end of the last piece.
  bool covers(double distance_m) const;

  /// Measured minus true range. `ray_rad`: from the wall's normal, counter-clockwise.
  double error_m(double distance_m, double ray_rad) const;
  double sigma_m(double distance_m) const;

 private:
  const WallPiece& piece_at(double distance_m) const;

  std::vector<WallPiece> pieces_;
};

/// A return from a wall at a known distance.
struct WallReturn {
  double distance_m = 0;  ///< of the wall: along its normal
  double ray_rad = 0;     ///< from the wall's normal, counter-clockwise
  double error_m = 0;     ///< measured minus true range
};

/// A fitted piece of the model, with the quality of the fit.
struct WallPieceFit {
  WallPiece piece;
  std::size_t ray_order = 0;
  std::size_t distance_order = 0;  ///< lower than the paper's for few distances
  std::size_t distances = 0;
  std::size_t returns = 0;
  double rms_m = 0;           ///< of the errors before the fit
  double beyond_3_sigma = 0;  ///< share of the residuals; 0.0027 for a normal distribution
};

/// Fits the three pieces of the paper by least squares: orders 6 in the ray and 3 in the distance
/// up to 0.6 m, 2 and 3 up to 1 m, 2 and 1 up to 2.25 m. Leaves out pieces without measurements,
/// and residuals beyond four sigmas.
std::vector<WallPieceFit> fit_wall_model(std::span<const WallReturn> returns);

}  // namespace cornerd::calibration
