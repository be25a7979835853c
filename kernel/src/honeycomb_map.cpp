// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/honeycomb_map.hpp"

#include "hexact/kernel/edge_numbering.hpp"
#include "hexact/kernel/errors.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace hexact {
namespace {

struct DirectedEdge {
  std::uint32_t from, to, half_edge;
};

std::string edge_name(std::uint32_t a, std::uint32_t b) {
  return "edge " + std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b));
}

std::vector<DirectedEdge> sorted_edges(const FacetLoops& loops, std::vector<Finding>& findings,
                                       std::size_t vertex_count) {
  std::vector<DirectedEdge> edges;
  edges.reserve(loops.corner_count());
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const auto loop = loops[f];
    const std::string name = "facet " + std::to_string(f);
    if (loop.size() < 3) findings.push_back({"NotManifold", "has fewer than 3 corners", name, {}});
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const auto a = static_cast<std::uint32_t>(loop[j]);
      const auto b = static_cast<std::uint32_t>(loop[(j + 1) % loop.size()]);
      if (a >= vertex_count) findings.push_back({"WrongIndex", "names vertex " + std::to_string(a), name, {}});
      edges.push_back({a, b, static_cast<std::uint32_t>(loops.start(f) + j)});
    }
    std::vector<VertexId> corners(loop.begin(), loop.end());
    std::sort(corners.begin(), corners.end());
    if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) {
      findings.push_back({"NotManifold", "repeats a corner", name, {}});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& x, const DirectedEdge& y) {
    return x.from != y.from ? x.from < y.from : x.to < y.to;
  });
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i].from == edges[i - 1].from && edges[i].to == edges[i - 1].to) {
      findings.push_back({"NotManifold", "is used twice in the same direction",
                          edge_name(edges[i].from, edges[i].to), {}});
    }
  }
  return edges;
}

}  // namespace

HoneycombMap::HoneycombMap(const FacetLoops& loops, std::size_t vertex_count) {
  HEXACT_EXPECTS(loops.corner_count() < std::numeric_limits<std::uint32_t>::max());
  std::vector<Finding> findings;
  const std::vector<DirectedEdge> edges = sorted_edges(loops, findings, vertex_count);
  if (loops.empty()) findings.push_back({"NotManifold", "there are no facets", "", {}});
  if (!findings.empty()) throw InvalidInput(std::move(findings));

  base_facets_ = loops.size();
  base_half_edges_ = static_cast<std::uint32_t>(loops.corner_count());
  level_facets_ = {base_facets_};
  const std::size_t h_count = base_half_edges_;
  twin_.resize(h_count);
  origin_.resize(h_count);
  base_facet_.resize(h_count);
  base_next_.resize(h_count);
  base_previous_.resize(h_count);
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const auto n = static_cast<std::uint32_t>(loops[f].size());
    const auto start = static_cast<std::uint32_t>(loops.start(f));
    base_size_.push_back(n);
    base_start_.push_back(start);
    for (std::uint32_t j = 0; j < n; ++j) {
      origin_[start + j] = static_cast<std::uint32_t>(loops[f][j]);
      base_facet_[start + j] = static_cast<std::uint32_t>(f);
      base_next_[start + j] = start + (j + 1) % n;
      base_previous_[start + j] = start + (j + n - 1) % n;
    }
  }
  for (const DirectedEdge& e : edges) {
    const auto found = std::lower_bound(edges.begin(), edges.end(), e, [](const DirectedEdge& x, const DirectedEdge& y) {
      return x.from != y.to ? x.from < y.to : x.to < y.from;
    });
    if (found == edges.end() || found->from != e.to || found->to != e.from) {
      findings.push_back({"HasBoundary", "has a facet on one side only", edge_name(e.from, e.to), {}});
      continue;
    }
    twin_[e.half_edge] = found->half_edge;
  }
  if (!findings.empty()) throw InvalidInput(std::move(findings));

  std::vector<std::uint32_t> valence(vertex_count, 0);
  base_first_.assign(vertex_count, std::numeric_limits<std::uint32_t>::max());
  for (std::uint32_t h = 0; h < h_count; ++h) {
    ++valence[origin_[h]];
    base_first_[origin_[h]] = std::min(base_first_[origin_[h]], h);
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (valence[v] != 3) {
      findings.push_back({"NotTrivalent", "has valence " + std::to_string(valence[v]) + ", expected 3",
                          "vertex " + std::to_string(v), {}});
    }
  }
  if (!findings.empty()) throw InvalidInput(std::move(findings));
  base_slot_.resize(h_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    const auto s = star(v);
    if (twin_[previous(s[2])] != s[0] || s[0] == s[1]) {
      findings.push_back({"NotManifold", "its facets do not form one cycle", "vertex " + std::to_string(v), {}});
      continue;
    }
    for (std::uint32_t i = 0; i < 3; ++i) base_slot_[s[i]] = i;
  }
  std::vector<std::uint32_t> stack{0};
  std::vector<char> seen(base_facets_, 0);
  seen[0] = 1;
  std::size_t reached = 1;
  while (!stack.empty()) {
    const std::uint32_t f = stack.back();
    stack.pop_back();
    for (std::uint32_t h = base_start_[f]; h < base_start_[f] + base_size_[f]; ++h) {
      const std::uint32_t g = base_facet_[twin_[h]];
      if (seen[g] == 0) {
        seen[g] = 1;
        ++reached;
        stack.push_back(g);
      }
    }
  }
  if (reached != base_facets_) {
    const auto missing = std::find(seen.begin(), seen.end(), 0) - seen.begin();
    findings.push_back({"NotConnected", "is not connected to facet 0", "facet " + std::to_string(missing), {}});
  }
  if (!findings.empty()) throw InvalidInput(std::move(findings));
}

HoneycombMap HoneycombMap::successor(Cut cut) const {
  const std::size_t h_count = half_edge_count(), cuts = cut == Cut::vertices ? vertex_count() : edge_count();
  const std::size_t new_count = h_count + 6 * cuts;
  if (new_count >= std::numeric_limits<std::uint32_t>::max()) {
    throw ResourceLimit("level " + std::to_string(level_ + 1) + " would have " + std::to_string(new_count) +
                        " half-edges; 32-bit numbers allow 4294967294");
  }
  HoneycombMap r;
  r.base_facet_ = base_facet_;
  r.base_next_ = base_next_;
  r.base_previous_ = base_previous_;
  r.base_size_ = base_size_;
  r.base_start_ = base_start_;
  r.base_half_edges_ = base_half_edges_;
  r.base_facets_ = base_facets_;
  r.level_facets_ = level_facets_;
  r.level_facets_.push_back(facet_count() + cuts);
  r.cuts_ = cuts_;
  r.cuts_.push_back(cut);
  r.level_ = level_ + 1;
  r.parent_half_edges_ = static_cast<std::uint32_t>(h_count);
  r.twin_.resize(new_count);
  r.origin_.resize(new_count);
  return r;
}

HoneycombMap HoneycombMap::refined() const {
  HoneycombMap r = successor(Cut::vertices);
  const std::uint32_t offset = r.parent_half_edges_;
  // Position of the hexagon half-edge that starts at vertex h in the hexagon of origin(h).
  const auto even = [&](std::uint32_t h) { return offset + 6 * origin_[h] + 2 * slot(h); };
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, offset, 1 << 14), [&](const auto& range) {
    for (std::uint32_t h = range.begin(); h != range.end(); ++h) {
      r.origin_[h] = h;
      r.twin_[h] = even(next(h));
    }
  });
  const auto vertices = static_cast<std::uint32_t>(vertex_count());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, vertices, 1 << 13), [&](const auto& range) {
    for (std::uint32_t v = range.begin(); v != range.end(); ++v) {
      const auto s = star(v);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t before = previous(s[k]);
        const std::uint32_t e = offset + 6 * v + 2 * k;
        r.origin_[e] = s[k];
        r.twin_[e] = before;
        r.origin_[e + 1] = before;
        r.twin_[e + 1] = even(next(twin_[before])) + 1;
      }
    }
  });
  return r;
}

HoneycombMap HoneycombMap::refined_at_edges(const EdgeNumbering& edges) const {
  HEXACT_EXPECTS(edges.edge.size() == half_edge_count());
  HoneycombMap r = successor(Cut::edges);
  const std::uint32_t offset = r.parent_half_edges_;
  // In the hexagon of its edge, the half-edge from vertex k to the vertex of its origin; and the one back, which
  // lies in the hexagon of the edge before.
  const auto inward = [&](std::uint32_t k) { return offset + 6 * edges.edge[k] + (edges.is_first(k) ? 5 : 2); };
  const auto outward = [&](std::uint32_t k) {
    const std::uint32_t p = previous(k);
    return offset + 6 * edges.edge[p] + (edges.is_first(p) ? 3 : 0);
  };
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, offset, 1 << 14), [&](const auto& range) {
    for (std::uint32_t h = range.begin(); h != range.end(); ++h) {
      r.origin_[h] = h;
      r.twin_[h] = offset + 6 * edges.edge[h] + (edges.is_first(h) ? 4 : 1);
    }
  });
  const auto count = static_cast<std::uint32_t>(edge_count());
  constexpr std::uint32_t kAhead = 8;
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 1 << 13), [&](const auto& range) {
    for (std::uint32_t e = range.begin(); e != range.end(); ++e) {
      if (e + 2 * kAhead < count) {  // neighbours lie scattered in memory
        __builtin_prefetch(&twin_[edges.half_edge[e + 2 * kAhead]]);
        const std::uint32_t far = twin_[edges.half_edge[e + kAhead]];
        __builtin_prefetch(&edges.edge[far]);
        __builtin_prefetch(&origin_[far]);
      }
      const std::uint32_t h = edges.half_edge[e], g = twin_[h], base = offset + 6 * e;
      const std::uint32_t after_h = next(h), after_g = next(g);
      const std::array<std::uint32_t, 6> corners = {offset + origin_[h], after_g, g, offset + origin_[g], after_h, h};
      const std::array<std::uint32_t, 6> twins = {inward(after_g), g, outward(g), inward(after_h), h, outward(h)};
      std::copy(corners.begin(), corners.end(), r.origin_.begin() + base);
      std::copy(twins.begin(), twins.end(), r.twin_.begin() + base);
    }
  });
  const auto vertices = static_cast<std::uint32_t>(vertex_count());
  r.edge_first_.resize(vertices);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, vertices, 1 << 13), [&](const auto& range) {
    for (std::uint32_t v = range.begin(); v != range.end(); ++v) {
      const auto s = star(v);
      const std::uint32_t h = *std::min_element(
          s.begin(), s.end(), [&](std::uint32_t x, std::uint32_t y) { return edges.edge[x] < edges.edge[y]; });
      r.edge_first_[v] = offset + 6 * edges.edge[h] + (edges.is_first(h) ? 0 : 3);
    }
  });
  return r;
}

std::uint32_t HoneycombMap::facet_level(std::uint32_t f) const noexcept {
  return static_cast<std::uint32_t>(std::upper_bound(level_facets_.begin(), level_facets_.end(), f) -
                                    level_facets_.begin());
}

std::uint32_t HoneycombMap::facet_parent(std::uint32_t f) const noexcept {
  return static_cast<std::uint32_t>(f - level_facets_[facet_level(f) - 1]);
}

FacetLoops HoneycombMap::loops() const {
  FacetLoops out;
  out.reserve(facet_count(), half_edge_count());
  for (std::uint32_t f = 0; f < facet_count(); ++f) {
    const std::uint32_t start = facet_start(f);
    for (std::uint32_t i = 0; i < facet_size(f); ++i) out.add_corner(make_id<VertexId>(origin_[start + i]));
    out.close_loop();
  }
  return out;
}

}  // namespace hexact
