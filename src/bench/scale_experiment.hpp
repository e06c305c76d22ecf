// SPDX-License-Identifier: MIT
// The first fix by the size of the building: no prior, one scan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/localization/pose_score.hpp"
#include "core/localizer.hpp"
#include "core/scan.hpp"

namespace cornerd::bench {

struct ScaleCase {
  std::string title;
  core::FloorPlan plan;
};

/// Office buildings of about so many corners each, and a corridor of twelve identical rooms, where
/// a scan is correct if the true pose is among the alternatives.
std::vector<ScaleCase> scale_cases(const std::vector<std::size_t>& corners, std::uint64_t seed);

struct ScaleResult {
  std::string title;
  std::size_t rooms = 0;
  std::size_t corners = 0;
  std::size_t pairs = 0;         ///< of the catalogue
  double map_s = 0;              ///< CPU time to find and index the plan's faces and corners
  double catalog_s = 0;          ///< CPU time to make the catalogue
  std::size_t memory_bytes = 0;  ///< of faces, corners, their index and the catalogue
  PoseScore score;
  double time_us = 0;                  ///< mean CPU time of a scan
  double time_99_us = 0;               ///< 99th percentile
  std::optional<double> instructions;  ///< mean of a scan
};

/// Scans at random poses in one building.
class ScaleScans {
 public:
  ScaleScans(std::shared_ptr<const core::WallMap> map, std::size_t scans, std::uint64_t seed);

  const std::vector<core::Pose2>& poses() const { return places_; }
  const std::vector<core::Scan>& scans() const { return scans_; }

  /// Localizes every scan without a prior.
  void localize(core::Localizer& localizer,
                const std::function<void(std::size_t scan, const core::PoseEstimate&)>& done) const;

 private:
  std::vector<core::Pose2> places_;
  std::vector<core::Scan> scans_;
};

ScaleResult run_scale_case(const ScaleCase& building, std::size_t scans, std::uint64_t seed);

}  // namespace cornerd::bench
