// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "survey/validity_checks.hpp"
#include "tool/drawing/text_table.hpp"
#include "tool/survey/survey_files.hpp"

namespace cornerd::tool {

namespace {

double length_of(const core::Vec2& from, const core::Vec2& to) { return (to - from).norm(); }

std::string sources_of(const survey::SurveyResult& result) {
  if (!result.has_odometry) return "by the lidar alone";
  const std::string wheels = result.has_gyro ? "wheels, gyro" : "wheels";
  const bool is_ransac = result.observations == 0;  // it places its scans by the odometry alone
  if (is_ransac) return result.has_gyro ? "by wheels and gyro" : "by wheels";
  return "by " + wheels + " and lidar";
}

/// Wear and pressure of tyres change a wheel by a few per cent; more is a wrong config.
std::string describe_wheels(const core::OdometryParameters& estimated) {
  constexpr double kMaxScale = 0.15;
  if (std::max(std::abs(estimated.left_scale), std::abs(estimated.right_scale)) < kMaxScale)
    return "";
  return formatted(
      "WARNING: the left wheel differs by %+.0f %% from the config, the right one by %+.0f %%: "
      "check odometry.counts_per_turn and odometry.wheel_radius\n",
      100 * estimated.left_scale, 100 * estimated.right_scale);
}

std::string describe_drive(const survey::SurveyResult& result) {
  double length_m = 0;
  for (std::size_t i = 1; i < result.T_map_base.size(); ++i) {
    length_m +=
        length_of(result.T_map_base[i - 1].translation(), result.T_map_base[i].translation());
  }
  const double duration_s = core::to_seconds(result.t_ns.back() - result.t_ns.front());
  return formatted("%zu scans, %.1f s, %.1f m %s\n", result.T_map_base.size(), duration_s, length_m,
                   sources_of(result).c_str());
}

std::string describe_rejected_odometry(const survey::RejectedOdometry& rejected) {
  const auto wheel = [](const survey::WheelDistance& distance) {
    return formatted("%.1f m by its counts and %.1f m by the lidar", distance.counted_m,
                     distance.lidar_m);
  };
  return formatted(
             "WARNING: the odometry contradicts the lidar in %zu scans and is missing in %zu. It "
             "was "
             "left out, and the map is by the lidar alone: ",
             rejected.contradicted_scans, rejected.scans_without_odometry) +
         "the left wheel moved " + wheel(rejected.left) + ", the right one " +
         wheel(rejected.right) +
         ". Check that both encoders count up when the robot drives forward, "
         "odometry.counts_per_turn and odometry.wheel_radius\n";
}

std::string describe_walls(const survey::SurveyResult& result) {
  std::size_t solids = 0;
  double length_m = 0;
  for (const core::Wall& wall : result.plan.walls) {
    solids += wall.thickness_m > 0 ? 1 : 0;
    length_m += length_of(wall.from, wall.to);
  }
  double thin_m = 0;
  for (const survey::ThinPlace& place : result.thin) thin_m += length_of(place.from, place.to);
  return formatted(
      "%zu walls, %.1f m: %zu with both faces, %zu with one face; %.2f m without observations, "
      "between observed parts\n",
      result.plan.walls.size(), length_m, solids, result.plan.walls.size() - solids, thin_m);
}

std::string describe_loop(const survey::SurveyResult& result, const survey::LoopReport& loop) {
  const auto time_s = [&](std::size_t scan) {
    return core::to_seconds(result.t_ns[scan] - result.t_ns.front());
  };
  const std::string text = formatted(
      "loop closure %s: scans at %.1f s and %.1f s, %zu matching scans; drift %.2f m and %.1f "
      "degrees",
      loop.closed() ? "accepted" : "rejected", time_s(loop.later), time_s(loop.earlier),
      loop.agreeing, loop.off_m, core::degrees(std::abs(loop.off_rad)));
  return text + (loop.closed() ? "\n" : ": " + loop.refused + "\n");
}

}  // namespace

std::string survey_report(const survey::SurveyResult& result) {
  std::string text = describe_drive(result) + describe_walls(result);
  if (result.observations == 0) return text;  // --method ransac
  if (result.rejected_odometry) text += describe_rejected_odometry(*result.rejected_odometry);
  text += formatted("%zu wall observations, residuals %.2f of their sigma, %zu outliers\n",
                    result.observations, result.sigma, result.outliers);
  if (!result.unmatched_scans.empty()) {
    text += formatted("%zu scans did not match the map\n", result.unmatched_scans.size());
  }
  if (!result.degenerate_scans.empty()) {
    text += formatted(
        "WARNING: %zu scans, the first %.1f s after the start, show only walls along one "
        "direction, "
        "and there is no odometry: the map may be too long or too short there\n",
        result.degenerate_scans.size(),
        core::to_seconds(result.t_ns[result.degenerate_scans.front()] - result.t_ns.front()));
  }
  if (survey::has_duplicate_walls(result.duplicate_m, result.plan.walls)) {
    text += formatted(
        "WARNING: %.1f m of duplicate walls, behind others that would have occluded them: objects "
        "moved, or the trajectory drifted there\n",
        result.duplicate_m);
  }
  if (survey::has_free_space_conflicts(result.free_space_conflicts)) {
    text += formatted(
        "WARNING: free-space conflicts: rays went through %.1f m of the wall faces, at %zu places: "
        "objects moved, or the recording maps several places over each other\n",
        result.free_space_conflicts.length_m, result.free_space_conflicts.places);
  }
  if (result.squared) {
    text += formatted("%zu wall faces are square to each other, %zu are not\n",
                      result.squared->square, result.squared->askew);
  }
  if (result.learned) {
    const core::OdometryParameters& learned = *result.learned;
    text +=
        formatted("odometry: left %+.4f, right %+.4f, track %+.4f, gyro %+.4f and %+.5f rad/s\n",
                  learned.left_scale, learned.right_scale, learned.track_scale, learned.gyro_scale,
                  learned.gyro_bias_rad_s);
    text += describe_wheels(learned);
  }
  for (const survey::LoopReport& loop : result.loops) text += describe_loop(result, loop);
  if (result.merged_faces > 0) {
    text += formatted("%zu wall faces were merged with others\n", result.merged_faces);
  }
  if (result.discarded_faces + result.dropped.size() == 0) return text;
  text += "dropped:\n";
  if (result.discarded_faces > 0) {
    text += formatted("  %zu faces observed once or twice\n", result.discarded_faces);
  }
  std::vector<survey::DroppedPiece> dropped = result.dropped;
  std::stable_sort(dropped.begin(), dropped.end(), [](const auto& one, const auto& other) {
    return length_of(one.from, one.to) > length_of(other.from, other.to);
  });
  for (const survey::DroppedPiece& piece : dropped) {
    text +=
        formatted("  %.2f m from %.2f,%.2f to %.2f,%.2f: %s\n", length_of(piece.from, piece.to),
                  piece.from.x(), piece.from.y(), piece.to.x(), piece.to.y(), piece.why.c_str());
  }
  return text;
}

}  // namespace cornerd::tool
