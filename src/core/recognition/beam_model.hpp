// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/ray_caster.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// What the rays of a scan do at a pose if every wall is where the map has it.
struct BeamCounts {
  std::size_t rays = 0;
  std::size_t hits = 0;       ///< on the face that the ray meets, within the noise and 3 mm
  std::size_t near_hits = 0;  ///< close to it: a wall slightly displaced
  std::size_t shorts = 0;     ///< short of it: an unmapped obstacle; or where no face is
  std::size_t free_space_violations = 0;  ///< beyond it
  /// Nats, over ranges that any other place would give; as if rays were independent.
  double log_likelihood = 0;

  double hit_share() const { return share(hits); }
  double near_hit_share() const { return share(hits + near_hits); }
  double violation_share() const { return share(free_space_violations); }

  /// Enough rays are on walls, and hardly any goes through one, for the place to be the right one.
  bool explains_scan() const;
  /// Hardly any ray is left for a competing place. `expected`: near the prior, where unmapped
  /// obstacles may take a larger share.
  bool is_conclusive(bool expected) const;

 private:
  double share(std::size_t count) const {
    return rays == 0 ? 0 : static_cast<double>(count) / static_cast<double>(rays);
  }
};

/// What they do in a map that is inexact and incomplete.
struct BeamStatistics {
  std::size_t rays = 0;
  std::size_t hits = 0;    ///< on the face that the ray meets, within its uncertainty
  std::size_t shorts = 0;  ///< before it: something unmapped
  std::size_t free_space_violations = 0;  ///< beyond it
  double map_sigma_m = 0;                 ///< the likeliest standard deviation of a face's offset
  double log_likelihood = 0;   ///< nats, over ranges that any other place would give; tempered
  double faces_log_ratio = 0;  ///< the part of it by hits
  double faces = 0;            ///< that are hit; one with less than three nominal rays is a part
  double unseen_faces = 0;     ///< that should be in view, and hardly a ray hits
  double predicted = 0;        ///< rays that should meet a face
  double predicted_hits = 0;   ///< that meet it, and no other
  double obstacles_m = 0;      ///< width of the runs of short rays
  double missing_walls = 0;    ///< runs of rays through a face; short faces are a part
  double rays_through = 0;     ///< nominal rays in these runs, the same
};

/// Beam model on faces (Thrun, Burgard and Fox, Probabilistic Robotics, section 6.3) whose errors
/// are common to many rays: a face is displaced as a whole, an unmapped object stops a run of rays,
/// a wall is missing as a whole. Allocates nothing after construction.
class BeamModel {
 public:
  BeamModel(const WallMap& map, const SensorNoise& noise);

  /// `points` must outlive the calls of the others. `hits`: the predicted face of each at
  /// `T_map_lidar`. `spacing_rad`: between two rays.
  void meet(std::span<const PolarPoint> points, std::span<const PredictedHit> hits,
            const Pose2& T_map_lidar, double spacing_rad, double noise_scale);
  /// Of the last meet().
  BeamCounts counts() const;
  BeamStatistics statistics(double max_map_sigma_m);
  /// The same at the prior's place, among walls where the map has them: a ray that ends near one is
  /// off by a motion that changes. No wall is missing there, and nothing stands before it.
  BeamStatistics statistics_if_exact();

  /// Standard deviations of a face's offset across itself that are tried, m.
  static constexpr std::array kMapSigmas_m = {0.003, 0.01, 0.025, 0.05};

 private:
  /// Density of an outlier among hits, over that of a range that says nothing of the place.
  static constexpr double kOutlierRatio = 0.02;
  /// Rays in a row that end on a wall's edge and may miss it.
  static constexpr std::size_t kEdgeRays = 2;
  /// What is near a wall.
  static constexpr double kNearSigma_m = kMapSigmas_m[2];

  enum class Outcome : std::uint8_t { kHit, kNear, kShort, kViolation, kBeyond };
  struct Ray {
    std::uint32_t predicted = 0;  ///< face that the ray should meet
    std::uint32_t face = 0;       ///< that it meets; another one next to an edge
    double across_m = 0;          ///< residual across the face, positive behind it
    double variance_m2 = 0;       ///< of the sensor, across the face
    double log_peak = 0;          ///< log density ratio of a hit without residual
    Outcome outcome = Outcome::kBeyond;
  };
  struct FaceSums {
    std::uint32_t evaluation = 0;  ///< that the sums belong to
    double predicted = 0;          ///< rays that should meet it
    double predicted_hits = 0;     ///< of these
    double rays = 0;               ///< that hit it
    double information = 0;        ///< sum of 1/variance, 1/m^2
    double gradient = 0;           ///< sum of across/variance, 1/m
    double offset_m = 0;           ///< the face's displacement, a posteriori
    double log_density = 0;
  };

  /// Over that of a range which any other place would give; of a ray that is on a wall or near.
  double log_density(const Ray& ray) const;
  Outcome outcome_of(const Ray& ray, double map_sigma_m) const;
  BeamStatistics by_map_sigma(double map_sigma_m, double near_sigma_m);
  void classify(double map_sigma_m, double near_sigma_m, BeamStatistics& result);
  FaceSums& sums_of(std::uint32_t face);
  void add_view(BeamStatistics& result) const;
  void add_faces(double map_sigma_m, BeamStatistics& result);
  void add_runs(BeamStatistics& result) const;

  const WallMap& map_;
  SensorNoise noise_;
  /// In what the map has and has not, 0 to 1. A map that is less exact than one measured with a
  /// tape is also wrong more often about what there is: missing walls and unmapped objects cost as
  /// much less.
  double trust_;
  std::span<const PolarPoint> points_;
  double spacing_rad_ = 0;
  std::vector<Ray> rays_;
  std::vector<FaceSums> faces_;     ///< by index into map.faces()
  std::vector<std::uint32_t> met_;  ///< faces with sums
  std::uint32_t evaluation_ = 0;
};

}  // namespace cornerd::core
