// SPDX-License-Identifier: MIT
#include "core/map/extent_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace cornerd::core {
namespace {

constexpr std::size_t kLeafItems = 16;
constexpr std::size_t kMaxEntriesPerItem = 128;
/// A split costs some searches of the leaf. Where walls meet in one point, which is searched once,
/// it would part nothing.
constexpr std::uint32_t kSplitVisit = 4;
/// Splits in a row that part nothing.
constexpr std::uint32_t kMaxFruitless = 3;
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

std::vector<std::uint32_t> ascending(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

}  // namespace

ExtentTree::ExtentTree(std::span<const Extent> extents)
    : ExtentTree(extents, ascending(extents.size()), nullptr) {}

ExtentTree::ExtentTree(std::span<const Extent> extents, std::vector<std::uint32_t> order,
                       Covers covers)
    : extents_(extents), covers_(std::move(covers)) {
  Node root;
  if (!extents.empty()) {
    Vec2 low = extents.front().low;
    Vec2 high = extents.front().high;
    for (const Extent& extent : extents) {
      low = low.cwiseMin(extent.low);
      high = high.cwiseMax(extent.high);
    }
    // Off round numbers: all walls of a fan around the corner of four squares would be in each.
    const double size_m = (high - low).maxCoeff();
    root.centre = (low + high) / 2 + size_m * Vec2(0.0219, 0.0383);
    root.half_m = 0.547 * size_m;
  }
  entries_ = order.size();
  root.items = std::move(order);
  nodes_.push_back(std::move(root));
}

bool ExtentTree::touches(std::uint32_t node, const Extent& extent) const {
  return touches_square(extent, nodes_[node].centre, nodes_[node].half_m);
}

void ExtentTree::fill(Node& node, std::span<const std::uint32_t> items) const {
  std::array<std::uint32_t, 2> covering;
  std::size_t found = 0;
  for (const std::uint32_t item : items) {
    if (!touches_square(extents_[item], node.centre, node.half_m)) continue;
    node.items.push_back(item);
    if (!covers_ || !covers_(item, node.centre, node.half_m + 2 * kSlack_m)) continue;
    covering[found++] = item;
    if (found < covering.size()) continue;
    node.items.assign(covering.begin(), covering.end());
    return;
  }
}

void ExtentTree::split(std::uint32_t index) {
  if (++nodes_[index].visits != kSplitVisit) return;
  const std::size_t count = nodes_[index].items.size();
  const bool is_full = entries_ + 4 * count > kMaxEntriesPerItem * (extents_.size() + kLeafItems);
  if (count <= kLeafItems || nodes_[index].depth + 1 == kMaxDepth || is_full) return;
  const double half_m = nodes_[index].half_m / 2;
  std::array<Node, 4> children;
  std::size_t entries = 0;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < children.size(); ++i) {
    Node& child = children[i];
    child.centre = nodes_[index].centre + half_m * Vec2(i % 2 == 0 ? -1 : 1, i < 2 ? -1 : 1);
    child.half_m = half_m;
    child.depth = nodes_[index].depth + 1;
    fill(child, nodes_[index].items);
    entries += child.items.size();
    largest = std::max(largest, child.items.size());
  }
  // Items that overlap are not parted by squares smaller than their width.
  const bool are_small = half_m < extents_[nodes_[index].items.front()].half_width_m;
  const bool is_fruitless = are_small && 4 * largest > 3 * count;
  const std::uint32_t fruitless = is_fruitless ? nodes_[index].fruitless + 1 : 0;
  if (fruitless > kMaxFruitless) return;
  for (Node& child : children) child.fruitless = fruitless;
  entries_ += entries - count;
  nodes_[index].items = {};
  nodes_[index].first_child = static_cast<std::uint32_t>(nodes_.size());
  for (Node& child : children) nodes_.push_back(std::move(child));
}

}  // namespace cornerd::core
