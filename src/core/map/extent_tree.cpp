// SPDX-License-Identifier: MIT
#include "core/map/extent_tree.hpp"

#include <cmath>
#include <utility>

namespace cornerd::core {
namespace {

constexpr std::size_t kLeafItems = 16;
constexpr std::size_t kMaxEntriesPerItem = 32;
/// A tenth of the tolerance for equal points.
constexpr double kSlack_m = 1e-6;

bool touches_square(const Extent& extent, const Vec2& centre, double half_m) {
  const double reach_m = half_m + kSlack_m;
  if (((extent.low - centre).array() > reach_m).any()) return false;
  if (((centre - extent.high).array() > reach_m).any()) return false;
  if (extent.normal.isZero(0)) return true;
  const double away_m = std::abs(extent.normal.dot(centre) - extent.offset_m);
  return away_m <= extent.half_width_m + reach_m * extent.normal.lpNorm<1>();
}

}  // namespace

ExtentTree::ExtentTree(std::span<const Extent> extents, std::vector<std::uint32_t> order)
    : extents_(extents) {
  Node root;
  if (!extents.empty()) {
    Vec2 low = extents.front().low;
    Vec2 high = extents.front().high;
    for (const Extent& extent : extents) {
      low = low.cwiseMin(extent.low);
      high = high.cwiseMax(extent.high);
    }
    root.centre = (low + high) / 2;
    root.half_m = (high - low).maxCoeff() / 2;
  }
  entries_ = order.size();
  root.items = std::move(order);
  nodes_.push_back(std::move(root));
}

bool ExtentTree::touches(std::uint32_t node, const Extent& extent) const {
  return touches_square(extent, nodes_[node].centre, nodes_[node].half_m);
}

void ExtentTree::split(std::uint32_t index) {
  if (nodes_[index].is_final) return;
  nodes_[index].is_final = true;
  const std::size_t count = nodes_[index].items.size();
  const bool is_full = entries_ + 4 * count > kMaxEntriesPerItem * (extents_.size() + kLeafItems);
  if (count <= kLeafItems || nodes_[index].depth + 1 == kMaxDepth || is_full) return;
  const double half_m = nodes_[index].half_m / 2;
  std::array<Node, 4> children;
  std::size_t entries = 0;
  for (std::size_t i = 0; i < children.size(); ++i) {
    Node& child = children[i];
    child.centre = nodes_[index].centre + half_m * Vec2(i % 2 == 0 ? -1 : 1, i < 2 ? -1 : 1);
    child.half_m = half_m;
    child.depth = nodes_[index].depth + 1;
    for (const std::uint32_t item : nodes_[index].items) {
      if (touches_square(extents_[item], child.centre, half_m)) child.items.push_back(item);
    }
    entries += child.items.size();
  }
  // Where all items cover all of the square, smaller squares do not part them.
  if (entries > 7 * count / 2) return;
  entries_ += entries - count;
  nodes_[index].items = {};
  nodes_[index].first_child = static_cast<std::uint32_t>(nodes_.size());
  for (Node& child : children) nodes_.push_back(std::move(child));
}

}  // namespace cornerd::core
