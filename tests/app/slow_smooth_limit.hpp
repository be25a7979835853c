// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "slow_reference.hpp"

// The claim smooth-limit, and with it all claims of a certificate, decided from their definitions.
namespace hexact::slow {

/// The smooth limit of docs/smooth-limit.md from its definitions: rational planes in the scale in which all planes of the
/// chamfer steps at the end are means of their neighbours, moved in; for every new facet E and its neighbour F beside the
/// old edge, the sum of all lifts that E gets there, each weighted by 2^level, is less than the defects at both old ends.
class SlowSmoothLimit {
 public:
  explicit SlowSmoothLimit(const Solid<Rational>& s) : body_(s) {}

  bool holds() {  // the body is convex
    if (!trivalent(body_) || body_.planes.empty()) return false;
    std::vector<Solid<Rational>> levels{body_};
    while (const auto before = undone(levels.back())) levels.push_back(*before);
    std::reverse(levels.begin(), levels.end());
    if (levels.size() < 2) return false;
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      const std::uint32_t number = levels[k + 1].addresses.back().level;
      if (!convex(levels[k]) || !all_cut_off(levels[k], body_.planes, true)) return false;
      const Solid<Rational> next = next_level_by_edges(levels[k], body_.planes, number);
      if (next.loops != levels[k + 1].loops || next.addresses != levels[k + 1].addresses) return false;
      if (k > 0 && number != levels[k].addresses.back().level + 1) return false;
    }
    if (!find_scale(levels)) return false;
    Rational weight(1);
    for (std::size_t k = 0; k + 1 < levels.size(); ++k, weight = weight + weight) {
      if (!step(levels[k], weight)) return false;
    }
    return true;
  }

 private:
  using Corner = std::pair<std::size_t, std::size_t>;  // facet and the place in its loop of a side

  /// The level before, when the last level has a plane for each of its edges and hexagons as a chamfer makes them.
  static std::optional<Solid<Rational>> undone(const Solid<Rational>& s) {
    const std::uint32_t last = s.addresses.back().level;
    const auto is_last = [&](const FacetAddress& a) { return a.level == last; };
    const auto run = std::find_if_not(s.addresses.rbegin(), s.addresses.rend(), is_last);
    const auto added = static_cast<std::size_t>(run - s.addresses.rbegin());
    std::size_t corners = 0;
    for (const auto& loop : s.loops) corners += loop.size();
    if (last == 0 || added == s.loops.size() || 8 * added != corners || s.points.size() % 4 != 0) return std::nullopt;
    const std::size_t facets = s.loops.size() - added, half_edges = 2 * added;
    std::map<std::size_t, std::size_t> origin;
    for (std::size_t f = facets; f < s.loops.size(); ++f) {
      const auto& c = s.loops[f];
      if (c.size() != 6 || c[0] < half_edges || c[3] < half_edges) return std::nullopt;
      origin[c[5]] = c[0] - half_edges;
      origin[c[2]] = c[3] - half_edges;
    }
    Solid<Rational> out;
    std::size_t h = 0;
    std::map<std::size_t, std::vector<std::size_t>> around;
    for (std::size_t f = 0; f < facets; ++f) {
      std::vector<std::size_t> loop;
      for (std::size_t j = 0; j < s.loops[f].size(); ++j, ++h) {
        if (!origin.count(h)) return std::nullopt;
        loop.push_back(origin[h]);
        around[origin[h]].push_back(f);
      }
      out.loops.push_back(loop);
    }
    out.planes.assign(s.planes.begin(), s.planes.begin() + static_cast<std::ptrdiff_t>(facets));
    out.addresses.assign(s.addresses.begin(), s.addresses.begin() + static_cast<std::ptrdiff_t>(facets));
    if (h != half_edges || around.size() != s.points.size() / 4) return std::nullopt;
    for (std::size_t v = 0; v < around.size(); ++v) {
      if (!around.count(v) || around[v].size() != 3) return std::nullopt;
      out.points.push_back(meet(out.planes[around[v][0]], out.planes[around[v][1]], out.planes[around[v][2]]));
    }
    return out;
  }

  static Plane<Rational> scaled(const Plane<Rational>& p, const Rational& k) { return {p.a * k, p.b * k, p.c * k, p.d * k}; }
  static Plane<Rational> sum(const Plane<Rational>& p, const Plane<Rational>& q) { return {p.a + q.a, p.b + q.b, p.c + q.c, p.d + q.d}; }
  /// k > 0 with k·n_p = n_q, if there is one.
  static std::optional<Rational> along(const Plane<Rational>& p, const Plane<Rational>& q) {
    const Rational pp = p.a * p.a + p.b * p.b + p.c * p.c, pq = p.a * q.a + p.b * q.b + p.c * q.c, k = pq / pp;
    if (sign(k) <= 0 || !(p.a * k == q.a) || !(p.b * k == q.b) || !(p.c * k == q.c)) return std::nullopt;
    return k;
  }

  bool find_scale(const std::vector<Solid<Rational>>& levels) {
    const auto& base = levels.front();
    std::map<std::size_t, Plane<Rational>> found{{0, body_.planes[0]}};
    const auto left = left_facets(base);
    const std::vector<Edge> edges = edges_in_order(base);
    for (bool more = true; more;) {
      more = false;
      for (std::size_t e = 0; e < edges.size(); ++e) {
        std::size_t f = left->at(edges[e]), g = left->at({edges[e].second, edges[e].first});
        if (found.count(f) == found.count(g)) continue;
        if (!found.count(f)) std::swap(f, g);
        // n_F + x n_G along n_E: both products with a vector that is orthogonal to n_E in their plane are 0.
        const Plane<Rational>&p = found[f], &q = body_.planes[g], &m = body_.planes[base.loops.size() + e];
        const Point3<Rational> axis = cross(Point3<Rational>{m.a, m.b, m.c},
                                            cross(Point3<Rational>{p.a, p.b, p.c}, Point3<Rational>{q.a, q.b, q.c}));
        const Rational b = dot(q, axis);
        if (sign(b) == 0) return false;
        const Rational x = -(dot(p, axis) / b);
        if (sign(x) <= 0) return false;
        found[g] = scaled(q, x);
        more = true;
      }
    }
    for (const auto& [f, plane] : found) planes_.push_back(plane);
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      const auto sides = left_facets(levels[k]);
      for (const Edge& e : edges_in_order(levels[k])) {
        const Plane<Rational> twice = sum(planes_[sides->at(e)], planes_[sides->at({e.second, e.first})]);
        const Plane<Rational>& own = body_.planes[planes_.size()];
        const auto k2 = along(own, twice);
        if (!k2) return false;
        planes_.push_back(scaled(own, *k2 / Rational(2)));
      }
    }
    return true;
  }

  bool step(const Solid<Rational>& level, const Rational& weight) {
    const auto left = left_facets(level);
    const std::vector<Edge> edges = edges_in_order(level);
    const std::size_t facets = level.loops.size();
    std::map<Edge, Rational> lift;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Edge back{edges[e].second, edges[e].first};
      lift[edges[e]] = lift[back] =
          weight * (planes_[left->at(edges[e])].d + planes_[left->at(back)].d - Rational(2) * planes_[facets + e].d);
      if (sign(lift[back]) <= 0) return false;
    }
    for (auto& [corner, budget] : left_over_) {
      const auto& loop = level.loops[corner.first];
      budget = budget - lift[{loop[corner.second], loop[(corner.second + 1) % loop.size()]}];
      if (sign(budget) <= 0) return false;
    }
    std::map<std::size_t, Rational> at;  // sum of the lifts at a vertex
    for (const auto& [edge, t] : lift) at[edge.first] = at[edge.first] + t;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [a, b] = edges[e];
      for (const bool forward : {true, false}) {
        const auto& loop = level.loops[forward ? left->at({a, b}) : left->at({b, a})];
        // The defect of a facet at a vertex: all lifts there less twice the one of the edge that is not the facet's.
        const auto defect = [&](std::size_t v) {
          const std::size_t j = static_cast<std::size_t>(std::find(loop.begin(), loop.end(), v) - loop.begin());
          const Rational two = lift[{v, loop[(j + 1) % loop.size()]}] + lift[{loop[(j + loop.size() - 1) % loop.size()], v}];
          return two - (at[v] - two);
        };
        left_over_[{facets + e, forward ? 4 : 1}] = std::min(defect(a), defect(b));
      }
    }
    return true;
  }

  const Solid<Rational>& body_;
  std::vector<Plane<Rational>> planes_;     ///< scaled
  std::map<Corner, Rational> left_over_;
};
inline bool smooth_limit(const Solid<Rational>& s) { return SlowSmoothLimit(s).holds(); }
inline bool smooth_limit(const Solid<QuadraticField>&) { return false; }

/// Whether each claim of the certificate holds, in order.
template <class S>
std::vector<bool> decide(const Certificate& c) {
  const Solid<S> s = solid_of<S>(c.body);
  const bool is_convex = convex(s);
  const auto holds = [&](const Claim& claim) {
    if (claim.name == "closed") return closed(s);
    if (claim.name == "planar") return planar(s);
    if (claim.name == "trivalent") return trivalent(s);
    if (claim.name == "convex" || !is_convex) return is_convex;
    if (claim.name == "smooth-limit") return smooth_limit(s);
    const auto reference =
        std::find_if(c.bodies.begin(), c.bodies.end(), [&](const NamedBody& b) { return b.name == claim.reference; });
    if (claim.name == "corner-cut-of") return corner_cut(s, *reference);
    return inside(c, s, *reference, claim.name == "tangent");
  };
  std::vector<bool> out;
  for (const Claim& claim : c.claims) out.push_back(holds(claim));
  return out;
}

}  // namespace hexact::slow
