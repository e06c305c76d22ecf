// SPDX-License-Identifier: MIT
#include "core/sigma_table.hpp"

#include <iterator>

namespace cornerd::core {
namespace {

double interpolate(std::span<const SigmaTable::Point> points, double range_m) {
  const auto next = std::upper_bound(
      points.begin(), points.end(), range_m,
      [](double range, const SigmaTable::Point& point) { return range < point.range_m; });
  if (next == points.begin()) return points.front().sigma_m;
  const SigmaTable::Point& last = *std::prev(next);
  if (next == points.end()) return last.sigma_m * range_m / last.range_m;
  const double part = (range_m - last.range_m) / (next->range_m - last.range_m);
  return last.sigma_m + part * (next->sigma_m - last.sigma_m);
}

}  // namespace

SigmaTable::SigmaTable(std::span<const Point> points) {
  if (points.empty()) return;
  end_m_ = points.back().range_m;
  for (std::size_t i = 0; i < sigma_m_.size(); ++i) {
    sigma_m_[i] = static_cast<float>(interpolate(points, kCellM * static_cast<double>(i)));
  }
  constexpr double kEndM = kCellM * kCells;
  share_beyond_ = interpolate(points, kEndM) / kEndM;
}

}  // namespace cornerd::core
