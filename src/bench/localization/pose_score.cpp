// SPDX-License-Identifier: MIT
#include "bench/localization/pose_score.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/statistics.hpp"
#include "replay/pose_error.hpp"

namespace cornerd::bench {

void PoseScore::add(const core::PoseEstimate& estimate, const core::Pose2& truth,
                    const core::Covariance3& bound) {
  using core::PoseState;
  ++scans_;
  reliability_.add(estimate, truth);
  const bool right = replay::is_right(estimate.T_map_base, truth);
  switch (estimate.state) {
    case PoseState::kLost:
      ++lost_;
      return;
    case PoseState::kAmbiguous:
      ++ambiguous_;
      ambiguous_with_truth_ += replay::lists_truth(estimate, truth) ? 1 : 0;
      return;
    case PoseState::kPredicted:
      ++predicted_;
      wrong_ += right ? 0 : 1;
      return;
    case PoseState::kFix:
    case PoseState::kTracking:
      ++named_;
      wrong_ += right ? 0 : 1;
  }
  if (const auto nees = replay::normalised_error_squared(estimate, truth)) {
    nees_ += *nees;
    inside_95_ += *nees < replay::kNees95 ? 1 : 0;
  }
  if (!right) return;
  const replay::PoseError error = replay::error_of(estimate.T_map_base, truth);
  errors_m_.push_back(error.position_m);
  squares_m2_ += error.position_m * error.position_m;
  bound_m2_ += bound.topLeftCorner<2, 2>().trace();
  heading_rad_ += error.heading_rad;
}

double PoseScore::per_right(double sum) const {
  return errors_m_.empty() ? 0 : sum / static_cast<double>(errors_m_.size());
}

double PoseScore::mean_error_m() const {
  return per_right(std::accumulate(errors_m_.begin(), errors_m_.end(), 0.0));
}

double PoseScore::median_error_m() const {
  std::vector<double> sorted = errors_m_;
  std::sort(sorted.begin(), sorted.end());
  return quantile(sorted, 0.5);
}

double PoseScore::rmse_m() const { return std::sqrt(per_right(squares_m2_)); }
double PoseScore::bound_m() const { return std::sqrt(per_right(bound_m2_)); }
double PoseScore::mean_heading_error_rad() const { return per_right(heading_rad_); }
double PoseScore::rmse_over_bound() const { return bound_m2_ > 0 ? rmse_m() / bound_m() : 0; }

double PoseScore::mean_nees() const {
  return named_ == 0 ? 0 : nees_ / static_cast<double>(named_);
}

double PoseScore::share_inside_95() const {
  return named_ == 0 ? 0 : static_cast<double>(inside_95_) / static_cast<double>(named_);
}

void Reliability::add(const core::PoseEstimate& estimate, const core::Pose2& truth) {
  const bool is_fix = estimate.state == core::PoseState::kFix;
  if (!is_fix && estimate.alternatives.empty()) return;
  const core::Pose2& first =
      is_fix ? estimate.T_map_base : estimate.alternatives.front().T_map_base;
  Bin* bin = bins_.data();
  for (Bin& each : bins_) {
    if (estimate.p_wrong >= each.min_p_wrong) bin = &each;
  }
  ++bin->scans;
  bin->wrong += replay::is_right(first, truth) ? 0 : 1;
  bin->expected_wrong += estimate.p_wrong;
}

void Reliability::add(const Reliability& other) {
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    bins_[k].scans += other.bins_[k].scans;
    bins_[k].wrong += other.bins_[k].wrong;
    bins_[k].expected_wrong += other.bins_[k].expected_wrong;
  }
}

}  // namespace cornerd::bench
