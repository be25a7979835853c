// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/mesh_topology.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace hexact {
namespace {

/// One side of an edge: the half-edge a→b with a, b stored as smaller and larger end.
struct EdgeUse {
  std::uint32_t low, high, half_edge, next, facet;
  bool forward;  ///< the half-edge runs from low to high
};

/// Disjoint sets; `parity` tells whether an element is reversed against the representative of its set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n), parity_(n, 0) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t x) {
    std::uint32_t root = x;
    char parity = 0;
    while (parent_[root] != root) {
      parity ^= parity_[root];
      root = parent_[root];
    }
    while (parent_[x] != root) {
      const std::uint32_t up = parent_[x];
      const char own = parity_[x];
      parent_[x] = root;
      parity_[x] = parity;
      parity ^= own;
      x = up;
    }
    return root;
  }
  char parity(std::uint32_t x) {
    find(x);
    return parity_[x];
  }
  /// Joins the sets of x and y with the given relative parity; false when they were joined with the other one.
  bool join(std::uint32_t x, std::uint32_t y, char relative = 0) {
    const std::uint32_t a = find(x), b = find(y);
    const char between = parity(x) ^ parity(y) ^ relative;
    if (a == b) return between == 0;
    parent_[std::max(a, b)] = std::min(a, b);
    parity_[std::max(a, b)] = between;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<char> parity_;
};

class Analysis {
 public:
  Analysis(const FacetLoops& loops, std::size_t vertex_count) : loops_(loops), used_(vertex_count, 0) {
    t_.vertices = vertex_count;
  }

  MeshTopology run() {
    examine_loops();
    t_.valid = t_.findings.empty();
    collect_uses();
    examine_edges();
    examine_vertices();
    examine_components();
    t_.euler = static_cast<std::int64_t>(t_.vertices - t_.unused_vertices) - static_cast<std::int64_t>(t_.edges) +
               static_cast<std::int64_t>(t_.facets);
    return std::move(t_);
  }

 private:
  void report(const char* code, std::string message, std::string element) {
    t_.findings.push_back({code, std::move(message), std::move(element), std::nullopt});
  }

  void examine_loops() {
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      const auto loop = loops_[f];
      if (loop.empty()) continue;
      ++t_.facets;
      ++t_.facet_sizes[loop.size()];
      if (loop.size() < 3) {
        report("TooFewCorners", "has " + std::to_string(loop.size()) + " corners, expected at least 3", facet_name(f));
      }
      std::vector<VertexId> corners(loop.begin(), loop.end());
      std::sort(corners.begin(), corners.end());
      if (const auto twice = std::adjacent_find(corners.begin(), corners.end()); twice != corners.end()) {
        report("RepeatedCorner", "names " + vertex_name(index(*twice)) + " more than once", facet_name(f));
      }
      if (index(corners.back()) >= t_.vertices) {
        report("WrongIndex", "names vertex " + std::to_string(index(corners.back())) + ", but there are only " +
               std::to_string(t_.vertices) + " vertices", facet_name(f));
      }
    }
    if (t_.facets == 0) report("Empty", "there are no facets", "");
  }

  void collect_uses() {
    uses_.reserve(loops_.corner_count());
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      const auto loop = loops_[f];
      const auto start = static_cast<std::uint32_t>(loops_.start(f));
      const auto n = static_cast<std::uint32_t>(loop.size());
      for (std::uint32_t j = 0; j < n; ++j) {
        const auto a = static_cast<std::uint32_t>(loop[j]);
        const auto b = static_cast<std::uint32_t>(loop[(j + 1) % n]);
        if (a >= t_.vertices || b >= t_.vertices || a == b) continue;
        used_[a] = used_[b] = 1;
        uses_.push_back({std::min(a, b), std::max(a, b), start + j, start + (j + 1) % n,
                         static_cast<std::uint32_t>(f), a < b});
      }
    }
    std::sort(uses_.begin(), uses_.end(), [](const EdgeUse& x, const EdgeUse& y) {
      if (x.low != y.low) return x.low < y.low;
      return x.high != y.high ? x.high < y.high : x.half_edge < y.half_edge;
    });
  }

  /// Corners of one fan are joined, and facets across an edge; edges with one, two and more facets are told apart.
  void examine_edges() {
    DisjointSets facets(loops_.size());
    fans_ = DisjointSets(loops_.corner_count());
    bool edges_manifold = t_.valid, closed = !uses_.empty(), agree = t_.valid, orientable = t_.valid;
    std::vector<Finding> boundary, disagreement;
    for (std::size_t i = 0, j = 0; i < uses_.size(); i = j) {
      while (j < uses_.size() && uses_[j].low == uses_[i].low && uses_[j].high == uses_[i].high) ++j;
      ++t_.edges;
      const std::string name = edge_name(uses_[i].low, uses_[i].high);
      for (std::size_t k = i + 1; k < j; ++k) join_corners(uses_[i], uses_[k]);
      if (j - i == 1) {
        closed = false;
        boundary_.push_back(uses_[i]);
        boundary.push_back({"HasBoundary", "has a facet on one side only", name, std::nullopt});
      } else if (j - i > 2) {
        edges_manifold = closed = agree = false;
        report("NotManifold", "belongs to " + std::to_string(j - i) + " facets, expected 2", name);
      } else {
        const bool same = uses_[i].forward == uses_[i + 1].forward;
        if (!facets.join(uses_[i].facet, uses_[i + 1].facet, same ? 1 : 0)) {
          if (orientable) report("NotOrientable", "no choice of directions makes the facets agree", name);
          orientable = false;
        }
        if (same) {
          disagreement.push_back({"InconsistentOrientation", "is used twice in the same direction", name, std::nullopt});
        }
      }
    }
    t_.closed = closed;
    t_.orientable = orientable && edges_manifold;
    t_.oriented = agree && disagreement.empty();
    edges_manifold_ = edges_manifold;
    if (orientable) t_.findings.insert(t_.findings.end(), disagreement.begin(), disagreement.end());
    t_.findings.insert(t_.findings.end(), boundary.begin(), boundary.end());
  }

  void join_corners(const EdgeUse& x, const EdgeUse& y) {
    fans_.join(low_corner(x), low_corner(y));
    fans_.join(high_corner(x), high_corner(y));
  }
  static std::uint32_t low_corner(const EdgeUse& u) { return u.forward ? u.half_edge : u.next; }
  static std::uint32_t high_corner(const EdgeUse& u) { return u.forward ? u.next : u.half_edge; }

  void examine_vertices() {
    std::vector<std::uint32_t> valence(t_.vertices, 0);
    for (std::size_t i = 0; i < uses_.size(); ++i) {
      if (i > 0 && uses_[i].low == uses_[i - 1].low && uses_[i].high == uses_[i - 1].high) continue;
      ++valence[uses_[i].low];
      ++valence[uses_[i].high];
    }
    std::vector<std::uint32_t> fan_count(t_.vertices, 0);
    const auto corners = loops_.corners();
    for (std::uint32_t c = 0; c < corners.size(); ++c) {
      if (index(corners[c]) < t_.vertices && fans_.find(c) == c) ++fan_count[index(corners[c])];
    }
    bool one_fan_each = true;
    for (std::size_t v = 0; v < t_.vertices; ++v) {
      ++t_.valences[valence[v]];
      if (used_[v] == 0) {
        ++t_.unused_vertices;
        report("UnusedVertex", "belongs to no facet", vertex_name(v));
      } else if (fan_count[v] > 1 && t_.valid) {
        one_fan_each = false;
        report("NotManifold", "the surface touches itself: its facets form " + std::to_string(fan_count[v]) +
               " separate fans", vertex_name(v));
      }
    }
    t_.manifold = edges_manifold_ && one_fan_each && t_.valid && t_.facets > 0;
  }

  /// Boundary edges are linked where their ends lie in the same fan.
  void examine_components() {
    DisjointSets chains(loops_.corner_count());
    for (const EdgeUse& u : boundary_) chains.join(fans_.find(low_corner(u)), fans_.find(high_corner(u)));
    std::vector<std::uint32_t> roots;
    for (const EdgeUse& u : boundary_) roots.push_back(chains.find(fans_.find(low_corner(u))));
    std::sort(roots.begin(), roots.end());
    t_.boundary_loops = static_cast<std::size_t>(std::unique(roots.begin(), roots.end()) - roots.begin());

    DisjointSets vertices(t_.vertices);
    for (const EdgeUse& u : uses_) vertices.join(u.low, u.high);
    std::vector<char> seen(t_.vertices, 0);
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      if (loops_[f].empty() || index(loops_[f][0]) >= t_.vertices) continue;
      const std::uint32_t root = vertices.find(static_cast<std::uint32_t>(loops_[f][0]));
      if (seen[root] != 0) continue;
      seen[root] = 1;
      if (++t_.components > 1) report("NotConnected", "is not connected to the first facet", facet_name(f));
    }
  }

  const FacetLoops& loops_;
  MeshTopology t_;
  std::vector<char> used_;
  std::vector<EdgeUse> uses_, boundary_;
  DisjointSets fans_{0};
  bool edges_manifold_ = false;
};

}  // namespace

MeshTopology analyse_topology(const FacetLoops& loops, std::size_t vertex_count) {
  return Analysis(loops, vertex_count).run();
}

std::string facet_name(std::size_t facet) { return "facet " + std::to_string(facet); }
std::string vertex_name(std::size_t vertex) { return "vertex " + std::to_string(vertex); }
std::string edge_name(std::size_t a, std::size_t b) {
  return "edge " + std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b));
}

HalfEdges half_edges_of(const FacetLoops& loops) {
  HalfEdges e;
  const std::size_t h_count = loops.corner_count();
  e.facet.resize(h_count);
  e.next.resize(h_count);
  e.previous.resize(h_count);
  e.origin.resize(h_count);
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const auto start = static_cast<std::uint32_t>(loops.start(f));
    const auto n = static_cast<std::uint32_t>(loops[f].size());
    for (std::uint32_t j = 0; j < n; ++j) {
      e.facet[start + j] = static_cast<std::uint32_t>(f);
      e.next[start + j] = start + (j + 1) % n;
      e.previous[start + j] = start + (j + n - 1) % n;
      e.origin[start + j] = static_cast<std::uint32_t>(loops[f][j]);
    }
  }
  e.twin.assign(h_count, kNoTwin);
  std::vector<std::uint32_t> order(h_count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t x, std::uint32_t y) {
    return e.origin[x] != e.origin[y] ? e.origin[x] < e.origin[y] : e.target(x) < e.target(y);
  });
  for (std::uint32_t h = 0; h < h_count; ++h) {
    const auto found = std::lower_bound(order.begin(), order.end(), h, [&](std::uint32_t x, std::uint32_t y) {
      return e.origin[x] != e.target(y) ? e.origin[x] < e.target(y) : e.target(x) < e.origin[y];
    });
    if (found != order.end() && e.origin[*found] == e.target(h) && e.target(*found) == e.origin[h]) e.twin[h] = *found;
  }
  return e;
}

std::vector<std::uint32_t> half_edge_twins(const FacetLoops& loops) { return half_edges_of(loops).twin; }

std::vector<std::uint32_t> HalfEdges::around(std::uint32_t h) const {
  std::vector<std::uint32_t> star{h};
  for (std::uint32_t g = twin[previous[h]]; g != kNoTwin && g != h; g = twin[previous[g]]) star.push_back(g);
  return star;
}

}  // namespace hexact
