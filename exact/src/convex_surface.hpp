// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "certificate_signs.hpp"
#include "hexact/kernel/mesh_topology.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

// The claims about one surface, each decided with the smallest element that refutes it.
namespace hexact::detail {

using Triples = std::vector<std::array<FacetId, 3>>;
/// What refutes a claim; empty: nothing does.
using Fault = std::string;

/// The smallest i < n for which test(i) holds; n if there is none.
template <class Test>
std::size_t first_where(std::size_t n, const Test& test) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, n, 4096), n,
      [&](const tbb::blocked_range<std::size_t>& range, std::size_t best) {
        for (std::size_t i = range.begin(); i < range.end() && i < best; ++i) {
          if (test(i)) return i;
        }
        return best;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

inline Fault closed_fault(const MeshTopology& topology) {
  if (topology.is_one_closed_surface() && topology.unused_vertices == 0) return {};
  const Finding& first = topology.findings.front();
  return first.element + (first.element.empty() ? "" : ": ") + first.message;
}

inline Fault trivalent_fault(const FacetLoops& loops, std::size_t vertices) {
  std::vector<std::uint32_t> valence(vertices, 0);
  for (const VertexId v : loops.corners()) ++valence[index(v)];
  for (std::size_t v = 0; v < vertices; ++v) {
    if (valence[v] != 3) return vertex_name(v) + ": " + std::to_string(valence[v]) + " facets";
  }
  return {};
}

template <class Planes>
Fault planar_fault(const Planes& planes, const FacetLoops& loops, const Triples& triples) {
  const auto id = [&](std::size_t v, std::size_t i) { return index(triples[v][i]); };
  const std::size_t flat = first_where(triples.size(), [&](std::size_t v) {
    return sign_det3(planes, id(v, 0), id(v, 1), id(v, 2)) == 0;
  });
  if (flat < triples.size()) return vertex_name(flat) + ": det3 of its defining planes = 0";
  const auto off_plane = [&](std::size_t f, VertexId v) {
    const auto& t = triples[index(v)];
    if (index(t[0]) == f || index(t[1]) == f || index(t[2]) == f) return false;
    return sign_det4(planes, index(t[0]), index(t[1]), index(t[2]), f) != 0;
  };
  const std::size_t bent = first_where(loops.size(), [&](std::size_t f) {
    if (loops[f].empty()) return false;
    return !has_normal(planes, f) ||
           std::any_of(loops[f].begin(), loops[f].end(), [&](VertexId v) { return off_plane(f, v); });
  });
  if (bent == loops.size()) return {};
  for (const VertexId v : loops[bent]) {
    if (!off_plane(bent, v)) continue;
    const auto& t = triples[index(v)];
    return facet_name(bent) + ": does not contain " + vertex_name(index(v)) + ", det4 = " +
           det4_text(planes, index(t[0]), index(t[1]), index(t[2]), bent);
  }
  return facet_name(bent) + ": its plane has no normal";
}

/// Strict local convexity of a closed planar surface, element by element.
template <class Planes>
class ConvexSigns {
 public:
  ConvexSigns(const Planes& planes, const FacetLoops& loops, const Triples& triples)
      : planes_(planes), loops_(loops), triples_(triples), edges_(half_edges_of(loops)) {}

  [[nodiscard]] const HalfEdges& edges() const noexcept { return edges_; }

  /// The edge runs along n_f × n_g, g being the facet on its right: then both facets bend inward there.
  [[nodiscard]] int edge_sign(std::uint32_t h) const {
    const std::size_t f = edges_.facet[h], g = right(h);
    for (const FacetId p : triples_[edges_.origin[h]]) {
      const int s = sign_det3(planes_, index(p), f, g);
      if (s == 0) continue;
      // p goes through the origin, so n_p·(target − origin) = n_p·target − d_p.
      const auto& t = triples_[edges_.target(h)];
      const std::size_t a = index(t[0]), b = index(t[1]), c = index(t[2]);
      return -s * sign_det3(planes_, a, b, c) * sign_det4(planes_, a, b, c, index(p));
    }
    return 0;
  }
  /// (n_f × n_k) × (n_f × n_g) = n_f·det(f, k, g): the facet turns left where h starts.
  [[nodiscard]] int corner_sign(std::uint32_t h) const {
    return sign_det3(planes_, edges_.facet[h], right(edges_.previous[h]), right(h));
  }
  /// The edge directions of a polygon that turns once change their sign along any axis exactly twice.
  [[nodiscard]] bool turns_once(std::size_t f) const {
    const int axis = other_axis(planes_, f);
    int first = 0, last = 0, changes = 0;
    const auto start = static_cast<std::uint32_t>(loops_.start(f));
    for (std::uint32_t h = start; h < start + loops_[f].size(); ++h) {
      const int s = cross_sign(planes_, f, right(h), axis);
      if (s == 0) continue;
      if (first == 0) first = s;
      if (last != 0 && s != last) ++changes;
      last = s;
    }
    if (first != last) ++changes;
    return changes == 2;
  }
  /// Whether a locally convex star with more than three facets goes round once: seen from the plane of its first
  /// facet all other edges lie strictly inside, and the lines of the facets there turn by less than a half turn.
  [[nodiscard]] bool star_is_simple(std::uint32_t h) const {
    std::vector<std::size_t> f;
    for (const std::uint32_t e : edges_.around(h)) f.push_back(edges_.facet[e]);
    const std::size_t k = f.size();
    if (k <= 3) return true;
    for (std::size_t i = 1; i + 1 < k; ++i) {
      // The edge between facets i and i + 1 (counter-clockwise) runs from the vertex along n_{i+1} × n_i.
      if (sign_det3(planes_, f[0], f[i + 1], f[i]) >= 0) return false;
    }
    const int axis = other_axis(planes_, f[0]);
    int last = 0, changes = 0;
    for (std::size_t i = 1; i < k; ++i) {
      const int s = cross_sign(planes_, f[0], f[i], axis);
      if (s == 0) continue;
      if (last != 0 && s != last) ++changes;
      last = s;
    }
    return changes <= 1;
  }

  [[nodiscard]] Fault fault() const {
    const std::size_t n = edges_.size();
    const auto half = [](std::size_t h) { return static_cast<std::uint32_t>(h); };
    const std::size_t corner = first_where(n, [&](std::size_t h) { return corner_sign(half(h)) <= 0; });
    if (corner < n) {
      return facet_name(edges_.facet[corner]) + ": corner at " + vertex_name(edges_.origin[corner]) +
             " is not strictly convex, det3 = " +
             det3_text(planes_, edges_.facet[corner], right(edges_.previous[corner]), right(half(corner)));
    }
    const std::size_t edge = first_where(n, [&](std::size_t h) { return h < edges_.twin[h] && edge_sign(half(h)) <= 0; });
    if (edge < n) return edge_text(half(edge));
    const std::size_t turn = first_where(loops_.size(), [&](std::size_t f) { return !loops_[f].empty() && !turns_once(f); });
    if (turn < loops_.size()) return facet_name(turn) + ": does not turn exactly once";
    std::vector<std::uint32_t> leaving(triples_.size(), kNoTwin);
    for (std::size_t h = n; h-- > 0;) leaving[edges_.origin[h]] = half(h);
    const std::size_t star = first_where(leaving.size(), [&](std::size_t v) { return !star_is_simple(leaving[v]); });
    if (star < leaving.size()) return vertex_name(star) + ": its facets do not go round exactly once";
    return {};
  }

 private:
  [[nodiscard]] std::size_t right(std::uint32_t h) const { return edges_.facet[edges_.twin[h]]; }
  [[nodiscard]] std::string edge_text(std::uint32_t h) const {
    const auto& t = triples_[edges_.target(h)];
    std::string text = edge_name(edges_.origin[h], edges_.target(h)) + ": is not strictly convex";
    for (const FacetId p : triples_[edges_.origin[h]]) {
      if (sign_det3(planes_, index(p), edges_.facet[h], right(h)) == 0) continue;
      return text + ", det4 = " + det4_text(planes_, index(t[0]), index(t[1]), index(t[2]), index(p));
    }
    return text;
  }

  const Planes& planes_;
  const FacetLoops& loops_;
  const Triples& triples_;
  HalfEdges edges_;
};

template <class Planes>
Fault convex_fault(const Planes& planes, const FacetLoops& loops, const Triples& triples, const MeshTopology& topology) {
  if (Fault fault = closed_fault(topology); !fault.empty()) return fault;
  if (Fault fault = planar_fault(planes, loops, triples); !fault.empty()) return fault;
  if (topology.euler != 2) return "Euler characteristic " + std::to_string(topology.euler) + ", expected 2";
  return ConvexSigns<Planes>(planes, loops, triples).fault();
}

}  // namespace hexact::detail
