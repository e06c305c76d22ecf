// SPDX-License-Identifier: MIT
// Start here, with localizer.cpp: one scan in, one pose out.
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
constexpr bool has_pose(PoseState state) {
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
  double p_wrong = 0;
  std::vector<Alternative> alternatives;  ///< capacity kMaxAlternatives; best first
};

/// Result of one scan. Reused from scan to scan.
struct ScanResult {
  ScanResult() { pose.alternatives.reserve(kMaxAlternatives); }
  PoseEstimate pose;
  Detection detection;
  OdometrySummary odometry;
  EstimatedBias bias;  ///< that the next scan will be corrected by
};

/// Localizes a lidar in a map, scan by scan. All memory is taken at construction: step() allocates
/// nothing, takes no lock and does no I/O (tests/unit/core/localizer_allocation_test.cpp). Not safe
/// for concurrent calls.
class Localizer {
 public:
  /// `map` may be null: breakpoints are detected and the state is always lost.
  Localizer(std::shared_ptr<const WallMap> map, const LocalizerConfig& config);
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// Localizes by one complete scan. The result is valid until the next call.
  const ScanResult& step(const Scan& scan);

  /// Adds a reading of wheels and gyro, before the scan that it belongs to. `now_ns`: see
  /// ReadingGate. Returns the pose at the reading's time, state predicted, where
  /// odometry.publish_predictions is on and the last scan gave a pose; else null. Valid until the
  /// next call.
  const PoseEstimate* add(const OdometryReading& reading, std::optional<TimeNs> now_ns);

  /// Adds the next sample of the scan in progress. Returns the pose at the sample's time, state
  /// tracking, where the sample ends a partial scan (updates_per_scan) that is consistent with the
  /// predicted state; else null. Valid until the next call.
  const PoseEstimate* follow(const Sample& sample);

  /// Sets the initial pose, as of the last scan.
  void set_pose(const Pose2& T_map_base);

  /// Forgets the pose: the next scan is localized globally.
  void relocalize();

  /// Back to the state after construction, estimates of the sensor included.
  void forget();

  /// For another lidar: forgets the estimated bias and noise, not the pose.
  void forget_lidar();

  /// The current estimate of the lidar's bias.
  EstimatedBias estimated_bias() const;
  /// Continues from a stored estimate of this lidar's bias.
  void resume(const EstimatedBias& learned);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace cornerd::core
