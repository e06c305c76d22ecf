// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "core/types.hpp"
#include "replay/simulator/simulated_odometry.hpp"
#include "settings/config.hpp"

namespace cornerd::tool {

class Command;

/// Options of a simulated robot's wheels and gyro, with their errors.
struct OdometryOptions {
  bool enabled = false;
  std::string wheel_errors;  ///< "LEFT,RIGHT"
  std::string covered;       ///< "FROM,TO"
  bool no_gyro = false;
  replay::RobotModel model;

  void add_to(Command& command);

  /// nullopt without --odometry. The geometry comes from the config. Throws UsageError.
  std::optional<replay::RobotModel> robot(const settings::OdometryConfig& config) const;
  struct Times {
    core::TimeNs from_ns = 0;
    core::TimeNs to_ns = 0;
  };
  /// Throws UsageError.
  Times covered_times() const;
};

}  // namespace cornerd::tool
