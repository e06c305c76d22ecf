// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tool/fleet/broker_options.hpp"

namespace cornerd::tool {

/// The recordings that a robot sent to its site, in a folder of their own that the destructor
/// removes.
class FleetDrives {
 public:
  /// Throws Failure if there are none, or not all is there.
  FleetDrives(const BrokerOptions& options, const std::string& robot);
  ~FleetDrives();
  FleetDrives(const FleetDrives&) = delete;
  FleetDrives& operator=(const FleetDrives&) = delete;

  /// By name.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace cornerd::tool
