// SPDX-License-Identifier: MIT
#include "core/localizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/breakpoint/detector.hpp"
#include "core/catalog/catalog.hpp"
#include "core/recognition/decision.hpp"
#include "core/recognition/recognition.hpp"
#include "core/recognition/verification.hpp"

namespace cornerd::core {
namespace {

/// A place that recognition gave is off by up to this much; one that was carried on from the turn
/// before, by what a robot drives meanwhile.
constexpr double kRecognisedReach_m = 0.10;
constexpr double kPriorReach_m = 0.15;
/// A pose older than this is no prior any more.
constexpr double kMaxPriorAge_s = 2;
/// Two poses tell the motion between them where they are one or two turns apart, and the robot did
/// not jump: nobody who needs an A1 is faster.
constexpr double kMinMotionTime_s = 0.03;
constexpr double kMaxMotionTime_s = 0.5;
constexpr double kMaxSpeed_m_s = 2;
constexpr double kMaxOmega_rad_s = 6;
/// A place that leaves more than this of the rays unexplained, or that few rays speak for, may be
/// the wrong one of several: then all that could have been overlooked is tested too.
constexpr double kCertainHitShare = 0.9;
constexpr std::size_t kCertainHits = 100;

/// A pose of `lidar` becomes that of `base`: the offset turns with the heading.
Covariance3 covariance_of_base(const Covariance3& of_lidar, const Pose2& T_map_lidar,
                               const Pose2& T_map_base) {
  Covariance3 slope = Covariance3::Identity();
  slope(0, 2) = -(T_map_base.y_m - T_map_lidar.y_m);
  slope(1, 2) = T_map_base.x_m - T_map_lidar.x_m;
  return slope * of_lidar * slope.transpose();
}

/// What is left of the motion within a turn after the samples were moved back by it: the robot may
/// have changed its speed since the last two poses. At a steady 0.1 to 0.5 m/s the mean error grew
/// by 3 % of half a turn's way.
Covariance3 doubt_of_motion(const Twist2& motion) {
  constexpr double kShare = 0.03;
  constexpr double kHalfTurn_s = 0.07;
  const double way_m = kShare * kHalfTurn_s * motion.speed_m_s();
  const double turn_rad = kShare * kHalfTurn_s * motion.omega_rad_s;
  return Eigen::Vector3d(way_m * way_m, way_m * way_m, turn_rad * turn_rad).asDiagonal();
}

}  // namespace

struct Localizer::Workspace {
  /// What needs a map.
  struct Place {
    Place(const WallMap& map, const LocalizerConfig& config)
        : catalog(map, config.max_range_m), recognition(map, catalog), verification(map, config) {}
    Catalog catalog;
    Recognition recognition;
    Verification verification;
  };

  Workspace(std::shared_ptr<const WallMap> the_map, const LocalizerConfig& the_config)
      : config(the_config),
        T_lidar_base(the_config.T_base_lidar.inverse()),
        map(std::move(the_map)),
        detector(the_config.detector, the_config.noise) {
    if (map) place.emplace(*map, config);
  }

  std::optional<Pose2> prior(TimeNs t_ns) const;
  void remember(const Pose2& T_map_lidar, TimeNs t_ns);
  void recognise(TimeNs t_ns);
  void report(const Decision& decision, TimeNs t_ns);
  void report_pose(const core::Place& found, TimeNs t_ns);
  void report_alternatives(std::span<const core::Place> rivals);

  LocalizerConfig config;
  Pose2 T_lidar_base;
  std::shared_ptr<const WallMap> map;
  Detector detector;
  std::optional<Place> place;

  PolarScan points;
  TurnResult result;
  std::optional<Pose2> last_T_map_lidar;
  TimeNs last_pose_ns = 0;
  Twist2 motion;  ///< of the lidar, from the last two poses
};

Localizer::Localizer(std::shared_ptr<const WallMap> map, const LocalizerConfig& config)
    : workspace_(std::make_unique<Workspace>(std::move(map), config)) {}
Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;
Localizer& Localizer::operator=(Localizer&&) noexcept = default;

const TurnResult& Localizer::step(const Scan& scan) {
  Workspace& w = *workspace_;
  const TimeNs t_ns = scan.start_ns() + (scan.end_ns() - scan.start_ns()) / 2;
  ++w.result.pose.seq;

  // 1. The turn's returns in the order of their bearing, as a robot that stood still had seen them.
  w.points.assign(scan, w.config.min_range_m, w.config.max_range_m, w.motion, t_ns);

  // 2. Its walls, and the corners and ends of walls between them (ALTBD).
  w.detector.detect(w.points, w.result.detection);

  // 3. The places whose corners form the same pattern, tested against every ray of the turn.
  w.recognise(t_ns);

  // 4. One place is a fix, several are ambiguous, none is lost.
  const Decision decision =
      w.place ? decide(w.place->verification.places(), w.prior(t_ns)) : Decision{};
  w.report(decision, t_ns);
  return w.result;
}

void Localizer::relocalize() {
  workspace_->last_T_map_lidar.reset();
  workspace_->motion = {};
}

/// Where the lidar should be by now.
std::optional<Pose2> Localizer::Workspace::prior(TimeNs t_ns) const {
  if (!last_T_map_lidar) return std::nullopt;
  const double age_s = to_seconds(t_ns - last_pose_ns);
  if (std::abs(age_s) > kMaxPriorAge_s) return std::nullopt;
  return *last_T_map_lidar * motion.over(age_s);
}

void Localizer::Workspace::remember(const Pose2& T_map_lidar, TimeNs t_ns) {
  const double dt_s = to_seconds(t_ns - last_pose_ns);
  motion = {};
  if (last_T_map_lidar && dt_s > kMinMotionTime_s && dt_s < kMaxMotionTime_s) {
    const Pose2 way = last_T_map_lidar->inverse() * T_map_lidar;
    const Twist2 seen{way.x_m / dt_s, way.y_m / dt_s, way.theta_rad / dt_s};
    const bool plausible =
        seen.speed_m_s() < kMaxSpeed_m_s && std::abs(seen.omega_rad_s) < kMaxOmega_rad_s;
    if (plausible) motion = seen;
  }
  last_T_map_lidar = T_map_lidar;
  last_pose_ns = t_ns;
}

void Localizer::Workspace::recognise(TimeNs t_ns) {
  if (!place) return;
  Verification& verification = place->verification;
  const std::span<const Breakpoint> breakpoints = result.detection.breakpoints;
  verification.begin(points.points(), std::clamp(result.detection.noise_scale, 0.5, 4.0));
  verification.consider(place->recognition.from_pairs(breakpoints), kRecognisedReach_m);
  if (const std::optional<Pose2> before = prior(t_ns)) {
    const Hypothesis carried_on{*before, 0};
    verification.consider(std::span(&carried_on, 1), kPriorReach_m);
  }
  const auto in_doubt = [&] {
    const auto places = verification.places();
    if (places.empty()) return true;
    const Explanation& best = places.front().explanation;
    return best.hits < kCertainHits || best.hit_share() < kCertainHitShare;
  };
  if (in_doubt()) {
    verification.consider(place->recognition.from_single_corners(breakpoints), kRecognisedReach_m);
  }
  if (in_doubt()) {
    verification.consider(place->recognition.from_walls(result.detection.segments, breakpoints),
                          kRecognisedReach_m);
  }
}

void Localizer::Workspace::report(const Decision& decision, TimeNs t_ns) {
  PoseEstimate& pose = result.pose;
  pose.state = decision.state;
  pose.t_ns = t_ns;
  pose.room.reset();
  pose.corners = 0;
  pose.inliers = 0;
  pose.rmse_m = 0;
  pose.alternatives.clear();
  pose.covariance.setZero();
  pose.T_map_base = {};
  if (decision.state == PoseState::kFix || decision.state == PoseState::kTracking) {
    report_pose(place->verification.places()[decision.place], t_ns);
  } else if (decision.state == PoseState::kAmbiguous) {
    report_alternatives(place->verification.places().first(decision.rivals));
  }
  pose.age_s = last_pose_ns == 0 ? 0 : to_seconds(t_ns - last_pose_ns);
}

void Localizer::Workspace::report_pose(const core::Place& found, TimeNs t_ns) {
  const Pose2& T_map_lidar = found.refined.T_map_lidar;
  PoseEstimate& pose = result.pose;
  pose.T_map_base = T_map_lidar * T_lidar_base;
  pose.covariance = covariance_of_base(found.refined.covariance + doubt_of_motion(motion),
                                       T_map_lidar, pose.T_map_base);
  pose.room = map->room_at(pose.T_map_base.translation());
  pose.corners = static_cast<std::size_t>(
      place->recognition.recognised(result.detection.breakpoints, T_map_lidar));
  pose.inliers = found.explanation.hits;
  pose.rmse_m = found.refined.rmse_m;
  remember(T_map_lidar, t_ns);
}

void Localizer::Workspace::report_alternatives(std::span<const core::Place> rivals) {
  const std::size_t count = std::min(rivals.size(), kMaxAlternatives);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += relative_belief(rivals[i], rivals.front());
  for (std::size_t i = 0; i < count; ++i) {
    result.pose.alternatives.push_back({rivals[i].refined.T_map_lidar * T_lidar_base,
                                        relative_belief(rivals[i], rivals.front()) / sum});
  }
}

}  // namespace cornerd::core
