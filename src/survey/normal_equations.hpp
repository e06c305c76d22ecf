// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace cornerd::survey {

/// Sparse normal equations of least squares. Stores the lower triangle.
class NormalEquations {
 public:
  explicit NormalEquations(int size) : right_hand_side_(Eigen::VectorXd::Zero(size)) {}

  /// Adds a residual and its Jacobian row over `unknowns`; -1 is fixed.
  template <std::size_t N>
  void add(const std::array<int, N>& unknowns, const std::array<double, N>& jacobian,
           double residual, double weight) {
    for (std::size_t i = 0; i < N; ++i) {
      if (unknowns[i] < 0) continue;
      right_hand_side_[unknowns[i]] -= weight * jacobian[i] * residual;
      for (std::size_t j = 0; j < N; ++j) {
        if (unknowns[j] < 0 || unknowns[j] > unknowns[i]) continue;
        entries_.emplace_back(unknowns[i], unknowns[j], weight * jacobian[i] * jacobian[j]);
      }
    }
  }

  /// Adds `weight` to the diagonal; keeps unobservable unknowns at their value.
  void add_damping(double weight) {
    for (int i = 0; i < right_hand_side_.size(); ++i) entries_.emplace_back(i, i, weight);
  }

  /// The negative gradient.
  const Eigen::VectorXd& right_hand_side() const { return right_hand_side_; }

  /// Solves for the columns of `right`. Empty where the factorisation fails.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  Eigen::VectorXd right_hand_side_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace cornerd::survey
