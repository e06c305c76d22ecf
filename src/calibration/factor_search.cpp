// SPDX-License-Identifier: MIT
#include "calibration/factor_search.hpp"

#include <cmath>
#include <optional>

namespace cornerd::calibration {
namespace {

/// Factors in whole thousandths, exact in each grid.
constexpr int kThousand = 1000;
constexpr int kMin = static_cast<int>(kMinFactor * kThousand);
constexpr int kMax = static_cast<int>(kMaxFactor * kThousand);

struct FactorPair {
  int encoder = kThousand;
  int gyro = kThousand;
};

class GridSearch {
 public:
  GridSearch(std::span<const core::OdometryIncrement> steps, std::span<const KnownPose> places,
             const core::DriveGeometry& geometry, const DeadReckoningConfig& start)
      : steps_(steps), places_(places), geometry_(geometry), config_(start) {
    try_candidate({});
  }

  bool by_encoder() const { return config_.source != HeadingSource::kGyro; }
  bool by_gyro() const { return config_.source != HeadingSource::kEncoder; }

  /// Tries all candidates within `count` steps of the best; repeats while the best is at the rim.
  void search(int step, int count) {
    for (bool at_rim = true; at_rim;) {
      const FactorPair around = best_;
      for (int i = by_encoder() ? -count : 0; i <= (by_encoder() ? count : 0); ++i) {
        for (int k = by_gyro() ? -count : 0; k <= (by_gyro() ? count : 0); ++k) {
          try_candidate({around.encoder + i * step, around.gyro + k * step});
        }
      }
      at_rim = std::abs(best_.encoder - around.encoder) == count * step ||
               std::abs(best_.gyro - around.gyro) == count * step;
    }
  }

  FoundFactors found() const {
    FoundFactors found;
    found.factors = factors_of(best_);
    found.encoder_at_edge = by_encoder() && (best_.encoder == kMin || best_.encoder == kMax);
    found.gyro_at_edge = by_gyro() && (best_.gyro == kMin || best_.gyro == kMax);
    return found;
  }

 private:
  PaperFactors factors_of(const FactorPair& candidate) const {
    PaperFactors factors = config_.factors;
    if (by_encoder()) factors.encoder_factor = candidate.encoder / double{kThousand};
    if (by_gyro()) factors.gyro_factor = candidate.gyro / double{kThousand};
    return factors;
  }
  static bool is_candidate(int thousandths) { return thousandths >= kMin && thousandths <= kMax; }

  void try_candidate(const FactorPair& candidate) {
    if (!is_candidate(candidate.encoder) || !is_candidate(candidate.gyro)) return;
    const double mean_m =
        reckon(steps_, places_, geometry_, {config_.source, factors_of(candidate)}).mean_m;
    if (least_m_ && mean_m >= *least_m_) return;
    least_m_ = mean_m;
    best_ = candidate;
  }

  std::span<const core::OdometryIncrement> steps_;
  std::span<const KnownPose> places_;
  const core::DriveGeometry& geometry_;
  DeadReckoningConfig config_;
  FactorPair best_;
  std::optional<double> least_m_;
};

}  // namespace

FoundFactors search_factors(std::span<const core::OdometryIncrement> steps,
                            std::span<const KnownPose> places, const core::DriveGeometry& geometry,
                            const DeadReckoningConfig& start) {
  GridSearch grid(steps, places, geometry, start);
  // The first grid covers the whole range.
  grid.search(50, (kMax - kMin) / 50);
  grid.search(10, 6);
  grid.search(1, 12);
  return grid.found();
}

}  // namespace cornerd::calibration
