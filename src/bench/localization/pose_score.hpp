// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "bench/localization/reliability.hpp"
#include "core/pose_estimate.hpp"

namespace cornerd::bench {

/// What many turns said of places that are known.
class PoseScore {
 public:
  /// `bound`: the least covariance that this turn allows (CramerRao), zero where nobody asks.
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

  // Of the poses that were named and right.
  double mean_error_m() const;
  double median_error_m() const;
  double rmse_m() const;
  double mean_heading_error_rad() const;
  /// Root mean square error over that of the bound; 0 where no bound was given.
  double of_bound() const;
  double bound_m() const;  ///< root mean square error that the bound allows

  /// Normalised estimation error squared: 3 on average where the covariances are honest, and
  /// under 7.815 in 95 % of the turns. Of all that were named.
  double mean_nees() const;
  double share_inside_95() const;

  /// Of all turns, whether they named a place or doubted.
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
