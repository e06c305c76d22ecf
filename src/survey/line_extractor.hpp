// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/breakpoint/detector.hpp"
#include "core/localizer_config.hpp"
#include "core/polar_scan.hpp"
#include "survey/line_landmark.hpp"

namespace cornerd::survey {

/// Line observations from the returns of a scan. The detector segments the scan; each segment gets
/// a weighted least-squares line, with each sample weighted by its own noise across the wall.
class LineExtractor {
 public:
  LineExtractor(const core::DetectorConfig& detector, const core::SensorNoise& noise)
      : noise_(noise), detector_(detector, noise) {}

  /// Appends to `observations`.
  void extract(const core::PolarScan& points, std::vector<LineObservation>& observations);

 private:
  void add(const core::PolarScan& points, const core::WallSegment& segment,
           std::vector<LineObservation>& observations);

  core::SensorNoise noise_;
  core::Detector detector_;
  core::Detection detection_;
};

}  // namespace cornerd::survey
