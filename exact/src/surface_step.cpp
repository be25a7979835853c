// SPDX-License-Identifier: LGPL-3.0-or-later
#include "surface_step.hpp"

#include "simple_polygon.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace hexact {
namespace detail {
namespace {

std::string at_level(std::uint32_t level) { return " at level " + std::to_string(level); }
Integer magnitude(const Integer& x) { return x.sign() < 0 ? -x : x; }

template <class Visit>
void for_each(std::size_t count, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) visit(i);
  });
}

/// 2σ of the corner of h, σ the depth below its facet at which the three cuts meet: docs/chamfer-nonconvex.md (2).
Integer doubled_depth(const SurfaceMap& map, const std::vector<Integer>& lifts, std::uint32_t h) {
  return lifts[map.edges.edge[h]] + lifts[map.edges.edge[map.half_edges.previous[h]]] - lifts[map.third_edge(h)];
}

void add_vertex_faults(const ChamferSurface& surface, const SurfaceMap& map, const std::vector<Integer>& lifts, std::vector<SurfaceFault>& out) {
  std::vector<char> seen(surface.body.vertex_count(), 0);
  const auto edges_at = [&](std::size_t v) {
    const auto& e = map.at_vertex[v];
    return std::vector<std::uint32_t>(e.begin(), e.end());
  };
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const std::uint32_t v = map.half_edges.origin[h];
    if (map.centre[v] == kNoTwin) continue;
    const auto& e = map.at_vertex[v];
    if (doubled_depth(map, lifts, h).is_zero() && !map.is_pure(surface, v)) {
      out.push_back({{"SpokeCollapse",
                      "the lifts " + lifts[e[0]].str() + ", " + lifts[e[1]].str() + ", " + lifts[e[2]].str() + " of its edges" + at_level(surface.level) +
                          " make the cuts meet in the plane of " + facet_name(map.half_edges.facet[h]), vertex_name(v), {}}, edges_at(v)});
    }
    if (seen[v] != 0 || !map.is_pure(surface, v)) continue;
    seen[v] = 1;
    const Integer a = magnitude(lifts[e[0]]), b = magnitude(lifts[e[1]]), c = magnitude(lifts[e[2]]);
    if (a < b + c && b < c + a && c < a + b) continue;
    out.push_back({{"TriangleInequality",
                    "the lifts " + lifts[e[0]].str() + ", " + lifts[e[1]].str() + ", " + lifts[e[2]].str() + " of its edges" + at_level(surface.level) +
                        " have to be smaller each, in magnitude, than the sum of the other two", vertex_name(v), {}}, edges_at(v)});
  }
}

/// What half-edges of the next level are given, in the order of its loops.
struct NewHalfEdges {
  std::vector<std::uint32_t> right;
  std::vector<std::int8_t> sign;
  void add(std::uint32_t plane, int s) {
    right.push_back(plane);
    sign.push_back(static_cast<std::int8_t>(s));
  }
};

class Cutter {
 public:
  Cutter(const ChamferSurface& surface, const SurfaceMap& map, const std::vector<Integer>& lifts)
      : old_(surface), map_(map), lifts_(lifts), planes_(static_cast<std::uint32_t>(surface.body.planes.size())) {}

  [[nodiscard]] ChamferSurface result() {
    ChamferSurface next;
    next.level = old_.level + 1;
    next.body.scale = old_.body.scale;
    next.body.shift = old_.body.shift;
    add_planes(next.body);
    add_triples(next.body);
    NewHalfEdges made;
    keep_facets(next.body.loops, made);
    for (std::uint32_t e = 0; e < map_.edges.half_edge.size(); ++e) add_hexagon(e, next.body.loops, made);
    next.right = std::move(made.right);
    next.sign = std::move(made.sign);
    return next;
  }

 private:
  [[nodiscard]] std::uint32_t cut(std::uint32_t h) const { return planes_ + map_.edges.edge[h]; }
  [[nodiscard]] std::uint32_t before(std::uint32_t h) const { return map_.half_edges.previous[h]; }
  [[nodiscard]] std::uint32_t behind(std::uint32_t h) const { return map_.half_edges.next[h]; }

  /// (1): old planes doubled, then F + G − τ for each edge.
  void add_planes(PlaneBody& body) const {
    const IntegerPlanes& old = old_.body.planes;
    std::vector<Plane<Integer>> made(planes_ + lifts_.size());
    for_each(made.size(), [&](std::size_t i) {
      if (i < planes_) {
        const Plane<Integer> p = old[i];
        made[i] = {p.a + p.a, p.b + p.b, p.c + p.c, p.d + p.d};
        return;
      }
      const std::uint32_t h = map_.edges.half_edge[i - planes_];
      const Plane<Integer> p = old[map_.half_edges.facet[h]], q = old[old_.right[h]];
      made[i] = {p.a + q.a, p.b + q.b, p.c + q.c, p.d + q.d - lifts_[i - planes_]};
    });
    body.planes.reserve(made.size());
    for (const auto& p : made) body.planes.push_back(p);
    body.addresses = old_.body.addresses;
    for (std::size_t e = 0; e < lifts_.size(); ++e) body.addresses.push_back({old_.level + 1, make_id<VertexId>(e)});
  }

  /// Counter-clockwise, the smallest plane first.
  void add_triples(PlaneBody& body) const {
    body.triples.resize(map_.new_vertices);
    for (std::uint32_t h = 0; h < map_.half_edge_count(); ++h) {
      body.triples[h] = {make_id<FacetId>(map_.half_edges.facet[h]), make_id<FacetId>(cut(before(h))), make_id<FacetId>(cut(h))};
      const std::uint32_t centre = map_.centre[map_.half_edges.origin[h]];
      if (centre == kNoTwin) continue;
      std::array<std::uint32_t, 3> e{cut(before(h)), planes_ + map_.third_edge(h), cut(h)};
      std::rotate(e.begin(), std::min_element(e.begin(), e.end()), e.end());
      body.triples[centre] = {make_id<FacetId>(e[0]), make_id<FacetId>(e[1]), make_id<FacetId>(e[2])};
    }
  }

  void keep_facets(FacetLoops& loops, NewHalfEdges& made) const {
    const FacetLoops& old = old_.body.loops;
    for (std::size_t f = 0; f < old.size(); ++f) {
      const auto start = static_cast<std::uint32_t>(old.start(f));
      for (std::uint32_t h = start; h < start + old[f].size(); ++h) {
        loops.add_corner(make_id<VertexId>(h));
        made.add(cut(h), old_.sign[h]);
      }
      loops.close_loop();
    }
  }

  /// Sign of the edge from the corner of h to the centre of its vertex: that of D·σ.
  [[nodiscard]] int spoke_sign(std::uint32_t h) const {
    return map_.corner_sign[map_.half_edges.origin[h]] * doubled_depth(map_, lifts_, h).sign();
  }

  void add_hexagon(std::uint32_t e, FacetLoops& loops, NewHalfEdges& made) const {
    const std::uint32_t h = map_.edges.half_edge[e], g = map_.half_edges.twin[h];
    if (g != kNoTwin) {
      const std::uint32_t f_plane = map_.half_edges.facet[h], g_plane = map_.half_edges.facet[g];
      const auto add = [&](std::uint32_t vertex, std::uint32_t right, int sign) {
        loops.add_corner(make_id<VertexId>(vertex));
        made.add(right, sign);
      };
      add(map_.centre[map_.half_edges.origin[h]], cut(behind(g)), spoke_sign(behind(g)));
      add(behind(g), g_plane, old_.sign[h]);
      add(g, cut(before(g)), spoke_sign(g));
      add(map_.centre[map_.half_edges.origin[g]], cut(behind(h)), spoke_sign(behind(h)));
      add(behind(h), f_plane, old_.sign[h]);
      add(h, cut(before(h)), spoke_sign(h));
    }
    loops.close_loop();
  }

  const ChamferSurface& old_;
  const SurfaceMap& map_;
  const std::vector<Integer>& lifts_;
  std::uint32_t planes_;
};

std::vector<std::uint32_t> edges_near(const SurfaceMap& map, const std::vector<std::uint32_t>& half_edges) {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t h : half_edges) out.push_back(map.edges.edge[h]);
  return out;
}

/// Sides of old facets. The edges between two cuts run as predicted by theory, whatever the lifts.
void add_side_faults(const SurfaceMap& map, const ChamferSurface& next, const LocatedPoints<Rational>& points, std::vector<SurfaceFault>& out) {
  const HalfEdges after = half_edges_of(next.body.loops);
  std::vector<char> wrong(after.size(), 0);
  for_each(after.size(), [&](std::size_t j) {
    const auto h = static_cast<std::uint32_t>(j);
    if (after.twin[h] != kNoTwin && after.twin[h] < h) return;
    wrong[j] = run_of_edge(points, after.origin[h], after.target(h), after.facet[h], next.right[h]) != next.sign[h];
  });
  for (std::uint32_t h = 0; h < wrong.size(); ++h) {
    if (wrong[h] == 0) continue;
    HEXACT_INVARIANT(h < map.half_edge_count());
    const HalfEdges& e = map.half_edges;
    out.push_back({{"SideReversed", "its side in " + facet_name(e.facet[h]) + " keeps no positive length under the lifts" + at_level(next.level - 1),
                    edge_name(e.origin[h], e.target(h)), {}},
                   edges_near(map, {e.previous[h], h, e.next[h]})});
  }
}

void add_facet_faults(const ChamferSurface& surface, const SurfaceMap& map, const ChamferSurface& next, const LocatedPoints<Rational>& points,
                      std::vector<SurfaceFault>& out) {
  const FacetLoops& loops = next.body.loops;
  std::vector<std::string> faults(loops.size());
  for_each(loops.size(), [&](std::size_t f) {
    if (!loops[f].empty()) faults[f] = SimplePolygon<Rational>(points, f).fault();
  });
  for (std::size_t f = 0; f < faults.size(); ++f) {
    if (faults[f].empty()) continue;
    std::vector<std::uint32_t> edges;
    std::string name = facet_name(f);
    if (f < surface.body.loops.size()) {
      for (std::size_t i = 0; i < loops[f].size(); ++i) edges.push_back(map.edges.edge[loops.start(f) + i]);
    } else {
      const auto e = static_cast<std::uint32_t>(f - surface.body.loops.size());
      const std::uint32_t h = map.edges.half_edge[e];
      for (const std::size_t v : {std::size_t{map.half_edges.origin[h]}, std::size_t{map.half_edges.target(h)}}) {
        edges.insert(edges.end(), map.at_vertex[v].begin(), map.at_vertex[v].end());
      }
      name += ", the cut of " + map.edge_text(e);
    }
    out.push_back({{"FacetNotSimple", faults[f] + at_level(next.level), name, {}}, std::move(edges)});
  }
}

}  // namespace

SurfaceMap::SurfaceMap(const ChamferSurface& surface)
    : half_edges(half_edges_of(surface.body.loops)), edges(number_surface_edges(surface)),
      at_vertex(surface.body.vertex_count(), {kNoTwin, kNoTwin, kNoTwin}), centre(surface.body.vertex_count(), kNoTwin),
      corner_sign(surface.body.vertex_count(), 0) {
  for (std::uint32_t h = 0; h < half_edges.size(); ++h) {
    for (const std::uint32_t v : {half_edges.origin[h], half_edges.target(h)}) {
      for (std::uint32_t& e : at_vertex[v]) {
        if (e == edges.edge[h]) break;
        if (e != kNoTwin) continue;
        e = edges.edge[h];
        break;
      }
    }
    std::int8_t& s = corner_sign[half_edges.origin[h]];
    if (s == 0) {
      s = static_cast<std::int8_t>(
          sign_det3(surface.body.planes, half_edges.facet[h], surface.right[half_edges.previous[h]], surface.right[h]));
    }
  }
  new_vertices = half_edges.size();
  for (std::size_t v = 0; v < centre.size(); ++v) {
    if (at_vertex[v][2] != kNoTwin) centre[v] = static_cast<std::uint32_t>(new_vertices++);
  }
}

bool SurfaceMap::is_pure(const ChamferSurface& surface, std::size_t v) const {
  const auto& e = at_vertex[v];
  if (e[2] == kNoTwin) return false;
  const auto sign = [&](std::uint32_t i) { return surface.sign[edges.half_edge[i]]; };
  return sign(e[0]) == sign(e[1]) && sign(e[1]) == sign(e[2]);
}

std::vector<SurfaceFault> lift_faults(const ChamferSurface& surface, const SurfaceMap& map, const std::vector<Integer>& lifts) {
  const std::size_t count = map.edges.half_edge.size();
  if (lifts.size() != count) {
    return {{{"BadLifts", std::to_string(lifts.size()) + " lifts are given, there are " + std::to_string(count) + " edges" + at_level(surface.level), "", {}}, {}}};
  }
  std::vector<SurfaceFault> out;
  for (std::uint32_t e = 0; e < count; ++e) {
    const int sign = surface.sign[map.edges.half_edge[e]];
    if (lifts[e].sign() == sign) continue;
    out.push_back({{"LiftSign", "its lift" + at_level(surface.level) + " is " + lifts[e].str() + ", expected a " +
                                    (sign > 0 ? "positive number, as it is convex" : "negative number, as it is concave"), map.edge_text(e), {}}, {e}});
  }
  add_vertex_faults(surface, map, lifts, out);
  return out;
}

ChamferSurface cut_edges(const ChamferSurface& surface, const SurfaceMap& map, const std::vector<Integer>& lifts) {
  return Cutter(surface, map, lifts).result();
}

std::vector<SurfaceFault> cut_faults(const ChamferSurface& surface, const SurfaceMap& map, const ChamferSurface& next) {
  const LocatedPoints<Rational> points(next.body);
  std::vector<SurfaceFault> out;
  add_side_faults(map, next, points, out);
  add_facet_faults(surface, map, next, points, out);
  return out;
}

}  // namespace detail

SurfaceEdges number_surface_edges(const ChamferSurface& surface) {
  const HalfEdges e = half_edges_of(surface.body.loops);
  SurfaceEdges out;
  out.edge.resize(e.size());
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    if (e.twin[h] != kNoTwin && e.origin[h] > e.target(h)) continue;
    out.edge[h] = static_cast<std::uint32_t>(out.half_edge.size());
    if (e.twin[h] != kNoTwin) out.edge[e.twin[h]] = out.edge[h];
    out.half_edge.push_back(h);
  }
  return out;
}

std::size_t concave_edge_count(const ChamferSurface& surface) {
  const SurfaceEdges edges = number_surface_edges(surface);
  return static_cast<std::size_t>(std::count_if(edges.half_edge.begin(), edges.half_edge.end(), [&](std::uint32_t h) { return surface.sign[h] < 0; }));
}

}  // namespace hexact
