// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

// The claims of a certificate decided straight from their definitions, over exact points: slow, and with nothing in
// common with the sign tests it is compared with.
namespace hexact::slow {

template <class S>
struct Solid {
  std::vector<Plane<S>> planes;                 ///< in file coordinates
  std::vector<std::vector<std::size_t>> loops;
  std::vector<std::optional<Point3<S>>> points; ///< nullopt: the defining planes meet in no single point
  std::vector<FacetAddress> addresses;
};

template <class S>
S dot(const Plane<S>& n, const Point3<S>& p) { return n.a * p.x + n.b * p.y + n.c * p.z; }
template <class S>
Point3<S> minus(const Point3<S>& p, const Point3<S>& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
template <class S>
Point3<S> cross(const Point3<S>& u, const Point3<S>& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
template <class S>
S det(const Plane<S>& p, const Plane<S>& q, const Plane<S>& r) {
  return dot(p, cross(Point3<S>{q.a, q.b, q.c}, Point3<S>{r.a, r.b, r.c}));
}

template <class S>
std::optional<Point3<S>> meet(const Plane<S>& p, const Plane<S>& q, const Plane<S>& r) {
  const S w = det(p, q, r);
  if (sign(w) == 0) return std::nullopt;
  const auto with = [](Plane<S> k, S Plane<S>::*column) { k.*column = k.d; return k; };
  const auto component = [&](S Plane<S>::*column) { return det(with(p, column), with(q, column), with(r, column)) / w; };
  return Point3<S>{component(&Plane<S>::a), component(&Plane<S>::b), component(&Plane<S>::c)};
}

inline Plane<Rational> plane_of(const PlaneBody& b, std::size_t i, const Rational*) {
  const Plane<Integer> p = b.planes[i];
  return {p.a, p.b, p.c, p.d};
}
inline Plane<QuadraticField> plane_of(const PlaneBody& b, std::size_t i, const QuadraticField*) { return b.planes_sqrt5[i]; }

template <class S>
Solid<S> solid_of(const PlaneBody& b) {
  Solid<S> out;
  const S unit(Rational(1).scaled(b.scale));
  for (std::size_t i = 0; i < b.plane_count(); ++i) {
    Plane<S> p = plane_of(b, i, static_cast<const S*>(nullptr));
    p.d = p.d * unit + p.a * S(b.shift[0]) + p.b * S(b.shift[1]) + p.c * S(b.shift[2]);
    out.planes.push_back(p);
    std::vector<std::size_t> loop;
    for (const VertexId v : b.loops[i]) loop.push_back(index(v));
    out.loops.push_back(loop);
  }
  for (const auto& t : b.triples) out.points.push_back(meet(out.planes[index(t[0])], out.planes[index(t[1])], out.planes[index(t[2])]));
  out.addresses = b.addresses;
  return out;
}

using Edge = std::pair<std::size_t, std::size_t>;

/// The facet on the left of each directed edge; nullopt when one is used twice.
template <class S>
std::optional<std::map<Edge, std::size_t>> left_facets(const Solid<S>& s) {
  std::map<Edge, std::size_t> left;
  for (std::size_t f = 0; f < s.loops.size(); ++f) {
    const auto& loop = s.loops[f];
    for (std::size_t j = 0; j < loop.size(); ++j) {
      if (!left.emplace(Edge{loop[j], loop[(j + 1) % loop.size()]}, f).second) return std::nullopt;
    }
  }
  return left;
}

/// The facets around v, counter-clockwise, each with its edge that leaves v; closed surfaces only.
using Star = std::vector<std::pair<std::size_t, Edge>>;

template <class S>
bool closed(const Solid<S>& s) {
  const auto left = left_facets(s);
  if (!left || left->empty()) return false;
  for (const auto& loop : s.loops) {
    if (!loop.empty() && (loop.size() < 3 || std::set<std::size_t>(loop.begin(), loop.end()).size() != loop.size())) return false;
  }
  std::map<std::size_t, std::set<std::size_t>> neighbours;           // of facets, over edges
  std::map<std::size_t, std::map<std::size_t, std::size_t>> turning; // at v: from facet to facet across an edge
  std::map<std::size_t, std::set<std::size_t>> at;                   // facets at v
  for (const auto& [edge, f] : *left) {
    const auto back = left->find({edge.second, edge.first});
    if (back == left->end()) return false;
    neighbours[f].insert(back->second);
    turning[edge.first][f] = back->second;
    at[edge.first].insert(f);
  }
  for (std::size_t v = 0; v < s.points.size(); ++v) {
    if (at[v].empty()) return false;
    std::set<std::size_t> reached;
    for (std::size_t f = *at[v].begin(); reached.insert(f).second;) f = turning[v][f];
    if (reached != at[v]) return false;
  }
  std::set<std::size_t> reached;
  std::vector<std::size_t> todo{left->begin()->second};
  while (!todo.empty()) {
    const std::size_t f = todo.back();
    todo.pop_back();
    if (reached.insert(f).second) todo.insert(todo.end(), neighbours[f].begin(), neighbours[f].end());
  }
  return reached.size() == neighbours.size();
}

template <class S>
bool planar(const Solid<S>& s) {
  if (!std::all_of(s.points.begin(), s.points.end(), [](const auto& p) { return p.has_value(); })) return false;
  for (std::size_t f = 0; f < s.loops.size(); ++f) {
    for (const std::size_t v : s.loops[f]) {
      if (sign(dot(s.planes[f], *s.points[v]) - s.planes[f].d) != 0) return false;
    }
  }
  return true;
}

template <class S>
bool trivalent(const Solid<S>& s) {
  std::vector<std::size_t> valence(s.points.size(), 0);
  for (const auto& loop : s.loops) {
    for (const std::size_t v : loop) ++valence[v];
  }
  return std::all_of(valence.begin(), valence.end(), [](std::size_t k) { return k == 3; });
}

/// Every facet is a strictly convex polygon, counter-clockwise seen from outside.
template <class S>
bool polygon_is_convex(const Solid<S>& s, std::size_t f) {
  const auto& loop = s.loops[f];
  const Point3<S> normal{s.planes[f].a, s.planes[f].b, s.planes[f].c};
  for (std::size_t j = 0; j < loop.size(); ++j) {
    const std::size_t next = (j + 1) % loop.size();
    const Point3<S> p = *s.points[loop[j]], inward = cross(normal, minus(*s.points[loop[next]], p));
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (k == j || k == next) continue;
      const Point3<S> d = minus(*s.points[loop[k]], p);
      if (sign(inward.x * d.x + inward.y * d.y + inward.z * d.z) <= 0) return false;
    }
  }
  return true;
}

/// Global: every vertex is strictly inside every facet half-space but those of its own facets.
template <class S>
bool convex(const Solid<S>& s) {
  if (!closed(s) || !planar(s)) return false;
  long facets = 0, corners = 0;
  for (std::size_t f = 0; f < s.loops.size(); ++f) {
    const auto& loop = s.loops[f];
    if (loop.empty()) continue;
    ++facets, corners += static_cast<long>(loop.size());
    for (std::size_t v = 0; v < s.points.size(); ++v) {
      const bool own = std::find(loop.begin(), loop.end(), v) != loop.end();
      if (!own && sign(dot(s.planes[f], *s.points[v]) - s.planes[f].d) >= 0) return false;
    }
    if (!polygon_is_convex(s, f)) return false;
  }
  return static_cast<long>(s.points.size()) - corners / 2 + facets == 2;
}

template <class S>
bool same(const Plane<S>& p, const Plane<S>& q) {
  const Point3<S> c = cross(Point3<S>{p.a, p.b, p.c}, Point3<S>{q.a, q.b, q.c});
  if (sign(c.x) != 0 || sign(c.y) != 0 || sign(c.z) != 0) return false;
  const S pp = p.a * p.a + p.b * p.b + p.c * p.c, pq = p.a * q.a + p.b * q.b + p.c * q.c;
  return sign(pq) > 0 && sign(p.d * pq - q.d * pp) == 0;
}

/// v satisfies the half-space, and so do all directions in which edges leave v.
template <class S>
bool supports(const Solid<S>& s, const Plane<S>& h, std::size_t v) {
  if (sign(dot(h, *s.points[v]) - h.d) > 0) return false;
  const auto left = left_facets(s);
  for (const auto& [edge, f] : *left) {
    if (edge.first == v && sign(dot(h, minus(*s.points[edge.second], *s.points[v]))) > 0) return false;
  }
  return true;
}

template <class S>
bool inside(const Certificate& c, const Solid<S>& s, const NamedBody& reference, bool tangent) {  // s is convex
  const Solid<S> outer = solid_of<S>(reference.body);
  if (!convex(outer)) return false;
  for (std::size_t i = 0; i < outer.planes.size(); ++i) {
    bool is_facet = false;
    for (std::size_t f = 0; f < s.planes.size(); ++f) is_facet = is_facet || (!s.loops[f].empty() && same(outer.planes[i], s.planes[f]));
    if (is_facet) continue;
    if (tangent && !outer.loops[i].empty()) return false;
    const auto evidence = std::find_if(c.supports.begin(), c.supports.end(),
                                       [&](const Support& e) { return e.reference == reference.name && e.plane == i; });
    if (evidence == c.supports.end() || !supports(s, outer.planes[i], index(evidence->vertex))) return false;
  }
  return true;
}

/// phs (b.2) from lists: vertex number of corner j of facet f counts the corners before it; the hexagon of v starts
/// in its facet with the smallest number and goes round counter-clockwise.
template <class S>
Solid<S> next_level(const Solid<S>& s, const std::vector<Plane<S>>& planes, std::uint32_t level) {
  Solid<S> out;
  const std::size_t facets = s.loops.size();
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> number;   // (facet, place) → new vertex
  std::map<Edge, std::pair<std::size_t, std::size_t>> place;           // directed edge → (facet, place)
  for (std::size_t f = 0; f < facets; ++f) {
    const std::size_t n = s.loops[f].size();
    std::vector<std::size_t> loop;
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t v = s.loops[f][j], w = s.loops[f][(j + 1) % n], made = number.size();
      number[{f, j}] = made;
      place[{v, w}] = {f, j};
      loop.push_back(made);
      out.points.push_back(meet(planes[f], planes[facets + v], planes[facets + w]));
    }
    out.loops.push_back(loop);
  }
  for (std::size_t v = 0; v < s.points.size(); ++v) {
    std::pair<std::size_t, std::size_t> at{facets, 0};
    for (const auto& [edge, where] : place) {
      if (edge.first == v && where.first < at.first) at = where;
    }
    std::vector<std::size_t> loop;
    for (int k = 0; k < 3; ++k) {
      const auto& old = s.loops[at.first];
      const std::size_t before = (at.second + old.size() - 1) % old.size();
      loop.push_back(number[at]);
      loop.push_back(number[{at.first, before}]);
      at = place[{v, old[before]}];  // across the edge that comes into v
    }
    out.loops.push_back(loop);
  }
  out.planes.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(facets + s.points.size()));
  out.addresses = s.addresses;
  for (std::size_t v = 0; v < s.points.size(); ++v) out.addresses.push_back({level, make_id<VertexId>(v)});
  return out;
}

/// The edges (v, w), v < w, in the order in which a walk along all loops first takes them that way.
template <class S>
std::vector<Edge> edges_in_order(const Solid<S>& s) {
  std::vector<Edge> out;
  for (const auto& loop : s.loops) {
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Edge e{loop[j], loop[(j + 1) % loop.size()]};
      if (e.first < e.second) out.push_back(e);
    }
  }
  return out;
}

/// A chamfer step from lists: a vertex for each corner of each facet, then one for each old vertex; old facets keep
/// their corners; edge (a, b), F on its left and G on its right, becomes m_a, G's corner at a, G's at b, m_b, F's at b, F's at a.
template <class S>
Solid<S> next_level_by_edges(const Solid<S>& s, const std::vector<Plane<S>>& planes, std::uint32_t level) {
  Solid<S> out;
  const auto left = left_facets(s);
  const std::vector<Edge> edges = edges_in_order(s);
  const std::size_t facets = s.loops.size();
  std::map<Edge, std::size_t> plane;                                      // both directions → plane of the edge
  for (std::size_t e = 0; e < edges.size(); ++e) {
    plane[edges[e]] = plane[{edges[e].second, edges[e].first}] = facets + e;
  }
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> corner;      // (facet, old vertex) → new vertex
  for (std::size_t f = 0; f < facets; ++f) {
    const auto& loop = s.loops[f];
    std::vector<std::size_t> made;
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const std::size_t v = loop[j], before = loop[(j + loop.size() - 1) % loop.size()], after = loop[(j + 1) % loop.size()];
      made.push_back(corner[{f, v}] = out.points.size());
      out.points.push_back(meet(planes[f], planes[plane[{before, v}]], planes[plane[{v, after}]]));
    }
    out.loops.push_back(made);
  }
  const std::size_t corners = out.points.size();
  for (std::size_t v = 0; v < s.points.size(); ++v) {
    std::vector<std::size_t> at;
    for (const auto& [edge, own] : plane) {
      if (edge.first == v) at.push_back(own);
    }
    out.points.push_back(meet(planes[at.at(0)], planes[at.at(1)], planes[at.at(2)]));
  }
  for (const auto& [a, b] : edges) {
    const std::size_t f = left->at({a, b}), g = left->at({b, a});
    out.loops.push_back({corners + a, corner[{g, a}], corner[{g, b}], corners + b, corner[{f, b}], corner[{f, a}]});
  }
  out.planes.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(facets + edges.size()));
  out.addresses = s.addresses;
  for (std::size_t e = 0; e < edges.size(); ++e) out.addresses.push_back({level, make_id<VertexId>(e)});
  return out;
}

/// Each vertex, or each end of each edge, is strictly beyond its own plane.
template <class S>
bool all_cut_off(const Solid<S>& level, const std::vector<Plane<S>>& planes, bool by_edges) {
  const auto beyond = [&](std::size_t v, std::size_t own) {
    return sign(dot(planes[own], *level.points[v]) - planes[own].d) > 0;
  };
  if (!by_edges) {
    for (std::size_t v = 0; v < level.points.size(); ++v) {
      if (!beyond(v, level.planes.size() + v)) return false;
    }
    return true;
  }
  const std::vector<Edge> edges = edges_in_order(level);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!beyond(edges[e].first, level.planes.size() + e) || !beyond(edges[e].second, level.planes.size() + e)) return false;
  }
  return true;
}

template <class S>
bool corner_cut(const Solid<S>& s, const NamedBody& reference) {  // s is convex
  Solid<S> level = solid_of<S>(reference.body);
  if (!convex(level) || !trivalent(level)) return false;
  const std::size_t base = level.planes.size();
  if (base > s.planes.size()) return false;
  for (std::size_t i = 0; i < base; ++i) {
    if (level.loops[i].empty() || !same(level.planes[i], s.planes[i])) return false;
    level.planes[i] = s.planes[i];
  }
  for (std::uint32_t k = 1; level.planes.size() < s.planes.size(); ++k) {
    if (!convex(level)) return false;
    // The planes of level k among those that are new; in the end every address has to be the one of its place.
    const auto made = static_cast<std::size_t>(std::count_if(s.addresses.begin() + static_cast<std::ptrdiff_t>(level.planes.size()),
                                                             s.addresses.end(), [&](const FacetAddress& a) { return a.level == k; }));
    const bool by_edges = made == edges_in_order(level).size();
    if (!by_edges && made != level.points.size()) return false;
    if (level.planes.size() + made > s.planes.size() || !all_cut_off(level, s.planes, by_edges)) return false;
    level = by_edges ? next_level_by_edges(level, s.planes, k) : next_level(level, s.planes, k);
  }
  return level.loops == s.loops && level.addresses == s.addresses;
}

}  // namespace hexact::slow
