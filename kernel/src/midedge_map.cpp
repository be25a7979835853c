// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/midedge_map.hpp"

#include "hexact/kernel/parallel.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace hexact {
namespace {

/// Vertices between the one that is worked on and the one whose far half-edge is asked for.
constexpr std::uint32_t kAhead = 16;
constexpr std::size_t kGrain = std::size_t{1} << 13;

/// Everything that keeps loops from being an oriented manifold whose inner vertices have 3 edges or more.
std::vector<Finding> midedge_findings(const FacetLoops& loops, std::size_t vertex_count) {
  MeshTopology topology = analyse_topology(loops, vertex_count);
  std::vector<Finding> findings = std::move(topology.findings);
  std::erase_if(findings, [](const Finding& f) { return f.code == "HasBoundary" || f.code == "NotConnected"; });
  for (std::size_t f = 0; f < loops.size(); ++f) {
    if (loops[f].empty()) findings.push_back({"TooFewCorners", "has no corners, expected at least 3", facet_name(f), {}});
  }
  return findings;
}

}  // namespace

MidedgeMap::MidedgeMap(const FacetLoops& loops, std::size_t vertex_count) : vertices_(vertex_count) {
  require_room(loops.corner_count());
  std::vector<Finding> findings = midedge_findings(loops, vertex_count);
  if (!findings.empty()) throw InvalidInput(std::move(findings));
  const HalfEdges edges = half_edges_of(loops);
  origin_.assign(edges.origin.begin(), edges.origin.end());
  twin_.assign(edges.twin.begin(), edges.twin.end());
  facet_of_ = edges.facet;
  for (std::size_t f = 0; f < loops.size(); ++f) start_.push_back(static_cast<std::uint32_t>(loops.start(f) + loops[f].size()));
  boundary_ = static_cast<std::size_t>(std::count(twin_.begin(), twin_.end(), kNoTwin));

  std::vector<std::uint32_t> corners(vertex_count, 0);
  std::vector<char> open(vertex_count, 0);
  for (std::uint32_t h = 0; h < origin_.size(); ++h) {
    ++corners[origin_[h]];
    if (twin_[h] == kNoTwin) open[origin_[h]] = 1;
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (corners[v] >= 3 || open[v] != 0) continue;
    findings.push_back({"LowValence", "is an inner vertex with " + std::to_string(corners[v]) + " edges, expected at least 3",
                        vertex_name(v), {}});
  }
  if (!findings.empty()) throw InvalidInput(std::move(findings));
}

void MidedgeMap::require_room(std::size_t half_edges) const {
  if (half_edges < std::numeric_limits<std::uint32_t>::max()) return;
  throw ResourceLimit("the mesh would have " + std::to_string(half_edges) +
                      " half-edges; 32-bit numbers allow 4294967294");
}

std::size_t MidedgeMap::pinched_vertex_count() const {
  if (closed()) return 0;
  std::vector<std::uint32_t> fans(vertices_, 0);
  std::size_t pinched = 0;
  for (std::uint32_t h = 0; h < origin_.size(); ++h) {
    if (twin_[h] == kNoTwin && ++fans[origin_[h]] == 2) ++pinched;
  }
  return pinched;
}

RawVector<std::uint32_t> MidedgeMap::edge_numbers() const {
  RawVector<std::uint32_t> edge(origin_.size());
  std::uint32_t count = 0;
  for (std::uint32_t h = 0; h < origin_.size(); ++h) {
    edge[h] = twin_[h] > h ? count++ : edge[twin_[h]];  // kNoTwin is larger than any h
  }
  return edge;
}

std::vector<std::uint32_t> MidedgeMap::fan_starts() const {
  std::vector<std::uint32_t> start(vertices_, kNoTwin);
  for (std::uint32_t h = 0; h < origin_.size(); ++h) {
    std::uint32_t& first = start[origin_[h]];
    if (first == kNoTwin || (twin_[h] == kNoTwin && twin_[first] != kNoTwin)) first = h;
  }
  return start;
}

/// Lists the sizes of the parent's facets and `further_sizes`, up to the last that is not a quadrilateral.
void MidedgeMap::set_sizes(const std::vector<std::uint32_t>& further_sizes, const MidedgeMap& parent) {
  const std::size_t before = parent.facet_count();
  std::size_t listed = further_sizes.size();
  while (listed > 0 && further_sizes[listed - 1] == 4) --listed;
  listed = listed > 0 ? before + listed : parent.listed_facets();
  while (listed > 0 && listed <= before && parent.facet_size(static_cast<std::uint32_t>(listed - 1)) == 4) --listed;
  start_.reserve(listed + 1);
  for (std::size_t f = 0; f < listed; ++f) {
    const std::uint32_t size = f < before ? parent.facet_size(static_cast<std::uint32_t>(f)) : further_sizes[f - before];
    start_.push_back(start_.back() + size);
  }
  facet_of_.resize(start_.back());
  for (std::uint32_t f = 0; f < listed; ++f) std::fill(facet_of_.begin() + start_[f], facet_of_.begin() + start_[f + 1], f);
}

MidedgeMap MidedgeMap::stepped(MidedgeBoundary boundary) const {
  HEXACT_EXPECTS(closed() || boundary != MidedgeBoundary::dual);
  return regular_ ? regular_step() : general_step(boundary);
}

MidedgeMap MidedgeMap::general_step(MidedgeBoundary boundary) const {
  const std::vector<std::uint32_t> fan_start = fan_starts();
  const auto h_count = static_cast<std::uint32_t>(origin_.size());
  std::vector<std::uint32_t> edges_at(vertices_, 0);
  for (std::uint32_t h = 0; h < h_count; ++h) edges_at[origin_[h]] += twin_[h] == kNoTwin ? 2 : 1;
  Birth birth{level_ + 1, static_cast<std::uint32_t>(facet_count()), {}};
  std::vector<std::uint32_t> sizes;
  std::size_t total = h_count;
  for (std::uint32_t v = 0; v < vertices_; ++v) {
    const bool inner = twin_[fan_start[v]] != kNoTwin;
    if (!inner && (boundary == MidedgeBoundary::drop || edges_at[v] < 3)) continue;
    birth.parents.push_back(v);
    sizes.push_back(edges_at[v]);
    total += edges_at[v];
  }
  require_room(total);

  MidedgeMap r;
  r.set_sizes(sizes, *this);
  r.vertices_ = edge_count();
  r.level_ = level_ + 1;
  r.origin_ = edge_numbers();
  r.origin_.resize(total);
  r.twin_.assign(total, kNoTwin);
  std::uint32_t at = h_count;
  for (const std::uint32_t v : birth.parents) at = r.cut_vertex(*this, fan_start[v], at);
  r.boundary_ = static_cast<std::size_t>(std::count(r.twin_.begin(), r.twin_.end(), kNoTwin));
  r.alternating_ = closed();
  r.regular_ = closed() && alternating_;
  r.births_ = births_;
  if (birth.parents.size() == vertices_) birth.parents.clear();
  r.births_.push_back(std::move(birth));
  return r;
}

/// Writes the facet that cuts off a vertex of `parent` to half-edges `at` and following; returns the number behind them.
std::uint32_t MidedgeMap::cut_vertex(const MidedgeMap& parent, std::uint32_t fan_start, std::uint32_t at) {
  std::uint32_t h = fan_start, last = h;
  do {
    origin_[at] = origin_[h];  // half-edges of old facets leave the vertex on their edge
    last = parent.previous(h);
    twin_[at] = last;
    twin_[last] = at++;
    h = parent.twin(last);
  } while (h != kNoTwin && h != fan_start);
  if (h == kNoTwin) origin_[at++] = origin_[last];  // the edge that closes the fan of a boundary vertex
  return at;
}

/// With valence 4 everywhere: half-edge h of an old facet leaves edge(h) and cuts its target v, whose new facet is the
/// quadrilateral number v; v < V and t, the other half-edge of an old facet that leaves v, tell the place in it.
MidedgeMap MidedgeMap::regular_step() const {
  const auto h_count = static_cast<std::uint32_t>(origin_.size());
  const auto v_count = static_cast<std::uint32_t>(vertices_);
  const std::uint32_t half = h_count / 2;
  require_room(2 * origin_.size());
  MidedgeMap r;
  r.start_ = start_;
  r.facet_of_ = facet_of_;
  r.births_ = births_;
  r.births_.push_back({level_ + 1, static_cast<std::uint32_t>(facet_count()), {}});
  r.vertices_ = half;
  r.level_ = level_ + 1;
  r.alternating_ = r.regular_ = true;
  r.origin_.resize(2 * origin_.size());
  r.twin_.resize(2 * origin_.size());
  for_ranges(half, 2 * kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t h = begin; h != end; ++h) {
      const std::uint32_t after = next(h);
      r.origin_[h] = h;
      r.twin_[h] = h_count + 4 * origin_[after] + (after < v_count ? 0 : 2);
    }
  });
  for_ranges(half, 2 * kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t h = half + begin; h != half + end; ++h) {
      const std::uint32_t edge = twin_[h];
      r.origin_[h] = edge;
      r.twin_[h] = h_count + 4 * origin_[next(h)] + (edge < v_count ? 3 : 1);
    }
  });
  for_ranges(v_count, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t v = begin; v != end; ++v) {
      if (v + kAhead < v_count) __builtin_prefetch(&twin_[previous(twin_[v + kAhead])]);
      const std::uint32_t a = previous(v), b = previous(twin_[a]), t = twin_[b], c = previous(t);
      const std::uint32_t at = h_count + 4 * v;
      r.origin_[at] = v;
      r.origin_[at + 1] = a;
      r.origin_[at + 2] = t;
      r.origin_[at + 3] = c;
      r.twin_[at] = a;
      r.twin_[at + 1] = b;
      r.twin_[at + 2] = c;
      r.twin_[at + 3] = twin_[v];
    }
  });
  return r;
}

MidedgeMap MidedgeMap::double_stepped() const {
  const auto h_count = static_cast<std::uint32_t>(origin_.size());
  const std::vector<std::uint32_t> fan_start = fan_starts();
  const RawVector<std::uint32_t> edge = edge_numbers();
  Birth edges{level_ + 2, static_cast<std::uint32_t>(facet_count()), {}};
  for (std::uint32_t h = 0; h < h_count; ++h) {
    if (twin_[h] != kNoTwin && twin_[h] > h) edges.parents.push_back(edge[h]);
  }
  Birth vertices{level_ + 1, edges.first + static_cast<std::uint32_t>(edges.parents.size()), {}};
  std::vector<std::uint32_t> valence(vertices_, 0), sizes(edges.parents.size(), 4);
  for (const std::uint32_t v : origin_) ++valence[v];
  const std::size_t first_fan = h_count + 4 * edges.parents.size();
  std::size_t total = first_fan;
  for (std::uint32_t v = 0; v < vertices_; ++v) {
    if (twin_[fan_start[v]] == kNoTwin) continue;
    vertices.parents.push_back(v);
    sizes.push_back(valence[v]);
    total += valence[v];
  }
  require_room(total);

  MidedgeMap r;
  r.set_sizes(sizes, *this);
  r.vertices_ = h_count;
  r.level_ = level_ + 2;
  r.origin_.resize(total);
  r.twin_.assign(total, kNoTwin);
  std::iota(r.origin_.begin(), r.origin_.begin() + h_count, 0u);
  // For each edge the first half-edge of its quadrilateral, or none on the boundary.
  std::vector<std::uint32_t> quad(edge_count(), kNoTwin);
  for (std::uint32_t i = 0; i < edges.parents.size(); ++i) quad[edges.parents[i]] = h_count + 4 * i;
  for (std::uint32_t h = 0; h < h_count; ++h) {
    if (twin_[h] != kNoTwin && origin_[h] < origin_[twin_[h]]) r.lay_along_edge(*this, h, quad[edge[h]]);
  }
  auto at = static_cast<std::uint32_t>(first_fan);
  for (const std::uint32_t v : vertices.parents) {
    std::uint32_t h = fan_start[v];
    do {
      const std::uint32_t following = twin_[previous(h)];
      const std::uint32_t side = quad[edge[following]] + (v < target(following) ? 1 : 3);
      r.origin_[at] = h;
      r.twin_[at] = side;
      r.twin_[side] = at++;
      h = following;
    } while (h != fan_start[v]);
  }
  r.boundary_ = static_cast<std::size_t>(std::count(r.twin_.begin(), r.twin_.end(), kNoTwin));
  r.births_ = births_;
  r.births_.push_back(std::move(edges));
  r.births_.push_back(std::move(vertices));
  return r;
}

/// Writes the quadrilateral of a double step along an inner edge; h leaves its smaller end.
void MidedgeMap::lay_along_edge(const MidedgeMap& parent, std::uint32_t h, std::uint32_t quad) {
  const std::uint32_t t = parent.twin(h);
  origin_[quad] = parent.next(h);
  origin_[quad + 1] = h;
  origin_[quad + 2] = parent.next(t);
  origin_[quad + 3] = t;
  twin_[quad] = h;
  twin_[h] = quad;
  twin_[quad + 2] = t;
  twin_[t] = quad + 2;
}

FacetAddress MidedgeMap::address(std::uint32_t f) const {
  const auto after = std::upper_bound(births_.begin(), births_.end(), f,
                                      [](std::uint32_t facet, const Birth& birth) { return facet < birth.first; });
  if (after == births_.begin()) return {};
  const Birth& birth = *(after - 1);
  const std::uint32_t i = f - birth.first;
  return {birth.level, make_id<VertexId>(birth.parents.empty() ? i : birth.parents[i])};
}

FacetLoops MidedgeMap::loops() const {
  FacetLoops out;
  out.reserve(facet_count(), half_edge_count());
  for (std::uint32_t f = 0; f < facet_count(); ++f) {
    for (const std::uint32_t v : loop(f)) out.add_corner(make_id<VertexId>(v));
    out.close_loop();
  }
  return out;
}

}  // namespace hexact
