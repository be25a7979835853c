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
using Three = std::array<float, 3>;  // one number for each edge at a vertex; a guess needs no more than floats
constexpr std::size_t kGrain = 1 << 12;
constexpr int kMostRounds = 200;
constexpr std::uint32_t kAhead = 8;
/// Share of the sum of two lifts that the third may reach.
constexpr float kTriangle = 0.9F;
/// A lift that would fall by less is left as it is.
constexpr float kSmallestChange = 0x1p-5F;
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

/// How far lifts at a vertex may go for the sides that end there.
///
/// Facets X0, X1, X2 and edges e0, e1, e2 go round counter-clockwise, e_i between X_i and X_{i−1}. In X_i the lines of
/// e_i and e_{i+1} move in, so that the corner moves along e_i by (τ_{i+1} a_i + τ_i k_i / a_i)/det, where
/// a_i = |X_i × X_{i−1}|, k_i = (X_i·X_{i+1})(X_i·X_{i−1}) − (X_i·X_i)(X_{i+1}·X_{i−1}), det = det(X0, X1, X2).
/// k_i has the sign of the cosine of the corner. With r_i what e_i may lose at this end, this is at most r_i if
/// τ_{i+1} <= limit_i + after_i τ_i; and the corner moves along e_{i+1} by at most r_{i+1} if
/// τ_i <= limit_{i+1} + before_i τ_{i+1}.
struct Corner {
  Three limit;   ///< r_i det / a_i
  Three after;   ///< −k_i / a_i²
  Three before;  ///< −k_i / a_{i+1}²

  [[nodiscard]] float largest_share(const Three& lift) const {
    float most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      most = std::max({most, (lift[j] - after[i] * lift[i]) / limit[i], (lift[i] - before[i] * lift[j]) / limit[j]});
    }
    return most;
  }
};

/// The largest lifts below t of which none is more than the share kTriangle of the sum of the other two: with c the
/// smallest, a, b <= kTriangle·(b + c), kTriangle·(a + c) say that both are at most c·kTriangle/(1 − kTriangle).
inline Three below_triangle(Three t) {
  const float cap = std::min({t[0], t[1], t[2]}) * (kTriangle / (1 - kTriangle));
  for (float& x : t) x = std::min(x, cap);
  const float sum = t[0] + t[1] + t[2];
  for (float& x : t) x = std::min(x, kTriangle * (sum - x));
  return t;
}

/// The lifts of a level as both ends of every edge propose them: place 3v + i holds what vertex v says about the edge of
/// the i-th half-edge of its star. The smaller of the two proposals counts.
class Relaxation {
 public:
  Relaxation(const ChamferLevel& level, double keep)
      : map_(level.surface.map), share_((1 - keep) / 2), active_(level.surface.map.vertex_count()) {
    const RawVector<Vector> normals = scaled_normals(level);
    const std::size_t vertices = map_.vertex_count();
    corners_.resize(vertices);
    lifts_.resize(3 * vertices);
    next_.resize(3 * vertices);
    partner_.resize(3 * vertices);
    changed_.resize(vertices);
    for_each(vertices, [&](std::uint32_t v) { start_vertex(v, normals, level.surface.points); });
  }

  /// Lifts by the number of the edge.
  RawVector<double> run(const EdgeNumbering& edges) {
    for (int round = 0; round < kMostRounds && relax(); ++round) {}
    scale_down();
    RawVector<double> out(map_.edge_count());
    for_each(map_.vertex_count(), [&](std::uint32_t v) {
      const Three t = lifts_at(v);
      for (std::uint32_t i = 0; i < 3; ++i) {
        if (3 * v + i < partner_[3 * v + i]) out[edges.at_vertex[v][i]] = static_cast<double>(t[i]);
      }
    });
    return out;
  }

 private:
  [[nodiscard]] Three lifts_at(std::uint32_t v) const {
    Three t;
    for (std::uint32_t i = 0; i < 3; ++i) t[i] = std::min(lifts_[3 * v + i], lifts_[partner_[3 * v + i]]);
    return t;
  }

  void start_vertex(std::uint32_t v, const RawVector<Vector>& normals, const RawVector<Vector>& points) {
    const auto s = map_.star(v);
    prefetch(v + kAhead, normals, points);
    std::array<Vector, 3> n;
    for (std::size_t i = 0; i < 3; ++i) n[i] = normals[map_.facet(s[i])];
    std::array<double, 3> dots, squares, sine, inverse, room;
    std::array<std::uint32_t, 3> twins;
    Vector last{};
    for (std::size_t i = 0; i < 3; ++i) {
      last = cross(n[i], n[(i + 2) % 3]);
      sine[i] = length(last);
      inverse[i] = 1 / sine[i];
      dots[i] = dot(n[(i + 1) % 3], n[(i + 2) % 3]);
      squares[i] = dot(n[i], n[i]);
      twins[i] = map_.twin(s[i]);
    }
    const double share = -dot(n[0], last) * share_ * kMargin;  // det(n0, n1, n2) = −n0 · (n2 × n1)
    for (std::size_t i = 0; i < 3; ++i) room[i] = share * length(minus(points[map_.origin(twins[i])], points[v]));
    Corner& corner = corners_[v];
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> widest = {0, 0, 0}, most = {kInfinity, kInfinity, kInfinity};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
      const double k = dots[l] * dots[j] - squares[i] * dots[i];
      corner.limit[i] = static_cast<float>(room[i] * inverse[i]);
      corner.after[i] = static_cast<float>(-k * inverse[i] * inverse[i]);
      corner.before[i] = static_cast<float>(-k * inverse[j] * inverse[j]);
      // Widths by which both sides may move in together, for either of them.
      const double product = sine[j] * sine[i], together = 1 / std::max(product + k, 0x1p-20 * product);
      const double width = std::max(room[i], room[j]) * together;
      widest[i] = std::max(widest[i], width);
      widest[j] = std::max(widest[j], width);
      if (k <= 0) continue;
      // At an acute corner both sides stand in each other's way: neither moves in farther than both can.
      most[i] = std::min(most[i], std::min(room[i], room[j]) * together);
      most[j] = std::min(most[j], std::min(room[i], room[j]) * together);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      lifts_[3 * v + i] = static_cast<float>(std::min(widest[i], most[i]) * sine[i]);
      partner_[3 * v + i] = 3 * map_.origin(twins[i]) + map_.slot(twins[i]);
    }
    active_[v].store(1, std::memory_order_relaxed);
    changed_[v] = 0;
  }

  /// What `start_vertex` reads lies scattered in memory: fetched ahead, vertex after vertex does not wait for it.
  void prefetch(std::uint32_t v, const RawVector<Vector>& normals, const RawVector<Vector>& points) const {
    if (v >= map_.vertex_count()) return;
    for (const std::uint32_t h : map_.star(v)) {
      __builtin_prefetch(&normals[map_.facet(h)]);
      __builtin_prefetch(&points[map_.target(h)]);
    }
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
            for (std::uint32_t i = 3 * v; i < 3 * v + 3; ++i) {
              lifts_[i] = next_[i];
              active_[partner_[i] / 3].store(1, std::memory_order_relaxed);
            }
          }
          return any;
        },
        [](bool a, bool b) { return a || b; });
  }

  void relax_vertex(std::uint32_t v) {
    active_[v].store(0, std::memory_order_relaxed);
    const Three t = lifts_at(v);
    const Corner& corner = corners_[v];
    Three u = below_triangle(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      u[j] = std::min(u[j], corner.limit[i] + t[i] * std::max(0.0F, corner.after[i]));
      u[i] = std::min(u[i], corner.limit[j] + t[j] * std::max(0.0F, corner.before[i]));
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (u[i] < t[i] * (1 - kSmallestChange)) changed_[v] = 1;
      next_[3 * v + i] = u[i];
    }
  }

  /// All lifts by one factor, so that no side loses too much; the triangle inequalities do not change.
  void scale_down() {
    const float most = tbb::parallel_reduce(
        Range(0, static_cast<std::uint32_t>(map_.vertex_count()), kGrain), 1.0F,
        [&](const Range& range, float found) {
          for (std::uint32_t v = range.begin(); v != range.end(); ++v) {
            found = std::max(found, corners_[v].largest_share(lifts_at(v)));
          }
          return found;
        },
        [](float a, float b) { return std::max(a, b); });
    if (most > 1) for_each(lifts_.size(), [&](std::uint32_t i) { lifts_[i] /= most; });
  }

  const HoneycombMap& map_;
  double share_;
  RawVector<Corner> corners_;
  RawVector<float> lifts_, next_;
  RawVector<std::uint32_t> partner_;       ///< the place of the other end's proposal
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
    return ProposedLifts{Relaxation(level, kept).run(edges)};
  };
}

}  // namespace hexact
