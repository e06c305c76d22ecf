// SPDX-License-Identifier: MIT
#include "survey/normal_equations.hpp"

#include <Eigen/SparseCholesky>

namespace cornerd::survey {

Eigen::MatrixXd NormalEquations::solve(const Eigen::MatrixXd& right) const {
  Eigen::SparseMatrix<double> matrix(right_hand_side_.size(), right_hand_side_.size());
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
  if (solver.info() != Eigen::Success) return {};
  const Eigen::MatrixXd solution = solver.solve(right);
  if (solver.info() != Eigen::Success || !solution.allFinite()) return {};
  return solution;
}

}  // namespace cornerd::survey
