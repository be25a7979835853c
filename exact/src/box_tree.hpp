// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/polygon_soup.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace hexact::detail {

/// A closed axis-parallel box.
struct Box {
  std::array<double, 3> low, high;
  Box() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  void include(const Point3<double>& p) {
    const std::array<double, 3> x{p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  }
  void include(const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], b.low[k]), high[k] = std::max(high[k], b.high[k]);
  }
  [[nodiscard]] bool meets(const Box& b) const noexcept {
    return low[0] <= b.high[0] && b.low[0] <= high[0] && low[1] <= b.high[1] && b.low[1] <= high[1] && low[2] <= b.high[2] &&
           b.low[2] <= high[2];
  }
};

/// A bounding-volume hierarchy over boxes: halves by the middle along the longest side. Built in O(n log² n); the same
/// for the same boxes.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
  }
  [[nodiscard]] const Box& box(std::size_t i) const noexcept { return boxes_[i]; }

  /// Calls visit(i) for every i whose box meets `query`, in no particular order.
  template <class Visit>
  void for_each_meeting(const Box& query, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::vector<std::uint32_t> todo{0};
    while (!todo.empty()) {
      const Node& node = nodes_[todo.back()];
      const std::uint32_t at = todo.back();
      todo.pop_back();
      if (!node.box.meets(query)) continue;
      if (node.second == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
          if (boxes_[order_[i]].meets(query)) visit(order_[i]);
        }
      } else {
        todo.push_back(at + 1);
        todo.push_back(node.second);
      }
    }
  }

 private:
  static constexpr std::uint32_t kLeaf = 4;
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0;
    std::uint32_t second = 0;  ///< the first child follows its parent; 0: a leaf
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end) {
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box box;
    for (std::uint32_t i = begin; i < end; ++i) box.include(boxes_[order_[i]]);
    nodes_[at].box = box;
    nodes_[at].begin = begin;
    nodes_[at].end = end;
    if (end - begin <= kLeaf) return at;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
    }
    const std::uint32_t half = begin + (end - begin) / 2;
    const auto centre = [&](std::uint32_t i) { return boxes_[i].low[axis] / 2 + boxes_[i].high[axis] / 2; };
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end, [&](std::uint32_t i, std::uint32_t j) {
      const double x = centre(i), y = centre(j);
      return x < y || (x == y && i < j);
    });
    build(begin, half);
    const std::uint32_t second = build(half, end);
    nodes_[at].second = second;
    return at;
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace hexact::detail
