// SPDX-License-Identifier: MIT
#include "core/catalog/pair_index.hpp"

#include <numeric>
#include <utility>

namespace cornerd::core {

std::size_t PairIndex::address(const Corner& from, const Corner& to, double distance_m,
                               FaceSide side) const {
  const Vec2 displacement = to.position - from.position;
  const double wall_rad = side == FaceSide::kLeft ? from.left_face_rad : from.right_face_rad;
  const double angle_rad = angle_between(std::atan2(displacement.y(), displacement.x()), wall_rad);
  const auto direction =
      static_cast<std::size_t>(std::floor(angle_rad / kDirection_rad) + kDirections) % kDirections;
  return row(side, from.is_convex(), direction) + bin_of(distance_m);
}

PairIndex::PairIndex(std::span<const Corner> landmarks, std::span<const LandmarkPair> pairs) {
  float longest_m = 0;
  for (const LandmarkPair& pair : pairs) longest_m = std::max(longest_m, pair.distance_m);
  bins_ = static_cast<std::size_t>(longest_m / kBin_m) + 1;
  first_.assign(4 * kDirections * bins_ + 1, 0);
  const auto for_each_entry = [&](auto&& visit) {
    for (const LandmarkPair& pair : pairs) {
      for (const auto& [from, to] : {std::pair{pair.from, pair.to}, {pair.to, pair.from}}) {
        for (const FaceSide side : {FaceSide::kLeft, FaceSide::kRight}) {
          visit(address(landmarks[from], landmarks[to], pair.distance_m, side),
                LandmarkPair{from, to, pair.distance_m});
        }
      }
    }
  };
  for_each_entry([&](std::size_t where, const LandmarkPair&) { ++first_[where + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  entries_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each_entry(
      [&](std::size_t where, const LandmarkPair& pair) { entries_[next[where]++] = pair; });
}

}  // namespace cornerd::core
