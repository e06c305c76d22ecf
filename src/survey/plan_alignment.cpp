// SPDX-License-Identifier: MIT
#include "survey/plan_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "core/geometry/squared.hpp"
#include "core/localizer.hpp"

namespace cornerd::survey {
namespace {

/// Two scans agree on the alignment: a plan's walls are within a decimetre, and so are poses in it.
constexpr double kAgreeing_m = 0.3;
constexpr double kAgreeing_rad = core::radians(5);
/// Scans that have to agree, and their share of those that were localized.
constexpr std::size_t kMinAgreeingScans = 5;
constexpr double kMinAgreeingPart = 0.6;
/// Drawn walls are within this of where they are, and turned by no more.
constexpr double kReach_m = 0.2;
constexpr double kMaxTurn_rad = core::radians(6);
/// Width of the Cauchy kernel: a wall drawn with a tape.
constexpr double kDrawn_m = 0.03;

struct LocalizedScan {
  std::size_t index = 0;
  core::Pose2 T_plan_base;
};

std::vector<LocalizedScan> localize(const RecordedDrive& drive,
                                    std::shared_ptr<const core::WallMap> plan,
                                    core::LocalizerConfig config) {
  config.updates_per_scan = 1;
  config.calibrate_online = false;
  core::Localizer localizer(std::move(plan), config);
  std::vector<LocalizedScan> found;
  core::Scan scan;
  auto reading = drive.readings().begin();
  for (std::size_t i = 0; i < drive.size(); ++i) {
    for (; reading != drive.readings().end() && reading->scan <= i; ++reading) {
      localizer.add(reading->reading);
    }
    drive.load(i, scan);
    const core::PoseEstimate& pose = localizer.step(scan).pose;
    if (pose.state == core::PoseState::kFix || pose.state == core::PoseState::kTracking) {
      found.push_back({i, pose.T_map_base});
    }
  }
  return found;
}

/// Least-squares rigid transform from the trajectory to the localized poses.
core::Pose2 fit_trajectory(std::span<const LocalizedScan> scans,
                           std::span<const core::Pose2> T_survey_base) {
  core::Vec2 heading = core::Vec2::Zero();
  for (const LocalizedScan& scan : scans) {
    heading += core::unit_vector(scan.T_plan_base.theta_rad - T_survey_base[scan.index].theta_rad);
  }
  core::Pose2 T_plan_survey{0, 0, core::angle_of(heading)};
  core::Vec2 shift = core::Vec2::Zero();
  for (const LocalizedScan& scan : scans) {
    shift +=
        scan.T_plan_base.translation() - T_plan_survey * T_survey_base[scan.index].translation();
  }
  shift /= static_cast<double>(scans.size());
  T_plan_survey.x_m = shift.x();
  T_plan_survey.y_m = shift.y();
  return T_plan_survey;
}

std::vector<LocalizedScan> agreeing(const core::Pose2& T_plan_survey,
                                    std::span<const LocalizedScan> scans,
                                    std::span<const core::Pose2> T_survey_base) {
  std::vector<LocalizedScan> some;
  for (const LocalizedScan& scan : scans) {
    const core::Pose2 expected = T_plan_survey * T_survey_base[scan.index];
    const core::Vec2 off = expected.translation() - scan.T_plan_base.translation();
    const double turn_rad = core::normalize_angle(expected.theta_rad - scan.T_plan_base.theta_rad);
    if (off.norm() < kAgreeing_m && std::abs(turn_rad) < kAgreeing_rad) some.push_back(scan);
  }
  return some;
}

/// The drawn face that lies along a surveyed one, of those the nearest.
const core::Face* counterpart(const core::Vec2& from, const core::Vec2& to,
                              std::span<const core::Face> drawn) {
  const core::Vec2 direction = (to - from).normalized();
  const core::Vec2 middle = (from + to) / 2;
  const core::Face* nearest = nullptr;
  double nearest_m = kReach_m;
  for (const core::Face& face : drawn) {
    if (face.direction.dot(direction) < std::cos(kMaxTurn_rad)) continue;
    const double along_m = face.direction.dot(middle - face.from);
    if (along_m < 0 || along_m > face.length_m) continue;
    const double off_m = std::abs(face.normal.dot(middle) - face.offset_m);
    if (off_m >= nearest_m) continue;
    nearest = &face;
    nearest_m = off_m;
  }
  return nearest;
}

}  // namespace

core::Pose2 align_to_plan(const RecordedDrive& drive, std::span<const core::Pose2> T_survey_base,
                          std::shared_ptr<const core::WallMap> plan,
                          const core::LocalizerConfig& sensor) {
  const std::vector<LocalizedScan> scans = localize(drive, std::move(plan), sensor);
  std::vector<LocalizedScan> most;
  // Every alignment that a scan proposes; a hundred of them are enough.
  const std::size_t stride = std::max<std::size_t>(1, scans.size() / 100);
  for (std::size_t i = 0; i < scans.size(); i += stride) {
    const core::Pose2 T_plan_survey =
        scans[i].T_plan_base * T_survey_base[scans[i].index].inverse();
    std::vector<LocalizedScan> some = agreeing(T_plan_survey, scans, T_survey_base);
    if (some.size() > most.size()) most = std::move(some);
  }
  if (most.size() < kMinAgreeingScans ||
      static_cast<double>(most.size()) < kMinAgreeingPart * static_cast<double>(scans.size())) {
    throw std::invalid_argument("the drive does not fit the plan: " + std::to_string(scans.size()) +
                                " of " + std::to_string(drive.size()) +
                                " scans are found in it, and " + std::to_string(most.size()) +
                                " of these agree on where the drive lies");
  }
  return fit_trajectory(most, T_survey_base);
}

core::Pose2 fit_to_walls(const core::Pose2& T_plan_survey, const core::WallMap& surveyed,
                         const core::WallMap& plan) {
  constexpr int kSteps = 10;
  core::Pose2 fitted = T_plan_survey;
  for (int step = 0; step < kSteps; ++step) {
    // A weak prior keeps what no wall determines.
    Eigen::Matrix3d information = 1e-3 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const core::Face& face : surveyed.faces()) {
      const core::Vec2 from = fitted * face.from;
      const core::Vec2 to = fitted * face.to;
      const core::Face* drawn = counterpart(from, to, plan.faces());
      if (drawn == nullptr) continue;
      for (const core::Vec2& point : {from, to}) {
        const double off_m = drawn->normal.dot(point) - drawn->offset_m;
        const core::Vec2 lever = core::rotate_left(point - fitted.translation());
        const Eigen::Vector3d jacobian(drawn->normal.x(), drawn->normal.y(),
                                       drawn->normal.dot(lever));
        const double weight = face.length_m / (1 + core::squared(off_m / kDrawn_m));
        information += weight * jacobian * jacobian.transpose();
        gradient += weight * off_m * jacobian;
      }
    }
    const Eigen::Vector3d change = information.ldlt().solve(-gradient);
    fitted.x_m += change.x();
    fitted.y_m += change.y();
    fitted.theta_rad = core::normalize_angle(fitted.theta_rad + change.z());
  }
  return fitted;
}

}  // namespace cornerd::survey
