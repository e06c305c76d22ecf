// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/pose_estimate.hpp"

namespace cornerd::bench {

/// Reliability diagram of p_wrong over all scans with a fix or alternatives.
class Reliability {
 public:
  struct Bin {
    double min_p_wrong = 0;
    std::size_t scans = 0;
    std::size_t wrong = 0;      ///< scans whose best hypothesis is wrong
    double expected_wrong = 0;  ///< sum of p_wrong: the expected number of wrong ones
  };

  void add(const core::PoseEstimate& estimate, const core::Pose2& truth);
  void add(const Reliability& other);

  /// Ascending by p_wrong.
  const auto& bins() const { return bins_; }

 private:
  std::array<Bin, 6> bins_ = {{{1e-6}, {1e-5}, {1e-4}, {1e-3}, {1e-2}, {1e-1}}};
};

/// Pose estimates against known poses.
class PoseScore {
 public:
  /// `bound`: the scan's Cramer-Rao bound, or zero.
  void add(const core::PoseEstimate& estimate, const core::Pose2& truth,
           const core::Covariance3& bound = core::Covariance3::Zero());

  std::size_t scans() const { return scans_; }
  std::size_t named() const { return named_; }            ///< fix and tracking, right or wrong
  std::size_t right() const { return errors_m_.size(); }  ///< of these
  std::size_t wrong() const { return wrong_; }            ///< of these, and of the predicted
  std::size_t predicted() const { return predicted_; }
  std::size_t ambiguous() const { return ambiguous_; }
  std::size_t ambiguous_with_truth() const { return ambiguous_with_truth_; }
  std::size_t lost() const { return lost_; }

  // Of the named and correct poses.
  double mean_error_m() const;
  double median_error_m() const;
  double rmse_m() const;
  double mean_heading_error_rad() const;
  /// Root mean square error over that of the bound; 0 without a bound.
  double rmse_over_bound() const;
  double bound_m() const;  ///< root mean square error of the bound

  /// Normalised estimation error squared of the named poses: for exact covariances the mean is 3,
  /// and 95 % are below 7.815 (chi-square, 3 degrees of freedom).
  double mean_nees() const;
  double share_inside_95() const;

  /// Of all scans.
  const Reliability& reliability() const { return reliability_; }

 private:
  double per_right(double sum) const;

  std::size_t scans_ = 0;
  std::size_t named_ = 0;
  std::size_t wrong_ = 0;
  std::size_t predicted_ = 0;
  std::size_t ambiguous_ = 0;
  std::size_t ambiguous_with_truth_ = 0;
  std::size_t lost_ = 0;
  std::vector<double> errors_m_;
  double squares_m2_ = 0;
  double bound_m2_ = 0;
  double heading_rad_ = 0;
  double nees_ = 0;
  std::size_t inside_95_ = 0;
  Reliability reliability_;
};

}  // namespace cornerd::bench
