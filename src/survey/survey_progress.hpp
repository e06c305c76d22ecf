// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>

#include "survey/drive_mapper.hpp"

namespace cornerd::survey {

/// Called with what is being done, and the share of the whole that is done; which never shrinks.
using SurveyProgress = std::function<void(std::string_view phase, double share)>;

/// Shares the bar among the passes through a drive.
class ProgressShares {
 public:
  ProgressShares(SurveyProgress progress, std::size_t scans)
      : progress_(std::move(progress)), scans_(std::max<std::size_t>(scans, 1)) {}

  /// Of a pass over all turns, from one share of the whole to another. `phase` must outlive it.
  Progress pass(std::string_view phase, double begin, double end) {
    if (!progress_) return {};
    return [this, phase, begin, end](std::size_t scan) {
      const double share =
          begin + (end - begin) * static_cast<double>(scan) / static_cast<double>(scans_);
      most_ = std::max(most_, std::min(share, end));
      progress_(phase, most_);
    };
  }

  /// What is left of the bar, for another survey that begins where this one ends.
  SurveyProgress rest() const {
    if (!progress_) return {};
    return [progress = progress_, done = most_](std::string_view phase, double share) {
      progress(phase, done + (1 - done) * share);
    };
  }

 private:
  SurveyProgress progress_;
  std::size_t scans_;
  double most_ = 0;
};

}  // namespace cornerd::survey
