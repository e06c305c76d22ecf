// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"
#include "message/request.hpp"

namespace cornerd::tool {

/// Where a robot really was, over time: a --truth file.
class Truth {
 public:
  /// Throws Failure where the file cannot be read, has a bad line, or goes back in time.
  static Truth load(const std::filesystem::path& file);
  explicit Truth(std::vector<message::RecordedTruth> points) : points_(std::move(points)) {}

  /// Interpolated, the heading by the shorter way; nullopt before the first point and more than a
  /// scan period (0.2 s) after the last one, as far as which the last one holds.
  std::optional<core::Pose2> at(core::TimeNs t_ns) const;

  const std::vector<message::RecordedTruth>& points() const { return points_; }

 private:
  std::vector<message::RecordedTruth> points_;
};

/// Between two poses, the heading by the shorter way. `share`: 0 at the first, 1 at the second.
core::Pose2 interpolate(const core::Pose2& from, const core::Pose2& to, double share);

}  // namespace cornerd::tool
