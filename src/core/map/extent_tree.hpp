// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/map/cell_grid.hpp"

namespace cornerd::core {

/// A quadtree of extents, split where searches go and items crowd: unlike a uniform grid it
/// stays fast where most items are in few places. Memory is linear in the number of items.
class ExtentTree {
 public:
  /// True where an item covers all of a square: its index, the square's centre, half its side, m.
  using Covers = std::function<bool(std::uint32_t, const Vec2&, double)>;

  /// `extents` must outlive this.
  explicit ExtentTree(std::span<const Extent> extents);
  /// `order`: indices of `extents`, in the order in which a search shall give them. Where two items
  /// cover all of a square, a search there gives no others.
  ExtentTree(std::span<const Extent> extents, std::vector<std::uint32_t> order, Covers covers);

  /// Calls `visit` with lists of items that may touch the segment until it returns false. An item
  /// may come several times, in several lists.
  template <typename Visitor>
  void search(const Vec2& from, const Vec2& to, Visitor&& visit) {
    const Extent segment = Extent::of_segment(from, to, 0);
    std::array<std::uint32_t, 4 * kMaxDepth> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::uint32_t index = stack[--size];
      if (!touches(index, segment)) continue;
      if (nodes_[index].first_child == 0) split(index);
      if (const std::uint32_t child = nodes_[index].first_child; child != 0) {
        for (std::uint32_t i = 0; i < 4; ++i) stack[size++] = child + i;
      } else if (!visit(std::span<const std::uint32_t>(nodes_[index].items))) {
        return;
      }
    }
  }

 private:
  static constexpr std::size_t kMaxDepth = 24;

  struct Node {
    Vec2 centre = Vec2::Zero();
    double half_m = 0;
    std::uint32_t depth = 0;
    std::uint32_t first_child = 0;  ///< 0: a leaf
    std::uint32_t visits = 0;       ///< as a leaf
    std::uint32_t fruitless = 0;    ///< splits above it in a row that parted nothing
    std::vector<std::uint32_t> items;
  };

  bool touches(std::uint32_t node, const Extent& extent) const;
  void split(std::uint32_t node);
  void fill(Node& node, std::span<const std::uint32_t> items) const;

  std::span<const Extent> extents_;
  Covers covers_;
  std::vector<Node> nodes_;
  std::size_t entries_ = 0;
};

}  // namespace cornerd::core
