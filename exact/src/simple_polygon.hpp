// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "located_points.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>

// Whether the loop of a facet is a simple polygon that runs counter-clockwise about the normal of its plane.
namespace hexact::detail {

template <class S>
class SimplePolygon {
 public:
  /// Precondition: the corners lie on the plane of the facet, whose normal is not 0.
  SimplePolygon(const LocatedPoints<S>& points, std::size_t facet)
      : points_(points), loop_(points.body().loops[facet]), facet_(facet), axis_(points.projection_axis(facet)),
        facing_(normal_sign(points.planes(), facet, axis_)) {}

  /// What is wrong, or nothing. Cost: n turns where the polygon is convex; else n log n and 4 turns for each pair of
  /// edges whose boxes overlap.
  [[nodiscard]] std::string fault() const {
    if (strictly_convex()) return {};
    if (std::string folded = corner_fault(); !folded.empty()) return folded;
    if (std::string crossing = crossing_fault(); !crossing.empty()) return crossing;
    return orientation() == facing_ ? "" : "runs clockwise about its normal";
  }

 private:
  static int normal_sign(const IntegerPlanes& planes, std::size_t f, int axis) {
    const Plane<Integer> p = planes[f];
    return (axis == 0 ? p.a : axis == 1 ? p.b : p.c).sign();
  }
  static int normal_sign(const RootPlanes& planes, std::size_t f, int axis) {
    const Plane<RootInteger>& p = planes[f];
    return sign(axis == 0 ? p.a : axis == 1 ? p.b : p.c);
  }
  [[nodiscard]] std::size_t size() const { return loop_.size(); }
  [[nodiscard]] std::size_t at(std::size_t i) const { return index(loop_[i % size()]); }
  [[nodiscard]] int turn(std::size_t a, std::size_t b, std::size_t c) const { return points_.turn(a, b, c, axis_); }
  [[nodiscard]] int u() const { return (axis_ + 1) % 3; }
  [[nodiscard]] int v() const { return (axis_ + 2) % 3; }

  /// Every corner turns left, and along one direction the edges change their sense exactly twice.
  [[nodiscard]] bool strictly_convex() const {
    int first = 0, last = 0, changes = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      if (turn(at(i), at(i + 1), at(i + 2)) != facing_) return false;
      const int s = points_.compare(at(i + 1), at(i), u());
      if (s == 0) continue;
      if (first == 0) first = s;
      if (last != 0 && s != last) ++changes;
      last = s;
    }
    return changes + (first != last ? 1 : 0) == 2;
  }

  /// Edges of length 0, and edges that run back along the one before.
  [[nodiscard]] std::string corner_fault() const {
    for (std::size_t i = 0; i < size(); ++i) {
      const std::size_t a = at(i), b = at(i + 1), c = at(i + 2);
      if (same_point(a, b)) return vertex_name(a) + " and " + vertex_name(b) + " coincide";
      if (turn(a, b, c) != 0) continue;
      for (const int axis : {u(), v()}) {
        const int in = points_.compare(b, a, axis), out = points_.compare(c, b, axis);
        if (in * out < 0) return "turns back at " + vertex_name(b);
      }
    }
    return {};
  }
  [[nodiscard]] bool same_point(std::size_t a, std::size_t b) const {
    return points_.compare(a, b, u()) == 0 && points_.compare(a, b, v()) == 0;
  }

  /// Two edges without a common corner that meet. Edges are compared in the order in which they begin along u.
  [[nodiscard]] std::string crossing_fault() const {
    const std::size_t n = size();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto low = [&](std::size_t i) { return std::min(near(at(i), u()), near(at(i + 1), u())); };
    const auto high = [&](std::size_t i) { return std::max(near(at(i), u()), near(at(i + 1), u())); };
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return low(i) < low(j) || (low(i) == low(j) && i < j);
    });
    for (std::size_t x = 0; x < n; ++x) {
      for (std::size_t y = x + 1; y < n && low(order[y]) <= high(order[x]); ++y) {
        const std::size_t i = std::min(order[x], order[y]), j = std::max(order[x], order[y]);
        if (j == i + 1 || (i == 0 && j == n - 1)) continue;
        if (edges_meet(at(i), at(i + 1), at(j), at(j + 1))) {
          return edge_name(at(i), at(i + 1)) + " and " + edge_name(at(j), at(j + 1)) + " meet";
        }
      }
    }
    return {};
  }
  [[nodiscard]] double near(std::size_t w, int axis) const { return coordinate(points_.near(w), axis); }

  [[nodiscard]] bool edges_meet(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    for (const int axis : {u(), v()}) {
      if (std::max(near(a, axis), near(b, axis)) < std::min(near(c, axis), near(d, axis))) return false;
      if (std::max(near(c, axis), near(d, axis)) < std::min(near(a, axis), near(b, axis))) return false;
    }
    const int s = turn(a, b, c), t = turn(a, b, d);
    if (s * t > 0) return false;
    const int p = turn(c, d, a), q = turn(c, d, b);
    if (p * q > 0) return false;
    if (s != 0 || t != 0 || p != 0 || q != 0) return true;
    return overlap(a, b, c, d, u()) && overlap(a, b, c, d, v());  // all four on one line
  }
  /// Whether the closed intervals that a, b and c, d span along an axis meet, exactly.
  [[nodiscard]] bool overlap(std::size_t a, std::size_t b, std::size_t c, std::size_t d, int axis) const {
    if (points_.compare(a, b, axis) > 0) std::swap(a, b);
    if (points_.compare(c, d, axis) > 0) std::swap(c, d);
    return points_.compare(a, d, axis) <= 0 && points_.compare(c, b, axis) <= 0;
  }

  /// Sense of rotation of a simple polygon: its turn at a smallest corner.
  [[nodiscard]] int orientation() const {
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < size(); ++i) {
      const int s = points_.compare(at(i), at(lowest), u());
      if (s < 0 || (s == 0 && points_.compare(at(i), at(lowest), v()) < 0)) lowest = i;
    }
    return turn(at(lowest + size() - 1), at(lowest), at(lowest + 1));
  }

  const LocatedPoints<S>& points_;
  std::span<const VertexId> loop_;
  std::size_t facet_;
  int axis_, facing_;
};

}  // namespace hexact::detail
