// SPDX-License-Identifier: MIT
#include "survey/ransac_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/odometry/fusion_filter.hpp"
#include "core/odometry/reading_gate.hpp"

namespace cornerd::survey {
namespace {

/// Where the robot was, by odometry alone.
class Track {
 public:
  Track(const RecordedDrive& drive, const core::OdometryConfig& config) {
    core::ReadingGate gate(config);
    core::FusionFilter filter(config);
    core::Pose2 pose;
    for (const RecordedDrive::Reading& reading : drive.readings()) {
      const auto step = gate.add(reading.reading, reading.now_ns);
      if (!step || step->is_hole || step->to_ns <= step->from_ns) continue;
      if (points_.empty()) points_.push_back({step->from_ns, pose});
      pose = pose * filter.motion_of(*step);
      if (step->to_ns > points_.back().t_ns) points_.push_back({step->to_ns, pose});
    }
    if (points_.size() < 2) {
      throw std::invalid_argument("the paper's way needs wheels: there is no odometry in it");
    }
  }

  core::Pose2 at(core::TimeNs t_ns) const {
    const auto after =
        std::upper_bound(points_.begin(), points_.end(), t_ns,
                         [](core::TimeNs t, const Point& point) { return t < point.t_ns; });
    if (after == points_.begin()) return points_.front().T_map_base;
    if (after == points_.end()) return points_.back().T_map_base;
    const Point& from = *(after - 1);
    const double share =
        static_cast<double>(t_ns - from.t_ns) / static_cast<double>(after->t_ns - from.t_ns);
    const core::Pose2& a = from.T_map_base;
    const core::Pose2& b = after->T_map_base;
    return {
        a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
        core::normalize_angle(a.theta_rad + share * core::angle_between(a.theta_rad, b.theta_rad))};
  }

 private:
  struct Point {
    core::TimeNs t_ns;
    core::Pose2 T_map_base;
  };
  std::vector<Point> points_;
};

}  // namespace

ReckonedDrive reckon_drive(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           std::size_t returns) {
  const Track track(drive, sensor.odometry);
  const core::Pose2 T_start_map = track.at(drive.middle_ns(0)).inverse();
  ReckonedDrive reckoned;
  core::Scan scan;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    reckoned.T_map_base.push_back(T_start_map * track.at(drive.middle_ns(i)));
    drive.load(i, scan);
    const std::size_t step =
        std::max<std::size_t>(1, scan.size() / std::max<std::size_t>(1, returns));
    for (std::size_t k = 0; k < scan.size(); k += step) {
      const core::Sample& sample = scan.samples()[k];
      const double range_m = sample.range_m;
      if (!(range_m >= sensor.min_range_m && range_m <= sensor.max_range_m)) continue;
      const core::Pose2 T_map_lidar = T_start_map * track.at(sample.t_ns) * sensor.T_base_lidar;
      reckoned.points.push_back(T_map_lidar *
                                core::Vec2(range_m * core::unit_vector(sample.bearing_rad)));
    }
  }
  return reckoned;
}

std::vector<core::Vec2> thin_out(const std::vector<core::Vec2>& points, double cell_m) {
  constexpr double kLeastShare = 0.2;
  struct Sum {
    core::Vec2 place = core::Vec2::Zero();
    double count = 0;
  };
  std::map<std::pair<std::int64_t, std::int64_t>, Sum> cells;
  for (const core::Vec2& point : points) {
    Sum& sum = cells[{static_cast<std::int64_t>(std::floor(point.x() / cell_m)),
                      static_cast<std::int64_t>(std::floor(point.y() / cell_m))}];
    sum.place += point;
    sum.count += 1;
  }
  std::vector<core::Vec2> thin;
  thin.reserve(cells.size());
  const double mean = static_cast<double>(points.size()) / static_cast<double>(cells.size());
  for (const auto& [cell, sum] : cells) {
    if (sum.count >= kLeastShare * mean) thin.push_back(sum.place / sum.count);
  }
  return thin;
}

}  // namespace cornerd::survey
