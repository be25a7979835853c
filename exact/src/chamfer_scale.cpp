// SPDX-License-Identifier: LGPL-3.0-or-later
#include "chamfer_scale.hpp"

#include <array>

namespace hexact::detail {
namespace {

constexpr std::uint32_t kUnset = UINT32_MAX;
/// A multiplier with more bits is given up: engines make factors of some dozen bits, and only a file that was made to
/// be slow has more.
constexpr std::size_t kMostBits = 2048;

struct Loops {
  FacetLoops loops;
  std::size_t vertices = 0;
};

/// The level before an edge cut that added `added` facets. Hexagon e lists H + a, ., g, H + b, ., h for the half-edge h
/// from a to b and its twin g.
std::optional<Loops> before_edge_cut(const Loops& now, std::size_t added) {
  const std::size_t half_edges = 2 * added, facets = now.loops.size() - added, vertices = now.vertices / 4;
  std::vector<std::uint32_t> origin(half_edges, kUnset);
  for (std::size_t f = facets; f < now.loops.size(); ++f) {
    const auto loop = now.loops[f];
    if (loop.size() != 6) return std::nullopt;
    const std::array<std::size_t, 2> old = {index(loop[0]), index(loop[3])}, half = {index(loop[5]), index(loop[2])};
    for (std::size_t k = 0; k < 2; ++k) {
      if (half[k] >= half_edges || old[k] < half_edges || old[k] >= half_edges + vertices) return std::nullopt;
      origin[half[k]] = static_cast<std::uint32_t>(old[k] - half_edges);
    }
  }
  Loops before;
  before.vertices = vertices;
  std::size_t h = 0;
  for (std::size_t f = 0; f < facets; ++f) {
    for (std::size_t j = 0; j < now.loops[f].size(); ++j, ++h) {
      if (h >= half_edges || origin[h] == kUnset) return std::nullopt;
      before.loops.add_corner(make_id<VertexId>(origin[h]));
    }
    before.loops.close_loop();
  }
  if (h != half_edges) return std::nullopt;
  return before;
}

std::array<Integer, 3> cross(const Plane<Integer>& p, const Plane<Integer>& q) {
  return {p.b * q.c - p.c * q.b, p.c * q.a - p.a * q.c, p.a * q.b - p.b * q.a};
}

/// κ_G / κ_F with κ_F n_F + κ_G n_G along n_E: κ_F (n_F × n_E) = κ_G (n_E × n_G). nullopt unless it is positive.
std::optional<Rational> ratio(const Plane<Integer>& f, const Plane<Integer>& g, const Plane<Integer>& e) {
  const auto left = cross(f, e), right = cross(e, g);
  for (std::size_t k = 0; k < 3; ++k) {
    if (right[k].is_zero()) continue;
    if (left[k].sign() * right[k].sign() <= 0) return std::nullopt;
    return Rational(left[k], right[k]);
  }
  return std::nullopt;
}

}  // namespace

ChamferStart chamfer_start_of(const PlaneBody& body) {
  Loops now{body.loops, body.vertex_count()};
  ChamferStart start;
  std::size_t end = body.plane_count();
  while (end > 0 && body.addresses.size() == body.plane_count()) {
    const std::uint32_t level = body.addresses[end - 1].level;
    std::size_t begin = end;
    while (begin > 0 && body.addresses[begin - 1].level == level) --begin;
    if (level == 0 || begin == 0 || 8 * (end - begin) != now.loops.corner_count() || now.vertices % 4 != 0) break;
    std::optional<Loops> before = before_edge_cut(now, end - begin);
    if (!before) break;
    now = std::move(*before);
    ++start.steps;
    start.first = level;
    end = begin;
  }
  for (std::size_t i = 0; i < end; ++i) {
    if (body.planes.is_narrow(i)) start.body.planes.push_back(body.planes.narrow(i));
    else start.body.planes.push_back(body.planes.wide(i));
  }
  start.body.addresses.assign(body.addresses.begin(), body.addresses.begin() + static_cast<std::ptrdiff_t>(std::min(end, body.addresses.size())));
  start.body.loops = std::move(now.loops);
  start.body.triples.resize(now.vertices);
  return start;
}

std::optional<std::vector<Rational>> mean_multipliers(const IntegerPlanes& planes, const HoneycombMap& map) {
  std::vector<std::uint32_t> edge(map.half_edge_count());
  const std::vector<std::uint32_t> forward = forward_half_edges(map);
  for (std::uint32_t e = 0; e < forward.size(); ++e) edge[forward[e]] = edge[map.twin(forward[e])] = e;
  std::vector<std::optional<Rational>> found(map.facet_count());
  std::vector<std::uint32_t> queue{0};
  found[0] = Rational(1);
  for (std::size_t i = 0; i < queue.size(); ++i) {  // breadth first: short chains of ratios
    const std::uint32_t f = queue[i], start = map.facet_start(f);
    for (std::uint32_t h = start; h < start + map.facet_size(f); ++h) {
      const std::uint32_t g = map.facet(map.twin(h));
      if (found[g]) continue;
      const auto r = ratio(planes[f], planes[g], planes[map.facet_count() + edge[h]]);
      if (!r) return std::nullopt;
      found[g] = *found[f] * *r;
      if (found[g]->numerator().bit_length() + found[g]->denominator().bit_length() > kMostBits) return std::nullopt;
      queue.push_back(g);
    }
  }
  std::vector<Rational> out;
  for (const auto& x : found) out.push_back(*x);
  return out;
}

}  // namespace hexact::detail
