// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "core/breakpoint/detector.hpp"
#include "core/catalog/catalog.hpp"
#include "core/estimate/refinement.hpp"
#include "core/localizer.hpp"
#include "core/odometry/odometer.hpp"
#include "core/recognition/beam_model.hpp"
#include "core/recognition/recognition.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd {

/// Stages of the localizer one by one, each on a scan that the daemon has just localized.
class LocalizerStages {
 public:
  /// `drive`: of the robot, for the readings of its wheels and gyro.
  LocalizerStages(std::shared_ptr<const core::WallMap> map, replay::Motion drive);

  void count(const core::Scan& scan, const core::ScanResult& result);

 private:
  void count_parts(const core::Scan& scan, const core::ScanResult& result);
  void count_searches(const core::Scan& scan);
  void count_odometry(const core::Scan& scan, const core::ScanResult& result);

  std::shared_ptr<const core::WallMap> map_;
  core::LocalizerConfig config_;
  core::Catalog catalog_;
  core::Recognition recognition_;
  core::Detector detector_;
  core::Refinement refinement_;
  core::RayCaster prediction_;
  core::BeamModel beam_model_;
  core::Localizer fresh_;
  core::Localizer elsewhere_;
  replay::SimulatedOdometry readings_;
  core::Odometer odometer_;
  core::PolarScan points_;
  std::vector<core::PolarPoint> thin_;
  core::Detection detection_;
  core::Scan deskewed_;
};

}  // namespace cornerd
