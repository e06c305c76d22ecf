// SPDX-License-Identifier: MIT
#include "baseline/paper_recognition.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::baseline {
namespace {

/// Tolerance of equal distances. The paper prints no value; here five times its corner error.
constexpr double kEqual_m = 0.05;
/// Tolerance of a point on a face.
constexpr double kOnFace_m = 0.05;
constexpr std::size_t kMaxFound = 1024;
constexpr std::size_t kMaxLevel = 64;
/// One corner outweighs all lines: stage 3 only breaks ties of stage 2.
constexpr int kVotesPerCorner = 1000;

bool is_type(const core::Breakpoint& breakpoint, const core::Corner& landmark) {
  return landmark.is_convex() ==
         (breakpoint.kind == core::BreakpointKind::kTerminal || breakpoint.convex);
}

bool is_equal(double seen_m, double drawn_m) { return std::abs(seen_m - drawn_m) < kEqual_m; }

}  // namespace

PaperRecognition::PaperRecognition(const core::WallMap& map, const core::Catalog& catalog)
    : map_(map), catalog_(catalog), found_(kMaxFound) {}

bool PaperRecognition::find_nearest(std::span<const core::Breakpoint> breakpoints) {
  nearest_ = {};
  for (const core::Breakpoint& breakpoint : breakpoints) {
    if (breakpoint.kind != core::BreakpointKind::kCorner) continue;
    const core::Breakpoint* candidate = &breakpoint;
    for (const core::Breakpoint*& place : nearest_) {
      if (place == nullptr || candidate->position.squaredNorm() < place->position.squaredNorm()) {
        std::swap(place, candidate);
      }
      if (candidate == nullptr) break;
    }
  }
  return nearest_.back() != nullptr;
}

void PaperRecognition::propose(const core::Corner& a, const core::Corner& b,
                               const core::Corner& c) {
  const core::Vec2 seen = nearest_[1]->position - nearest_[0]->position;
  const core::Vec2 drawn = b.position - a.position;
  const double heading_rad =
      core::normalize_angle(std::atan2(drawn.y(), drawn.x()) - std::atan2(seen.y(), seen.x()));
  const core::Vec2 origin = (a.position + b.position) / 2 -
                            core::Pose2{0, 0, heading_rad} *
                                core::Vec2((nearest_[0]->position + nearest_[1]->position) / 2);
  const core::Pose2 T_map_lidar{origin.x(), origin.y(), heading_rad};
  // Distances alone do not distinguish a triangle from its mirror image.
  if ((T_map_lidar * nearest_[2]->position - c.position).norm() < 2 * kEqual_m) {
    found_.add(T_map_lidar);
  }
}

void PaperRecognition::match_nearest() {
  const auto landmarks = catalog_.landmarks();
  const auto seen_m = [&](int i, int j) {
    return (nearest_[static_cast<std::size_t>(i)]->position -
            nearest_[static_cast<std::size_t>(j)]->position)
        .norm();
  };
  const double first_m = seen_m(0, 1);
  const double second_m = seen_m(0, 2);
  const double third_m = seen_m(1, 2);
  for (std::uint32_t i = 0; i < landmarks.size(); ++i) {
    if (!is_type(*nearest_[0], landmarks[i])) continue;
    for (const core::LandmarkPair& one : catalog_.neighbours(i)) {
      const core::Corner& b = landmarks[one.to];
      if (!is_equal(first_m, one.distance_m) || !is_type(*nearest_[1], b)) continue;
      for (const core::LandmarkPair& other : catalog_.neighbours(i)) {
        const core::Corner& c = landmarks[other.to];
        if (is_equal(second_m, other.distance_m) && is_type(*nearest_[2], c) &&
            is_equal(third_m, (b.position - c.position).norm())) {
          propose(landmarks[i], b, c);
        }
      }
    }
  }
}

int PaperRecognition::recognised(std::span<const core::Breakpoint> breakpoints,
                                 const core::Pose2& T_map_lidar) const {
  int count = 0;
  for (const core::Breakpoint& breakpoint : breakpoints) {
    const core::Vec2 point = T_map_lidar * breakpoint.position;
    bool found = false;
    catalog_.visit_near(point, [&](std::uint32_t index) {
      const core::Corner& landmark = catalog_.landmarks()[index];
      found = found || (is_type(breakpoint, landmark) &&
                        (landmark.position - point).norm() < core::Catalog::kVisitRadius_m);
    });
    count += found ? 1 : 0;
  }
  return count;
}

int PaperRecognition::lines_on_walls(std::span<const core::WallSegment> segments,
                                     const core::Pose2& T_map_lidar) const {
  int count = 0;
  for (const core::WallSegment& segment : segments) {
    const core::Vec2 middle = T_map_lidar * core::Vec2((segment.first + segment.last) / 2);
    const auto faces = map_.face_grid().at(middle);
    count += std::any_of(faces.begin(), faces.end(), [&](std::uint32_t i) {
      const core::Face& face = map_.faces()[i];
      const double along_m = face.direction.dot(middle - face.from);
      return std::abs(face.normal.dot(middle) - face.offset_m) < kOnFace_m && along_m >= 0 &&
             along_m <= face.length_m;
    });
  }
  return count;
}

std::span<const core::PoseHypothesis> PaperRecognition::hypotheses(
    std::span<const core::Breakpoint> breakpoints, std::span<const core::WallSegment> segments) {
  found_.clear();
  if (!find_nearest(breakpoints)) return {};
  match_nearest();
  const std::span<core::PoseHypothesis> hypotheses = found_.most_voted(kMaxFound);
  for (core::PoseHypothesis& place : hypotheses) {
    place.votes = kVotesPerCorner * recognised(breakpoints, place.T_map_lidar) +
                  lines_on_walls(segments, place.T_map_lidar);
  }
  std::sort(hypotheses.begin(), hypotheses.end(), core::is_better);
  std::size_t level = 0;
  while (level < std::min(hypotheses.size(), kMaxLevel) &&
         hypotheses[level].votes == hypotheses[0].votes) {
    ++level;
  }
  return hypotheses.first(level);
}

}  // namespace cornerd::baseline
