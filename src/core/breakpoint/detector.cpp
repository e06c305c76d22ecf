// SPDX-License-Identifier: MIT
#include "core/breakpoint/detector.hpp"

namespace cornerd::core {

Detector::Detector(const DetectorConfig& config, const SensorNoise& noise)
    : altbd_(config, noise),
      finder_(config.finder ? config.finder(config, noise) : nullptr),
      polyline_(config, noise) {
  tracks_.reserve(kMaxSegmentsPerScan);
}

void Detector::detect(const PolarScan& scan, Detection& detection) {
  detection.clear();
  polyline_.begin();
  if (finder_) {
    detection.overflowed = finder_->track(scan, tracks_);
    for (const SegmentTrack& wall : tracks_) polyline_.add(scan, wall, 1, detection);
  } else {
    altbd_.begin();
    feed(altbd_, polyline_, scan, /*ended=*/true, detection);
    detection.noise_scale = altbd_.noise_scale();
  }
  polyline_.finish(scan, detection.noise_scale, detection);
}

void Detector::forget() { altbd_.forget(); }

void feed(Altbd& tracker, WallPolyline& polyline, const PolarScan& scan, bool ended,
          Detection& detection) {
  SegmentTrack wall;
  for (;;) {
    switch (tracker.next(scan, ended, wall)) {
      case Altbd::Event::kNone:
        return;
      case Altbd::Event::kShortWall:
      case Altbd::Event::kWallBegun:
        polyline.add(scan, wall, tracker.noise_scale(), detection);
        break;
      case Altbd::Event::kWallEnded:
        polyline.extend_last(wall);
        break;
    }
  }
}

}  // namespace cornerd::core
