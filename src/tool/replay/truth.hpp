// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"
#include "message/request.hpp"

namespace cornerd::tool {

/// True poses over time: a --truth file.
class Truth {
 public:
  /// Throws Failure if the file cannot be read, has a bad line or goes back in time.
  static Truth load(const std::filesystem::path& file);
  explicit Truth(std::vector<message::RecordedTruth> points) : points_(std::move(points)) {}

  /// Interpolated pose; nullopt before the first point and more than 0.2 s after the last.
  std::optional<core::Pose2> at(core::TimeNs t_ns) const;

  const std::vector<message::RecordedTruth>& points() const { return points_; }

 private:
  std::vector<message::RecordedTruth> points_;
};

/// Interpolates, the heading by the smaller angle. `share`: 0 at the first, 1 at the second pose.
core::Pose2 interpolate(const core::Pose2& from, const core::Pose2& to, double share);

}  // namespace cornerd::tool
