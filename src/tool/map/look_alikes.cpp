// SPDX-License-Identifier: MIT
#include "tool/map/look_alikes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/localizer.hpp"
#include "replay/simulator/random_poses.hpp"
#include "replay/simulator/scan_simulator.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::Vec2;

constexpr std::size_t kSamplesPerScan = 800;
constexpr std::uint64_t kNoiseSeed = 1;
/// A robot's lidar stays this far from walls.
constexpr double kMinClearance_m = 0.15;
constexpr double kMinStep_m = 0.05;
/// An alternative this near is the same pose.
constexpr double kSamePose_m = 0.1;
constexpr double kSamePose_rad = core::radians(5);
/// Lines of the report.
constexpr std::size_t kMaxLines = 12;

bool is_same_pose(const core::Pose2& one, const core::Pose2& other) {
  return (one.translation() - other.translation()).norm() < kSamePose_m &&
         std::abs(core::angle_between(one.theta_rad, other.theta_rad)) < kSamePose_rad;
}

std::string name_of(const core::WallMap& map, const core::Pose2& place) {
  if (const auto room = map.room_at(place.translation())) return map.plan().rooms[*room].name;
  return map.plan().rooms.empty() ? formatted("(%.2f, %.2f)", place.x_m, place.y_m) : "no room";
}

struct Ambiguity {
  std::size_t places = 0;
  double rotation_deg = 0;  ///< of one of them: what is alike may be turned
};

}  // namespace

std::vector<ExaminedPlace> examine_places(const std::shared_ptr<const core::WallMap>& map,
                                          std::size_t count) {
  const Vec2 size = map->upper_right() - map->lower_left();
  const double step_m = std::max(
      kMinStep_m,
      std::sqrt(size.x() * size.y() / static_cast<double>(std::max<std::size_t>(1, count))));
  replay::ScanSimulator lidar({}, kSamplesPerScan, kNoiseSeed);
  core::Localizer localizer(map, {});
  std::vector<ExaminedPlace> examined;
  for (double y = step_m / 2; y < size.y(); y += step_m) {
    for (double x = step_m / 2; x < size.x(); x += step_m) {
      const Vec2 point = map->lower_left() + Vec2(x, y);
      if (!replay::is_indoors(*map, point) || replay::clearance_at(*map, point) < kMinClearance_m)
        continue;
      ExaminedPlace result;
      result.place = {point.x(), point.y(), 0};
      localizer.relocalize();
      const core::PoseEstimate& pose = localizer.step(lidar.take(*map, result.place)).pose;
      result.is_known = pose.state == core::PoseState::kFix;
      result.is_lost = pose.state == core::PoseState::kLost;
      for (const core::Alternative& other : pose.alternatives) {
        if (!is_same_pose(other.T_map_base, result.place))
          result.look_alikes.push_back(other.T_map_base);
      }
      examined.push_back(std::move(result));
    }
  }
  return examined;
}

std::string describe_look_alikes(const core::WallMap& map,
                                 const std::vector<ExaminedPlace>& places) {
  if (places.empty()) {
    return "alike    no place examined: none is in a room or has walls on all sides; close the "
           "outline, outer doors too, or add rooms\n";
  }
  std::size_t alike = 0;
  std::size_t lost = 0;
  std::map<std::string, std::size_t> places_of;
  std::map<std::pair<std::string, std::string>, Ambiguity> ambiguities;
  for (const ExaminedPlace& place : places) {
    const std::string name = name_of(map, place.place);
    ++places_of[name];
    lost += place.is_lost ? 1 : 0;
    alike += place.look_alikes.empty() ? 0 : 1;
    std::map<std::string, double> others;  // each room once for this place
    for (const core::Pose2& other : place.look_alikes) {
      others.emplace(name_of(map, other),
                     core::angle_between(place.place.theta_rad, other.theta_rad));
    }
    for (const auto& [other, rotation_rad] : others) {
      Ambiguity& ambiguity = ambiguities[{name, other}];
      ++ambiguity.places;
      ambiguity.rotation_deg = rotation_rad * 180 / core::kPi;
    }
  }

  std::vector<std::pair<std::pair<std::string, std::string>, Ambiguity>> lines(ambiguities.begin(),
                                                                               ambiguities.end());
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.second.places > b.second.places; });
  std::string text =
      formatted("alike    %zu of %zu places look like others\n", alike, places.size());
  for (std::size_t i = 0; i < std::min(lines.size(), kMaxLines); ++i) {
    const auto& [names, ambiguity] = lines[i];
    text += formatted("         %s like %s, turned by %.0f degrees: %zu of %zu places\n",
                      names.first.c_str(),
                      names.first == names.second ? "itself" : names.second.c_str(),
                      std::abs(ambiguity.rotation_deg), ambiguity.places, places_of[names.first]);
  }
  if (lines.size() > kMaxLines) {
    text += formatted("         and %zu more\n", lines.size() - kMaxLines);
  }
  text += formatted("lost     %zu of %zu places show too little\n", lost, places.size());
  return text;
}

}  // namespace cornerd::tool
