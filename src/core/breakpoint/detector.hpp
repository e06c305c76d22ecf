// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/breakpoint/altbd.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_chain.hpp"
#include "core/breakpoint/wall_finder.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// From a scan's returns to its walls and breakpoints. ALTBD finds the walls, or the finder that
/// the configuration brings; what becomes of them is the same for all. All memory is taken at
/// construction.
class Detector {
 public:
  Detector(const DetectorConfig& config, const SensorNoise& noise);

  void detect(const PolarScan& scan, Detection& detection);

  /// Forgets what the turns showed of the noise.
  void forget();

 private:
  Altbd altbd_;
  std::unique_ptr<WallFinder> finder_;  ///< null: ALTBD
  SegmentTracks tracks_;
  WallChain chain_;
};

/// Hands the walls that ALTBD finds, from where it stopped to the scan's end, to the chain.
void feed(Altbd& tracker, WallChain& chain, const PolarScan& scan, bool ended,
          Detection& detection);

}  // namespace cornerd::core
