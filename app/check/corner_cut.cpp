// SPDX-License-Identifier: LGPL-3.0-or-later
#include "corner_cut.hpp"

#include "surface.hpp"

#include <algorithm>
#include <utility>

namespace check {
namespace {

// A level, its half-edges, and the address of each facet.
struct Level {
  Surface surface;
  Edges edges;
  std::vector<Address> address;
};

// A honeycomb step: corner h of the old loops is vertex h; old facets keep their corners; vertex v becomes a hexagon.
Surface corners_cut(const Surface& s, const Edges& e) {
  Surface r;
  const std::size_t corners = s.corner.size();
  const auto facets = static_cast<Index>(s.facets());
  r.start = s.start;
  r.start.reserve(s.start.size() + s.triple.size());
  r.corner.reserve(3 * corners);
  r.triple.resize(corners);
  for (Index h = 0; h < corners; ++h) {
    r.corner.push_back(h);
    r.triple[h] = {e.facet[h], facets + s.corner[h], facets + s.corner[e.next[h]]};
  }
  for (Index v = 0; v < s.triple.size(); ++v) {
    Index h = e.leaving[v];
    for (int k = 0; k < 3; ++k, h = e.twin[e.previous[h]]) {
      r.corner.push_back(h);
      r.corner.push_back(e.previous[h]);
    }
    r.start.push_back(static_cast<Index>(r.corner.size()));
  }
  return r;
}

// A chamfer step: corner h of the old loops is vertex h, old facets keep their corners, the three cut edges of v meet
// in vertex H + v; the edge of h and its twin g becomes a hexagon.
Surface edges_cut(const Surface& s, const Edges& e, const std::vector<Index>& list) {
  Surface r;
  const auto corners = static_cast<Index>(s.corner.size()), facets = static_cast<Index>(s.facets());
  std::vector<Index> plane(corners);  // of the edge of each half-edge
  for (std::size_t i = 0; i < list.size(); ++i) plane[list[i]] = plane[e.twin[list[i]]] = facets + static_cast<Index>(i);
  r.start = s.start;
  r.start.reserve(s.start.size() + list.size());
  r.corner.reserve(std::size_t{4} * corners);
  r.triple.resize(corners + s.triple.size());
  for (Index h = 0; h < corners; ++h) {
    r.corner.push_back(h);
    r.triple[h] = {e.facet[h], plane[e.previous[h]], plane[h]};
  }
  for (std::size_t v = 0; v < s.triple.size(); ++v) {
    const Index a = e.leaving[v], b = e.twin[e.previous[a]], c = e.twin[e.previous[b]];
    r.triple[corners + v] = {plane[a], plane[b], plane[c]};
  }
  for (const Index h : list) {
    const Index g = e.twin[h], a = s.corner[h], b = s.corner[g];
    for (const Index v : {corners + a, e.next[g], g, corners + b, e.next[h], h}) r.corner.push_back(v);
    r.start.push_back(static_cast<Index>(r.corner.size()));
  }
  return r;
}

// Vertex v of a convex level is strictly beyond the plane `own`.
bool is_cut_off(const Planes& planes, const Surface& s, std::size_t v, std::size_t own) {
  const auto& t = s.triple[v];
  return sign3(planes, t[0], t[1], t[2]) * sign4(planes, t[0], t[1], t[2], own) < 0;
}
std::string kept_text(const Planes& planes, const Surface& s, std::size_t v, std::size_t own) {
  const auto& t = s.triple[v];
  return vertex_name(v) + ": is not beyond " + facet_name(own) + ", which should cut it off, det4 = " +
         text(det4(planes[t[0]], planes[t[1]], planes[t[2]], planes[own]));
}

// Makes level `number`, whose planes are as many as the level before it has vertices or edges (3V = 2E, never both).
std::string advance(Level& level, const Body& body, Index number) {
  const Surface& s = level.surface;
  const std::size_t facets = s.facets(), vertices = s.triple.size(), edges = s.corner.size() / 2;
  std::size_t end = facets;
  while (end < body.address.size() && body.address[end].level == number) ++end;
  if (end - facets != vertices && end - facets != edges) {
    return std::to_string(end - facets) + " planes instead of one for each vertex or one for each edge";
  }
  for (Index i = 0; i < end - facets; ++i) level.address.push_back({number, i});
  if (end - facets == vertices) {
    for (std::size_t v = 0; v < vertices; ++v) {
      if (!is_cut_off(body.planes, s, v, facets + v)) return kept_text(body.planes, s, v, facets + v);
    }
    level.surface = corners_cut(s, level.edges);
    return {};
  }
  const std::vector<Index> list = edge_list(s, level.edges);
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const Index v : {s.corner[list[i]], s.corner[level.edges.next[list[i]]]}) {
      if (!is_cut_off(body.planes, s, v, facets + i)) return kept_text(body.planes, s, v, facets + i);
    }
  }
  level.surface = edges_cut(s, level.edges, list);
  return {};
}

// Whether loops and addresses of the body are those of the last level.
std::string difference(const Level& last, const Body& body) {
  const Surface &s = last.surface, &t = body.surface;
  for (std::size_t f = 0; f < s.facets(); ++f) {
    const auto *first = s.corner.data() + s.start[f], *end = s.corner.data() + s.start[f + 1];
    if (!std::equal(first, end, t.corner.data() + t.start[f], t.corner.data() + t.start[f + 1])) {
      return facet_name(f) + ": another loop than that of the steps";
    }
    if (!(last.address[f] == body.address[f])) return facet_name(f) + ": level or parent is not the one of its place";
  }
  return {};
}

}  // namespace

// Half-space i of `of` in the coordinates of `frame`.
Plane in_frame(const Body& of, std::size_t i, const Body& frame) {
  Plane p = of.planes[i];
  if (of.scale == frame.scale && of.shift == frame.shift) return p;
  Number d = p[3] * Number(power_of_two(of.scale));
  for (std::size_t k = 0; k < 3; ++k) d = d - p[k] * Number(mpq_class(frame.shift[k] - of.shift[k]));
  p[3] = d * Number(power_of_two(-frame.scale));
  return p;
}

// The half-edge of each edge that runs to the vertex with the larger number, ascending: the order of edges.
std::vector<Index> edge_list(const Surface& s, const Edges& e) {
  std::vector<Index> list;
  list.reserve(s.corner.size() / 2);
  for (Index h = 0; h < s.corner.size(); ++h) {
    if (s.corner[h] < s.corner[e.next[h]]) list.push_back(h);
  }
  return list;
}

std::string replay(const Body& body, const Surface& first, std::vector<Address> address, Index first_level,
                   const std::function<std::string(const Surface&, const Edges&)>& visit) {
  Level level{first, {}, std::move(address)};
  for (Index number = first_level; level.surface.facets() < body.planes.size(); ++number) {
    const auto at = [](Index l) { return "level " + std::to_string(l) + ": "; };
    if (std::string fault = convex_fault(body.planes, level.surface, level.edges); !fault.empty()) return at(number - 1) + fault;
    if (visit) {
      if (std::string fault = visit(level.surface, level.edges); !fault.empty()) return at(number) + fault;
    }
    if (std::string fault = advance(level, body, number); !fault.empty()) return at(number) + fault;
  }
  return difference(level, body);
}

// Whether the planes are those of `base` and then one per vertex or edge, level by level, each level before the last
// convex, and the loops those of the last level. That the last level is convex is the claim `convex` of the body
// itself: its vertices are the same points, since every plane around a vertex passes through it.
std::string corner_cut_fault(const Body& body, const Body& base, const std::string& name) {
  if (std::string fault = trivalent_fault(base.surface); !fault.empty()) return "body " + name + ": " + fault;
  if (base.planes.size() > body.planes.size()) return "fewer planes than " + name;
  for (std::size_t i = 0; i < base.planes.size(); ++i) {
    if (base.surface.size(i) == 0) return facet_name(i) + " of " + name + ": has no loop";
    if (!same_half_space(in_frame(base, i, body), body.planes[i])) return facet_name(i) + ": is not the plane of " + name;
  }
  return replay(body, base.surface, base.address, 1, nullptr);
}

}  // namespace check
