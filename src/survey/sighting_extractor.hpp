// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/breakpoint/detector.hpp"
#include "core/localizer_config.hpp"
#include "core/polar_scan.hpp"
#include "survey/sighting.hpp"

namespace cornerd::survey {

/// From the returns of a turn to the faces seen in it: the detector tells which samples are one
/// wall, a line through these, each by its own noise across the wall, is what is kept.
class SightingExtractor {
 public:
  SightingExtractor(const core::DetectorConfig& detector, const core::SensorNoise& noise)
      : noise_(noise), detector_(detector, noise) {}

  /// Appends to `sightings`.
  void extract(const core::PolarScan& points, std::vector<Sighting>& sightings);

 private:
  void add(const core::PolarScan& points, const core::WallSegment& segment,
           std::vector<Sighting>& sightings);

  core::SensorNoise noise_;
  core::Detector detector_;
  core::Detection detection_;
};

}  // namespace cornerd::survey
