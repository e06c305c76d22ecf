// SPDX-License-Identifier: MIT
#include "survey/drive_mapper.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "survey/scan_matcher.hpp"
#include "survey/scan_reader.hpp"
#include "survey/sighting_extractor.hpp"

namespace cornerd::survey {
namespace {

/// Walls sighted so seldom, and not for so many turns, were none.
constexpr std::size_t kSeldom = 3;
constexpr std::size_t kForgottenAfter = 40;
/// A face begins with a sighting whose direction is known to this.
constexpr double kNewFaceSigma_rad = core::radians(4);
/// Of the samples on walls: where so many are matched, no other heading is tried.
constexpr double kGoodShare = 0.8;
constexpr double kEnoughShare = 0.5;
constexpr double kLeastShareAlone = 0.4;
/// How far off such another heading is, and what is not known of the place then.
constexpr double kVague_rad = core::radians(6);
constexpr double kVague_m = 0.05;
/// Of what a robot may do from one turn to the next, to any place that walls tell.
constexpr double kMostWaySigmas = 3;
constexpr double kMaxRotationSigmas = 4;
/// Who turned so far from what was foreseen has to see more of what he knows.
constexpr double kSurprise_rad = core::radians(9);
/// So many turns in a row may be guessed; then the way is lost, and is not found again by chance.
constexpr std::size_t kMostGuesses = 3;
/// Of the samples on walls, in the turn that ends them.
constexpr double kFoundAgainShare = 0.6;
/// And in the first one after a pause in which the robot may have gone anywhere: it has not.
constexpr double kUnmovedShare = 0.8;
/// Each tells the turn's motion better, and that bends the turn less.
constexpr int kStraightenings = 2;

class Mapper {
 public:
  Mapper(const RecordedDrive& drive, const core::LocalizerConfig& config, const MappedDrive* before,
         bool anew)
      : before_(anew ? nullptr : before),
        reader_(drive, config, before ? before->learned : std::nullopt,
                before && !before->has_odometry ? std::span<const core::Pose2>(before->T_map_lidar)
                                                : std::span<const core::Pose2>(),
                anew ? std::span<const std::size_t>(before->unmatched_scans)
                     : std::span<const std::size_t>()),
        extractor_(config.detector, config.noise) {
    if (before_) {
      result_.faces = before->faces;
      result_.ties = before->ties;
    }
    for (MappedFace& face : result_.faces) {
      face.sightings = 0;
      face.id = next_id_++;
    }
    known_faces_ = next_id_;
    result_.has_odometry = drive.has_wheels();
    result_.first_point.push_back(0);
  }

  bool step() {
    if (!reader_.next()) return false;
    extract();
    locate();
    take_in();
    keep_points();
    return true;
  }

  MappedDrive finish() {
    forget(/*all=*/true);
    rename_faces();
    if (result_.has_odometry) result_.learned = reader_.learned();
    return std::move(result_);
  }

 private:
  void extract() {
    sightings_.clear();
    extractor_.extract(reader_.points(), sightings_);
  }

  void locate() {
    ScanPrior prior = reader_.prior();
    const std::size_t scan = reader_.scan();
    if (before_) {
      prior.T_map_lidar = before_->T_map_lidar[scan];
      prior.covariance = Eigen::Vector3d(1e-5, 1e-5, 1e-6).asDiagonal();
    }
    core::Pose2 T_map_lidar = prior.T_map_lidar;
    core::Covariance3 covariance = prior.covariance;
    double share =
        ScanMatcher::assign(sightings_, result_.faces, T_map_lidar, kExactReach, faces_of_);
    // Adjusted already, or the one that the map's frame is.
    const bool known = scan == 0 || (before_ && share > kEnoughShare);
    ScanMatch match;
    if (!known) {
      if (guesses_ <= kMostGuesses) match = find(prior);
      share = match.matched_share;
      if (match.valid) {
        T_map_lidar = match.T_map_lidar;
        covariance = match.covariance;
        // Along it the motion of the turns before was taken for this one's.
        is_blind_ = !prior.by_odometry && !match.by_walls();
        if (is_blind_) result_.degenerate_scans.push_back(scan);
      } else {
        result_.unmatched_scans.push_back(scan);
        if (reader_.straighten_again(T_map_lidar)) extract();
        ScanMatcher::assign(sightings_, result_.faces, T_map_lidar, kExactReach, faces_of_);
      }
    }
    const bool is_placed = known || match.valid;
    if (prior.after_pause && !known && !has_stayed(match)) result_.lost_scans.push_back(scan);
    // Where nothing but the walls tells the way, a turn that fits badly has lost it.
    begins_faces_ = scan == 0 || prior.by_odometry || (is_placed && share > kLeastShareAlone);
    if (result_.has_odometry && scan > 0 && !prior.by_odometry) {
      ++(reader_.is_contradicted() ? result_.contradicted_scans : result_.scans_without_odometry);
    }
    add_link(prior);
    result_.T_map_lidar.push_back(T_map_lidar);
    // A guess is no place to guess on from: without odometry it is the doubt that grows.
    guesses_ = result_.has_odometry || is_placed ? 0 : guesses_ + 1;
    if (guesses_ == 0) reader_.place(T_map_lidar, covariance);
  }

  static bool has_stayed(const ScanMatch& match) {
    return match.valid && match.matched_share > kUnmovedShare && match.by_walls();
  }

  ScanMatch find(const ScanPrior& prior) {
    // A wall that begins beside one that is known is not yet its next piece: where it was taken for
    // that, the end of a wall 0.1 m away told the place.
    matcher_.set_cautious(!result_.has_odometry);
    ScanMatch found = search(prior);
    if (!found.valid && !result_.has_odometry) {
      matcher_.set_cautious(false);
      found = search(prior);
    }
    for (int again = 0; again < kStraightenings && found.valid; ++again) {
      if (!reader_.straighten_again(found.T_map_lidar)) break;
      extract();
      found = match(found.T_map_lidar, prior.covariance, faces_of_);
      found.valid = is_believable(prior, found);
    }
    return found;
  }

  /// Without odometry the turn is left straightened by some motion that was tried.
  ScanMatch search(const ScanPrior& prior) {
    ScanMatch best = match(prior.T_map_lidar, prior.covariance, faces_of_);
    best.valid = is_believable(prior, best);
    const double enough = prior.by_odometry ? kEnoughShare : kGoodShare;
    if (best.valid && best.matched_share > enough) return best;
    // The heading is what is off most: a robot spins up within a turn, its wheels slip.
    for (const double away : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
      core::Pose2 start = prior.T_map_lidar;
      start.theta_rad = core::normalize_angle(start.theta_rad + away * 1.5 * kVague_rad);
      // A turn that is bent by another motion than its own fits nowhere.
      if (reader_.straighten_again(start)) extract();
      const ScanMatch other = match(start, vague(prior), other_faces_of_);
      if (!is_believable(prior, other)) continue;
      if (best.valid && other.matched_share <= best.matched_share) continue;
      best = other;
      faces_of_.swap(other_faces_of_);
    }
    return best;
  }

  static core::Covariance3 vague(const ScanPrior& prior) {
    return prior.covariance +
           core::Covariance3(
               Eigen::Vector3d(squared(kVague_m), squared(kVague_m), squared(kVague_rad))
                   .asDiagonal());
  }

  /// Where nothing but the walls tells the way, they must not tell what no robot does: walls that
  /// look alike are beside each other, and at right angles.
  bool is_believable(const ScanPrior& prior, const ScanMatch& match) const {
    if (!match.valid || result_.has_odometry) return match.valid;
    const core::Pose2 off = prior.T_map_lidar.inverse() * match.T_map_lidar;
    // After blind turns the place is off by what was guessed of all of them.
    return (is_blind_ || off.translation().norm() < kMostWaySigmas * prior.sigma_m) &&
           std::abs(off.theta_rad) < kMaxRotationSigmas * prior.sigma_rad &&
           match.matched_share > least_share(std::abs(off.theta_rad));
  }

  /// Of a match that is so far from the heading that was foreseen.
  double least_share(double rotated_rad) const {
    if (guesses_ > 0) return kFoundAgainShare;
    return rotated_rad > kSurprise_rad ? kLeastShareAlone : 0;
  }

  ScanMatch match(const core::Pose2& start, const core::Covariance3& covariance,
                  std::vector<std::uint32_t>& faces_of) {
    const double place_m = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
    const double heading_rad = std::sqrt(covariance(2, 2));
    const Reach reach{std::clamp(3 * place_m, 0.05, 0.5),
                      std::clamp(3 * heading_rad, core::radians(3), core::radians(25))};
    return matcher_.match(sightings_, result_.faces, start, covariance, reach, faces_of);
  }

  void add_link(const ScanPrior& prior) {
    DriveLink link;
    // A turn that was not placed stands where it was guessed to be.
    link.T_before_now = prior.by_odometry || result_.T_map_lidar.empty()
                            ? prior.T_before_now
                            : result_.T_map_lidar.back().inverse() * prior.T_map_lidar;
    link.covariance =
        Eigen::Vector3d(squared(prior.sigma_m), squared(prior.sigma_m), squared(prior.sigma_rad))
            .asDiagonal();
    result_.links.push_back(link);
  }

  void take_in() {
    const auto scan = static_cast<std::uint32_t>(reader_.scan());
    const core::Pose2& T_map_lidar = result_.T_map_lidar.back();
    for (std::size_t i = 0; i < sightings_.size(); ++i) {
      const Sighting& seen = sightings_[i];
      if (faces_of_[i] == kNoFace) {
        if (seen.sigma_angle_rad > kNewFaceSigma_rad || !begins_faces_) continue;
        result_.faces.emplace_back(seen, T_map_lidar, scan);
        result_.faces.back().id = next_id_++;
        result_.observations.push_back({scan, result_.faces.back().id, seen});
        continue;
      }
      MappedFace& face = result_.faces[faces_of_[i]];
      if (face.id < known_faces_) {
        // Adjusted already, and to be adjusted again: only what was seen of it counts.
        face.see(seen, T_map_lidar, scan);
      } else {
        face.update(seen, T_map_lidar, scan);
      }
      result_.observations.push_back({scan, face.id, seen});
    }
    if (scan % kForgottenAfter == 0) forget(/*all=*/false);
  }

  /// Takes out the faces that were never seen again.
  void forget(bool all) {
    const std::size_t before = result_.faces.size();
    std::erase_if(result_.faces, [&](const MappedFace& face) {
      if (face.sightings >= kSeldom) return false;
      return all || (face.id >= known_faces_ && face.last_scan + kForgottenAfter < reader_.scan());
    });
    result_.forgotten_faces += before - result_.faces.size();
  }

  /// From the faces' ids to their places in the list.
  void rename_faces() {
    std::vector<std::uint32_t> places(next_id_, kNoFace);
    for (std::size_t i = 0; i < result_.faces.size(); ++i) {
      places[result_.faces[i].id] = static_cast<std::uint32_t>(i);
    }
    std::erase_if(result_.observations, [&](Observation& observation) {
      observation.face = places[observation.face];
      return observation.face == kNoFace;
    });
  }

  void keep_points() {
    for (const core::PolarPoint& point : reader_.points().points()) {
      result_.points.push_back(
          {static_cast<float>(point.bearing_rad), static_cast<float>(point.range_m)});
    }
    result_.first_point.push_back(result_.points.size());
  }

  const MappedDrive* before_;
  ScanReader reader_;
  SightingExtractor extractor_;
  ScanMatcher matcher_;
  std::vector<Sighting> sightings_;
  std::vector<std::uint32_t> faces_of_;
  std::vector<std::uint32_t> other_faces_of_;
  bool is_blind_ = false;     ///< the last turn that was placed
  std::size_t guesses_ = 0;   ///< turns in a row that only their motion before tells
  bool begins_faces_ = true;  ///< with what the turn saw beyond them
  std::uint32_t next_id_ = 0;
  std::uint32_t known_faces_ = 0;  ///< ids below this are of the earlier pass
  MappedDrive result_;
};

}  // namespace

MappedDrive map_drive(const RecordedDrive& drive, const core::LocalizerConfig& config,
                      const MappedDrive* before, const Progress& progress, bool anew) {
  Mapper mapper(drive, config, before, anew);
  for (std::size_t done = 0; mapper.step(); ++done) {
    if (progress) progress(done);
  }
  return mapper.finish();
}

}  // namespace cornerd::survey
