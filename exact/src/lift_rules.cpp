// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/lift_rules.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

namespace hexact {
namespace {

using Range = tbb::blocked_range<std::uint32_t>;
using Vector = Point3<double>;
constexpr std::size_t kGrain = 1 << 12;
constexpr int kMostRounds = 200;
/// Share of the sum of two lifts that the third may reach.
constexpr double kTriangle = 0.9;
/// A lift that would fall by less is left as it is.
constexpr double kSmallestChange = 0x1p-9;
/// What sides give away stays below the allowed share by this much, more than the rounding of lifts can take.
constexpr double kMargin = 1 - 0x1p-8;

Vector minus(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }

template <class Visit>
void for_each(std::size_t count, const Visit& visit) {
  tbb::parallel_for(Range(0, static_cast<std::uint32_t>(count), kGrain), [&](const Range& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) visit(i);
  });
}

/// Sine of the angle across each edge (times the lengths of the nearly unit normals) and length of the edge.
struct EdgeMeasure {
  double sine, length;
};

/// What lifts at a vertex do to the sides that end there, as shares of what those may lose.
///
/// Facets X0, X1, X2 and edges e0, e1, e2 go round counter-clockwise, e_i between X_i and X_{i−1}. In X_i the lines of
/// e_i and e_{i+1} move in, so that the corner moves along e_i by (τ_{i+1} a_i + τ_i k_i / a_i)/det, where
/// a_i = |X_i × X_{i−1}|, k_i = (X_i·X_{i+1})(X_i·X_{i−1}) − (X_i·X_i)(X_{i+1}·X_{i−1}), det = det(X0, X1, X2).
/// k_i has the sign of the cosine of the corner.
struct Corner {
  std::array<double, 3> other;   ///< of τ_{i+1} on e_i in X_i; of τ_i on e_{i+1} in X_i at place i + 1
  std::array<double, 3> own;     ///< of τ_i on e_i in X_i
  std::array<double, 3> behind;  ///< of τ_{i+1} on e_{i+1} in X_i

  [[nodiscard]] double largest_share(const std::array<double, 3>& lift) const {
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      most = std::max({most, lift[j] * other[i] + lift[i] * own[i], lift[i] * other[j] + lift[j] * behind[i]});
    }
    return most;
  }
};

RawVector<EdgeMeasure> measure_edges(const SnappedLevel& surface, const RawVector<Vector>& normals, const EdgeNumbering& edges) {
  const HoneycombMap& map = surface.map;
  RawVector<EdgeMeasure> out(map.edge_count());
  for_each(out.size(), [&](std::uint32_t e) {
    const std::uint32_t h = edges.half_edge[e];
    out[e] = {length(cross(normals[map.facet(h)], normals[map.facet(map.twin(h))])),
              length(minus(surface.points[map.target(h)], surface.points[map.origin(h)]))};
  });
  return out;
}

/// The largest lifts below t of which none is more than the share kTriangle of the sum of the other two: with c the
/// smallest, a, b <= kTriangle·(b + c), kTriangle·(a + c) say that both are at most c·kTriangle/(1 − kTriangle).
std::array<double, 3> below_triangle(std::array<double, 3> t) {
  const double cap = std::min({t[0], t[1], t[2]}) * (kTriangle / (1 - kTriangle));
  for (double& x : t) x = std::min(x, cap);
  const double sum = t[0] + t[1] + t[2];
  for (double& x : t) x = std::min(x, kTriangle * (sum - x));
  return t;
}

/// The lifts at the vertex where h starts are those of h, of the edge before, and so on round the vertex.
class Relaxation {
 public:
  Relaxation(const ChamferLevel& level, const EdgeNumbering& edges, double keep)
      : map_(level.surface.map), share_((1 - keep) / 2), active_(level.surface.map.vertex_count()) {
    const RawVector<Vector> normals = scaled_normals(level);
    const RawVector<EdgeMeasure> measures = measure_edges(level.surface, normals, edges);
    corners_.resize(map_.vertex_count());
    lifts_.resize(map_.half_edge_count());
    next_.resize(map_.half_edge_count());
    changed_.resize(map_.vertex_count());
    for_each(map_.vertex_count(), [&](std::uint32_t v) { start_vertex(v, normals, measures, edges); });
  }

  RawVector<double> run(const EdgeNumbering& edges) {
    for (std::atomic<char>& mark : active_) mark.store(1, std::memory_order_relaxed);
    for (int round = 0; round < kMostRounds && relax(); ++round) {}
    scale_down();
    RawVector<double> out(map_.edge_count());
    for_each(out.size(), [&](std::uint32_t e) { out[e] = lift(edges.half_edge[e]); });
    return out;
  }

 private:
  /// Both ends of an edge have their say; the smaller counts.
  [[nodiscard]] double lift(std::uint32_t h) const { return std::min(lifts_[h], lifts_[map_.twin(h)]); }

  void start_vertex(std::uint32_t v, const RawVector<Vector>& normals, const RawVector<EdgeMeasure>& measures,
                    const EdgeNumbering& edges) {
    const auto s = map_.star(v);
    std::array<Vector, 3> n;
    std::array<EdgeMeasure, 3> m;
    for (std::size_t i = 0; i < 3; ++i) {
      n[i] = normals[map_.facet(s[i])];
      m[i] = measures[edges.edge[s[i]]];
    }
    const double det = dot(n[0], cross(n[1], n[2]));
    std::array<double, 3> dots, squares, scale;
    for (std::size_t i = 0; i < 3; ++i) {
      dots[i] = dot(n[(i + 1) % 3], n[(i + 2) % 3]);
      squares[i] = dot(n[i], n[i]);
      scale[i] = 1 / (det * share_ * kMargin * m[i].length);
    }
    Corner& corner = corners_[v];
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> widest = {0, 0, 0}, most = {kInfinity, kInfinity, kInfinity};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
      const double k = dots[l] * dots[j] - squares[i] * dots[i];
      corner.other[i] = m[i].sine * scale[i];
      corner.own[i] = k / m[i].sine * scale[i];
      corner.behind[i] = k / m[j].sine * scale[j];
      // Width by which both sides may move in together, for either of them.
      const double together = std::max(m[j].sine * m[i].sine + k, 0x1p-20 * m[j].sine * m[i].sine);
      const double width = std::max(1 / (together * scale[i]), 1 / (together * scale[j]));
      widest[i] = std::max(widest[i], width);
      widest[j] = std::max(widest[j], width);
      // At an acute corner both sides stand in each other's way: neither moves in farther than both can.
      if (k > 0) most[i] = std::min(most[i], 1 / (together * std::max(scale[i], scale[j])));
      if (k > 0) most[j] = std::min(most[j], 1 / (together * std::max(scale[i], scale[j])));
    }
    for (std::size_t i = 0; i < 3; ++i) lifts_[s[i]] = std::min(widest[i], most[i]) * m[i].sine;
    changed_[v] = 0;
  }

  /// One round over the vertices that may change: new lifts from old ones, then those in their place. Whether any
  /// changed by enough to matter.
  bool relax() {
    const auto vertices = static_cast<std::uint32_t>(map_.vertex_count());
    for_each(vertices, [&](std::uint32_t v) {
      if (active_[v].load(std::memory_order_relaxed) != 0) relax_vertex(v);
    });
    return tbb::parallel_reduce(
        Range(0, vertices, kGrain), false,
        [&](const Range& range, bool any) {
          for (std::uint32_t v = range.begin(); v != range.end(); ++v) {
            if (changed_[v] == 0) continue;
            changed_[v] = 0;
            any = true;
            active_[v].store(1, std::memory_order_relaxed);
            for (const std::uint32_t h : map_.star(v)) {
              lifts_[h] = next_[h];
              active_[map_.target(h)].store(1, std::memory_order_relaxed);
            }
          }
          return any;
        },
        [](bool a, bool b) { return a || b; });
  }

  void relax_vertex(std::uint32_t v) {
    active_[v].store(0, std::memory_order_relaxed);
    const auto s = map_.star(v);
    const std::array<double, 3> t = {lift(s[0]), lift(s[1]), lift(s[2])};
    const Corner& corner = corners_[v];
    std::array<double, 3> u = below_triangle(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      u[j] = std::min(u[j], (1 - t[i] * std::min(0.0, corner.own[i])) / corner.other[i]);
      u[i] = std::min(u[i], (1 - t[j] * std::min(0.0, corner.behind[i])) / corner.other[j]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (u[i] < t[i] * (1 - kSmallestChange)) changed_[v] = 1;
      next_[s[i]] = u[i];
    }
  }

  /// All lifts by one factor, so that no side loses too much; the triangle inequalities do not change.
  void scale_down() {
    const double most = tbb::parallel_reduce(
        Range(0, static_cast<std::uint32_t>(map_.vertex_count()), kGrain), 1.0,
        [&](const Range& range, double found) {
          for (std::uint32_t v = range.begin(); v != range.end(); ++v) {
            const auto s = map_.star(v);
            found = std::max(found, corners_[v].largest_share({lift(s[0]), lift(s[1]), lift(s[2])}));
          }
          return found;
        },
        [](double a, double b) { return std::max(a, b); });
    if (most > 1) for_each(lifts_.size(), [&](std::uint32_t h) { lifts_[h] /= most; });
  }

  const HoneycombMap& map_;
  double share_;
  RawVector<Corner> corners_;
  RawVector<double> lifts_, next_;  ///< what the origin of each half-edge says about its edge
  std::vector<std::atomic<char>> active_;  ///< vertices that see other lifts than when they were relaxed last
  RawVector<char> changed_;
};

}  // namespace

KeptFraction constant_keep(double keep) {
  HEXACT_EXPECTS(keep > 0 && keep < 1);
  return [keep](std::uint32_t) { return keep; };
}

KeptFraction smooth_keep(std::uint32_t start_level) {
  return [start_level](std::uint32_t level) {
    HEXACT_EXPECTS(level >= start_level);
    return 1 - std::ldexp(0.25, -static_cast<int>(std::min(level - start_level, 900U)));
  };
}

LiftRule automatic_lifts(KeptFraction keep) {
  return [keep = std::move(keep)](const ChamferLevel& level, const EdgeNumbering& edges) -> Lifts {
    const double kept = keep(level.surface.map.level());
    HEXACT_EXPECTS(kept > 0 && kept < 1);
    return ProposedLifts{Relaxation(level, edges, kept).run(edges)};
  };
}

}  // namespace hexact
