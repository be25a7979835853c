// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

// Bodies of midedge.hpp, for the explicit instantiations in `kernel` (double) and `exact` (Rational) only.

#include "hexact/kernel/midedge.hpp"

#include "hexact/kernel/parallel.hpp"

#include <array>
#include <cstdint>

namespace hexact::detail {

/// Facets or edges that one thread takes at a time: more where the arithmetic is cheap.
template <class S>
inline constexpr std::size_t kMidedgeGrain = std::is_trivially_copyable_v<S> ? std::size_t{1} << 13 : 64;

template <class S>
Point3<S> plus(const Point3<S>& a, const Point3<S>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class S>
Point3<S> minus(const Point3<S>& a, const Point3<S>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class S>
Point3<S> times(const S& w, const Point3<S>& a) {
  return {w * a.x, w * a.y, w * a.z};
}
template <class S>
Point3<S> middle(const Point3<S>& a, const Point3<S>& b) {
  return times(S(1) / S(2), plus(a, b));
}

/// What a polygon adds to the points on its sides: `emit(j, 5/32 (p_j + p_{j+1}) + 3/(16(k−2)) Σ other corners)` for
/// every side j. `corner(j)` is p_j, j < k.
template <class S, class Corner, class Emit>
void polygon_shares(std::uint32_t k, const Corner& corner, const Emit& emit) {
  const S ends = S(5) / S(32), others = S(3) / S(16 * static_cast<int>(k - 2));
  if (k == 4) {
    const Point3<S> &a = corner(0), &b = corner(1), &c = corner(2), &d = corner(3);
    const Point3<S> ab = plus(a, b), bc = plus(b, c), cd = plus(c, d), da = plus(d, a);
    emit(0, plus(times(ends, ab), times(others, cd)));
    emit(1, plus(times(ends, bc), times(others, da)));
    emit(2, plus(times(ends, cd), times(others, ab)));
    emit(3, plus(times(ends, da), times(others, bc)));
    return;
  }
  if (k == 3) {
    for (std::uint32_t j = 0; j < 3; ++j) {
      emit(j, plus(times(ends, plus(corner(j), corner((j + 1) % 3))), times(others, corner((j + 2) % 3))));
    }
    return;
  }
  Point3<S> sum = corner(0);
  for (std::uint32_t j = 1; j < k; ++j) sum = plus(sum, corner(j));
  for (std::uint32_t j = 0; j < k; ++j) {
    const Point3<S> side = plus(corner(j), corner((j + 1) % k));
    emit(j, plus(times(ends, side), times(others, minus(sum, side))));
  }
}

/// Half-edges between the one that is worked on and the one whose point is asked for. Half-edges run through memory in
/// order, their points do not: beyond the caches every access would wait (18.5 ns a facet at 6 million, 12 this way).
inline constexpr std::uint32_t kHalfEdgesAhead = 48;

/// Asks for the points of a quadrilateral's corners, a dozen quadrilaterals ahead of half-edge `start`.
template <class S>
void fetch_points_ahead(const MidedgeMap& map, std::span<const Point3<S>> points, std::uint32_t start) {
  const std::size_t begin = std::size_t{start} + kHalfEdgesAhead;
  if (begin + 4 > map.half_edge_count()) return;
  for (std::size_t h = begin; h < begin + 4; ++h) __builtin_prefetch(&points[map.origin(static_cast<std::uint32_t>(h))]);
}

/// Shares of facets first … last − 1 in the points on their sides, to `emit(half-edge, share)`.
template <class S, class Emit>
void facet_shares(const MidedgeMap& map, std::span<const Point3<S>> points, std::uint32_t first, std::uint32_t last, const Emit& emit) {
  for (std::uint32_t f = first; f != last; ++f) {
    const auto loop = map.loop(f);
    const std::uint32_t start = map.facet_start(f);
    fetch_points_ahead<S>(map, points, start);
    polygon_shares<S>(
        static_cast<std::uint32_t>(loop.size()), [&](std::uint32_t j) -> const Point3<S>& { return points[loop[j]]; },
        [&](std::uint32_t j, const Point3<S>& share) { emit(start + j, share); });
  }
}

/// The facet that begins with half-edge H/2 of a regular map: facets before it hold every edge once, and so do the rest.
inline std::uint32_t first_new_facet(const MidedgeMap& map) {
  return map.facet(static_cast<std::uint32_t>(map.half_edge_count() / 2));
}

/// Edge e is half-edge e of an old facet: old facets write in order, then each edge has one half-edge of a new facet.
template <class S>
PointArray<S> regular_six_point(const MidedgeMap& map, std::span<const Point3<S>> points) {
  PointArray<S> out(map.edge_count());
  const std::uint32_t old_facets = first_new_facet(map);
  for_ranges(old_facets, kMidedgeGrain<S>, [&](std::uint32_t begin, std::uint32_t end) {
    facet_shares<S>(map, points, begin, end, [&](std::uint32_t h, const Point3<S>& share) { out[h] = share; });
  });
  for_ranges(map.facet_count() - old_facets, kMidedgeGrain<S>, [&](std::uint32_t begin, std::uint32_t end) {
    facet_shares<S>(map, points, old_facets + begin, old_facets + end, [&](std::uint32_t h, const Point3<S>& share) {
      if (h + kHalfEdgesAhead < map.half_edge_count()) __builtin_prefetch(&out[map.twin(h + kHalfEdgesAhead)]);
      Point3<S>& p = out[map.twin(h)];
      p = plus(p, share);
    });
  });
  return out;
}

template <class S>
PointArray<S> general_six_point(const MidedgeMap& map, std::span<const Point3<S>> points) {
  PointArray<S> shares(map.half_edge_count());
  for_ranges(map.facet_count(), kMidedgeGrain<S>, [&](std::uint32_t begin, std::uint32_t end) {
    facet_shares<S>(map, points, begin, end, [&](std::uint32_t h, const Point3<S>& share) { shares[h] = share; });
  });
  const RawVector<std::uint32_t> edge = map.edge_numbers();
  PointArray<S> out(map.edge_count());
  for_ranges(edge.size(), kMidedgeGrain<S>, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t h = begin; h != end; ++h) {
      const std::uint32_t t = map.twin(h);
      if (t < h) continue;
      out[edge[h]] = t == kNoTwin ? middle(points[map.origin(h)], points[map.target(h)]) : plus(shares[h], shares[t]);
    }
  });
  return out;
}

template <class S>
PointArray<S> midpoints(const MidedgeMap& map, std::span<const Point3<S>> points) {
  PointArray<S> out(map.edge_count());
  if (map.regular()) {
    for_ranges(out.size(), kMidedgeGrain<S>, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t h = begin; h != end; ++h) {
        if (h + kHalfEdgesAhead < map.half_edge_count()) __builtin_prefetch(&points[map.origin(h + kHalfEdgesAhead)]);
        out[h] = middle(points[map.origin(h)], points[map.target(h)]);
      }
    });
    return out;
  }
  const RawVector<std::uint32_t> edge = map.edge_numbers();
  for_ranges(edge.size(), kMidedgeGrain<S>, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t h = begin; h != end; ++h) {
      if (map.twin(h) > h) out[edge[h]] = middle(points[map.origin(h)], points[map.target(h)]);
    }
  });
  return out;
}

/// The half-edges that leave the origin of `first`, counter-clockwise. Precondition: an inner vertex.
inline void collect_fan(const MidedgeMap& map, std::uint32_t first, std::vector<std::uint32_t>& fan) {
  fan.clear();
  std::uint32_t h = first;
  do {
    fan.push_back(h);
    h = map.twin(map.previous(h));
  } while (h != first);
}

/// Adds the shares of the polygons of edge points around inner vertices to the corners there.
template <class S>
void add_vertex_shares(const MidedgeMap& map, const RawVector<std::uint32_t>& edge, std::span<const Point3<S>> middles, PointArray<S>& out) {
  const std::vector<std::uint32_t> start = map.fan_starts();
  for_ranges(start.size(), kMidedgeGrain<S>, [&](std::uint32_t begin, std::uint32_t end) {
    std::vector<std::uint32_t> fan;
    for (std::uint32_t v = begin; v != end; ++v) {
      if (map.twin(start[v]) == kNoTwin) continue;
      collect_fan(map, start[v], fan);
      polygon_shares<S>(
          static_cast<std::uint32_t>(fan.size()),
          [&](std::uint32_t j) -> const Point3<S>& { return middles[edge[fan[j]]]; },
          [&](std::uint32_t j, const Point3<S>& share) { out[fan[j]] = plus(out[fan[j]], share); });
    }
  });
}

}  // namespace hexact::detail

namespace hexact {

template <class S>
PointArray<S> edge_points(const MidedgeMap& map, std::span<const Point3<S>> points, MidedgeRule rule) {
  HEXACT_EXPECTS(points.size() == map.vertex_count());
  if (rule == MidedgeRule::simple) return detail::midpoints<S>(map, points);
  return map.regular() ? detail::regular_six_point<S>(map, points) : detail::general_six_point<S>(map, points);
}

template <class S>
PointArray<S> corner_points(const MidedgeMap& map, std::span<const Point3<S>> points, MidedgeRule rule) {
  using namespace detail;
  const PointArray<S> middles = edge_points<S>(map, points, rule);
  const RawVector<std::uint32_t> edge = map.edge_numbers();
  const std::vector<std::uint32_t> start = map.fan_starts();
  PointArray<S> out(map.half_edge_count());
  const auto of_edge = [&](std::uint32_t h) -> const Point3<S>& { return middles[edge[h]]; };
  for_ranges(map.facet_count(), kMidedgeGrain<S>, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t f = begin; f != end; ++f) {
      const std::uint32_t first = map.facet_start(f), k = map.facet_size(f);
      // Side j of the polygon of edge points joins edges j and j + 1: the corner where half-edge j + 1 begins.
      const auto emit = [&](std::uint32_t j, const Point3<S>& share) {
        const std::uint32_t h = map.next(first + j);
        const bool mean = rule == MidedgeRule::simple || map.twin(start[map.origin(h)]) == kNoTwin;
        out[h] = mean ? middle(of_edge(first + j), of_edge(h)) : share;
      };
      polygon_shares<S>(k, [&](std::uint32_t j) -> const Point3<S>& { return of_edge(first + j); }, emit);
    }
  });
  if (rule == MidedgeRule::six_point) add_vertex_shares<S>(map, edge, middles, out);
  return out;
}

template <class S>
MidedgeLevel<S> midedge_step(const MidedgeLevel<S>& level, MidedgeRule rule, MidedgeBoundary boundary) {
  return {level.map.stepped(boundary), edge_points<S>(level.map, level.points, rule)};
}

template <class S>
MidedgeLevel<S> midedge_double_step(const MidedgeLevel<S>& level, MidedgeRule rule) {
  return {level.map.double_stepped(), corner_points<S>(level.map, level.points, rule)};
}

}  // namespace hexact
