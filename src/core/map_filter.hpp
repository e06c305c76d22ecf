// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/pose_estimate.hpp"

namespace cornerd::core {

/// What one scan shows of one map.
struct MapEvidence {
  /// Localizer::log_odds_of_map(): against "in none of the maps".
  std::optional<double> log_odds;
  /// Where it may have been taken, the likeliest first.
  std::array<Pose2, kMaxAlternatives> places;
  std::size_t count = 0;
};

/// Bayes filter over maps: which of them the scans of a drive are taken in, or in none of them. All
/// are equally likely at first. Scans that were taken near each other show the same walls and the
/// same furniture: only the first of them counts. Allocates nothing after construction.
class MapFilter {
 public:
  explicit MapFilter(std::size_t maps);

  void forget();
  /// A scan, compared in all maps but those that are ruled out.
  void update(std::span<const MapEvidence> evidence);

  std::size_t maps() const { return log_beliefs_.size(); }
  /// Maps that the robot may be in, the likeliest first: the fewest that leave out no more than
  /// kWrongFixRate of the belief. None before the first scan, and where they explain too little.
  std::span<const std::size_t> in_doubt() const { return std::span(order_).first(in_doubt_); }
  /// The only one in doubt, where the robot is surely in it.
  std::optional<std::size_t> map() const;
  /// Posterior of a map.
  double belief(std::size_t map) const { return beliefs_[map]; }
  /// No scan can make it likely again.
  bool is_ruled_out(std::size_t map) const;
  /// Scans that counted.
  std::size_t scans() const { return scans_; }

 private:
  /// Scans are remembered by where they may have been taken in each map.
  static constexpr std::size_t kMaxRemembered = 64;
  struct Places {
    std::array<Vec2, kMaxAlternatives> at;
    std::size_t count = 0;
  };
  std::span<Places> remembered(std::size_t scan) {
    return std::span(remembered_).subspan(scan % kMaxRemembered * maps(), maps());
  }
  bool is_elsewhere(std::span<const MapEvidence> evidence, std::span<const Places> before) const;
  void decide();

  std::vector<double> log_beliefs_;  ///< relative to "in none of them"
  std::vector<double> beliefs_;
  std::vector<std::size_t> order_;
  std::size_t in_doubt_ = 0;
  double p_wrong_ = 1;  ///< of the likeliest map
  std::vector<Places> remembered_;
  std::size_t scans_ = 0;
};

}  // namespace cornerd::core
