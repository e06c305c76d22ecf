// SPDX-License-Identifier: MIT
#include "survey/ransac_survey.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

#include "core/breakpoint/line_fit.hpp"
#include "survey/ransac_points.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

struct RansacLine {
  Vec2 from;
  Vec2 to;
  double length_m() const { return (to - from).norm(); }
};

/// True where `other` is collinear with `line` and close; `line` then reaches over both.
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

/// Algorithm 1 of the print. A line as normal and offset needs no second run for vertical walls.
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
    if (metres(hits_.size()) < config_.least_line_m) return;
    std::sort(hits_.begin(), hits_.end(),
              [](const auto& one, const auto& other) { return one.first < other.first; });
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= hits_.size(); ++i) {
      if (i < hits_.size() && hits_[i].first - hits_[i - 1].first < config_.gap_m) continue;
      if (metres(i - begin) > config_.least_run_m) keep_run(begin, i);
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
    if (run.length_m() < config_.least_run_m) return;
    // The same wall is found again and again.
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

/// The longest first; each takes in what is collinear and close, until nothing changes.
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

SurveyResult ransac_survey(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           const RansacConfig& config, const SurveyProgress& progress) {
  if (drive.size() == 0) throw std::invalid_argument("not one whole turn of a lidar in it");
  ReckonedDrive reckoned = reckon_drive(drive, sensor, config.returns);
  const std::vector<Vec2> points = thin_out(reckoned.points, config.cell_m);
  if (points.size() < 2) throw std::invalid_argument("no walls were seen");
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
  if (result.plan.walls.empty()) throw std::invalid_argument("no line was found in its points");
  result.T_map_base = std::move(reckoned.T_map_base);
  for (std::size_t i = 0; i < drive.size(); ++i) result.t_ns.push_back(drive.middle_ns(i));
  result.points = points;
  result.has_odometry = drive.has_wheels();
  result.has_gyro = drive.has_gyro();
  return result;
}

}  // namespace cornerd::survey
