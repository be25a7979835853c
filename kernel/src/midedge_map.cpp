// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/midedge_map.hpp"

#include "hexact/kernel/parallel.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace hexact {
namespace {

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
  const RawVector<std::uint32_t> edge = edge_numbers();
  const std::vector<std::uint32_t> fan_start = fan_starts();
  const auto h_count = static_cast<std::uint32_t>(origin_.size());
  std::vector<std::uint32_t> edges_at(vertices_, 0);
  for (std::uint32_t h = 0; h < h_count; ++h) edges_at[origin_[h]] += twin_[h] == kNoTwin ? 2 : 1;
  const auto becomes_facet = [&](std::size_t v) {
    const bool inner = twin_[fan_start[v]] != kNoTwin;
    return inner || (boundary == MidedgeBoundary::close && edges_at[v] >= 3);
  };
  Birth birth{level_ + 1, static_cast<std::uint32_t>(facet_count()), {}};
  std::vector<std::uint32_t> sizes;
  std::size_t total = h_count;
  for (std::uint32_t v = 0; v < vertices_; ++v) {
    if (!becomes_facet(v)) continue;
    birth.parents.push_back(v);
    sizes.push_back(edges_at[v]);
    total += edges_at[v];
  }
  require_room(total);

  MidedgeMap r;
  r.set_sizes(sizes, *this);
  r.vertices_ = edge_count();
  r.level_ = level_ + 1;
  r.origin_.resize(total);
  r.twin_.resize(total);
  std::copy(edge.begin(), edge.end(), r.origin_.begin());
  std::fill(r.twin_.begin(), r.twin_.begin() + h_count, kNoTwin);
  std::uint32_t at = h_count;
  for (const std::uint32_t v : birth.parents) {
    std::uint32_t h = fan_start[v], last = h;
    do {
      r.origin_[at] = edge[h];
      last = previous(h);
      r.twin_[at] = last;
      r.twin_[last] = at++;
      h = twin_[last];
    } while (h != kNoTwin && h != fan_start[v]);
    if (h == kNoTwin) {  // the edge that closes the fan of a boundary vertex
      r.origin_[at] = edge[last];
      r.twin_[at++] = kNoTwin;
    }
  }
  r.boundary_ = static_cast<std::size_t>(std::count(r.twin_.begin(), r.twin_.end(), kNoTwin));
  r.alternating_ = closed();
  r.regular_ = closed() && alternating_;
  r.births_ = births_;
  if (birth.parents.size() == vertices_) birth.parents.clear();
  r.births_.push_back(std::move(birth));
  return r;
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
  // For each edge the first half-edge of its quadrilateral, or none on the boundary.
  std::vector<std::uint32_t> quad(edge_count(), kNoTwin);
  Birth edges{level_ + 2, static_cast<std::uint32_t>(facet_count()), {}};
  std::vector<std::uint32_t> sizes;
  std::size_t total = h_count;
  for (std::uint32_t h = 0; h < h_count; ++h) {
    if (twin_[h] == kNoTwin || twin_[h] < h) continue;
    edges.parents.push_back(edge[h]);
    quad[edge[h]] = static_cast<std::uint32_t>(total);
    sizes.push_back(4);
    total += 4;
    require_room(total);
  }
  Birth vertices{level_ + 1, edges.first + static_cast<std::uint32_t>(sizes.size()), {}};
  std::vector<std::uint32_t> valence(vertices_, 0);
  for (const std::uint32_t v : origin_) ++valence[v];
  const std::size_t first_fan = total;
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
  for (std::uint32_t h = 0; h < h_count; ++h) {
    r.origin_[h] = h;
    const std::uint32_t t = twin_[h];
    if (t == kNoTwin || origin_[h] > origin_[t]) continue;  // each inner edge once, from its smaller end
    const std::uint32_t q = quad[edge[h]];
    r.origin_[q] = next(h);
    r.origin_[q + 1] = h;
    r.origin_[q + 2] = next(t);
    r.origin_[q + 3] = t;
    r.twin_[q] = h;
    r.twin_[h] = q;
    r.twin_[q + 2] = t;
    r.twin_[t] = q + 2;
  }
  auto at = static_cast<std::uint32_t>(first_fan);
  for (const std::uint32_t v : vertices.parents) {
    std::uint32_t h = fan_start[v];
    do {
      const std::uint32_t following = twin_[previous(h)];
      const bool from_smaller_end = v < target(following);
      const std::uint32_t side = quad[edge[following]] + (from_smaller_end ? 1 : 3);
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
