// SPDX-License-Identifier: MIT
#include "calibration/wall_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "calibration/robust_statistics.hpp"

namespace cornerd::calibration {
namespace {

struct PaperPiece {
  double from_m;
  double to_m;
  std::size_t ray_order;
  std::size_t distance_order;
};
constexpr PaperPiece kPaper[] = {{0, 0.6, 6, 3}, {0.6, 1.0, 2, 3}, {1.0, 2.25, 2, 1}};

/// A polynomial of order 6 has seven coefficients.
constexpr std::size_t kMinPieceReturns = 100;
constexpr double kGate = 4;
constexpr int kRejectRounds = 4;
/// Nearer distances are one: walls are not placed more precisely.
constexpr double kSameDistanceM = 0.002;

std::vector<WallReturn> within(std::span<const WallReturn> returns, const PaperPiece& paper) {
  std::vector<WallReturn> inside;
  // Returns at a border belong to both pieces, which makes them continuous.
  std::copy_if(returns.begin(), returns.end(), std::back_inserter(inside), [&](const auto& each) {
    return each.distance_m >= paper.from_m - kSameDistanceM &&
           each.distance_m <= paper.to_m + kSameDistanceM;
  });
  return inside;
}

std::size_t count_distances(std::span<const WallReturn> returns) {
  std::set<long> distances;
  for (const WallReturn& each : returns) {
    distances.insert(std::lround(each.distance_m / kSameDistanceM));
  }
  return distances.size();
}

/// Normal equations of the scaled powers; memory does not grow with the returns.
class NormalEquations {
 public:
  NormalEquations(const WallPieceFit& fit)
      : fit_(fit),
        columns_(static_cast<Eigen::Index>((fit.ray_order + 1) * (fit.distance_order + 1))),
        matrix_(Eigen::MatrixXd::Zero(columns_, columns_)),
        right_(Eigen::VectorXd::Zero(columns_)),
        row_(columns_) {}

  void add(const WallReturn& each) {
    Eigen::Index column = 0;
    double ray_power = 1;
    for (std::size_t i = 0; i <= fit_.ray_order; ++i) {
      double power = ray_power;
      for (std::size_t j = 0; j <= fit_.distance_order; ++j) {
        row_[column++] = power;
        power *= each.distance_m / fit_.piece.to_m;
      }
      ray_power *= each.ray_rad / fit_.piece.ray_rad;
    }
    matrix_.selfadjointView<Eigen::Lower>().rankUpdate(row_);
    right_ += each.error_m * row_;
  }

  void solve(WallPiece& piece) const {
    const Eigen::VectorXd scaled = matrix_.selfadjointView<Eigen::Lower>().ldlt().solve(right_);
    Eigen::Index column = 0;
    for (std::size_t i = 0; i <= fit_.ray_order; ++i) {
      for (std::size_t j = 0; j <= fit_.distance_order; ++j) {
        const double scale = std::pow(piece.ray_rad, i) * std::pow(piece.to_m, j);
        piece.coefficients[i][j] = scaled[column++] / scale;
      }
    }
  }

 private:
  const WallPieceFit& fit_;
  Eigen::Index columns_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
  Eigen::VectorXd row_;
};

void fit_piece(std::span<const WallReturn> returns, WallPieceFit& fit) {
  double gate_m = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRejectRounds; ++round) {
    NormalEquations equations(fit);
    const WallModel last({fit.piece});
    for (const WallReturn& each : returns) {
      const double rest_m = each.error_m - last.error_m(each.distance_m, each.ray_rad);
      if (std::abs(rest_m) <= gate_m) equations.add(each);
    }
    equations.solve(fit.piece);

    const WallModel model({fit.piece});
    std::vector<double> rests;
    for (const WallReturn& each : returns) {
      rests.push_back(std::abs(each.error_m - model.error_m(each.distance_m, each.ray_rad)));
    }
    gate_m = kGate * kMedianToSigma * median(rests);
    double squares = 0;
    std::size_t kept = 0;
    for (const double rest : rests) {
      if (rest > gate_m) continue;
      squares += rest * rest;
      ++kept;
    }
    fit.piece.sigma_m = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(kept, 1)));
    const auto beyond = std::count_if(rests.begin(), rests.end(),
                                      [&](double rest) { return rest > 3 * fit.piece.sigma_m; });
    fit.beyond_3_sigma = static_cast<double>(beyond) / static_cast<double>(rests.size());
  }
}

}  // namespace

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

std::vector<WallPieceFit> fit_wall_model(std::span<const WallReturn> returns) {
  std::vector<WallPieceFit> fits;
  for (const PaperPiece& paper : kPaper) {
    const std::vector<WallReturn> inside = within(returns, paper);
    if (inside.size() < kMinPieceReturns) continue;
    WallPieceFit fit;
    fit.returns = inside.size();
    fit.distances = count_distances(inside);
    fit.ray_order = paper.ray_order;
    fit.distance_order = std::min(paper.distance_order, fit.distances - 1);
    const auto [nearest, farthest] = std::minmax_element(
        inside.begin(), inside.end(),
        [](const auto& a, const auto& b) { return a.distance_m < b.distance_m; });
    fit.piece.from_m = nearest->distance_m;
    fit.piece.to_m = farthest->distance_m;
    double squares = 0;
    for (const WallReturn& each : inside) {
      fit.piece.ray_rad = std::max(fit.piece.ray_rad, std::abs(each.ray_rad));
      squares += each.error_m * each.error_m;
    }
    // A wall at a border only is in the piece before.
    const bool new_distances = fits.empty() || fit.piece.to_m > fits.back().piece.to_m;
    if (fit.piece.ray_rad <= 0 || !new_distances) continue;
    fit.rms_m = std::sqrt(squares / static_cast<double>(inside.size()));
    fit_piece(inside, fit);
    fits.push_back(fit);
  }
  return fits;
}

}  // namespace cornerd::calibration
