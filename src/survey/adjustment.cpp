// SPDX-License-Identifier: MIT
#include "survey/adjustment.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

namespace cornerd::survey {
namespace {

constexpr int kMaxSteps = 15;
/// The first steps let what is far off pull as well: walls that were mapped twice and are one now
/// bring the poses together. From step to step that is less.
constexpr double kFirstLeniency = 256;
constexpr double kLeniencyShare = 0.25;
/// Steps smaller than this are the end.
constexpr double kStill_m = 2e-6;
/// Chi-square (two degrees of freedom) at which an observation counts half.
constexpr double kHalfWeight = 9;
/// A link that the walls contradict as much counts half: a slip of the wheels.
constexpr double kHalfLink = 9;

/// The normal equations, of which the lower triangle is kept.
class Equations {
 public:
  explicit Equations(std::size_t size) : pull_(Eigen::VectorXd::Zero(signed_of(size))) {}

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
  void hold(int unknown, double weight) { entries_.emplace_back(unknown, unknown, weight); }

  bool solve(Eigen::VectorXd& move) {
    Eigen::SparseMatrix<double> matrix(pull_.size(), pull_.size());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
    if (solver.info() != Eigen::Success) return false;
    move = solver.solve(pull_);
    return solver.info() == Eigen::Success && move.allFinite();
  }

 private:
  static Eigen::Index signed_of(std::size_t size) { return static_cast<Eigen::Index>(size); }
  Eigen::VectorXd pull_;
  std::vector<Eigen::Triplet<double>> entries_;
};

class Adjustment {
 public:
  Adjustment(MappedDrive& drive, std::span<const FaceBond> bonds)
      : drive_(drive),
        bonds_(bonds),
        first_face_(3 * (static_cast<int>(drive.T_map_lidar.size()) - 1)),
        information_(drive.faces.size(), Eigen::Matrix2d::Zero()) {}

  AdjustmentResult run() {
    for (result_.steps = 1; result_.steps <= kMaxSteps; ++result_.steps) {
      Equations equations(static_cast<std::size_t>(first_face_) + 2 * drive_.faces.size());
      chi_square_ = 0;
      result_.outliers = 0;
      leniency_ = std::max(1.0, kFirstLeniency * std::pow(kLeniencyShare, result_.steps - 1));
      std::fill(information_.begin(), information_.end(), Eigen::Matrix2d::Zero());
      for (const Observation& observation : drive_.observations) add(observation, equations);
      for (std::size_t turn = 1; turn < drive_.links.size(); ++turn) add_link(turn, equations);
      for (const FaceBond& bond : bonds_) add_bond(bond, equations);
      for (int i = 0; i < first_face_; ++i) equations.hold(i, 1e-3);
      for (std::size_t i = 0; i < 2 * drive_.faces.size(); ++i) {
        equations.hold(first_face_ + static_cast<int>(i), 1e-3);
      }
      Eigen::VectorXd move;
      if (!equations.solve(move) || (apply(move) < kStill_m && leniency_ <= 1)) break;
    }
    for (std::size_t i = 0; i < drive_.faces.size(); ++i) {
      if (information_[i].determinant() > 0) {
        drive_.faces[i].set_covariance(information_[i].inverse());
      }
    }
    const double count = static_cast<double>(2 * drive_.observations.size());
    result_.sigma = count > 0 ? std::sqrt(chi_square_ / count) : 0;
    return result_;
  }

 private:
  int pose_unknown(std::size_t turn) const { return 3 * (static_cast<int>(turn) - 1); }
  int face_unknown(std::size_t face) const { return first_face_ + 2 * static_cast<int>(face); }
  static int or_fixed(int unknown, int part) { return unknown < 0 ? -1 : unknown + part; }

  void add(const Observation& observation, Equations& equations) {
    const core::Pose2& T_map_lidar = drive_.T_map_lidar[observation.turn];
    const MappedFace& face = drive_.faces[observation.face];
    const Sighting& seen = observation.seen;
    const core::Vec2 arm = T_map_lidar * seen.centroid - T_map_lidar.translation();
    const core::Vec2 centroid = T_map_lidar.translation() + arm;
    const double angle_rad =
        core::angle_between(face.normal_rad(), seen.normal_rad + T_map_lidar.theta_rad);
    const double height_m = face.height_of(centroid);
    const double angle_weight = 1 / (seen.sigma_angle_rad * seen.sigma_angle_rad);
    const double height_weight = 1 / (seen.sigma_offset_m * seen.sigma_offset_m);
    const double chi2 = angle_rad * angle_rad * angle_weight + height_m * height_m * height_weight;
    const double weight = 1 / (1 + chi2 / (kHalfWeight * leniency_));
    chi_square_ += std::min(chi2, kHalfWeight);
    if (chi2 > kHalfWeight) ++result_.outliers;

    const int pose = pose_unknown(observation.turn);
    const int line = face_unknown(observation.face);
    equations.add<2>({or_fixed(pose, 2), line}, {1, -1}, angle_rad, weight * angle_weight);
    const core::Vec2& normal = face.normal();
    const double along_m = face.along_of(centroid);
    equations.add<5>({or_fixed(pose, 0), or_fixed(pose, 1), or_fixed(pose, 2), line, line + 1},
                     {normal.x(), normal.y(), normal.dot(core::rotate_left(arm)), -along_m, -1},
                     height_m, weight * height_weight);

    Eigen::Matrix2d& known = information_[observation.face];
    const Eigen::Vector2d slope(along_m, 1);
    known += weight * height_weight * slope * slope.transpose();
    known(0, 0) += weight * angle_weight;
  }

  void add_link(std::size_t turn, Equations& equations) {
    const DriveLink& link = drive_.links[turn];
    const core::Pose2& before = drive_.T_map_lidar[turn - 1];
    const core::Pose2& now = drive_.T_map_lidar[turn];
    const core::Pose2 way = before.inverse() * now;
    const double c = std::cos(before.theta_rad);
    const double s = std::sin(before.theta_rad);
    const std::array<double, 3> off = {
        way.x_m - link.T_before_now.x_m, way.y_m - link.T_before_now.y_m,
        core::angle_between(link.T_before_now.theta_rad, way.theta_rad)};
    double chi2 = 0;
    for (int i = 0; i < 3; ++i) {
      const double residual = off[static_cast<std::size_t>(i)];
      chi2 += residual * residual / link.covariance(i, i);
    }
    const double weight = 1 / (1 + chi2 / kHalfLink);
    const int a = pose_unknown(turn - 1);
    const int b = pose_unknown(turn);
    const std::array<int, 6> unknowns = {or_fixed(a, 0), or_fixed(a, 1), or_fixed(a, 2),
                                         or_fixed(b, 0), or_fixed(b, 1), or_fixed(b, 2)};
    equations.add<6>(unknowns, {-c, -s, way.y_m, c, s, 0}, off[0], weight / link.covariance(0, 0));
    equations.add<6>(unknowns, {s, -c, -way.x_m, -s, c, 0}, off[1], weight / link.covariance(1, 1));
    equations.add<6>(unknowns, {0, 0, -1, 0, 0, 1}, off[2], weight / link.covariance(2, 2));
  }

  void add_bond(const FaceBond& bond, Equations& equations) {
    const MappedFace& one = drive_.faces[bond.one];
    const MappedFace& other = drive_.faces[bond.other];
    const int a = face_unknown(bond.one);
    const int b = face_unknown(bond.other);
    const double turn_rad =
        core::angle_between(one.normal_rad() + bond.turn_rad, other.normal_rad());
    const double angle_weight = 1 / (bond.sigma_rad * bond.sigma_rad);
    equations.add<2>({a, b}, {-1, 1}, turn_rad, angle_weight);
    if (!bond.on_one_line) return;
    // The middle of `other` lies on `one`: height of a point of the other's line over the first.
    const double other_along_m = (other.begin_m() + other.end_m()) / 2;
    const core::Vec2 middle = other.at(other_along_m);
    equations.add<4>({a, a + 1, b, b + 1}, {-one.along_of(middle), -1, other_along_m, 1},
                     one.height_of(middle), 1 / (bond.sigma_m * bond.sigma_m));
  }

  /// Returns the largest way of a pose.
  double apply(const Eigen::VectorXd& move) {
    double largest_m = 0;
    for (std::size_t turn = 1; turn < drive_.T_map_lidar.size(); ++turn) {
      const Eigen::Vector3d step = move.segment<3>(pose_unknown(turn));
      core::Pose2& pose = drive_.T_map_lidar[turn];
      pose = {pose.x_m + step.x(), pose.y_m + step.y(),
              core::normalize_angle(pose.theta_rad + step.z())};
      largest_m = std::max(largest_m, step.head<2>().norm());
    }
    for (std::size_t i = 0; i < drive_.faces.size(); ++i) {
      const Eigen::Vector2d step = move.segment<2>(face_unknown(i));
      MappedFace& face = drive_.faces[i];
      face.set_line(face.normal_rad() + step[0], face.offset_m() + step[1]);
    }
    return largest_m;
  }

  MappedDrive& drive_;
  std::span<const FaceBond> bonds_;
  int first_face_;
  std::vector<Eigen::Matrix2d> information_;
  double chi_square_ = 0;
  double leniency_ = 1;
  AdjustmentResult result_;
};

}  // namespace

AdjustmentResult adjust(MappedDrive& drive, std::span<const FaceBond> bonds) {
  if (drive.T_map_lidar.size() < 2) return {};
  return Adjustment(drive, bonds).run();
}

}  // namespace cornerd::survey
