// SPDX-License-Identifier: MIT
#include "tool/replay/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numeric>
#include <string_view>

#include "message/line_writer.hpp"
#include "replay/pose_error.hpp"

namespace cornerd::tool {

namespace {

constexpr double kMm = 1e3;

double distance(const core::Pose2& a, const core::Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

double rotation(const core::Pose2& a, const core::Pose2& b) {
  return std::abs(core::angle_between(a.theta_rad, b.theta_rad));
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The smallest value that `share` of the values do not exceed; they are sorted here.
double quantile(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

__attribute__((format(printf, 2, 3))) void append(std::string& out, const char* format, ...) {
  char line[160];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out += line;
}

void append_share(std::string& out, std::string_view name, std::size_t count, std::size_t of) {
  const double percent = of == 0 ? 0 : 100.0 * static_cast<double>(count) / static_cast<double>(of);
  append(out, "%-10.*s %7zu  %5.1f %%\n", static_cast<int>(name.size()), name.data(), count,
         percent);
}

void append_spread(std::string& out, const char* name, std::vector<double> values, double scale,
                   const char* unit) {
  append(out, "%-10s mean %.2f  median %.2f  95 %% %.2f  max %.2f %s\n", name, mean(values) * scale,
         quantile(values, 0.5) * scale, quantile(values, 0.95) * scale, quantile(values, 1) * scale,
         unit);
}

}  // namespace

void ErrorStatistics::add(const core::PoseEstimate& estimate, const core::Pose2& truth) {
  ++scans_;
  ++states_[index(estimate.state)];
  switch (estimate.state) {
    case core::PoseState::kFix:
    case core::PoseState::kTracking:
    case core::PoseState::kPredicted:
      add_pose(estimate, truth);
      break;
    case core::PoseState::kAmbiguous:
      ambiguous_with_truth_ += replay::lists_truth(estimate, truth) ? 1 : 0;
      break;
    case core::PoseState::kLost:
      break;
  }
}

void ErrorStatistics::add_pose(const core::PoseEstimate& estimate, const core::Pose2& truth) {
  const core::Pose2& pose = estimate.T_map_base;
  distances_m_.push_back(distance(pose, truth));
  angles_rad_.push_back(rotation(pose, truth));
  wrong_ += replay::is_right(pose, truth) ? 0 : 1;
  if (const auto nees = replay::normalised_error_squared(estimate, truth)) {
    nees_sum_ += *nees;
    ++nees_count_;
  }
}

double ErrorStatistics::mean_error_m() const { return mean(distances_m_); }

double ErrorStatistics::max_error_m() const {
  return distances_m_.empty() ? 0 : *std::max_element(distances_m_.begin(), distances_m_.end());
}

double ErrorStatistics::mean_nees() const {
  return nees_count_ == 0 ? 0 : nees_sum_ / static_cast<double>(nees_count_);
}

std::string ErrorStatistics::report(std::string_view counted) const {
  std::string out;
  append(out, "%-10.*s %7zu\n", static_cast<int>(counted.size()), counted.data(), scans_);
  for (std::size_t i = 0; i < kStates; ++i) {
    if (states_[i] > 0 || i == index(core::PoseState::kFix)) {
      append_share(out, message::to_string(static_cast<core::PoseState>(i)), states_[i], scans_);
    }
  }
  append_share(out, "wrong", wrong_, scans_);
  out.insert(out.size() - 1, "  (over 100 mm or 5 degrees)");
  if (!distances_m_.empty()) {
    append_spread(out, "position", distances_m_, kMm, "mm");
    append_spread(out, "heading", angles_rad_, core::degrees(1), "degrees");
  }
  if (nees_count_ > 0) {
    // The sum is chi-square with 3 n degrees of freedom: mean 3, variance of the mean 6 / n.
    const double margin = 1.96 * std::sqrt(6 / static_cast<double>(nees_count_));
    append(out, "nees       %.2f  (consistent covariances: %.2f to %.2f)\n", mean_nees(),
           std::max(0.0, 3 - margin), 3 + margin);
  }
  if (const std::size_t ambiguous = count(core::PoseState::kAmbiguous); ambiguous > 0) {
    append(out, "ambiguous  %zu of %zu list the true pose\n", ambiguous_with_truth_, ambiguous);
  }
  if (unknown_ > 0) append(out, "unknown    %zu scans outside the truth's time span\n", unknown_);
  return out;
}

}  // namespace cornerd::tool
