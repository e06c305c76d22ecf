// SPDX-License-Identifier: MIT
#include "core/breakpoint/detector.hpp"

namespace cornerd::core {

Detector::Detector(const DetectorConfig& config, const SensorNoise& noise)
    : altbd_(config, noise),
      finder_(config.finder ? config.finder(config, noise) : nullptr),
      chain_(config, noise) {
  tracks_.reserve(kMaxSegmentsPerScan);
}

void Detector::detect(const PolarScan& scan, Detection& detection) {
  detection.clear();
  chain_.begin();
  if (finder_) {
    detection.overflowed = finder_->track(scan, tracks_);
    for (const SegmentTrack& wall : tracks_) chain_.add(scan, wall, 1, detection);
  } else {
    altbd_.begin();
    feed(altbd_, chain_, scan, /*ended=*/true, detection);
    detection.noise_scale = altbd_.noise_scale();
  }
  chain_.finish(scan, detection.noise_scale, detection);
}

void Detector::forget() { altbd_.forget(); }

void feed(Altbd& tracker, WallChain& chain, const PolarScan& scan, bool ended,
          Detection& detection) {
  SegmentTrack wall;
  for (;;) {
    switch (tracker.next(scan, ended, wall)) {
      case Altbd::Event::kNone:
        return;
      case Altbd::Event::kShortWall:
      case Altbd::Event::kWallBegun:
        chain.add(scan, wall, tracker.noise_scale(), detection);
        break;
      case Altbd::Event::kWallEnded:
        chain.grow(wall);
        break;
    }
  }
}

}  // namespace cornerd::core
