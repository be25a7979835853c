// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/snapped_honeycomb.hpp"
#include "four_lanes.hpp"
#include "instruction_sets.hpp"
#include "plane_determinants.hpp"
#include "point_signs.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace hexact {
namespace {

using Violations = std::vector<SignViolation>;

/// Sign of component `axis` of n_f × n_g.
int direction_sign(const IntegerPlanes& planes, std::size_t f, std::size_t g, int axis) {
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  if (planes.is_narrow(f) && planes.is_narrow(g)) {
    const auto& p = planes.narrow(f);
    const auto& q = planes.narrow(g);
    if (((detail::normal_spread(p) | detail::normal_spread(q)) >> 31) == 0) {
      const std::int64_t x = p[static_cast<std::size_t>(i)] * q[static_cast<std::size_t>(j)] -
                             p[static_cast<std::size_t>(j)] * q[static_cast<std::size_t>(i)];
      return x > 0 ? 1 : x < 0 ? -1 : 0;
    }
    const __int128 x = static_cast<__int128>(p[static_cast<std::size_t>(i)]) * q[static_cast<std::size_t>(j)] -
                       static_cast<__int128>(p[static_cast<std::size_t>(j)]) * q[static_cast<std::size_t>(i)];
    return x > 0 ? 1 : x < 0 ? -1 : 0;
  }
  const auto p = detail::big_row(planes[f]);
  const auto q = detail::big_row(planes[g]);
  return (p[static_cast<std::size_t>(i)] * q[static_cast<std::size_t>(j)] -
          p[static_cast<std::size_t>(j)] * q[static_cast<std::size_t>(i)]).sign();
}

/// An axis along which facet f is not perpendicular to all its edges: not that of the largest coefficient.
int turning_axis(const IntegerPlanes& planes, std::size_t f) {
  std::array<double, 3> n;
  if (planes.is_narrow(f)) {
    const auto& p = planes.narrow(f);
    n = {std::fabs(static_cast<double>(p[0])), std::fabs(static_cast<double>(p[1])),
         std::fabs(static_cast<double>(p[2]))};
  } else {
    const auto& p = planes.wide(f);
    n = {static_cast<double>(p.a.bit_length()), static_cast<double>(p.b.bit_length()),
         static_cast<double>(p.c.bit_length())};
  }
  return static_cast<int>((std::max_element(n.begin(), n.end()) - n.begin() + 1) % 3);
}

/// The edge directions of a polygon that turns once change their sign along any axis exactly twice.
bool turns_once(const HoneycombMap& map, const IntegerPlanes& planes, std::uint32_t f) {
  const int axis = turning_axis(planes, f);
  int first = 0, last = 0, changes = 0;
  const std::uint32_t start = map.facet_start(f);
  for (std::uint32_t h = start; h < start + map.facet_size(f); ++h) {
    const int s = direction_sign(planes, f, map.facet(map.twin(h)), axis);
    if (s == 0) continue;
    if (first == 0) first = s;
    if (last != 0 && s != last) ++changes;
    last = s;
  }
  if (first != last) ++changes;
  return changes == 2;
}

void check_vertex(const HoneycombMap& map, const IntegerPlanes& planes, std::uint32_t v, Violations& out) {
  const auto star = map.star(v);
  const std::array<std::uint32_t, 3> f = {map.facet(star[0]), map.facet(star[1]), map.facet(star[2])};
  if (detail::sign_det3(planes, f[0], f[1], f[2]) <= 0) out.push_back({SignViolation::Kind::corner, v});
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t h = star[i];
    if (h > map.twin(h)) continue;  // both ends give the same determinant
    const std::uint32_t far = map.facet(map.twin(map.next(h)));
    if (detail::sign_det4(planes, f[0], f[1], f[2], far) <= 0) out.push_back({SignViolation::Kind::edge, h});
  }
}

/// Whether the far plane at the target of h keeps its origin v strictly: d − n·v > 0, the sign of det4 over det3 > 0.
bool edge_is_strict(const SnappedLevel& level, std::uint32_t h, std::uint32_t far) {
  const std::uint32_t v = level.map.origin(h);
  const double error = level.errors[v];
  if (error < std::numeric_limits<double>::infinity()) {
    if (const int side = detail::side_by_point(level.planes, far, level.points[v], error); side != 0) return side > 0;
  }
  const auto f = level.map.facets_at(v);
  return detail::sign_det4(level.planes, f[0], f[1], f[2], far) > 0;
}

double coordinate(const Point3<double>& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Edges of the level, each given by its half-edge with the smaller number, collected until there are four to decide.
class EdgeBlock {
 public:
  explicit EdgeBlock(const SnappedLevel& level) : level_(level) {}
  [[gnu::always_inline]] bool add(std::uint32_t h) {
    const std::uint32_t far = level_.map.facet(level_.map.twin(level_.map.next(h)));
    half_edge_[count_] = h;
    far_[count_] = far;
    rows_[count_++] = &level_.planes.row(far);
    return count_ < 4 || decide_four();
  }
  bool finish() {
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!edge_is_strict(level_, half_edge_[i], far_[i])) return false;
    }
    count_ = 0;
    return true;
  }

 private:
  /// `side_by_point` for four edges at once; where a lane is not decided as strict, one after another.
  [[gnu::always_inline]] bool decide_four() {
    detail::FourPlanes p;
    detail::Four x, y, z, error;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t v = level_.map.origin(half_edge_[i]);
      const Point3<double>& q = level_.points[v];
      x[i] = q.x;
      y[i] = q.y;
      z[i] = q.z;
      error[i] = level_.errors[v];
    }
    if (!detail::load_planes(rows_, p)) return finish();
    using detail::magnitude;
    const detail::Four tx = p.a * x, ty = p.b * y, tz = p.c * z;
    const detail::Four value = p.d - tx - ty - tz;
    const detail::Four bound = ((magnitude(p.a) + magnitude(p.b) + magnitude(p.c)) * error +
                                0x1p-50 * (magnitude(tx) + magnitude(ty) + magnitude(tz) + magnitude(p.d))) * (1 + 0x1p-40);
    const detail::FourWords strict = value > bound;
    if ((strict[0] & strict[1] & strict[2] & strict[3]) == 0) return finish();
    count_ = 0;
    return true;
  }

  const SnappedLevel& level_;
  std::array<std::uint32_t, 4> half_edge_{}, far_{};
  std::array<const detail::Row*, 4> rows_{};
  std::uint32_t count_ = 0;
};

HEXACT_FOR_EACH_INSTRUCTION_SET
bool edges_are_strict(const SnappedLevel& level, std::uint32_t begin, std::uint32_t end) {
  EdgeBlock block(level);
  for (std::uint32_t h = begin; h < end; ++h) {
    if (h < level.map.twin(h) && !block.add(h)) return false;
  }
  return block.finish();
}

/// The strict edges of a facet run along n_f × n_g, so the difference of two corners has the signs of that direction
/// wherever it is larger than their errors.
bool facet_turns_once(const SnappedLevel& level, std::uint32_t f) {
  const HoneycombMap& map = level.map;
  const std::uint32_t start = map.facet_start(f), size = map.facet_size(f);
  const int axis = turning_axis(level.planes, f);
  int first = 0, last = 0, changes = 0;
  std::uint32_t v = map.origin(start);
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t h = start + i, next = i + 1 == size ? start : h + 1, w = map.origin(next);
    const double step = coordinate(level.points[w], axis) - coordinate(level.points[v], axis);
    const double error = (static_cast<double>(level.errors[v]) + static_cast<double>(level.errors[w])) * (1 + 0x1p-40);
    const int s = step > error ? 1 : step < -error ? -1 : direction_sign(level.planes, f, map.facet(map.twin(h)), axis);
    if (s != 0) {
      if (first == 0) first = s;
      if (last != 0 && s != last) ++changes;
      last = s;
    }
    v = w;
  }
  return changes + (first != last ? 1 : 0) == 2;
}

/// The same for the hexagons f … f + 3 at once; false also where a difference is within the errors.
[[gnu::always_inline]] inline bool four_hexagons_turn_once(const SnappedLevel& level, std::uint32_t f) {
  const HoneycombMap& map = level.map;
  detail::Four at[6], error[6];
  for (std::uint32_t k = 0; k < 4; ++k) {
    const int axis = turning_axis(level.planes, f + k);
    const std::uint32_t start = map.facet_start(f + k);
    for (std::uint32_t i = 0; i < 6; ++i) {
      const std::uint32_t v = map.origin(start + i);
      at[i][k] = coordinate(level.points[v], axis);
      error[i][k] = level.errors[v];
    }
  }
  detail::FourWords decided = {-1, -1, -1, -1}, rising[6];
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    const detail::Four step = at[j] - at[i], bound = (error[i] + error[j]) * (1 + 0x1p-40);
    rising[i] = step > bound;
    decided &= rising[i] | (step < -bound);
  }
  detail::FourWords changes = {0, 0, 0, 0};
  for (int i = 0; i < 6; ++i) changes -= rising[i] ^ rising[(i + 1) % 6];
  const detail::FourWords good = decided & (changes == detail::FourWords{2, 2, 2, 2});
  return (good[0] & good[1] & good[2] & good[3]) != 0;
}

HEXACT_FOR_EACH_INSTRUCTION_SET
bool facets_turn_once(const SnappedLevel& level, std::uint32_t begin, std::uint32_t end) {
  const auto base = static_cast<std::uint32_t>(level.map.base_facet_count());
  for (std::uint32_t f = begin; f < end;) {
    if (f >= base && end - f >= 4 && four_hexagons_turn_once(level, f)) {
      f += 4;
      continue;
    }
    for (const std::uint32_t stop = std::min(f + 4, end); f < stop; ++f) {
      if (!facet_turns_once(level, f)) return false;
    }
  }
  return true;
}

/// A finite error bound of a located vertex says that its det3 is positive.
bool corner_is_strict(const SnappedLevel& level, std::uint32_t v) {
  if (level.errors[v] < std::numeric_limits<float>::infinity()) return true;
  const auto f = level.map.facets_at(v);
  return detail::sign_det3(level.planes, f[0], f[1], f[2]) > 0;
}

bool corners_are_strict(const SnappedLevel& level, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t v = begin; v < end; ++v) {
    if (!corner_is_strict(level, v)) return false;
  }
  return true;
}

using RangeTest = bool (*)(const SnappedLevel&, std::uint32_t, std::uint32_t);

/// Whether the test holds for all ranges of [0, count).
bool holds_for_all(const SnappedLevel& level, std::size_t count, RangeTest test) {
  std::atomic<bool> holds{true};
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(count), 1 << 13), [&](const auto& range) {
    if (holds.load(std::memory_order_relaxed) && !test(level, range.begin(), range.end())) holds = false;
  });
  return holds;
}

template <class Check>
Violations collect(std::size_t count, std::size_t limit, const Check& check) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(count), 1 << 13), Violations{},
      [&](const tbb::blocked_range<std::uint32_t>& range, Violations found) {
        for (std::uint32_t i = range.begin(); i != range.end() && found.size() < limit; ++i) check(i, found);
        return found;
      },
      [&](Violations a, const Violations& b) {
        a.insert(a.end(), b.begin(), b.begin() + static_cast<std::ptrdiff_t>(std::min(b.size(), limit - std::min(limit, a.size()))));
        return a;
      });
}

}  // namespace

std::vector<SignViolation> sign_violations(const HoneycombMap& map, const IntegerPlanes& planes, std::size_t limit) {
  HEXACT_EXPECTS(planes.size() == map.facet_count());
  Violations found = collect(map.vertex_count(), limit, [&](std::uint32_t v, Violations& out) {
    check_vertex(map, planes, v, out);
  });
  const Violations turning = collect(map.facet_count(), limit, [&](std::uint32_t f, Violations& out) {
    if (!turns_once(map, planes, f)) out.push_back({SignViolation::Kind::turning, f});
  });
  found.insert(found.end(), turning.begin(), turning.end());
  if (found.size() > limit) found.resize(limit);
  return found;
}

std::vector<SignViolation> sign_violations(const SnappedLevel& level, std::size_t limit) {
  HEXACT_EXPECTS(level.planes.size() == level.map.facet_count());
  const bool holds = holds_for_all(level, level.map.vertex_count(), corners_are_strict) &&
                     holds_for_all(level, level.map.half_edge_count(), edges_are_strict) &&
                     holds_for_all(level, level.map.facet_count(), facets_turn_once);
  return holds ? Violations{} : sign_violations(level.map, level.planes, limit);
}

Finding explain(const SignViolation& violation, const HoneycombMap& map) {
  const std::string level = " at level " + std::to_string(map.level());
  if (violation.kind == SignViolation::Kind::corner) {
    return {"NotConvex", "is not a proper convex corner" + level, "vertex " + std::to_string(violation.element), {}};
  }
  if (violation.kind == SignViolation::Kind::turning) {
    return {"NotConvex", "does not turn exactly once" + level, "facet " + std::to_string(violation.element), {}};
  }
  const std::uint32_t h = violation.element;
  const std::uint32_t facet = std::min(map.facet(h), map.facet(map.twin(h)));
  if (map.level() > 0 && facet < map.base_facet_count() && map.facet_size(facet) <= 4) {
    const bool triangle = map.facet_size(facet) == 3;
    return {triangle ? "TriangleOvercut" : "QuadCollapse", "collapses" + level, "facet " + std::to_string(facet), {}};
  }
  return {map.level() > 0 ? "EdgeCollapse" : "NotConvex",
          (map.level() > 0 ? "collapses" : "is not strictly convex") + level,
          "edge " + std::to_string(map.origin(h)) + "-" + std::to_string(map.target(h)), {}};
}

}  // namespace hexact
