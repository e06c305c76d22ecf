// SPDX-License-Identifier: MIT
#include "survey/face_merging.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cornerd::survey {
namespace {

constexpr double kMergeSigmas = 3.5;
/// Limit for short faces, whose direction is uncertain: they must not merge with all they cross.
constexpr double kMaxMergeAngle_rad = core::radians(8);

/// Begin and end of `other` along `face`, begin first.
std::pair<double, double> extent_on(const LineLandmark& face, const LineLandmark& other) {
  const double a = face.along_of(other.first());
  const double b = face.along_of(other.last());
  return {std::min(a, b), std::max(a, b)};
}

bool lie_on_one_line(const LineLandmark& longer, const LineLandmark& shorter,
                     const MergeLimits& limits) {
  const double rotation_rad = core::angle_between(longer.normal_rad(), shorter.normal_rad());
  const double angle_sigma_rad = std::sqrt(longer.covariance()(0, 0) + shorter.covariance()(0, 0));
  const double allowed_rad =
      std::min(kMaxMergeAngle_rad, limits.heading_rad + kMergeSigmas * angle_sigma_rad);
  if (std::abs(rotation_rad) > allowed_rad) return false;
  // Compared in the middle of what they share, or where they are nearest to each other.
  const auto [begin_m, end_m] = extent_on(longer, shorter);
  const double middle_m =
      (std::max(begin_m, longer.begin_m()) + std::min(end_m, longer.end_m())) / 2;
  const double nearest_m = std::clamp(middle_m, longer.begin_m(), longer.end_m());
  const core::Vec2 place = longer.at(nearest_m);
  const double own_m = std::clamp(shorter.along_of(place), shorter.begin_m(), shorter.end_m());
  const double sigma_m = std::sqrt(longer.variance_at(middle_m) + shorter.variance_at(own_m));
  const double apart_m = longer.height_of(shorter.at(own_m));
  return std::abs(apart_m) < limits.place_m + kMergeSigmas * std::min(sigma_m, limits.place_m);
}

/// Share of the shorter face's cells at which rays ended on both.
double shared_cells(const LineLandmark& one, const FaceEvidence& on_one, const LineLandmark& other,
                    const FaceEvidence& on_other) {
  const bool other_shorter = other.length_m() < one.length_m();
  const FaceEvidence& shorter = other_shorter ? on_other : on_one;
  const FaceEvidence& longer = other_shorter ? on_one : on_other;
  const LineLandmark& from = other_shorter ? other : one;
  const LineLandmark& to = other_shorter ? one : other;
  std::size_t hit = 0;
  std::size_t both = 0;
  for (std::size_t cell = 0; cell < shorter.size(); ++cell) {
    const double along_m = shorter.along_of(cell) + FaceEvidence::kCell_m / 2;
    if (shorter.hits(cell) == 0 || along_m < from.begin_m() || along_m > from.end_m()) continue;
    ++hit;
    both += longer.hits_at(to.along_of(from.at(along_m))) > 0 ? 1 : 0;
  }
  return hit > 0 ? static_cast<double>(both) / static_cast<double>(hit) : 0;
}

/// One wall that was mapped twice, since the trajectory drifted in between.
bool are_duplicates(const LineLandmark& one, const FaceEvidence& on_one, const LineLandmark& other,
                    const FaceEvidence& on_other, const MergeLimits& limits) {
  constexpr double kMostlyShared = 0.5;
  const double rotation_rad = core::angle_between(one.normal_rad(), other.normal_rad());
  if (std::abs(rotation_rad) > limits.duplicate_rad) return false;
  const LineLandmark& shorter = other.length_m() < one.length_m() ? other : one;
  const LineLandmark& longer = other.length_m() < one.length_m() ? one : other;
  const core::Vec2 middle = shorter.at((shorter.begin_m() + shorter.end_m()) / 2);
  if (std::abs(longer.height_of(middle)) > limits.duplicate_m) return false;
  return shared_cells(one, on_one, other, on_other) > kMostlyShared;
}

bool are_one(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence, std::size_t a,
             std::size_t b, const MergeLimits& limits) {
  const LineLandmark& one = drive.faces[a];
  const LineLandmark& other = drive.faces[b];
  if (one.normal().dot(other.normal()) < 0.9) return false;
  const auto [begin_m, end_m] = extent_on(one, other);
  const double gap_m = std::max(begin_m - one.end_m(), one.begin_m() - end_m);
  if (gap_m > (evidence.empty() ? 0.0 : limits.gap_m)) return false;
  if (!evidence.empty() && gap_m < 0 &&
      are_duplicates(one, evidence[a], other, evidence[b], limits)) {
    return true;
  }
  const bool first_longer = one.length_m() >= other.length_m();
  return lie_on_one_line(first_longer ? one : other, first_longer ? other : one, limits);
}

}  // namespace

std::size_t merge_faces(MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                        const MergeLimits& limits) {
  // Faces with fewer observations are merged into those with more.
  std::vector<std::uint32_t> order(drive.faces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return drive.faces[a].observations > drive.faces[b].observations;
  });
  std::vector<std::uint32_t> into(drive.faces.size());
  std::iota(into.begin(), into.end(), 0);
  std::size_t merged = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const std::uint32_t host = order[k];
      if (into[host] != host || !are_one(drive, evidence, host, order[i], limits)) continue;
      into[order[i]] = host;
      const LineLandmark& guest = drive.faces[order[i]];
      LineLandmark& face = drive.faces[host];
      face.extend(guest.first());
      face.extend(guest.last());
      face.observations += guest.observations;
      face.first_scan = std::min(face.first_scan, guest.first_scan);
      face.last_scan = std::max(face.last_scan, guest.last_scan);
      ++merged;
      break;
    }
  }
  if (merged == 0) return 0;

  std::vector<std::uint32_t> place(drive.faces.size(), kNoFace);
  std::vector<LineLandmark> kept;
  for (std::size_t i = 0; i < drive.faces.size(); ++i) {
    if (into[i] != i) continue;
    place[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(drive.faces[i]);
  }
  for (MatchedObservation& observation : drive.observations) {
    observation.face = place[into[observation.face]];
  }
  drive.faces = std::move(kept);
  return merged;
}

std::size_t split_revisited(MappedDrive& drive, std::size_t from_scan, double distance_m) {
  const std::vector<double> travelled = travelled_m(drive);
  const std::size_t known = drive.faces.size();
  std::vector<std::uint32_t> now_of(known);  // current index of each face
  std::iota(now_of.begin(), now_of.end(), 0);
  std::vector<std::uint32_t> last_seen(known, kNoFace);
  for (MatchedObservation& observation : drive.observations) {
    const std::uint32_t face = observation.face;
    const std::uint32_t last = last_seen[face];
    last_seen[face] = observation.scan;
    if (last != kNoFace && observation.scan >= from_scan &&
        travelled[observation.scan] - travelled[last] > distance_m) {
      now_of[face] = static_cast<std::uint32_t>(drive.faces.size());
      drive.faces.push_back(drive.faces[face]);
    }
    observation.face = now_of[face];
  }
  if (drive.faces.size() > known) measure_faces(drive);
  return drive.faces.size() - known;
}

}  // namespace cornerd::survey
