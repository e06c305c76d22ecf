// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "core/types.hpp"
#include "replay/simulator/simulated_odometry.hpp"
#include "settings/config.hpp"

namespace cornerd::tool {

class Command;

/// What a simulated robot's wheels and gyro tell, and how wrong they are.
struct OdometryOptions {
  bool enabled = false;
  std::string wheel_errors;  ///< "LEFT,RIGHT"
  std::string covered;       ///< "FROM,TO"
  bool no_gyro = false;
  replay::RobotModel model;

  void add_to(Command& command);

  /// nullopt where no odometry is asked for. The geometry is the config's. Throws UsageError.
  std::optional<replay::RobotModel> robot(const settings::OdometryConfig& config) const;
  struct Times {
    core::TimeNs from_ns = 0;
    core::TimeNs to_ns = 0;
  };
  /// Throws UsageError.
  Times covered_times() const;
};

}  // namespace cornerd::tool
