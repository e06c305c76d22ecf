// SPDX-License-Identifier: MIT
// Inverses and factorizations of small dense matrices, instantiated once for all layers: each file
// that instantiates Eigen's own takes seconds longer to compile.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace cornerd::core {

/// Not finite where the matrix is singular.
Eigen::Matrix2d inverse(const Eigen::Matrix2d& matrix);
Eigen::Matrix3d inverse(const Eigen::Matrix3d& matrix);

inline double determinant(const Eigen::Matrix2d& matrix) {
  return matrix(0, 0) * matrix(1, 1) - matrix(1, 0) * matrix(0, 1);
}

/// P^T L D L^T P of a symmetric matrix (Eigen::LDLT). Only its lower triangle is read. The sizes in
/// use are instantiated at the end of linear_solve.cpp.
template <int N>
class SymmetricSolver {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  SymmetricSolver() = default;
  explicit SymmetricSolver(const Matrix& matrix) { compute(matrix); }

  void compute(const Matrix& matrix);
  bool succeeded() const { return factors_.info() == Eigen::Success; }
  bool is_positive() const { return factors_.isPositive(); }
  /// The diagonal of D.
  Vector pivots() const { return factors_.vectorD(); }
  Vector solve(const Vector& right) const;
  template <int Columns>
  Eigen::Matrix<double, N, Columns> solve_columns(
      const Eigen::Matrix<double, N, Columns>& right) const;
  Matrix inverse() const;

 private:
  Eigen::LDLT<Matrix> factors_;
};

/// L L^T of a positive definite matrix (Eigen::LLT). Only its lower triangle is read.
class Cholesky3 {
 public:
  explicit Cholesky3(const Eigen::Matrix3d& matrix);

  /// False where the matrix is not positive definite.
  bool succeeded() const { return factors_.info() == Eigen::Success; }
  Eigen::Vector3d solve(const Eigen::Vector3d& right) const;
  template <int Columns>
  Eigen::Matrix<double, 3, Columns> solve_columns(
      const Eigen::Matrix<double, 3, Columns>& right) const;
  /// L^-1 * right: of unit covariance where `matrix` is the covariance of `right`.
  Eigen::Vector3d whiten(const Eigen::Vector3d& right) const;

 private:
  Eigen::LLT<Eigen::Matrix3d> factors_;
};

}  // namespace cornerd::core
