// SPDX-License-Identifier: MIT
// THE FILE TO READ FIRST, with localizer.cpp: one turn of the lidar in, one pose out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/geometry/pose2.hpp"
#include "core/localizer_config.hpp"
#include "core/map/wall_map.hpp"
#include "core/odometry/odometer.hpp"
#include "core/scan.hpp"

namespace cornerd::core {

enum class PoseState : std::uint8_t { kFix, kTracking, kPredicted, kAmbiguous, kLost };

/// True where a turn itself says where the robot is.
constexpr bool names_a_place(PoseState state) {
  return state == PoseState::kFix || state == PoseState::kTracking;
}

/// A place that explains the turn. The scores of one turn are shares of belief: they sum to 1.
struct Alternative {
  Pose2 T_map_base;
  double score = 0;
};

inline constexpr std::size_t kMaxAlternatives = 16;

/// Where the robot was at `t_ns`, and how far to believe it. In the states ambiguous and lost
/// nothing but `alternatives` says anything about the place.
struct PoseEstimate {
  std::uint64_t seq = 0;  ///< counts the estimates
  TimeNs t_ns = 0;
  PoseState state = PoseState::kLost;
  Pose2 T_map_base;
  Covariance3 covariance = Covariance3::Zero();
  std::optional<std::size_t> room;  ///< index into the map's rooms
  std::size_t corners = 0;          ///< breakpoints that were recognised
  std::size_t inliers = 0;          ///< samples that lie on the map's walls
  double rmse_m = 0;                ///< of the inliers
  double age_s = 0;                 ///< since the last turn that named a place
  /// The turn's belief that its likeliest place is not the right one: 0 to 1, Decision::doubt.
  double doubt = 0;
  std::vector<Alternative> alternatives;  ///< capacity kMaxAlternatives; best first
};

/// Everything that one turn gave. Reused from turn to turn.
struct ScanResult {
  ScanResult() { pose.alternatives.reserve(kMaxAlternatives); }
  PoseEstimate pose;
  Detection detection;
  OdometrySummary odometry;
  LearnedBias bias;  ///< that the next turn will be corrected by
};

/// Finds the robot in a map, turn by turn. All memory is taken at construction: step() allocates
/// nothing, takes no lock, does no I/O (tests/unit/core/localizer_allocation_test.cpp counts).
/// Not safe for concurrent calls.
class Localizer {
 public:
  /// Without a map it detects breakpoints and is always lost.
  Localizer(std::shared_ptr<const WallMap> map, const LocalizerConfig& config);
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// Localizes in one complete turn. The result is valid until the next call.
  const ScanResult& step(const Scan& scan);

  /// What wheels and gyro say; before the turn that it belongs to. `now_ns`: see ReadingGate. Where
  /// odometry.publish is on and the last turn named a place: where the robot is by now, in the
  /// state predicted, valid until the next call; else null.
  const PoseEstimate* add(const OdometryReading& reading, std::optional<TimeNs> now_ns);

  /// The next sample of the turn in progress, after the turn that it ended. Where
  /// updates_per_scan asks for poses before the turn's end, and this sample ends a part of it that
  /// agrees with where the robot should be: where it is, at the time of the sample, in the state
  /// tracking, valid until the next call; else null.
  const PoseEstimate* follow(const Sample& sample);

  /// Somebody knows that the robot is about there, as of the last turn.
  void set_pose(const Pose2& T_map_base);

  /// Forgets where the robot was: the next turn is recognised without a prior.
  void relocalize();

  /// Forgets everything, what was learnt of the sensor included: as newly constructed.
  void forget();

  /// Another lidar: forgets how the last one erred and how noisy it was, not where the robot is.
  void forget_lidar();

  /// How the lidar errs always, as far as it is known by now.
  LearnedBias learned_bias() const;
  /// What was learnt of this lidar before.
  void resume(const LearnedBias& learned);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace cornerd::core
