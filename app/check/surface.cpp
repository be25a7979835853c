// SPDX-License-Identifier: LGPL-3.0-or-later
#include "surface.hpp"

#include <algorithm>

namespace check {
namespace {

std::string edge_name(Index v, Index w) { return "edge " + std::to_string(std::min(v, w)) + "-" + std::to_string(std::max(v, w)); }

std::string read_facets(const Surface& s, Edges& e) {
  const std::size_t n = s.corner.size(), vertices = s.triple.size();
  e.facet.resize(n), e.next.resize(n), e.previous.resize(n);
  e.twin.assign(n, kNone), e.leaving.assign(vertices, kNone);
  std::vector<Index> seen(vertices, kNone);
  for (std::size_t f = 0; f < s.facets(); ++f) {
    const Index b = s.start[f], end = s.start[f + 1];
    if (b == end) continue;
    if (end - b < 3) return facet_name(f) + ": fewer than 3 corners";
    for (Index h = b; h < end; ++h) {
      const Index v = s.corner[h];
      if (seen[v] == f) return facet_name(f) + ": passes " + vertex_name(v) + " twice";
      seen[v] = static_cast<Index>(f);
      e.facet[h] = static_cast<Index>(f);
      e.next[h] = h + 1 == end ? b : h + 1;
      e.previous[h] = h == b ? end - 1 : h - 1;
      if (e.leaving[v] == kNone) e.leaving[v] = h;
    }
  }
  return n == 0 ? "there is no facet" : "";
}

// The half-edges that leave each vertex, sorted by the vertex they go to.
struct Fans {
  std::vector<Index> start, half_edge;
};

Fans fans_of(const Surface& s, const Edges& e) {
  const std::size_t n = s.corner.size(), vertices = s.triple.size();
  Fans fans{std::vector<Index>(vertices + 1, 0), std::vector<Index>(n)};
  for (const Index v : s.corner) ++fans.start[v + 1];
  for (std::size_t v = 0; v < vertices; ++v) fans.start[v + 1] += fans.start[v];
  std::vector<Index> at(fans.start.begin(), fans.start.end() - 1);
  for (Index h = 0; h < n; ++h) fans.half_edge[at[s.corner[h]]++] = h;
  const auto target = [&](Index h) { return s.corner[e.next[h]]; };
  for (std::size_t v = 0; v < vertices; ++v) {
    std::sort(fans.half_edge.begin() + fans.start[v], fans.half_edge.begin() + fans.start[v + 1],
              [&](Index g, Index h) { return target(g) < target(h); });
  }
  return fans;
}

std::string pair_edges(const Surface& s, Edges& e, const Fans& fans) {
  const auto target = [&](Index h) { return s.corner[e.next[h]]; };
  const auto fault = [&](Index h) { return edge_name(s.corner[h], target(h)) + ": is not used once in each direction"; };
  for (Index v = 0; v < s.triple.size(); ++v) {
    const auto *first = fans.half_edge.data() + fans.start[v], *last = fans.half_edge.data() + fans.start[v + 1];
    for (const auto* h = first; h != last; ++h) {
      const Index w = target(*h);
      if (h + 1 != last && target(h[1]) == w) return fault(*h);
      const auto *begin = fans.half_edge.data() + fans.start[w], *end = fans.half_edge.data() + fans.start[w + 1];
      const auto* back = std::lower_bound(begin, end, v, [&](Index g, Index x) { return target(g) < x; });
      if (back == end || target(*back) != v) return fault(*h);
      e.twin[*h] = *back;
    }
  }
  return {};
}

std::string fan_fault(const Surface& s, const Edges& e, const Fans& fans) {
  for (std::size_t v = 0; v < s.triple.size(); ++v) {
    if (e.leaving[v] == kNone) return vertex_name(v) + ": is in no facet";
    Index round = 0, h = e.leaving[v];
    do ++round, h = e.twin[e.previous[h]];
    while (h != e.leaving[v]);
    if (round != fans.start[v + 1] - fans.start[v]) return vertex_name(v) + ": its facets are not one fan";
  }
  return {};
}

std::size_t facets_with_loops(const Surface& s) {
  std::size_t used = 0;
  for (std::size_t f = 0; f < s.facets(); ++f) used += s.size(f) > 0 ? 1 : 0;
  return used;
}

std::string connected_fault(const Surface& s, const Edges& e) {
  std::vector<bool> reached(s.facets(), false);
  std::vector<Index> todo{e.facet[0]};
  reached[e.facet[0]] = true;
  std::size_t found = 1;
  while (!todo.empty()) {
    const Index f = todo.back();
    todo.pop_back();
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) {
      const Index g = e.facet[e.twin[h]];
      if (!reached[g]) reached[g] = true, ++found, todo.push_back(g);
    }
  }
  return found == facets_with_loops(s) ? "" : "the surface is not connected";
}

// Counts sign changes of the component of n_f × n_g along an axis that is not orthogonal to the turning in facet f.
class Turning {
 public:
  Turning(const Planes& planes, std::size_t f) : planes_(planes), f_(f), axis_(axis_of(planes, f)) {}
  void add(std::size_t g) {
    const int s = cross(planes_, f_, g, axis_);
    if (s == 0) return;
    if (first_ == 0) first_ = s;
    if (last_ != 0 && s != last_) ++changes_;
    last_ = s;
  }
  int open_changes() const { return changes_; }
  int cyclic_changes() const { return changes_ + (first_ != last_ ? 1 : 0); }

 private:
  static int axis_of(const Planes& planes, std::size_t f) {
    if (planes.is_short(f)) return planes.row(f)[0] != 0 ? 1 : planes.row(f)[1] != 0 ? 2 : 0;
    const Plane p = planes[f];
    return !is_zero(p[0]) ? 1 : !is_zero(p[1]) ? 2 : 0;
  }
  const Planes& planes_;
  std::size_t f_;
  int axis_, first_ = 0, last_ = 0, changes_ = 0;
};

Index right_of(const Edges& e, Index h) { return e.facet[e.twin[h]]; }

std::string edges_fault(const Planes& planes, const Surface& s, const Edges& e) {
  for (Index h = 0; h < s.corner.size(); ++h) {
    const Index f = e.facet[h], g = right_of(e, h), k = right_of(e, e.previous[h]), v = s.corner[h], w = s.corner[e.next[h]];
    if (sign3(planes, f, k, g) <= 0) {
      return facet_name(f) + ": corner at " + vertex_name(v) + " is not convex, det3 = " + text(det3(planes[f], planes[k], planes[g]));
    }
    if (h > e.twin[h]) continue;
    // w = v + t·(n_f × n_g) with t > 0: seen from the plane k through v, whose normal is independent of f and g.
    const auto& t = s.triple[w];
    if (sign3(planes, t[0], t[1], t[2]) * sign4(planes, t[0], t[1], t[2], k) <= 0) {
      return edge_name(v, w) + ": is not strictly convex, det4 = " + text(det4(planes[t[0]], planes[t[1]], planes[t[2]], planes[k]));
    }
  }
  return {};
}

std::string facets_fault(const Planes& planes, const Surface& s, const Edges& e) {
  for (std::size_t f = 0; f < s.facets(); ++f) {
    if (s.size(f) == 0) continue;
    Turning turning(planes, f);
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) turning.add(right_of(e, h));
    if (turning.cyclic_changes() != 2) return facet_name(f) + ": does not turn exactly once";
  }
  return {};
}

// Around a vertex of four and more facets the edges go round once: all but its own two lie strictly inside the first
// facet, and their traces there make less than a half turn.
std::string vertices_fault(const Planes& planes, const Surface& s, const Edges& e) {
  std::vector<Index> around;
  for (std::size_t v = 0; v < s.triple.size(); ++v) {
    around.clear();
    Index h = e.leaving[v];
    do around.push_back(e.facet[h]), h = e.twin[e.previous[h]];
    while (h != e.leaving[v]);
    if (around.size() == 3) continue;
    Turning turning(planes, around[0]);
    bool inside = true;
    for (std::size_t i = 1; i < around.size(); ++i) {
      turning.add(around[i]);
      if (i + 1 < around.size()) inside = inside && sign3(planes, around[0], around[i + 1], around[i]) < 0;
    }
    if (!inside || turning.open_changes() > 1) return vertex_name(v) + ": its facets do not go round once";
  }
  return {};
}

}  // namespace

std::string facet_name(std::size_t f) { return "facet " + std::to_string(f); }
std::string vertex_name(std::size_t v) { return "vertex " + std::to_string(v); }

std::string closed_fault(const Surface& s, Edges& e) {
  if (std::string fault = read_facets(s, e); !fault.empty()) return fault;
  const Fans fans = fans_of(s, e);
  if (std::string fault = pair_edges(s, e, fans); !fault.empty()) return fault;
  if (std::string fault = fan_fault(s, e, fans); !fault.empty()) return fault;
  return connected_fault(s, e);
}

std::string planar_fault(const Planes& planes, const Surface& s) {
  for (std::size_t v = 0; v < s.triple.size(); ++v) {
    if (sign3(planes, s.triple[v][0], s.triple[v][1], s.triple[v][2]) == 0) return vertex_name(v) + ": det3 of its planes = 0";
  }
  for (std::size_t f = 0; f < s.facets(); ++f) {
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) {
      const auto& t = s.triple[s.corner[h]];
      if (t[0] == f || t[1] == f || t[2] == f || sign4(planes, t[0], t[1], t[2], f) == 0) continue;
      return facet_name(f) + ": does not contain " + vertex_name(s.corner[h]) + ", det4 = " +
             text(det4(planes[t[0]], planes[t[1]], planes[t[2]], planes[f]));
    }
  }
  return {};
}

std::string trivalent_fault(const Surface& s) {
  std::vector<Index> valence(s.triple.size(), 0);
  for (const Index v : s.corner) ++valence[v];
  for (std::size_t v = 0; v < valence.size(); ++v) {
    if (valence[v] != 3) return vertex_name(v) + ": " + std::to_string(valence[v]) + " facets";
  }
  return {};
}

std::string convex_fault(const Planes& planes, const Surface& s, Edges& e) {
  if (std::string fault = closed_fault(s, e); !fault.empty()) return fault;
  if (std::string fault = planar_fault(planes, s); !fault.empty()) return fault;
  const auto count = [](std::size_t n) { return static_cast<long>(n); };
  const long euler = count(s.triple.size()) - count(s.corner.size() / 2) + count(facets_with_loops(s));
  if (euler != 2) return "Euler characteristic " + std::to_string(euler);
  if (std::string fault = edges_fault(planes, s, e); !fault.empty()) return fault;
  if (std::string fault = facets_fault(planes, s, e); !fault.empty()) return fault;
  return vertices_fault(planes, s, e);
}

}  // namespace check
