// SPDX-License-Identifier: MIT
#include "core/estimate/wall_offset_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// Standard deviation of a wall in one scan about its mean, which no number of points averages out:
/// a wall is not plane, and a lidar's error changes with range and incidence.
constexpr double kScanSigma_m = 0.003;
/// Mean square of a line about its middle over the variance of its ends: of a direction,
/// 2 (sigma / length)^2, at a place that is uniform over the length, length^2 / 12.
constexpr double kTurnedShare = 1.0 / 6;
/// Of the rays on a wall that is there.
constexpr double kMinShareOfRays = 0.5;
/// Mean squared innovation of a scan, 1 in the model, beyond which it is of another place.
constexpr double kMaxInnovation = 3;

/// Cholesky factorization of a lower triangle, by rows.
bool is_positive(std::vector<double> matrix, std::size_t size) {
  const auto row = [&](std::size_t i) { return &matrix[i * (i + 1) / 2]; };
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = row(i)[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row(i)[k] * row(j)[k];
      if (i == j && !(sum > 0)) return false;
      row(i)[j] = i == j ? std::sqrt(sum) : sum / row(j)[j];
    }
  }
  return true;
}

}  // namespace

WallOffsetFilter::WallOffsetFilter(const WallMap& map)
    : sides_(face_walls(map)),
      states_(map.plan().walls.size()),
      capacity_(std::min(states_.size(), kMaxWalls)),
      covariance_(capacity_ * capacity_),
      rows_(kMaxVisible * capacity_),
      gains_(kMaxVisible * capacity_) {
  slots_.reserve(capacity_);
  means_m_.reserve(capacity_);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].prior_variance_m2 =
        squared(map.plan().walls[i].sigma_m.value_or(map.plan().sigma_m));
  }
}

double WallOffsetFilter::offset_m(std::uint32_t face) const {
  const FaceWall& side = sides_[face];
  if (side.sign == 0 || states_[side.wall].slot == kNone) return 0;
  return side.sign * means_m_[states_[side.wall].slot];
}

double WallOffsetFilter::sigma_m(std::uint32_t face) const {
  if (sides_[face].sign == 0) return 0;
  const WallState& state = states_[sides_[face].wall];
  return std::sqrt(scan_variance_m2(state) + (state.slot == kNone
                                                  ? state.prior_variance_m2
                                                  : covariance_m2(state.slot, state.slot)));
}

double WallOffsetFilter::scan_variance_m2(const WallState& wall) const {
  return squared(kScanSigma_m) + direction_share_ * kTurnedShare * wall.prior_variance_m2;
}

bool WallOffsetFilter::add(std::uint32_t face, const Vec2& normal, const FaceSums& sums,
                           std::size_t rays) {
  const FaceWall& side = sides_[face];
  if (side.sign == 0 || sums.points < kMinShareOfRays * static_cast<double>(rays)) return false;
  const bool is_known = states_[side.wall].slot != kNone || slots_.size() < capacity_;
  if (!is_known || !(sums.weight > 0)) return false;
  std::size_t i = 0;
  while (i < count_ && visible_[i].wall != side.wall) ++i;
  if (i == kMaxVisible) return false;
  if (i == count_) visible_[count_++] = {side.wall};
  visible_[i].weight += sums.weight;
  visible_[i].by_pose +=
      side.sign * Eigen::Vector3d(sums.weight * normal.x(), sums.weight * normal.y(), sums.lever);
  visible_[i].distance += side.sign * sums.distance;
  return true;
}

double WallOffsetFilter::prior_covariance_m2(const Visible& one, const Visible& other) const {
  const WallState& a = states_[one.wall];
  const WallState& b = states_[other.wall];
  const bool is_same = &a == &b;
  const double scan_m2 = is_same ? scan_variance_m2(a) : 0;
  if (a.slot != kNone && b.slot != kNone) return covariance_m2(a.slot, b.slot) + scan_m2;
  return is_same ? a.prior_variance_m2 + scan_m2 : 0;
}

// With S^2 the walls' weights, C the offsets' covariance, G and d their Jacobians and residuals
// over S: B = I + S C S, and the offsets take G' (I - B^-1) G of the pose's information.
WallOffsetFilter::Reduced WallOffsetFilter::marginalise() {
  Reduced reduced;
  for (std::size_t i = 0; i < count_; ++i) {
    const double root = std::sqrt(visible_[i].weight);
    Eigen::Vector4d right;
    right << visible_[i].by_pose / root, visible_[i].distance / root;
    const auto add = [&](const Eigen::Vector4d& v, double sign) {
      reduced.information += sign * v.head<3>() * v.head<3>().transpose();
      reduced.gradient += sign * v[3] * v.head<3>();
      reduced.chi_square += sign * v[3] * v[3];
    };
    add(right, 1);
    for (std::size_t j = 0; j <= i; ++j) {
      double sum =
          root * std::sqrt(visible_[j].weight) * prior_covariance_m2(visible_[i], visible_[j]) +
          (i == j ? 1 : 0);
      for (std::size_t k = 0; k < j; ++k) sum -= factor_[i][k] * factor_[j][k];
      factor_[i][j] = i == j ? std::sqrt(sum) : sum / factor_[j][j];
      if (j < i) right -= factor_[i][j] * whitened_[j];
    }
    whitened_[i] = right / factor_[i][i];
    add(whitened_[i], -1);
  }
  return reduced;
}

void WallOffsetFilter::assign_slots() {
  for (std::size_t i = 0; i < count_; ++i) {
    WallState& state = states_[visible_[i].wall];
    if (state.slot != kNone || slots_.size() == capacity_) continue;
    state.slot = static_cast<std::uint32_t>(slots_.size());
    for (std::size_t k = 0; k < slots_.size(); ++k) at(state.slot, k) = at(k, state.slot) = 0;
    at(state.slot, state.slot) = state.prior_variance_m2;
    slots_.push_back(visible_[i].wall);
    means_m_.push_back(0);
  }
}

void WallOffsetFilter::forget_visible() {
  for (std::size_t i = 0; i < count_; ++i) {
    const WallState& state = states_[visible_[i].wall];
    if (state.slot == kNone) continue;
    for (std::size_t k = 0; k < slots_.size(); ++k) at(state.slot, k) = at(k, state.slot) = 0;
    at(state.slot, state.slot) = state.prior_variance_m2;
    means_m_[state.slot] = 0;
  }
}

// The gain's matrix: S (B^-1 - B^-1 G covariance G' B^-1) S, where B^-1 = L^-T L^-1.
bool WallOffsetFilter::learn(const Covariance3& covariance) {
  double innovations = 0;
  for (std::size_t i = 0; i < count_; ++i) innovations += squared(whitened_[i][3]);
  if (!(innovations <= kMaxInnovation * static_cast<double>(count_))) return false;
  assign_slots();
  const std::size_t size = slots_.size();
  // Rows of L^-1 S P_v, and of the whitened Jacobian's share in them.
  for (std::size_t i = 0; i < count_; ++i) {
    const double root = std::sqrt(visible_[i].weight);
    const std::uint32_t slot = states_[visible_[i].wall].slot;
    double* const row = &rows_[i * capacity_];
    for (std::size_t k = 0; k < size; ++k) row[k] = slot == kNone ? 0 : root * at(slot, k);
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < size; ++k) row[k] -= factor_[i][j] * rows_[j * capacity_ + k];
    }
    for (std::size_t k = 0; k < size; ++k) row[k] /= factor_[i][i];
  }
  // P - R' (I - Y covariance Y') R, with R those rows and Y the whitened Jacobians.
  for (std::size_t i = 0; i < count_; ++i) {
    double* const gain = &gains_[i * capacity_];
    std::copy_n(&rows_[i * capacity_], size, gain);
    const Eigen::Vector3d by_pose = covariance * whitened_[i].head<3>();
    for (std::size_t j = 0; j < count_; ++j) {
      const double share = by_pose.dot(whitened_[j].head<3>());
      for (std::size_t k = 0; k < size; ++k) gain[k] -= share * rows_[j * capacity_ + k];
    }
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const double* const row = &rows_[i * capacity_];
    const double* const gain = &gains_[i * capacity_];
    for (std::size_t k = 0; k < size; ++k) {
      means_m_[k] += row[k] * whitened_[i][3];
      for (std::size_t l = 0; l <= k; ++l) at(k, l) -= row[k] * gain[l];
    }
  }
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t l = 0; l < k; ++l) at(l, k) = at(k, l);
  }
  return true;
}

WallOffset WallOffsetFilter::operator[](std::size_t slot) const {
  return {slots_[slot], means_m_[slot], std::sqrt(covariance_m2(slot, slot))};
}

void WallOffsetFilter::copy_to(LearnedWalls& learned) const {
  learned.offsets.clear();
  learned.covariance_m2.clear();
  for (std::size_t k = 0; k < size(); ++k) {
    learned.offsets.push_back((*this)[k]);
    for (std::size_t l = 0; l <= k; ++l) learned.covariance_m2.push_back(covariance_m2(k, l));
  }
}

bool WallOffsetFilter::resume(const LearnedWalls& learned) {
  const std::size_t size = learned.offsets.size();
  if (size > capacity_ || learned.covariance_m2.size() != size * (size + 1) / 2) return false;
  std::vector<bool> is_known(states_.size());
  for (const WallOffset& offset : learned.offsets) {
    if (offset.wall >= is_known.size() || is_known[offset.wall]) return false;
    is_known[offset.wall] = true;
  }
  if (!is_positive(learned.covariance_m2, size)) return false;
  forget();
  const double* next = learned.covariance_m2.data();
  for (std::size_t k = 0; k < size; ++k) {
    states_[learned.offsets[k].wall].slot = static_cast<std::uint32_t>(k);
    slots_.push_back(static_cast<std::uint32_t>(learned.offsets[k].wall));
    means_m_.push_back(learned.offsets[k].offset_m);
    for (std::size_t l = 0; l <= k; ++l) at(k, l) = at(l, k) = *next++;
  }
  return true;
}

void WallOffsetFilter::forget() {
  for (WallState& state : states_) state.slot = kNone;
  slots_.clear();
  means_m_.clear();
  count_ = 0;
}

}  // namespace cornerd::core
