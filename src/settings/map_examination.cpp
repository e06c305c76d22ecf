// SPDX-License-Identifier: MIT
#include "settings/map_examination.hpp"

#include <vector>

#include "settings/map_file.hpp"

namespace cornerd::settings {

std::optional<calibration::MapFinding> examine_map(const core::FloorPlan& plan,
                                                   const Config& config,
                                                   std::span<const calibration::ScanSamples> scans,
                                                   const std::function<bool()>& is_over) {
  std::vector<core::FloorPlan> others;
  for (const NamedMap& other : config.maps) {
    if (other.name == plan.name) continue;
    others.push_back(load_map(other.file)->plan());
    others.back().name = other.name;
  }
  return calibration::find_map_fault(plan, others, config.localizer(), scans, is_over);
}

}  // namespace cornerd::settings
