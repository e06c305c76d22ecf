// SPDX-License-Identifier: MIT
#include "calibration/fault_list.hpp"

#include <utility>

namespace cornerd::calibration {
namespace {

/// Of the recent scans: in a map of another place hardly any scan has a pose, whereas among
/// furniture and people that hide half of the walls some always have one.
constexpr std::size_t kMost = RecentPoses::kScans * 95 / 100;
/// The same where the map and its variants were tried on some of them, in vain.
constexpr std::size_t kMostExamined = RecentPoses::kScans * 3 / 4;
/// In rooms that look alike most scans are ambiguous, but hardly one is lost.
constexpr std::size_t kLeastLost = RecentPoses::kScans / 2;

/// Of a minute's scans: so many fit nowhere by no crowd or closed door alone.
constexpr std::size_t kMostOfAMinute = RecentPoses::kScansOfAMinute * 2 / 3;
/// Of the last hundred scans: in a map whose walls are where it says hardly so many are lost, but
/// for a lidar that is covered or a crowd. Chosen below the 11 of a simulated drive with odometry
/// in a map 3 % too large (wrong_setups.py). The variants decide.
constexpr std::size_t kManyLost = 8;
/// Scans in which odometry contradicts the lidar; after a slip it is some.
constexpr std::size_t kManyContradicted = RecentPoses::kScans / 2;

/// Of all readings: a wheel that spins up now and then moves as far.
constexpr double kManyJumps = 0.02;

/// A robot's own body may be nearer than min_range in half of the view; nothing is beyond a
/// lidar's reach.
constexpr double kMostNear = 0.6;
constexpr double kMostFar = 0.25;

/// A scan that shows so many walls is that of an uncovered lidar.
constexpr std::size_t kUncoveredSegments = 3;

std::string lost_hint(std::size_t lost, const core::FloorPlan* plan) {
  if (plan == nullptr) {
    return "the scans fit in none of the config's maps: check that the map of this place is one of "
           "\"maps\", that the robot is inside it, and lidar.mount.inverted";
  }
  return std::to_string(lost) + " of the last " + std::to_string(RecentPoses::kScans) +
         " scans fit nowhere in the map \"" + plan->name +
         "\": check that it is the map of this place (not mirrored, in metres), that the robot is "
         "inside it, that closed doors and furniture do not hide its walls, and "
         "lidar.mount.inverted";
}

bool is_cut(const core::Scan& scan, const RecentPoses::Limits& limits) {
  double returns = 0;
  double near = 0;
  double far = 0;
  for (const core::Sample& sample : scan.samples()) {
    if (!(sample.range_m > 0)) continue;
    ++returns;
    near += sample.range_m < limits.min_range_m ? 1 : 0;
    far += sample.range_m > limits.max_range_m ? 1 : 0;
  }
  return near > kMostNear * returns || far > kMostFar * returns;
}

/// What the gate left out, where it may be why the rest contradicts the lidar.
std::string lost_counts(const core::OdometryCounters& counters) {
  if (static_cast<double>(counters.jumps) > kManyJumps * static_cast<double>(counters.readings)) {
    return "; " + std::to_string(counters.jumps) +
           " readings moved farther than advanced.odometry.max_speed allows, and were left out";
  }
  if (counters.restarts == 0) return {};
  return "; counts began again elsewhere, " + std::to_string(counters.restarts) +
         " times so far: if they wrap, set advanced.odometry.counter_max to the highest count";
}

}  // namespace

void FaultList::add(std::string_view name, std::string hint) {
  if (names_.empty()) hint_ = std::move(hint);
  names_.push_back(name);
}

bool is_outside(const core::WallMap& map, const core::Vec2& place) {
  constexpr double kMargin_m = 1;
  return (place - map.lower_left()).minCoeff() < -kMargin_m ||
         (map.upper_right() - place).minCoeff() < -kMargin_m;
}

void RecentPoses::add(const core::ScanResult& result, const core::Scan& scan, const Limits& limits,
                      const core::WallMap* map) {
  const core::PoseEstimate& pose = result.pose;
  const bool fits_nowhere =
      pose.state == core::PoseState::kLost || pose.state == core::PoseState::kPredicted;
  const bool shows_walls = result.detection.segments.size() >= kUncoveredSegments;
  lost_ <<= 1;
  lost_[0] = fits_nowhere && shows_walls;
  lost_in_a_minute_ <<= 1;
  lost_in_a_minute_[0] = lost_[0];
  blank_ <<= 1;
  blank_[0] = fits_nowhere && !shows_walls;
  contradicted_ <<= 1;
  contradicted_[0] = result.odometry.present && !result.odometry.healthy;
  ambiguous_ <<= 1;
  ambiguous_[0] = pose.state == core::PoseState::kAmbiguous;
  cut_ <<= 1;
  cut_[0] = !core::has_pose(pose.state) && is_cut(scan, limits);
  outside_ <<= 1;
  outside_[0] = map != nullptr && core::has_pose(pose.state) &&
                is_outside(*map, pose.T_map_base.translation());
}

bool RecentPoses::doubts_map() const {
  return lost() >= kManyLost || contradicted() >= kManyContradicted;
}

void FaultList::add_map(const std::optional<MapFinding>& finding, const RecentPoses& recent,
                        const core::FloorPlan* plan) {
  if (recent.cut() >= kManyLost) {
    add("range-limits",
        "most of the lidar's returns are beyond advanced.lidar.min_range and max_range, which are "
        "in metres, and are not used");
  }
  const std::size_t most = finding ? kMostExamined : kMost;
  const bool is_mostly_lost = recent.lost() >= kLeastLost && recent.unnamed() >= most;
  if (finding && (is_mostly_lost || finding->fault != MapFault::kNoVariant)) {
    add(name_of(*finding), describe(*finding, plan->name));
  } else if (is_mostly_lost) {
    add("map-mismatch", lost_hint(recent.lost(), plan));
  } else if (recent.lost_in_a_minute() >= kMostOfAMinute && plan != nullptr) {
    add("map-mismatch", "most scans of the last minute fit nowhere in the map \"" + plan->name +
                            "\": its walls may be hidden (closed doors, furniture), missing or "
                            "elsewhere by now");
  }
  if (recent.blank() == RecentPoses::kScans) {
    add("no-walls",
        "the last scans show hardly a wall: the lidar may be covered, or lidar.noise and "
        "advanced.detector may be those of another lidar");
  }
  if (recent.ambiguous() == RecentPoses::kScans && plan != nullptr) {
    add("map-alike", "the last scans fit several places of the map \"" + plan->name +
                         "\": drive on, or say where the robot is: cornerctl set-pose "
                         "--pose=X,Y,THETA");
  }
  // The scans fit: the lidar is inside.
  if (recent.outside() >= kMost) {
    add("outside-map",
        "the robot's poses are more than a metre outside of the map, where the lidar is not: check "
        "that lidar.mount is in metres, and that the map has all walls");
  }
}

void FaultList::add_drive(const DriveFaults& drive, const OdometryNames& names,
                          const RecentPoses& recent, const core::OdometrySummary& odometry) {
  const std::string lost = lost_counts(odometry.counters);
  for (const std::string_view name : names_of(drive)) add(name, describe(drive, names) + lost);
  if (!drive.any() && odometry.present && !odometry.healthy &&
      recent.contradicted() >= kManyContradicted) {
    add("odometry-unhealthy",
        "the odometry contradicts the lidar and is not used: drive a minute, straight and with "
        "rotations both ways; if no reason is named here by then, check wheel_radius, track, "
        "counts_per_turn, the signs and times of the counts, lidar.mount, the map's measures, and "
        "whether wheels slip" +
            lost);
  }
}

}  // namespace cornerd::calibration
