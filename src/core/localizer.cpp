// SPDX-License-Identifier: MIT
#include "core/localizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/breakpoint/detector.hpp"
#include "core/catalog/catalog.hpp"
#include "core/estimate/bias_estimator.hpp"
#include "core/estimate/part_tracker.hpp"
#include "core/estimate/pose_memory.hpp"
#include "core/estimate/refinement.hpp"
#include "core/recognition/decision.hpp"
#include "core/recognition/evidence.hpp"
#include "core/recognition/paper_recognition.hpp"
#include "core/recognition/recognition.hpp"
#include "core/recognition/verification.hpp"

namespace cornerd::core {
namespace {

/// A place that recognition gave is off by up to this much; one that was carried on from the turn
/// before, by what a robot drives meanwhile; one that a turn in motion gave, by the motion.
constexpr double kRecognisedReach_m = 0.10;
constexpr double kPriorReach_m = 0.15;
constexpr double kMotionReach_m = 0.08;
/// Places with fewer votes of corners than this share of the best one's are looked at where those
/// with more leave doubt: in large buildings they are many.
constexpr double kLikelyShare = 0.7;
/// A robot moves no farther than this between two turns. A place farther off was either wrong or
/// the robot was carried: the next turn tells.
constexpr double kJump_m = 0.5;
constexpr double kJump_rad = radians(60);
/// A motion has to explain one ray in so many more than rest does: it fits things that are not on
/// the map a little, always.
constexpr std::size_t kRaysForAMotion = 50;
/// Where nothing explains half of the rays, the robot may be turning: so many of these rates are
/// tried, by turns. Places are found within some 0.8 rad/s of the true one.
constexpr std::array kGuesses_rad_s = {1.5, -1.5, 3.0, -3.0, 0.75, -0.75};
constexpr std::size_t kGuessesATurn = 2;
constexpr double kGuessedShare = 0.8;
/// The lidar's bias is learnt from turns that the map explains nearly whole, of a robot that
/// stands or whose wheels tell how it moves: what is steady in a motion passes for no bias, but
/// what changes would.
constexpr double kTeachingShare = 0.8;
/// Turns within which a lidar's bias is learnt, and the share of the rays that a place explains at
/// least roughly where a bias is all that is wrong.
constexpr std::size_t kTurnsOfANewLidar = 20;
constexpr double kAllButExact = 0.95;
/// How sure somebody is who says where the robot is.
constexpr double kGivenSigma_m = 0.1;
constexpr double kGivenSigma_rad = radians(5);
/// Residuals this much beyond the turn's own noise are smeared by a motion.
constexpr double kSmearedSpread = 1.4;

/// What a bias of 1 % and 5 mm that is not learnt yet does to poses in rooms of a metre or two.
Covariance3 doubt_of_bias() {
  constexpr double kPlace_m = 0.006;
  constexpr double kHeading_rad = radians(0.15);
  return Eigen::Vector3d(kPlace_m * kPlace_m, kPlace_m * kPlace_m, kHeading_rad * kHeading_rad)
      .asDiagonal();
}

/// What a turn showed of the noise, where it is more than chance.
double clamped_noise(double noise_scale) { return std::clamp(noise_scale, 0.5, 4.0); }

/// Shorter, and two poses tell nothing of the motion between them.
constexpr double kLeastTimeOfAMotion_s = 0.02;
/// Wheels tell the way itself; how unevenly it was driven is as if a motion were so much of the
/// time old (the NEES of quarters of turns, drives in a flat that stop and turn often).
constexpr double kUnevenShare = 0.15;

}  // namespace

struct Localizer::Workspace {
  /// What needs a map.
  struct Place {
    Place(const WallMap& map, const LocalizerConfig& config)
        : catalog(map, config.max_range_m),
          recognition(map, catalog),
          verification(map, config),
          refinement(config.max_range_m, config.noise),
          bias(config.max_range_m, config.noise, config.bias) {
      if (config.recognition == RecognitionMethod::kPaper) paper.emplace(map, catalog);
      if (config.updates_per_turn > 1) parts.emplace(map, config);
    }
    Catalog catalog;
    Recognition recognition;
    std::optional<PaperRecognition> paper;  ///< where it is asked for, instead
    Verification verification;
    Refinement refinement;
    BiasEstimator bias;
    std::optional<PartTracker> parts;  ///< where poses are asked for before a turn ends
  };

  Workspace(std::shared_ptr<const WallMap> the_map, const LocalizerConfig& the_config)
      : config(the_config),
        T_lidar_base(the_config.T_base_lidar.inverse()),
        map(std::move(the_map)),
        detector(the_config.detector, the_config.noise),
        odometer(the_config.odometry) {
    if (map) place.emplace(*map, config);
  }

  const Scan& straightened(const Scan& turn, TimeNs t_ns);
  void look(const Scan& scan, TimeNs t_ns, const Twist2& as_if_moving);
  void look_for_the_motion(const Scan& scan, TimeNs t_ns);
  void look_everywhere(TimeNs t_ns);
  std::size_t corners_of(const Decision& decision) const;
  PoseState believe(const Decision& decision, std::size_t corners, TimeNs t_ns);
  bool is_expected(const Pose2& T_map_lidar, TimeNs t_ns) const;
  bool in_doubt(TimeNs t_ns) const;
  bool is_smeared() const;
  std::size_t best_hits() const;
  bool may_be_biased() const;
  bool teaches(const Decision& decision) const;
  void report(const Decision& decision, std::size_t corners, TimeNs t_ns);
  void report_pose(const core::Place& found, std::size_t corners, TimeNs t_ns);
  void report_alternatives(std::span<const core::Place> rivals);
  std::optional<Expectation> expectation(TimeNs t_ns);
  void predict(const PredictedPose& predicted, PoseEstimate& pose) const;
  bool contradicts(const PredictedPose& predicted) const;

  LocalizerConfig config;
  Pose2 T_lidar_base;
  std::shared_ptr<const WallMap> map;
  Detector detector;
  std::optional<Place> place;

  Odometer odometer;
  Scan still;  ///< the turn as a lidar that stood still would have seen it
  PoseMemory memory;
  PolarScan points;
  std::size_t guesses = 0;             ///< of the motion, so far
  Twist2 motion;                       ///< that `points` were moved back by
  std::optional<Pose2> T_map_doubted;  ///< a jump of the turn before that waits for a second
  TurnResult result;
  PoseEstimate between;  ///< of a reading between two turns, or of a part of a turn
};

Localizer::Localizer(std::shared_ptr<const WallMap> map, const LocalizerConfig& config)
    : workspace_(std::make_unique<Workspace>(std::move(map), config)) {}
Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;
Localizer& Localizer::operator=(Localizer&&) noexcept = default;

const TurnResult& Localizer::step(const Scan& turn) {
  Workspace& w = *workspace_;
  const TimeNs t_ns = turn.start_ns() + (turn.end_ns() - turn.start_ns()) / 2;
  ++w.result.pose.seq;

  // 0. Odometry, where there is any, says how the robot moved during the turn and where it should
  //    be.
  const Scan& scan = w.straightened(turn, t_ns);

  // 1. The turn's walls and corners, and the places whose corners form the same pattern, tested
  //    against every ray.
  w.look(scan, t_ns, w.memory.motion());

  // 2. Where none is convincing, the robot may have changed its speed since the last turns.
  if ((w.in_doubt(t_ns) || w.is_smeared()) && !w.may_be_biased()) {
    w.look_for_the_motion(scan, t_ns);
  }

  // 3. Where still none is, all places are tested that could have been overlooked.
  if (w.in_doubt(t_ns)) w.look_everywhere(t_ns);

  // 4. One place is a fix, several are ambiguous, none is lost.
  Decision decision =
      w.place ? decide(w.place->verification.places(), w.memory.prior(t_ns)) : Decision{};

  // 5. What is less than evident, or far from where the robot just was, is not believed at once.
  const std::size_t corners = w.corners_of(decision);
  if (names_a_place(decision.state)) decision.state = w.believe(decision, corners, t_ns);
  w.report(decision, corners, t_ns);

  // 6. A turn whose place is known tells how the lidar errs always.
  if (w.teaches(decision)) {
    const core::Place& at = w.place->verification.places()[decision.place];
    w.place->bias.learn(*w.map, at.refined.T_map_lidar, w.points.points(),
                        std::max(1.0, w.result.detection.noise_scale));
  }
  w.result.bias = learned_bias();
  return w.result;
}

const PoseEstimate* Localizer::add(const OdometryReading& reading, std::optional<TimeNs> now_ns) {
  Workspace& w = *workspace_;
  const bool moved = w.odometer.add(reading, now_ns);
  const PoseState last = w.result.pose.state;
  if (!moved || !w.config.odometry.publish || last == PoseState::kAmbiguous ||
      last == PoseState::kLost) {
    return nullptr;
  }
  const std::optional<PredictedPose> ahead = w.odometer.ahead();
  if (!ahead) return nullptr;
  w.between.seq = ++w.result.pose.seq;
  w.between.t_ns = ahead->t_ns;
  w.predict(*ahead, w.between);
  w.between.age_s = w.memory.age_s(ahead->t_ns);
  return &w.between;
}

const PoseEstimate* Localizer::follow(const Sample& sample) {
  Workspace& w = *workspace_;
  if (!w.place || !w.place->parts || !w.place->parts->add(sample)) return nullptr;
  PartTracker& parts = *w.place->parts;
  const std::optional<Expectation> expected = w.expectation(parts.end_ns());
  if (!expected) return nullptr;
  const auto found = parts.localize(*expected, w.place->bias.bias(),
                                    clamped_noise(w.result.detection.noise_scale));
  if (!found) return nullptr;
  const Pose2& T_map_lidar = found->refined.T_map_lidar;
  PoseEstimate& pose = w.between;
  pose.seq = ++w.result.pose.seq;
  pose.t_ns = parts.end_ns();
  pose.state = PoseState::kTracking;
  pose.T_map_base = T_map_lidar * w.T_lidar_base;
  const Covariance3 of_lidar = found->refined.covariance +
                               doubt_of_motion(expected->motion, expected->motion) +
                               doubt_of_old_motion(expected->motion_age_s, parts.duration_s());
  pose.covariance = covariance_of_base(of_lidar, T_map_lidar, pose.T_map_base);
  pose.room = w.map->room_at(pose.T_map_base.translation());
  pose.corners =
      static_cast<std::size_t>(w.place->recognition.recognised(parts.breakpoints(), T_map_lidar));
  pose.inliers = found->explanation.hits;
  pose.rmse_m = found->refined.rmse_m;
  pose.age_s = w.memory.age_s(pose.t_ns);
  return &pose;
}

void Localizer::set_pose(const Pose2& T_map_base) {
  relocalize();
  Workspace& w = *workspace_;
  const Covariance3 doubt =
      Eigen::Vector3d(kGivenSigma_m * kGivenSigma_m, kGivenSigma_m * kGivenSigma_m,
                      kGivenSigma_rad * kGivenSigma_rad)
          .asDiagonal();
  w.memory.remember(T_map_base * w.config.T_base_lidar, w.result.pose.t_ns, {});
  w.odometer.set_pose(T_map_base, doubt);
}

void Localizer::relocalize() {
  workspace_->odometer.forget();
  workspace_->memory.forget();
  workspace_->T_map_doubted.reset();
}

void Localizer::forget() {
  relocalize();
  workspace_->odometer = Odometer(workspace_->config.odometry);
  workspace_->detector.forget();
  if (workspace_->place) workspace_->place->bias.forget();
}

LearnedBias Localizer::learned_bias() const {
  if (workspace_->place) return workspace_->place->bias.learned();
  return {.bias = workspace_->config.bias, .sigma = {}};
}

void Localizer::resume(const LearnedBias& learned) {
  if (workspace_->place) workspace_->place->bias.resume(learned);
}

bool Localizer::Workspace::teaches(const Decision& decision) const {
  if (!config.learn_bias) return false;
  if (!names_a_place(decision.state)) return false;
  const core::Place& at = place->verification.places()[decision.place];
  return (memory.stands() || odometer.knows_motion()) &&
         at.explanation.near_share() > kTeachingShare;
}

/// By odometry, where it knows; else the robot goes on as the last turns saw it move.
std::optional<Expectation> Localizer::Workspace::expectation(TimeNs t_ns) {
  if (!names_a_place(result.pose.state)) return std::nullopt;
  const auto ahead = odometer.ahead();
  const auto behind = odometer.prediction();
  if (ahead && behind && to_seconds(ahead->t_ns - behind->t_ns) > kLeastTimeOfAMotion_s) {
    const Pose2 T_map_ahead = ahead->T_map_base * config.T_base_lidar;
    const Twist2 steady = motion_between(behind->T_map_base * config.T_base_lidar, T_map_ahead,
                                         to_seconds(ahead->t_ns - behind->t_ns));
    return Expectation{T_map_ahead * steady.over(to_seconds(t_ns - ahead->t_ns)),
                       covariance_of_base(ahead->covariance, ahead->T_map_base, T_map_ahead),
                       steady, kUnevenShare * to_seconds(ahead->t_ns - behind->t_ns)};
  }
  const std::optional<Pose2> prior = memory.prior(t_ns);
  if (!prior || odometer.knows_motion()) return std::nullopt;
  const Covariance3 of_lidar = covariance_of_base(result.pose.covariance, result.pose.T_map_base,
                                                  result.pose.T_map_base * config.T_base_lidar);
  const double age_s = to_seconds(t_ns - result.pose.t_ns);
  return Expectation{*prior, later(of_lidar, age_s), memory.motion(), age_s};
}

const Scan& Localizer::Workspace::straightened(const Scan& turn, TimeNs t_ns) {
  odometer.advance(turn.start_ns(), t_ns, turn.end_ns());
  std::optional<Pose2> T_map_lidar;
  if (const auto predicted = odometer.prediction()) {
    T_map_lidar = predicted->T_map_base * config.T_base_lidar;
  }
  const bool known = odometer.straighten(turn, config.T_base_lidar, still);
  memory.expect(T_map_lidar, known);
  return known ? still : turn;
}

std::size_t Localizer::Workspace::corners_of(const Decision& decision) const {
  if (!names_a_place(decision.state)) return 0;
  const core::Place& found = place->verification.places()[decision.place];
  return static_cast<std::size_t>(
      place->recognition.recognised(result.detection.breakpoints, found.refined.T_map_lidar));
}

bool Localizer::Workspace::is_expected(const Pose2& T_map_lidar, TimeNs t_ns) const {
  const std::optional<Pose2> prior = memory.prior(t_ns);
  return prior && same_place(*prior, T_map_lidar, kJump_m, kJump_rad);
}

PoseState Localizer::Workspace::believe(const Decision& decision, std::size_t corners,
                                        TimeNs t_ns) {
  const core::Place& found = place->verification.places()[decision.place];
  const Pose2& T_map_lidar = found.refined.T_map_lidar;
  const Evidence evidence{found.explanation, corners, points.widest_gap_rad(),
                          !place->paper && place->recognition.tries_all()};
  if (decision.state == PoseState::kTracking) {
    return may_be_tracked(evidence) ? PoseState::kTracking : PoseState::kAmbiguous;
  }
  const bool confirmed =
      T_map_doubted && same_place(*T_map_doubted, T_map_lidar, kJump_m, kJump_rad);
  T_map_doubted.reset();
  if (is_expected(T_map_lidar, t_ns)) {
    if (is_evident(evidence)) return PoseState::kFix;
    return may_be_tracked(evidence) ? PoseState::kTracking : PoseState::kLost;
  }
  if (!is_evident(evidence)) return PoseState::kLost;
  if (memory.prior(t_ns) && !confirmed && !is_certain(evidence)) {
    T_map_doubted = T_map_lidar;
    return PoseState::kLost;
  }
  return PoseState::kFix;
}

void Localizer::Workspace::look(const Scan& scan, TimeNs t_ns, const Twist2& as_if_moving) {
  // The returns in the order of their bearing, as a lidar that stood still would have seen them.
  motion = as_if_moving;
  points.assign(scan, config.min_range_m, config.max_range_m, t_ns, motion,
                place ? place->bias.bias() : config.bias);

  // Walls, and the corners and ends of walls between them (ALTBD).
  detector.detect(points, result.detection);
  if (!place) return;

  // The place where the robot should be by now, and those that pairs of corners point to.
  Verification& verification = place->verification;
  verification.begin(points.points(), clamped_noise(result.detection.noise_scale));
  if (const std::optional<Pose2> prior = memory.prior(t_ns)) {
    const Hypothesis carried_on{*prior, 0};
    verification.consider(std::span(&carried_on, 1), kPriorReach_m);
  }
  const Detection& seen = result.detection;
  if (place->paper) {
    verification.consider(place->paper->places(seen.breakpoints, seen.segments),
                          kRecognisedReach_m);
    return;
  }
  const auto pairs = place->recognition.from_pairs(seen.breakpoints);
  const std::size_t likely = count_likely(pairs, kLikelyShare);
  verification.consider(pairs.first(likely), kRecognisedReach_m);
  if (in_doubt(t_ns)) verification.consider(pairs.subspan(likely), kRecognisedReach_m);
}

bool Localizer::Workspace::in_doubt(TimeNs t_ns) const {
  if (!place || place->verification.places().empty()) return true;
  const core::Place& best = place->verification.places().front();
  return !leaves_no_doubt(best.explanation, is_expected(best.refined.T_map_lidar, t_ns));
}

bool Localizer::Workspace::is_smeared() const {
  return place && !place->verification.places().empty() &&
         place->verification.places().front().refined.spread > kSmearedSpread;
}

/// A bias fits like a motion: walls are where they should be, but not exactly. While the lidar is
/// new and the robot is seen to stand, it is the bias.
bool Localizer::Workspace::may_be_biased() const {
  if (!config.learn_bias || !place || place->verification.places().empty()) return false;
  return place->bias.turns() < kTurnsOfANewLidar && memory.stands() &&
         place->verification.places().front().explanation.near_share() > kAllButExact;
}

std::size_t Localizer::Workspace::best_hits() const {
  const auto places = place->verification.places();
  return places.empty() ? 0 : places.front().explanation.hits;
}

void Localizer::Workspace::look_for_the_motion(const Scan& scan, TimeNs t_ns) {
  if (!place) return;
  Twist2 best_motion = motion;
  std::size_t best = best_hits();
  const auto try_motion = [&](const Twist2& candidate) {
    look(scan, t_ns, candidate);
    if (best_hits() <= best + points.size() / kRaysForAMotion) return;
    best = best_hits();
    best_motion = motion;
  };
  if (!motion.is_rest()) try_motion({});
  const auto refine = [&] {
    for (int k = 0; k < 2 && (in_doubt(t_ns) || is_smeared()) && best_hits() > 0; ++k) {
      const Pose2 start = place->verification.places().front().refined.T_map_lidar;
      const RefinedMotion refined = place->refinement.refine_motion(
          *map, start, kMotionReach_m, points.points(), result.detection.noise_scale);
      if (!refined.valid || !is_plausible(refined.motion)) break;
      try_motion(motion + refined.motion);
    }
  };
  refine();
  const bool is_known = odometer.knows_motion() || memory.prior(t_ns);
  for (std::size_t k = 0; k < kGuessesATurn && !is_known && best_hits() < points.size() / 2; ++k) {
    const Twist2 motion_before = best_motion;
    const std::size_t best_before = best;
    try_motion({0, 0, kGuesses_rad_s[guesses++ % kGuesses_rad_s.size()]});
    refine();
    // A guess that is right explains nearly all; any other explains a little more than rest does.
    if (static_cast<double>(best) > kGuessedShare * static_cast<double>(points.size())) break;
    best_motion = motion_before;
    best = best_before;
  }
  if (motion != best_motion) look(scan, t_ns, best_motion);
}

void Localizer::Workspace::look_everywhere(TimeNs t_ns) {
  if (!place || place->paper) return;
  const std::span<const Breakpoint> breakpoints = result.detection.breakpoints;
  Recognition& recognition = place->recognition;
  place->verification.consider(recognition.from_single_corners(breakpoints), kRecognisedReach_m);
  if (!in_doubt(t_ns)) return;
  place->verification.consider(recognition.from_walls(result.detection.segments, breakpoints),
                               kRecognisedReach_m);
}

void Localizer::Workspace::report(const Decision& decision, std::size_t corners, TimeNs t_ns) {
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
  pose.doubt = decision.doubt;
  if (names_a_place(decision.state)) {
    report_pose(place->verification.places()[decision.place], corners, t_ns);
  } else if (decision.state == PoseState::kAmbiguous) {
    report_alternatives(place->verification.places().first(decision.rivals));
  }
  if (pose.state == PoseState::kLost || pose.state == PoseState::kAmbiguous) {
    const auto predicted = odometer.prediction();
    if (predicted && !contradicts(*predicted)) predict(*predicted, result.pose);
  }
  pose.age_s = memory.age_s(t_ns);
  result.odometry = odometer.summary();
}

bool Localizer::Workspace::contradicts(const PredictedPose& predicted) const {
  if (result.pose.state == PoseState::kLost) return T_map_doubted.has_value();
  const auto is_near = [&](const Alternative& other) {
    return same_place(predicted.T_map_base, other.T_map_base, kJump_m, kJump_rad);
  };
  return std::none_of(result.pose.alternatives.begin(), result.pose.alternatives.end(), is_near);
}

void Localizer::Workspace::predict(const PredictedPose& predicted, PoseEstimate& pose) const {
  pose.state = PoseState::kPredicted;
  pose.alternatives.clear();
  pose.T_map_base = predicted.T_map_base;
  pose.covariance = predicted.covariance;
  if (map) pose.room = map->room_at(pose.T_map_base.translation());
}

void Localizer::Workspace::report_pose(const core::Place& found, std::size_t corners, TimeNs t_ns) {
  const Pose2& T_map_lidar = found.refined.T_map_lidar;
  PoseEstimate& pose = result.pose;
  pose.T_map_base = T_map_lidar * T_lidar_base;
  memory.remember(T_map_lidar, t_ns, motion);
  const Covariance3 of_lidar = found.refined.covariance +
                               (odometer.knows_motion() ? odometer.doubt_of_motion()
                                                        : doubt_of_motion(motion, memory.motion()));
  pose.covariance = covariance_of_base(of_lidar, T_map_lidar, pose.T_map_base);
  if (found.refined.spread > kSmearedSpread && place->bias.turns() < kTurnsOfANewLidar) {
    pose.covariance += doubt_of_bias();
  }
  odometer.correct(pose.T_map_base, pose.covariance);
  pose.room = map->room_at(pose.T_map_base.translation());
  pose.corners = corners;
  pose.inliers = found.explanation.hits;
  pose.rmse_m = found.refined.rmse_m;
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
