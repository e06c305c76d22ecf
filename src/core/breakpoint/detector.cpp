// SPDX-License-Identifier: MIT
#include "core/breakpoint/detector.hpp"

#include <type_traits>

namespace cornerd::core {

Detector::Tracker Detector::make_tracker(const DetectorConfig& config, const SensorNoise& noise) {
  switch (config.method) {
    case Method::kPrintedAltbd:
      return PrintedAltbd(config, noise);
    case Method::kAbdIepf:
      return AbdIepf(config, noise);
    case Method::kLineTracking:
      return LineTracking(config, noise);
    case Method::kAltbd:
      break;
  }
  return Altbd(config, noise);
}

Detector::Detector(const DetectorConfig& config, const SensorNoise& noise)
    : tracker_(make_tracker(config, noise)), polyline_(config, noise) {
  tracks_.reserve(kMaxSegmentsPerScan);
}

void Detector::detect(const PolarScan& scan, Detection& detection) {
  detection.clear();
  polyline_.begin();
  std::visit(
      [&](auto& tracker) {
        if constexpr (std::is_same_v<std::decay_t<decltype(tracker)>, Altbd>) {
          tracker.begin();
          feed(tracker, polyline_, scan, /*ended=*/true, detection);
          detection.noise_scale = tracker.noise_scale();
        } else {
          detection.overflowed = tracker.track(scan, tracks_);
          for (const SegmentTrack& wall : tracks_) polyline_.add(scan, wall, 1, detection);
        }
      },
      tracker_);
  polyline_.finish(scan, detection.noise_scale, detection);
}

void Detector::forget() {
  if (auto* altbd = std::get_if<Altbd>(&tracker_)) altbd->forget();
}

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
