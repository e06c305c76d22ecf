// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "core/pose_estimate.hpp"
#include "core/types.hpp"

namespace cornerd::daemon {

/// What the log says of poses: the first one, a loss that lasts, and the end of such a loss; at
/// most two lines for each loss of 10 s.
class PoseLog {
 public:
  static constexpr core::TimeNs kLoss_ns = 10 * core::kNsPerSecond;

  /// Adds the pose of a scan; `t_ns`: its time on a clock without steps. Returns a line for the
  /// log.
  std::optional<std::string> add(const core::PoseEstimate& pose, core::TimeNs t_ns);

 private:
  bool had_fix_ = false;
  bool said_lost_ = false;
  std::optional<core::TimeNs> since_ns_;  ///< first of the scans without a pose, until now
};

}  // namespace cornerd::daemon
