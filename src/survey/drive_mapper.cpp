// SPDX-License-Identifier: MIT
#include "survey/drive_mapper.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "survey/line_extractor.hpp"
#include "survey/scan_matcher.hpp"
#include "survey/scan_reader.hpp"

namespace cornerd::survey {
namespace {

/// A face with fewer observations, and none in the last kForgottenAfter scans, is discarded.
constexpr std::size_t kMinObservations = 3;
constexpr std::size_t kForgottenAfter = 40;
/// Largest angle sigma of an observation that begins a face.
constexpr double kNewFaceSigma_rad = core::radians(4);
/// Shares of the samples on lines that are matched. From kGoodShare on (kEnoughShare with odometry)
/// no other heading is tried.
constexpr double kGoodShare = 0.8;
constexpr double kEnoughShare = 0.5;
constexpr double kMinShareAlone = 0.4;
/// Extra sigmas of the prior where other headings are tried.
constexpr double kWidenedSigma_rad = core::radians(6);
constexpr double kWidenedSigma_m = 0.05;
/// Without odometry: gates of a match against the prediction.
constexpr double kMaxTranslationSigmas = 3;
constexpr double kMaxRotationSigmas = 4;
/// A heading this far from the prediction needs a larger matched share.
constexpr double kLargeDeviation_rad = core::radians(9);
/// After more unmatched scans in a row the pose is lost, and no further match is tried.
constexpr std::size_t kMaxUnmatched = 3;
/// Matched share of the scan that ends a run of unmatched ones.
constexpr double kFoundAgainShare = 0.6;
/// Matched share of the first scan after a pause that shows that the robot stayed.
constexpr double kUnmovedShare = 0.8;
constexpr int kDeskewRounds = 2;

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
      result_.loop_constraints = before->loop_constraints;
    }
    for (LineLandmark& face : result_.faces) {
      face.observations = 0;
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
    observations_.clear();
    extractor_.extract(reader_.points(), observations_);
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
        ScanMatcher::assign(observations_, result_.faces, T_map_lidar, kExactRadius, faces_of_);
    // Adjusted already, or the origin of the map frame.
    const bool known = scan == 0 || (before_ && share > kEnoughShare);
    ScanMatch match;
    if (!known) {
      if (unmatched_in_a_row_ <= kMaxUnmatched) match = find(prior);
      share = match.matched_share;
      if (match.valid) {
        T_map_lidar = match.T_map_lidar;
        covariance = match.covariance;
        // The position along the walls is extrapolated.
        is_degenerate_ = !prior.by_odometry && !match.is_constrained();
        if (is_degenerate_) result_.degenerate_scans.push_back(scan);
      } else {
        result_.unmatched_scans.push_back(scan);
        if (reader_.deskew_again(T_map_lidar)) extract();
        ScanMatcher::assign(observations_, result_.faces, T_map_lidar, kExactRadius, faces_of_);
      }
    }
    const bool is_placed = known || match.valid;
    if (prior.after_pause && !known && !has_stayed(match)) result_.displaced_scans.push_back(scan);
    // Without odometry, a scan that matches badly may be in a wrong place.
    begins_faces_ = scan == 0 || prior.by_odometry || (is_placed && share > kMinShareAlone);
    if (result_.has_odometry && scan > 0 && !prior.by_odometry) {
      ++(reader_.is_contradicted() ? result_.contradicted_scans : result_.scans_without_odometry);
    }
    add_odometry_edge(prior);
    result_.T_map_lidar.push_back(T_map_lidar);
    // Without odometry, an extrapolated pose is not extrapolated further: the covariance grows.
    unmatched_in_a_row_ = result_.has_odometry || is_placed ? 0 : unmatched_in_a_row_ + 1;
    if (unmatched_in_a_row_ == 0) reader_.place(T_map_lidar, covariance);
  }

  static bool has_stayed(const ScanMatch& match) {
    return match.valid && match.matched_share > kUnmovedShare && match.is_constrained();
  }

  ScanMatch find(const ScanPrior& prior) {
    // A line beside a face may be another wall's end, which gives a wrong position along a
    // corridor.
    matcher_.set_requires_overlap(!result_.has_odometry);
    ScanMatch found = search(prior);
    if (!found.valid && !result_.has_odometry) {
      matcher_.set_requires_overlap(false);
      found = search(prior);
    }
    for (int again = 0; again < kDeskewRounds && found.valid; ++again) {
      if (!reader_.deskew_again(found.T_map_lidar)) break;
      extract();
      found = match(found.T_map_lidar, prior.covariance, faces_of_);
      found.valid = is_plausible(prior, found);
    }
    return found;
  }

  /// Without odometry the scan is left deskewed by one of the motions that were tried.
  ScanMatch search(const ScanPrior& prior) {
    ScanMatch best = match(prior.T_map_lidar, prior.covariance, faces_of_);
    best.valid = is_plausible(prior, best);
    const double enough = prior.by_odometry ? kEnoughShare : kGoodShare;
    if (best.valid && best.matched_share > enough) return best;
    // The heading errs most: a robot starts to rotate within a scan, or its wheels slip.
    for (const double away : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
      core::Pose2 start = prior.T_map_lidar;
      start.theta_rad = core::normalize_angle(start.theta_rad + away * 1.5 * kWidenedSigma_rad);
      // A scan deskewed by a wrong motion matches nowhere.
      if (reader_.deskew_again(start)) extract();
      const ScanMatch other = match(start, widened(prior), other_faces_of_);
      if (!is_plausible(prior, other)) continue;
      if (best.valid && other.matched_share <= best.matched_share) continue;
      best = other;
      faces_of_.swap(other_faces_of_);
    }
    return best;
  }

  static core::Covariance3 widened(const ScanPrior& prior) {
    return prior.covariance +
           core::Covariance3(Eigen::Vector3d(squared(kWidenedSigma_m), squared(kWidenedSigma_m),
                                             squared(kWidenedSigma_rad))
                                 .asDiagonal());
  }

  /// Without odometry, rejects matches that imply an implausible motion: similar walls often lie
  /// beside each other, and at right angles.
  bool is_plausible(const ScanPrior& prior, const ScanMatch& match) const {
    if (!match.valid || result_.has_odometry) return match.valid;
    const core::Pose2 off = prior.T_map_lidar.inverse() * match.T_map_lidar;
    // After degenerate scans the error along the walls accumulates.
    return (is_degenerate_ || off.translation().norm() < kMaxTranslationSigmas * prior.sigma_m) &&
           std::abs(off.theta_rad) < kMaxRotationSigmas * prior.sigma_rad &&
           match.matched_share > least_share(std::abs(off.theta_rad));
  }

  /// Smallest matched share of a match whose heading is off the prediction by `rotated_rad`.
  double least_share(double rotated_rad) const {
    if (unmatched_in_a_row_ > 0) return kFoundAgainShare;
    return rotated_rad > kLargeDeviation_rad ? kMinShareAlone : 0;
  }

  ScanMatch match(const core::Pose2& start, const core::Covariance3& covariance,
                  std::vector<std::uint32_t>& faces_of) {
    const double place_m = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
    const double heading_rad = std::sqrt(covariance(2, 2));
    const SearchRadius radius{std::clamp(3 * place_m, 0.05, 0.5),
                              std::clamp(3 * heading_rad, core::radians(3), core::radians(25))};
    return matcher_.match(observations_, result_.faces, start, covariance, radius, faces_of);
  }

  void add_odometry_edge(const ScanPrior& prior) {
    OdometryEdge link;
    // The scan before may have been moved by a match after its prediction.
    link.T_before_now = prior.by_odometry || result_.T_map_lidar.empty()
                            ? prior.T_before_now
                            : result_.T_map_lidar.back().inverse() * prior.T_map_lidar;
    link.covariance =
        Eigen::Vector3d(squared(prior.sigma_m), squared(prior.sigma_m), squared(prior.sigma_rad))
            .asDiagonal();
    result_.odometry_edges.push_back(link);
  }

  void take_in() {
    const auto scan = static_cast<std::uint32_t>(reader_.scan());
    const core::Pose2& T_map_lidar = result_.T_map_lidar.back();
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const LineObservation& seen = observations_[i];
      if (faces_of_[i] == kNoFace) {
        if (seen.sigma_angle_rad > kNewFaceSigma_rad || !begins_faces_) continue;
        result_.faces.emplace_back(seen, T_map_lidar, scan);
        result_.faces.back().id = next_id_++;
        result_.observations.push_back({scan, result_.faces.back().id, seen});
        continue;
      }
      LineLandmark& face = result_.faces[faces_of_[i]];
      if (face.id < known_faces_) {
        // The line is adjusted already: only the extent grows.
        face.see(seen, T_map_lidar, scan);
      } else {
        face.update(seen, T_map_lidar, scan);
      }
      result_.observations.push_back({scan, face.id, seen});
    }
    if (scan % kForgottenAfter == 0) forget(/*all=*/false);
  }

  /// Discards faces with too few observations.
  void forget(bool all) {
    const std::size_t before = result_.faces.size();
    std::erase_if(result_.faces, [&](const LineLandmark& face) {
      if (face.observations >= kMinObservations) return false;
      return all || (face.id >= known_faces_ && face.last_scan + kForgottenAfter < reader_.scan());
    });
    result_.discarded_faces += before - result_.faces.size();
  }

  /// Replaces the faces' ids in the observations by indices.
  void rename_faces() {
    std::vector<std::uint32_t> places(next_id_, kNoFace);
    for (std::size_t i = 0; i < result_.faces.size(); ++i) {
      places[result_.faces[i].id] = static_cast<std::uint32_t>(i);
    }
    std::erase_if(result_.observations, [&](MatchedObservation& observation) {
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
  LineExtractor extractor_;
  ScanMatcher matcher_;
  std::vector<LineObservation> observations_;
  std::vector<std::uint32_t> faces_of_;
  std::vector<std::uint32_t> other_faces_of_;
  bool is_degenerate_ = false;          ///< the last matched scan
  std::size_t unmatched_in_a_row_ = 0;  ///< unmatched scans in a row
  bool begins_faces_ = true;            ///< unmatched observations begin new faces
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
