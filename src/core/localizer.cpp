// SPDX-License-Identifier: MIT
#include "core/localizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// How sure somebody is who says where the robot is.
constexpr double kGivenSigma_m = 0.1;
constexpr double kGivenSigma_rad = radians(5);

/// What a prediction by odometry is off by at most: three sigma.
constexpr double kSurely = 3;

}  // namespace

Localizer::Localizer(std::shared_ptr<const WallMap> map, const LocalizerConfig& config)
    : workspace_(std::make_unique<Workspace>(std::move(map), config)) {}
Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;
Localizer& Localizer::operator=(Localizer&&) noexcept = default;

const ScanResult& Localizer::step(const Scan& received) {
  Workspace& w = *workspace_;
  const Scan& measured = w.as_measured(received);
  const TimeNs t_ns = measured.start_ns() + (measured.end_ns() - measured.start_ns()) / 2;
  ++w.result.pose.seq;
  w.rotation.add(measured);

  // 0. Odometry, where there is any, says how the robot moved during the scan and where it should
  //    be.
  const Scan& scan = w.deskewed(measured, t_ns);

  // 1. to 4. The place where that scan was taken. One that fits nowhere may have been deskewed by
  //    wrong odometry: once more, as it came. One that fits exactly only as it came was.
  Decision decision = w.find(scan, t_ns);
  const bool may_be_wrong = &scan != &measured && !(w.trusts_odometry() && w.memory.prior(t_ns));
  if (decision.state == PoseState::kLost && may_be_wrong) {
    // Where nearly every ray hits, that may be anywhere; else only where odometry leads to, for
    // rooms that look alike fit.
    const PlaceFilter lost = w.filtered;
    const std::optional<Prior> prior = w.memory.prior(t_ns);
    w.reject_motion(prior);
    const Decision undeskewed = w.find(measured, t_ns);
    if (w.is_conclusive(t_ns) || !prior ||
        (has_pose(undeskewed.state) &&
         w.is_expected(w.chosen(undeskewed).refined.T_map_lidar, t_ns))) {
      w.reject_motion(std::nullopt);
      decision = undeskewed;
    } else {
      w.filtered = lost;
    }
  } else if (may_be_wrong && !w.is_conclusive(t_ns) && w.fits_as_it_came(measured, t_ns)) {
    const Decision undeskewed = w.find(measured, t_ns);
    const bool is_exact = w.is_conclusive(t_ns);
    if (is_exact) w.reject_motion(std::nullopt);
    decision = is_exact ? undeskewed : w.find(scan, t_ns);
  }

  // 5. A place that is less than certain, or far from where the robot just was, waits for the next
  //    scan.
  const std::size_t corners = w.corners_of(decision);
  if (has_pose(decision.state)) {
    decision.state = w.believe(decision, corners, t_ns);
  } else {
    w.T_map_doubted.reset();
  }
  w.report(decision, corners, t_ns);

  // 6. A scan whose place is known tells how the lidar errs always, if the robot stood.
  const Scan& seen = w.odometer.has_motion() ? scan : measured;
  w.learn_bias(seen, decision, t_ns);
  w.try_bias(seen, decision, t_ns);
  w.result.bias = estimated_bias();
  w.learn_sweep(measured, t_ns);
  return w.result;
}

Decision Localizer::Workspace::find(const Scan& scan, TimeNs t_ns) {
  // 1. The scan's walls and corners, and the places whose corners form the same pattern, compared
  //    by every ray.
  look(scan, t_ns, memory.motion());

  // 2. Where none is convincing, the robot may have changed its speed since the last scans, or
  //    walls are off.
  if (may_move(t_ns)) {
    look_for_the_motion(scan, t_ns);
    if (motion != memory.motion() && is_explained_by_offsets(scan, t_ns)) {
      look(scan, t_ns, memory.motion());
    }
  }

  const Decision decision = compare_places(t_ns);
  // Or it rotates, and neither odometry nor a scan before shows how: once more by a few rates.
  if (decision.state != PoseState::kLost || !rotation_is_unknown() ||
      !try_rotation_rates(scan, t_ns)) {
    return decision;
  }
  place->map_search.stop();  // it matched the scan as if at rest
  return compare_places(t_ns);
}

Decision Localizer::Workspace::compare_places(TimeNs t_ns) {
  // 3. Where still none is, the whole map is searched.
  candidates = {};
  if (!place) return {};
  if (!is_conclusive(t_ns)) search_map(t_ns);

  // 4. One place is a fix, several are ambiguous, none is lost.
  candidates = place->place_search.places();
  filtered = filter;
  return decide(candidates, place->place_search.is_complete(), memory.prior(t_ns), filtered);
}

const PoseEstimate* Localizer::add(const OdometryReading& reading) {
  Workspace& w = *workspace_;
  const bool moved = w.odometer.add(reading);
  const PoseState last = w.result.pose.state;
  if (!moved || !w.config.odometry.publish_predictions || last == PoseState::kAmbiguous ||
      last == PoseState::kLost) {
    return nullptr;
  }
  const std::optional<PredictedPose> ahead = w.odometer.predict_latest();
  if (!ahead) return nullptr;
  w.between.seq = ++w.result.pose.seq;
  w.between.t_ns = ahead->t_ns;
  w.predict(*ahead, w.between);
  w.between.age_s = w.memory.age_s(ahead->t_ns);
  return &w.between;
}

const std::optional<MeasuredMotion>& Localizer::measured_motion() const {
  return workspace_->odometer.last_motion();
}

void Localizer::set_pose(const Pose2& T_map_base) {
  relocalize();
  Workspace& w = *workspace_;
  const Covariance3 doubt =
      Eigen::Vector3d(kGivenSigma_m * kGivenSigma_m, kGivenSigma_m * kGivenSigma_m,
                      kGivenSigma_rad * kGivenSigma_rad)
          .asDiagonal();
  w.memory.update(T_map_base * w.config.T_base_lidar, w.result.pose.t_ns, {}, Covariance3::Zero());
  w.filter.confirm(T_map_base * w.config.T_base_lidar);
  w.odometer.set_pose(T_map_base, doubt);
}

void Localizer::relocalize() {
  workspace_->odometer.forget();
  workspace_->memory.forget();
  workspace_->filter.forget();
  if (workspace_->place) workspace_->place->map_search.stop();
  workspace_->result.pose.alternatives.clear();
  workspace_->T_map_doubted.reset();
  workspace_->of_last_scan.reset();
}

void Localizer::forget() {
  forget_scans();
  workspace_->odometer = Odometer(workspace_->config.odometry);
}

void Localizer::forget_scans() {
  relocalize();
  workspace_->saw_all_around = false;
  workspace_->rotation.forget();
  workspace_->odometer.reset();
  workspace_->sweep_log_odds = 0;
  forget_lidar();
}

void Localizer::resume_odometry(const Localizer& other) {
  const Workspace& before = *other.workspace_;
  workspace_->odometer.resume(before.odometer);
  // What was learned of the wheels was so by another mount.
  if (workspace_->config.T_base_lidar != before.config.T_base_lidar) workspace_->odometer.reset();
}

void Localizer::Workspace::reject_motion(const std::optional<Prior>& prior) {
  odometer.reject_motion();
  memory.set_prediction(prior, false);
}

const Scan& Localizer::Workspace::deskewed(const Scan& measured, TimeNs t_ns) {
  odometer.advance(measured.start_ns(), t_ns, measured.end_ns());
  std::optional<Prior> prior;
  if (const auto predicted = odometer.dead_reckoning()) {
    const Covariance3& covariance = predicted->covariance;
    prior = {predicted->T_map_base * config.T_base_lidar,
             kSurely * std::sqrt(std::max(covariance(0, 0), covariance(1, 1))),
             kSurely * std::sqrt(covariance(2, 2))};
  }
  // By coarse counts, or wheels that slip, less is known of the motion in a scan than by the poses
  // before.
  const double duration_s = to_seconds(measured.end_ns() - measured.start_ns());
  if (odometer.has_motion() && outdated_motion_covariance(memory.age_s(t_ns), duration_s).trace() <
                                   odometer.deskew_covariance_with_slips().trace()) {
    odometer.reject_motion();
  }
  const bool known = odometer.deskew(measured, config.T_base_lidar, still);
  memory.set_prediction(prior, known);
  return known ? still : measured;
}

std::size_t Localizer::Workspace::corners_of(const Decision& decision) const {
  if (!has_pose(decision.state)) return 0;
  const core::VerifiedHypothesis& found = chosen(decision);
  return static_cast<std::size_t>(
      place->recognition.recognised(result.detection.breakpoints, found.refined.T_map_lidar));
}

}  // namespace cornerd::core
