// SPDX-License-Identifier: MIT
#include "baseline/wall_finders.hpp"

#include <memory>

namespace cornerd::baseline {
namespace {

template <typename Finder, typename Config>
core::WallFinderFactory factory(const Config& config) {
  return [config](const core::DetectorConfig& detector, const core::SensorNoise& noise) {
    return std::make_unique<Finder>(detector, noise, config);
  };
}

}  // namespace

core::WallFinderFactory printed_altbd(const PrintedAltbdConfig& config) {
  return factory<PrintedAltbd>(config);
}

core::WallFinderFactory abd_iepf(const AbdIepfConfig& config) { return factory<AbdIepf>(config); }

core::WallFinderFactory line_tracking(const LineTrackingConfig& config) {
  return factory<LineTracking>(config);
}

core::WallFinderFactory wall_finder(std::string_view name) {
  if (name == "altbd-printed") return printed_altbd();
  if (name == "abd-iepf") return abd_iepf();
  if (name == "lt") return line_tracking();
  return {};
}

}  // namespace cornerd::baseline
