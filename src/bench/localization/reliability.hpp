// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "core/pose_estimate.hpp"

namespace cornerd::bench {

/// Whether turns are wrong as often as they say themselves: the reliability diagram of the
/// decision between one place and several. Turns that named no place at all say nothing.
class Reliability {
 public:
  struct Bin {
    double least_doubt = 0;
    std::size_t scans = 0;
    std::size_t wrong = 0;  ///< turns whose likeliest place was not the true one
    double doubt = 0;       ///< of these turns, summed: how many should be wrong
  };

  void add(const core::PoseEstimate& estimate, const core::Pose2& truth);
  void add(const Reliability& other);

  /// By how much they doubted their likeliest place, least first.
  const auto& bins() const { return bins_; }

 private:
  std::array<Bin, 6> bins_ = {{{0}, {1e-5}, {1e-4}, {1e-3}, {1e-2}, {1e-1}}};
};

}  // namespace cornerd::bench
