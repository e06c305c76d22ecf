// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/scan.hpp"

namespace cornerd::core {

/// How fast a lidar turns, from two consecutive scans and no map: their ranges by bearing are
/// shifted against each other. Each is skewed by the motion in it, both alike at a steady rate, so
/// that the shift is the turn from one to the next. Allocates nothing.
class ScanRotation {
 public:
  void forget() {
    scans_ = 0;
    rate_rad_s_.reset();
  }

  /// Adds a scan as it was measured.
  void add(const Scan& turn);

  /// The mean rate between the last two scans, rad/s, counter-clockwise, to some 0.1 rad/s up to
  /// 4 rad/s; nullopt where they do not look alike or more than a second lies between. Found when
  /// first asked for: by one thread at a time.
  std::optional<double> rate_rad_s() const;

 private:
  static constexpr std::size_t kBins = 360;
  using Ranges = std::array<float, kBins>;  ///< m, in a degree of bearing; 0: no return

  struct Profile {
    Ranges ranges_m{};
    TimeNs start_ns = 0;
  };

  std::optional<double> find_rate_rad_s() const;

  Profile last_;
  Profile before_;
  mutable std::optional<std::optional<double>> rate_rad_s_;
  int scans_ = 0;  ///< up to two
};

}  // namespace cornerd::core
