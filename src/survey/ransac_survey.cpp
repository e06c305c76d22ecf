// SPDX-License-Identifier: MIT
#include "survey/ransac_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>

#include "core/breakpoint/line_fit.hpp"
#include "core/odometry/motion_factor.hpp"
#include "core/odometry/reading_gate.hpp"

namespace cornerd::survey {
namespace {

/// The trajectory by dead reckoning.
class Track {
 public:
  Track(const RecordedDrive& drive, const core::OdometryConfig& config) {
    core::ReadingGate gate(config);
    core::Pose2 pose;
    for (const RecordedDrive::Reading& reading : drive.readings()) {
      const auto step = gate.add(reading.reading);
      if (!step || step->is_gap || step->to_ns <= step->from_ns) continue;
      if (points_.empty()) points_.push_back({step->from_ns, pose});
      pose = pose * core::CalibratedIncrement(*step, config.geometry, config.initial).motion();
      if (step->to_ns > points_.back().t_ns) points_.push_back({step->to_ns, pose});
    }
    if (points_.size() < 2) {
      throw std::invalid_argument(
          "the method ransac needs wheel odometry, and the recording has none: record it, or use "
          "the method adjusted");
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

using core::Vec2;

struct RansacLine {
  Vec2 from;
  Vec2 to;
  double length_m() const { return (to - from).norm(); }
};

/// Extends `line` over `other` where that is collinear and close; false where it is not.
bool merge_into(RansacLine& line, const RansacLine& other, const RansacConfig& config) {
  const Vec2 direction = (line.to - line.from).normalized();
  const Vec2 normal = core::rotate_left(direction);
  const double sine = std::abs(core::cross(direction, (other.to - other.from).normalized()));
  if (sine > std::sin(config.merge_rad)) return false;
  if (std::max(std::abs(normal.dot(other.from - line.from)),
               std::abs(normal.dot(other.to - line.from))) > config.merge_m) {
    return false;
  }
  const double a = direction.dot(other.from - line.from);
  const double b = direction.dot(other.to - line.from);
  const double low_m = std::min(a, b);
  const double high_m = std::max(a, b);
  if (low_m > line.length_m() + config.gap_m || high_m < -config.gap_m) return false;
  const double end_m = std::max(line.length_m(), high_m);
  const Vec2 from = line.from + std::min(0.0, low_m) * direction;
  line.to = line.from + end_m * direction;
  line.from = from;
  return true;
}

/// Algorithm 1 of the paper, with lines as normal and offset: no second run for vertical walls.
class Ransac {
 public:
  Ransac(const std::vector<Vec2>& points, const RansacConfig& config)
      : points_(points), config_(config), random_(config.seed) {}

  void iterate() {
    const Vec2& a = points_[pick()];
    const Vec2& b = points_[pick()];
    const double length_m = (b - a).norm();
    if (length_m < config_.near_m) return;
    const Vec2 direction = (b - a) / length_m;
    const Vec2 normal = core::rotate_left(direction);
    hits_.clear();
    for (const Vec2& point : points_) {
      if (std::abs(normal.dot(point - a)) < config_.near_m) {
        hits_.emplace_back(direction.dot(point - a), point);
      }
    }
    if (metres(hits_.size()) < config_.min_line_m) return;
    std::sort(hits_.begin(), hits_.end(),
              [](const auto& one, const auto& other) { return one.first < other.first; });
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= hits_.size(); ++i) {
      if (i < hits_.size() && hits_[i].first - hits_[i - 1].first < config_.gap_m) continue;
      if (metres(i - begin) > config_.min_run_m) keep_run(begin, i);
      begin = i;
    }
  }

  std::vector<RansacLine> lines;

 private:
  std::size_t pick() { return static_cast<std::size_t>(random_() % points_.size()); }
  double metres(std::size_t count) const { return config_.cell_m * static_cast<double>(count); }

  void keep_run(std::size_t begin, std::size_t end) {
    core::LineFit fit(hits_[begin].second);
    for (std::size_t i = begin; i < end; ++i) fit.add(hits_[i].second.x(), hits_[i].second.y(), 1);
    const core::Line line = fit.line();
    const auto foot = [&](const Vec2& point) {
      return Vec2(point - (line.normal.dot(point) - line.offset_m) * line.normal);
    };
    const RansacLine run{foot(hits_[begin].second), foot(hits_[end - 1].second)};
    if (run.length_m() < config_.min_run_m) return;
    // The same wall is found many times.
    const bool known = std::any_of(lines.begin(), lines.end(), [&](RansacLine& longer) {
      return merge_into(longer, run, config_);
    });
    if (!known) lines.push_back(run);
  }

  const std::vector<Vec2>& points_;
  const RansacConfig& config_;
  std::mt19937_64 random_;
  std::vector<std::pair<double, Vec2>> hits_;
};

/// Merges collinear lines into longer ones until nothing changes.
std::vector<RansacLine> merge_lines(std::vector<RansacLine> lines, const RansacConfig& config) {
  std::stable_sort(lines.begin(), lines.end(), [](const RansacLine& a, const RansacLine& b) {
    return a.length_m() > b.length_m();
  });
  for (bool changed = true; std::exchange(changed, false);) {
    std::vector<RansacLine> merged;
    for (const RansacLine& line : lines) {
      const bool taken = std::any_of(merged.begin(), merged.end(), [&](RansacLine& longer) {
        return merge_into(longer, line, config);
      });
      if (!taken) merged.push_back(line);
    }
    changed = merged.size() < lines.size();
    lines = std::move(merged);
  }
  return lines;
}

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
  constexpr double kMinShare = 0.2;
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
    if (sum.count >= kMinShare * mean) thin.push_back(sum.place / sum.count);
  }
  return thin;
}

SurveyResult ransac_survey(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           const RansacConfig& config, const SurveyProgress& progress) {
  if (drive.size() == 0) {
    throw std::invalid_argument("the recording has no complete scan: record for longer");
  }
  ReckonedDrive reckoned = reckon_drive(drive, sensor, config.returns);
  const std::vector<Vec2> points = thin_out(reckoned.points, config.cell_m);
  if (points.size() < 2) {
    throw std::invalid_argument("the recording has no returns: check the lidar's ranges");
  }
  Ransac ransac(points, config);
  for (std::size_t i = 0; i < config.iterations; ++i) {
    ransac.iterate();
    if (progress)
      progress("finding lines",
               static_cast<double>(i + 1) / static_cast<double>(config.iterations));
  }

  SurveyResult result;
  for (const RansacLine& line : merge_lines(std::move(ransac.lines), config)) {
    result.plan.walls.push_back({line.from, line.to, 0});
  }
  if (result.plan.walls.empty()) {
    throw std::invalid_argument("RANSAC found no line in the recording: raise the iterations");
  }
  result.T_map_base = std::move(reckoned.T_map_base);
  for (std::size_t i = 0; i < drive.size(); ++i) result.t_ns.push_back(drive.middle_ns(i));
  result.points = points;
  result.has_odometry = drive.has_wheels();
  result.has_gyro = drive.has_gyro();
  return result;
}

}  // namespace cornerd::survey
