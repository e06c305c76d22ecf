// SPDX-License-Identifier: MIT
#include "calibration/wall_model.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cornerd::calibration {

WallModel::WallModel(std::vector<WallPiece> pieces) : pieces_(std::move(pieces)) {}

bool WallModel::covers(double distance_m) const {
  return !empty() && distance_m <= pieces_.back().to_m;
}

const WallPiece& WallModel::piece_at(double distance_m) const {
  const auto piece = std::find_if(pieces_.begin(), pieces_.end(), [distance_m](const auto& each) {
    return distance_m <= each.to_m;
  });
  if (piece == pieces_.end()) return pieces_.back();
  if (piece == pieces_.begin() || distance_m >= piece->from_m) return *piece;
  const WallPiece& nearer = *std::prev(piece);
  return distance_m - nearer.to_m < piece->from_m - distance_m ? nearer : *piece;
}

double WallModel::error_m(double distance_m, double ray_rad) const {
  if (empty()) return 0;
  const WallPiece& piece = piece_at(distance_m);
  const double distance = std::clamp(distance_m, piece.from_m, piece.to_m);
  const double ray = std::clamp(ray_rad, -piece.ray_rad, piece.ray_rad);
  double error = 0;
  for (auto row = piece.coefficients.rbegin(); row != piece.coefficients.rend(); ++row) {
    double coefficient = 0;
    for (auto each = row->rbegin(); each != row->rend(); ++each) {
      coefficient = coefficient * distance + *each;
    }
    error = error * ray + coefficient;
  }
  return error;
}

double WallModel::sigma_m(double distance_m) const {
  return empty() ? 0 : piece_at(distance_m).sigma_m;
}

}  // namespace cornerd::calibration
