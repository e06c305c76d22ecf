// SPDX-License-Identifier: MIT
#include "core/map/crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace cornerd::core {
namespace {

using Items = std::vector<std::uint32_t>;

/// So few faces are compared with each other.
constexpr std::size_t kFew = 24;
constexpr double kParallel = 1e-9;

struct Square {
  Vec2 centre;
  double half_m;
};

bool touches(const Face& face, const Square& square) {
  const Vec2 low = face.from.cwiseMin(face.to);
  const Vec2 high = face.from.cwiseMax(face.to);
  if (((low - square.centre).array() > square.half_m).any()) return false;
  if (((square.centre - high).array() > square.half_m).any()) return false;
  return std::abs(face.normal.dot(square.centre) - face.offset_m) <=
         square.half_m * face.normal.lpNorm<1>();
}

/// Where a face's line enters and leaves a square, as lengths along its border.
struct Chord {
  double first = 0;
  double second = 0;

  Chord(const Face& face, const Square& square) {
    const Vec2 start = face.from - square.centre;
    double enter = -1e300;
    double leave = 1e300;
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(face.direction[axis]) < 1e-15) continue;
      const double one = (-square.half_m - start[axis]) / face.direction[axis];
      const double other = (square.half_m - start[axis]) / face.direction[axis];
      enter = std::max(enter, std::min(one, other));
      leave = std::min(leave, std::max(one, other));
    }
    const double one = along_border(start + enter * face.direction, square.half_m);
    const double other = along_border(start + leave * face.direction, square.half_m);
    first = std::min(one, other);
    second = std::max(one, other);
  }

 private:
  static double along_border(const Vec2& p, double half_m) {
    if (std::abs(p.y()) < std::abs(p.x())) {
      return p.x() > 0 ? half_m + p.y() : 5 * half_m - p.y();
    }
    return p.y() > 0 ? 3 * half_m - p.x() : 7 * half_m + p.x();
  }
};

class Search {
 public:
  Search(std::span<const Face> faces, double end_m, std::size_t max_pairs)
      : faces_(faces), end_m_(end_m), max_pairs_(max_pairs) {}

  std::vector<std::pair<std::uint32_t, std::uint32_t>> run() {
    if (faces_.empty()) return {};
    Vec2 low = faces_.front().from;
    Vec2 high = low;
    for (const Face& face : faces_) {
      low = low.cwiseMin(face.from).cwiseMin(face.to);
      high = high.cwiseMax(face.from).cwiseMax(face.to);
    }
    Items all(faces_.size());
    std::iota(all.begin(), all.end(), 0u);
    search({(low + high) / 2, (high - low).maxCoeff() / 2 + end_m_}, all);
    if (pairs_.size() >= max_pairs_) return std::move(pairs_);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    return std::move(pairs_);
  }

 private:
  void search(const Square& square, const Items& items) {
    if (pairs_.size() >= max_pairs_) return;
    if (items.size() <= kFew) return compare_all(items, square);
    // In one point, or in a square as small as one.
    if (meet_in_one_point(items) || square.half_m < end_m_) return compare_first(items);
    if (!chords_cross(square, items)) return;
    // A crossing on a border is in both squares.
    const double half_m = square.half_m / 2;
    Items part;
    for (int i = 0; i < 4; ++i) {
      const Vec2 aside(i % 2 == 0 ? -half_m : half_m, i < 2 ? -half_m : half_m);
      const Square quarter{square.centre + aside, half_m + end_m_ / 4};
      part.clear();
      std::copy_if(items.begin(), items.end(), std::back_inserter(part),
                   [&](std::uint32_t item) { return touches(faces_[item], quarter); });
      search(quarter, part);
    }
  }

  void compare(std::uint32_t i, std::uint32_t j, const Square* within) {
    const Face& a = faces_[i];
    const Face& b = faces_[j];
    const double sine = cross(a.direction, b.direction);
    if (std::abs(sine) < kParallel) return;
    const double along_a = cross(b.from - a.from, b.direction) / sine;
    if (along_a < end_m_ || along_a > a.length_m - end_m_) return;
    const double along_b = cross(b.from - a.from, a.direction) / sine;
    if (along_b < end_m_ || along_b > b.length_m - end_m_) return;
    if (within != nullptr) {
      const Vec2 aside = a.from + along_a * a.direction - within->centre;
      if (aside.lpNorm<Eigen::Infinity>() > within->half_m) return;  // found in another square
    }
    pairs_.emplace_back(i, j);
  }

  void compare_all(const Items& items, const Square& square) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      for (std::size_t j = i + 1; j < items.size(); ++j) compare(items[i], items[j], &square);
    }
  }

  void compare_first(const Items& items) {
    const std::size_t before = pairs_.size();
    for (std::size_t j = 1; j < items.size() && pairs_.size() == before; ++j) {
      compare(items[0], items[j], nullptr);
    }
  }

  bool meet_in_one_point(const Items& items) const {
    const Face& a = faces_[items[0]];
    const auto other = std::find_if(items.begin(), items.end(), [&](std::uint32_t item) {
      return std::abs(cross(a.direction, faces_[item].direction)) > 0.01;
    });
    if (other == items.end()) return false;
    const Face& b = faces_[*other];
    const Vec2 point = a.from + cross(b.from - a.from, b.direction) /
                                    cross(a.direction, b.direction) * a.direction;
    return std::all_of(items.begin(), items.end(), [&](std::uint32_t item) {
      return std::abs(faces_[item].normal.dot(point) - faces_[item].offset_m) < end_m_ / 10;
    });
  }

  /// Two chords of a square cross if one of them ends on either side of the other.
  bool chords_cross(const Square& square, const Items& items) {
    chords_.clear();
    for (const std::uint32_t item : items) chords_.emplace_back(faces_[item], square);
    std::sort(chords_.begin(), chords_.end(), [](const Chord& a, const Chord& b) {
      return a.first != b.first ? a.first < b.first : a.second > b.second;
    });
    open_.clear();
    for (const Chord& chord : chords_) {
      while (!open_.empty() && open_.back() < chord.first) open_.pop_back();
      // Both sides of a line wall are one chord, up to rounding.
      if (!open_.empty() && open_.back() < chord.second - kSame_m) return true;
      open_.push_back(chord.second);
    }
    return false;
  }

  static constexpr double kSame_m = 1e-9;

  std::span<const Face> faces_;
  double end_m_;
  std::size_t max_pairs_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
  std::vector<Chord> chords_;
  std::vector<double> open_;  ///< far ends of the chords around the current one
};

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings_of(std::span<const Face> faces,
                                                                  double end_m,
                                                                  std::size_t max_pairs) {
  return Search(faces, end_m, max_pairs).run();
}

}  // namespace cornerd::core
