// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "located_points.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

// Whether two simple planar polygons of one surface meet outside of their common vertices and edges.
namespace hexact::detail {

/// An exact point with its nearest doubles.
template <class S>
struct Spot {
  Point3<S> exact;
  Point3<double> near;
  explicit Spot(Point3<S> p) : exact(std::move(p)), near{exact.x.to_double(), exact.y.to_double(), exact.z.to_double()} {}
  Spot(Point3<S> p, const Point3<double>& q) : exact(std::move(p)), near(q) {}
};
template <class S>
int compare(const Spot<S>& p, const Spot<S>& q, int axis) {
  const double x = coordinate(p.near, axis), y = coordinate(q.near, axis);
  return x < y ? -1 : y < x ? 1 : sign(coordinate(p.exact, axis) - coordinate(q.exact, axis));
}
template <class S>
int turn(const Spot<S>& a, const Spot<S>& b, const Spot<S>& c, int axis) {
  const int s = turn_filter(a.near, b.near, c.near, axis);
  return s != 0 ? s : turn_sign(a.exact, b.exact, c.exact, axis);
}
template <class S>
Spot<S> middle(const Spot<S>& p, const Spot<S>& q) {
  return Spot<S>(S(Rational(1).scaled(-1)) * (p.exact + q.exact));
}

/// A facet with exact corners, in the projection along an axis that its normal is not orthogonal to.
template <class S>
struct ExactFacet {
  std::vector<std::size_t> name;  ///< vertex numbers
  std::vector<Spot<S>> corner;
  int axis;

  ExactFacet(const LocatedPoints<S>& points, std::size_t f, int along) : axis(along) {
    for (const VertexId v : points.body().loops[f]) {
      name.push_back(index(v));
      corner.emplace_back(points.exact(index(v)), points.near(index(v)));
    }
  }
  [[nodiscard]] std::size_t size() const { return corner.size(); }
  [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 == size() ? 0 : i + 1; }
  [[nodiscard]] bool has(std::size_t vertex) const { return std::find(name.begin(), name.end(), vertex) != name.end(); }
  [[nodiscard]] bool has_edge(std::size_t a, std::size_t b) const {
    for (std::size_t i = 0; i < size(); ++i) {
      const std::size_t p = name[i], q = name[next(i)];
      if ((p == a && q == b) || (p == b && q == a)) return true;
    }
    return false;
  }
  /// Whether a point of the plane lies in the closed polygon: number of edges to its right, of odd parity.
  [[nodiscard]] bool contains(const Spot<S>& x) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    bool inside = false;
    for (std::size_t i = 0; i < size(); ++i) {
      const Spot<S>&a = corner[i], &b = corner[next(i)];
      const int av = compare(a, x, v), bv = compare(b, x, v);
      if (av * bv > 0) continue;
      const int t = turn(a, b, x, axis);
      if (t == 0) {
        if (compare(a, x, u) * compare(b, x, u) <= 0) return true;
        continue;
      }
      if ((av <= 0) != (bv <= 0) && (t > 0) == (bv > av)) inside = !inside;
    }
    return inside;
  }
};

template <class S>
class FacetPair {
 public:
  FacetPair(const LocatedPoints<S>& points, std::size_t f, std::size_t g) : points_(points), f_(f), g_(g) {}

  /// A point of both facets that is on no common vertex or edge; nullopt proves that there is none.
  [[nodiscard]] std::optional<Point3<S>> contact() const {
    const std::vector<int> of_f = sides(f_, g_);
    if (one_side(of_f, f_, g_)) return std::nullopt;
    const std::vector<int> of_g = sides(g_, f_);
    if (one_side(of_g, g_, f_)) return std::nullopt;
    for (int axis = 0; axis < 3; ++axis) {
      if (cross_sign(points_.planes(), f_, g_, axis) != 0) return contact_on_line(of_f, of_g, axis);
    }
    return contact_in_plane();
  }

 private:
  [[nodiscard]] std::span<const VertexId> loop(std::size_t f) const { return points_.body().loops[f]; }
  [[nodiscard]] static bool has(std::span<const VertexId> loop, VertexId v) {
    return std::find(loop.begin(), loop.end(), v) != loop.end();
  }
  [[nodiscard]] static bool has_edge(std::span<const VertexId> loop, VertexId a, VertexId b) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const VertexId p = loop[i], q = loop[(i + 1) % loop.size()];
      if ((p == a && q == b) || (p == b && q == a)) return true;
    }
    return false;
  }

  /// On which side of facet g's plane the corners of f are; common corners lie on it.
  [[nodiscard]] std::vector<int> sides(std::size_t f, std::size_t g) const {
    std::vector<int> out;
    for (const VertexId v : loop(f)) out.push_back(has(loop(g), v) ? 0 : points_.side(index(v), g));
    return out;
  }

  /// Facet f touches the plane of g in common vertices and edges alone, and lies on one side of it otherwise.
  [[nodiscard]] bool one_side(const std::vector<int>& side, std::size_t f, std::size_t g) const {
    const auto a = loop(f), b = loop(g);
    int seen = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (side[i] == 0) {
        if (!has(b, a[i])) return false;
        const std::size_t j = (i + 1) % a.size();
        if (side[j] == 0 && !has_edge(b, a[i], a[j])) return false;
      } else if (seen == 0) {
        seen = side[i];
      } else if (side[i] != seen) {
        return false;
      }
    }
    return seen != 0;
  }

  /// Corners on the other plane and the points where edges cross it.
  void add_events(const ExactFacet<S>& facet, const std::vector<int>& side, const Plane<S>& other, std::vector<Spot<S>>& out) const {
    for (std::size_t i = 0; i < facet.size(); ++i) {
      const std::size_t j = facet.next(i);
      if (side[i] == 0) out.push_back(facet.corner[i]);
      if (side[i] * side[j] >= 0) continue;
      const Point3<S>&p = facet.corner[i].exact, &q = facet.corner[j].exact;
      const S hp = height(other, p), hq = height(other, q);
      out.emplace_back(p + (hp / (hp - hq)) * (q - p));
    }
  }
  [[nodiscard]] Plane<S> exact_plane(std::size_t f) const {
    const auto p = points_.planes()[f];
    return {to_field(p.a), to_field(p.b), to_field(p.c), to_field(p.d)};
  }

  /// Both facets meet the line of the two planes in finitely many segments that end at events.
  [[nodiscard]] std::optional<Point3<S>> contact_on_line(const std::vector<int>& of_f, const std::vector<int>& of_g, int along) const {
    const ExactFacet<S> f(points_, f_, points_.projection_axis(f_)), g(points_, g_, points_.projection_axis(g_));
    std::vector<Spot<S>> events;
    add_events(f, of_f, exact_plane(g_), events);
    add_events(g, of_g, exact_plane(f_), events);
    std::sort(events.begin(), events.end(), [&](const auto& p, const auto& q) { return compare(p, q, along) < 0; });
    events.erase(std::unique(events.begin(), events.end(), [&](const auto& p, const auto& q) { return compare(p, q, along) == 0; }),
                 events.end());
    const auto meets = [&](const Spot<S>& x) { return !is_common(f, g, x, along) && f.contains(x) && g.contains(x); };
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (meets(events[i])) return events[i].exact;
      if (i + 1 == events.size()) break;
      const Spot<S> between = middle(events[i], events[i + 1]);
      if (meets(between)) return between.exact;
    }
    return std::nullopt;
  }
  /// Whether a point of the line is a common vertex or on a common edge.
  [[nodiscard]] bool is_common(const ExactFacet<S>& f, const ExactFacet<S>& g, const Spot<S>& x, int along) const {
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (!g.has(f.name[i])) continue;
      const int s = compare(f.corner[i], x, along);
      if (s == 0) return true;
      const std::size_t j = f.next(i);
      if (g.has_edge(f.name[i], f.name[j]) && s * compare(f.corner[j], x, along) < 0) return true;
    }
    return false;
  }

  /// Facets in one plane: edges that meet, then edges of one inside the other.
  [[nodiscard]] std::optional<Point3<S>> contact_in_plane() const {
    const int axis = points_.projection_axis(f_);
    const ExactFacet<S> f(points_, f_, axis), g(points_, g_, axis);
    for (std::size_t i = 0; i < f.size(); ++i) {
      for (std::size_t j = 0; j < g.size(); ++j) {
        if (auto x = edges_contact(f, i, g, j)) return x;
      }
    }
    bool all_common = true;
    for (const auto& [own, other] : {std::pair{&f, &g}, std::pair{&g, &f}}) {
      for (std::size_t i = 0; i < own->size(); ++i) {
        const std::size_t j = own->next(i);
        if (other->has_edge(own->name[i], own->name[j])) continue;
        all_common = false;
        const Spot<S> x = middle(own->corner[i], own->corner[j]);
        if (other->contains(x)) return x.exact;
      }
    }
    return all_common ? std::optional(middle(f.corner[0], f.corner[1]).exact) : std::nullopt;
  }
  /// A point where edge i of f meets edge j of g outside of a common vertex, unless it is a common edge.
  [[nodiscard]] std::optional<Point3<S>> edges_contact(const ExactFacet<S>& f, std::size_t i, const ExactFacet<S>& g, std::size_t j) const {
    const std::size_t k = f.next(i), l = g.next(j);
    const std::array<std::size_t, 2> e{f.name[i], f.name[k]}, h{g.name[j], g.name[l]};
    const auto named = [](const auto& pair, std::size_t v) { return pair[0] == v || pair[1] == v; };
    const int common = (named(h, e[0]) ? 1 : 0) + (named(h, e[1]) ? 1 : 0);
    if (common == 2) return std::nullopt;
    const Spot<S>&a = f.corner[i], &b = f.corner[k], &c = g.corner[j], &d = g.corner[l];
    const int s = turn(a, b, c, f.axis), t = turn(a, b, d, f.axis), p = turn(c, d, a, f.axis), q = turn(c, d, b, f.axis);
    if (s * t > 0 || p * q > 0) return std::nullopt;
    if (s == 0 && t == 0) return collinear_contact({&a, &b, &c, &d}, {e[0], e[1], h[0], h[1]}, f.axis);
    if (common == 1) return std::nullopt;  // not on one line: they meet in the common vertex alone
    if (p == 0) return a.exact;
    if (q == 0) return b.exact;
    if (s == 0) return c.exact;
    if (t == 0) return d.exact;
    return crossing(a, b, c, d, f.axis);
  }
  /// An end of one segment within the other, or the middle of an overlap.
  static std::optional<Point3<S>> collinear_contact(const std::array<const Spot<S>*, 4>& p, const std::array<std::size_t, 4>& name, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int along = compare(*p[0], *p[1], u) != 0 ? u : v;
    std::array<std::size_t, 2> first{0, 1}, second{2, 3};
    if (compare(*p[0], *p[1], along) > 0) std::swap(first[0], first[1]);
    if (compare(*p[2], *p[3], along) > 0) std::swap(second[0], second[1]);
    const std::size_t low = compare(*p[first[0]], *p[second[0]], along) >= 0 ? first[0] : second[0];
    const std::size_t high = compare(*p[first[1]], *p[second[1]], along) <= 0 ? first[1] : second[1];
    const int s = compare(*p[low], *p[high], along);
    if (s > 0) return std::nullopt;
    if (s < 0) return middle(*p[low], *p[high]).exact;
    return name[low] == name[high] ? std::nullopt : std::optional(p[low]->exact);
  }
  static Point3<S> crossing(const Spot<S>& a, const Spot<S>& b, const Spot<S>& c, const Spot<S>& d, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto area = [&](const Point3<S>& x) {
      return (coordinate(d.exact, u) - coordinate(c.exact, u)) * (coordinate(x, v) - coordinate(c.exact, v)) -
             (coordinate(d.exact, v) - coordinate(c.exact, v)) * (coordinate(x, u) - coordinate(c.exact, u));
    };
    const S s = area(a.exact), t = area(b.exact);
    return a.exact + (s / (s - t)) * (b.exact - a.exact);
  }

  const LocatedPoints<S>& points_;
  std::size_t f_, g_;
};

}  // namespace hexact::detail
