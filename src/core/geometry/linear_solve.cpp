// SPDX-License-Identifier: MIT
#include "core/geometry/linear_solve.hpp"

#include <Eigen/LU>

namespace cornerd::core {

Eigen::Matrix2d inverse(const Eigen::Matrix2d& matrix) { return matrix.inverse(); }
Eigen::Matrix3d inverse(const Eigen::Matrix3d& matrix) { return matrix.inverse(); }

template <int N>
void SymmetricSolver<N>::compute(const Matrix& matrix) {
  factors_.compute(matrix);
}

template <int N>
typename SymmetricSolver<N>::Vector SymmetricSolver<N>::solve(const Vector& right) const {
  return factors_.solve(right);
}

template <int N>
template <int Columns>
Eigen::Matrix<double, N, Columns> SymmetricSolver<N>::solve_columns(
    const Eigen::Matrix<double, N, Columns>& right) const {
  return factors_.solve(right);
}

template <int N>
typename SymmetricSolver<N>::Matrix SymmetricSolver<N>::inverse() const {
  return factors_.solve(Matrix::Identity());
}

Cholesky3::Cholesky3(const Eigen::Matrix3d& matrix) : factors_(matrix) {}

Eigen::Vector3d Cholesky3::solve(const Eigen::Vector3d& right) const {
  return factors_.solve(right);
}

template <int Columns>
Eigen::Matrix<double, 3, Columns> Cholesky3::solve_columns(
    const Eigen::Matrix<double, 3, Columns>& right) const {
  return factors_.solve(right);
}

Eigen::Vector3d Cholesky3::whiten(const Eigen::Vector3d& right) const {
  return factors_.matrixL().solve(right);
}

// The solves in use, and no others: each takes a second to compile.
template void SymmetricSolver<3>::compute(const Matrix&);
template Eigen::Vector3d SymmetricSolver<3>::solve(const Vector&) const;
template Eigen::Matrix3d SymmetricSolver<3>::inverse() const;
template void SymmetricSolver<4>::compute(const Matrix&);
template Eigen::Matrix4d SymmetricSolver<4>::inverse() const;
template void SymmetricSolver<6>::compute(const Matrix&);
template void SymmetricSolver<7>::compute(const Matrix&);
template SymmetricSolver<6>::Vector SymmetricSolver<6>::solve(const Vector&) const;
template SymmetricSolver<7>::Vector SymmetricSolver<7>::solve(const Vector&) const;
template Eigen::Matrix<double, 6, 4> SymmetricSolver<6>::solve_columns(
    const Eigen::Matrix<double, 6, 4>&) const;
template Eigen::Matrix<double, 3, 11> Cholesky3::solve_columns(
    const Eigen::Matrix<double, 3, 11>&) const;

}  // namespace cornerd::core
