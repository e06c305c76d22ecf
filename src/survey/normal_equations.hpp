// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace cornerd::survey {

/// The normal equations of least squares, sparse. The lower triangle is kept.
class NormalEquations {
 public:
  explicit NormalEquations(int size) : pull_(Eigen::VectorXd::Zero(size)) {}

  /// One residual, with the unknowns that it depends on. Unknown -1 is fixed.
  template <std::size_t N>
  void add(const std::array<int, N>& unknowns, const std::array<double, N>& slope, double residual,
           double weight) {
    for (std::size_t i = 0; i < N; ++i) {
      if (unknowns[i] < 0) continue;
      pull_[unknowns[i]] -= weight * slope[i] * residual;
      for (std::size_t j = 0; j < N; ++j) {
        if (unknowns[j] < 0 || unknowns[j] > unknowns[i]) continue;
        entries_.emplace_back(unknowns[i], unknowns[j], weight * slope[i] * slope[j]);
      }
    }
  }

  /// A little stiffness for what nothing ties down.
  void hold(double weight) {
    for (int i = 0; i < pull_.size(); ++i) entries_.emplace_back(i, i, weight);
  }

  /// What the residuals pull the unknowns to.
  const Eigen::VectorXd& pull() const { return pull_; }

  /// Solves for any right-hand sides, a column each; empty where that cannot be done.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  Eigen::VectorXd pull_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace cornerd::survey
