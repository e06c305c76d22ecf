// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace cornerd::core {

/// Standard deviation of a range as a function of the range, from a calibration. Linear between the
/// points; constant before the first; a constant share of the range after the last. Tabulated on a
/// grid of 5 cm.
class SigmaTable {
 public:
  struct Point {
    double range_m = 0;
    double sigma_m = 0;
  };
  static constexpr std::size_t kMaxPoints = 64;

  SigmaTable() = default;
  /// `points`: by ascending range above 0; empty: an empty table.
  explicit SigmaTable(std::span<const Point> points);

  bool empty() const { return end_m_ == 0; }

  /// Requires a table that is not empty.
  double sigma_m(double range_m) const {
    const double cell = std::max(range_m, 0.0) / kCellM;
    if (!(cell < kCells)) return share_beyond_ * range_m;
    const auto index = static_cast<std::size_t>(cell);
    const double part = cell - static_cast<double>(index);
    return (1 - part) * sigma_m_[index] + part * sigma_m_[index + 1];
  }

 private:
  static constexpr double kCellM = 0.05;
  static constexpr std::size_t kCells = 256;  ///< to 12.8 m: beyond an A1's range

  std::array<float, kCells + 1> sigma_m_{};
  double share_beyond_ = 0;
  double end_m_ = 0;  ///< range of the last point
};

}  // namespace cornerd::core
