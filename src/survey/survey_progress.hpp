// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>

#include "survey/drive_mapper.hpp"

namespace cornerd::survey {

/// Called with the current phase and the share of the whole that is done, which never decreases.
using SurveyProgress = std::function<void(std::string_view phase, double share)>;

/// Divides the progress bar among the passes through a drive.
class ProgressShares {
 public:
  ProgressShares(SurveyProgress progress, std::size_t scans)
      : progress_(std::move(progress)), scans_(std::max<std::size_t>(scans, 1)) {}

  /// For a pass over all scans, from one share of the whole to another. `phase` must outlive it.
  Progress pass(std::string_view phase, double begin, double end) {
    if (!progress_) return {};
    return [this, phase, begin, end](std::size_t scan) {
      const double share =
          begin + (end - begin) * static_cast<double>(scan) / static_cast<double>(scans_);
      most_ = std::max(most_, std::min(share, end));
      progress_(phase, most_);
    };
  }

  /// The rest of the bar, for another survey that replaces this one.
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
