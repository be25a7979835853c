// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/merge_coplanar.hpp"

#include "facet_geometry.hpp"
#include "hexact/kernel/mesh_topology.hpp"
#include "ring_soup.hpp"

#include <algorithm>
#include <numeric>

namespace hexact {
namespace {

using namespace detail;

constexpr std::uint32_t kNone = UINT32_MAX;

/// Which facets become one: `group[f]` is the smallest facet of the group of f.
template <class R>
class Grouping {
 public:
  Grouping(const std::vector<Point3<R>>& points, const FacetLoops& loops, const HalfEdges& edges)
      : points_(points), loops_(loops), edges_(edges), parent_(loops.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    shapes_.reserve(loops.size());
    for (std::size_t f = 0; f < loops.size(); ++f) {
      shapes_.push_back(loops[f].empty() ? FacetShape<R>{} : facet_shape(PolygonView<R>{points, loops[f]}));
    }
  }

  std::vector<std::uint32_t> run() {
    for (std::uint32_t h = 0; h < edges_.size(); ++h) {
      const std::uint32_t t = edges_.twin[h];
      if (t == kNoTwin || t < h) continue;
      const std::uint32_t f = edges_.facet[h], g = edges_.facet[t];
      if (find(f) != find(g) && one_plane(f, g)) join(f, g);
    }
    join_slivers();
    std::vector<std::uint32_t> group(loops_.size());
    for (std::uint32_t f = 0; f < group.size(); ++f) group[f] = find(f);
    return group;
  }

 private:
  std::uint32_t find(std::uint32_t f) {
    while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
    return f;
  }
  void join(std::uint32_t f, std::uint32_t g) {
    f = find(f);
    g = find(g);
    parent_[std::max(f, g)] = std::min(f, g);
  }

  bool one_plane(std::uint32_t f, std::uint32_t g) const {
    if (!shapes_[f].planar() || !shapes_[g].planar()) return false;
    const Plane<R>& plane = *shapes_[f].plane;
    for (const VertexId v : loops_[g]) {
      if (!height(plane, points_[index(v)]).is_zero()) return false;
    }
    return dot(normal(plane), normal(*shapes_[g].plane)).sign() > 0;
  }

  bool is_sliver(std::uint32_t f) const { return loops_[f].size() == 3 && !shapes_[f].plane; }

  /// The half-edge of a triangle without area that spans the other two.
  std::uint32_t longest(std::uint32_t f) const {
    const auto start = static_cast<std::uint32_t>(loops_.start(f));
    const auto squared = [&](std::uint32_t h) {
      const Point3<R> d = points_[edges_.target(h)] - points_[edges_.origin[h]];
      return dot(d, d);
    };
    std::uint32_t best = start;
    for (std::uint32_t h = start + 1; h < start + 3; ++h) {
      if (squared(h) > squared(best)) best = h;
    }
    return best;
  }

  void join_slivers() {
    for (std::uint32_t f = 0; f < loops_.size(); ++f) {
      if (!is_sliver(f)) continue;
      const std::uint32_t t = edges_.twin[longest(f)];
      if (t != kNoTwin) join(f, edges_.facet[t]);
    }
  }

  const std::vector<Point3<R>>& points_;
  const FacetLoops& loops_;
  const HalfEdges& edges_;
  std::vector<std::uint32_t> parent_;
  std::vector<FacetShape<R>> shapes_;
};

/// The outlines of groups of facets, in the order of their first facets.
FacetLoops outlines(const HalfEdges& edges, const std::vector<std::uint32_t>& group) {
  const auto inner = [&](std::uint32_t h) {
    const std::uint32_t t = edges.twin[h];
    return t != kNoTwin && group[edges.facet[t]] == group[edges.facet[h]];
  };
  std::vector<std::vector<VertexId>> loop_of(group.size());
  std::vector<char> seen(edges.size(), 0);
  std::vector<Finding> findings;
  for (std::uint32_t start = 0; start < edges.size(); ++start) {
    if (seen[start] != 0 || inner(start)) continue;
    const std::uint32_t g = group[edges.facet[start]];
    if (!loop_of[g].empty()) {
      findings.push_back({"FacetWithHole", "its coplanar neighbours surround a hole; cut it by an edge or fill it",
                          facet_name(g), std::nullopt});
    }
    std::vector<VertexId> loop;
    std::uint32_t h = start;
    do {
      seen[h] = 1;
      loop.push_back(make_id<VertexId>(edges.origin[h]));
      h = edges.next[h];
      while (inner(h)) h = edges.next[edges.twin[h]];
    } while (h != start);
    std::vector<VertexId> sorted = loop;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      findings.push_back({"PinchedFacet", "its coplanar neighbours touch it at a single vertex again", facet_name(g),
                          std::nullopt});
    }
    loop_of[g] = std::move(loop);
  }
  if (!findings.empty()) throw InvalidInput(std::move(findings));
  FacetLoops loops;
  for (std::uint32_t f = 0; f < group.size(); ++f) {
    if (group[f] == f && !loop_of[f].empty()) loops.add(loop_of[f]);
  }
  return loops;
}

/// Vertices that stay: corners that are not straight in all of their facets.
template <class R>
std::vector<char> needed_vertices(const std::vector<Point3<R>>& points, const FacetLoops& loops) {
  std::vector<char> bend(points.size(), 0);
  std::vector<std::uint32_t> corners(points.size(), 0);
  std::vector<std::array<std::uint32_t, 2>> ends(points.size(), {kNone, kNone});
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const auto loop = loops[f];
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const std::size_t v = index(loop[j]);
      const auto a = static_cast<std::uint32_t>(loop[(j + loop.size() - 1) % loop.size()]);
      const auto b = static_cast<std::uint32_t>(loop[(j + 1) % loop.size()]);
      std::array<std::uint32_t, 2> pair{std::min(a, b), std::max(a, b)};
      if (ends[v][0] != kNone && ends[v] != pair) bend[v] = 1;  // more than two edges
      ends[v] = pair;
      if (bend[v] != 0) continue;
      const Point3<R> in = points[v] - points[a], out = points[b] - points[v];
      if (!is_zero(cross(in, out)) || dot(in, out).sign() <= 0) bend[v] = 1;
    }
  }
  return bend;
}

std::vector<Finding> serious(std::vector<Finding> findings) {
  std::erase_if(findings, [](const Finding& f) { return f.code == "HasBoundary" || f.code == "UnusedVertex"; });
  return findings;
}

}  // namespace

template <class S>
MergedSoup<S> merge_coplanar(const PolygonSoup<S>& soup) {
  std::vector<Finding> findings = serious(analyse_topology(soup.facets, soup.points.size()).findings);
  if (!findings.empty()) throw InvalidInput(std::move(findings));
  const HalfEdges edges = half_edges_of(soup.facets);
  std::vector<std::uint32_t> group;
  FacetLoops loops;
  std::vector<char> needed;
  on_short_ring(soup.points, [&](const auto& points) {
    using R = std::decay_t<decltype(points[0].x)>;
    group = Grouping<R>(points, soup.facets, edges).run();
    loops = outlines(edges, group);
    needed = needed_vertices(points, loops);
  });

  MergedSoup<S> result;
  std::vector<std::uint32_t> number(soup.points.size(), kNone);
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (needed[v] == 0) continue;
    number[v] = static_cast<std::uint32_t>(result.soup.points.size());
    result.soup.points.push_back(soup.points[v]);
  }
  for (std::size_t f = 0; f < loops.size(); ++f) {
    for (const VertexId v : loops[f]) {
      if (number[index(v)] != kNone) result.soup.facets.add_corner(make_id<VertexId>(number[index(v)]));
    }
    result.soup.facets.close_loop();
  }
  for (std::size_t f = 0; f < soup.addresses.size(); ++f) {
    if (group[f] == f && !soup.facets[f].empty()) result.soup.addresses.push_back(soup.addresses[f]);
  }
  result.merged_facets = soup.facets.size() - result.soup.facets.size();
  result.dropped_vertices = soup.points.size() - result.soup.points.size();
  return result;
}

template MergedSoup<Rational> merge_coplanar(const PolygonSoup<Rational>&);
template MergedSoup<QuadraticField> merge_coplanar(const PolygonSoup<QuadraticField>&);

}  // namespace hexact
