// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/chamfer.hpp"

#include "chamfer_scaling.hpp"
#include "snapped_vertices.hpp"
#include "plane_determinants.hpp"
#include "point_signs.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hexact {
namespace {

using Range = tbb::blocked_range<std::uint32_t>;
constexpr std::size_t kGrain = 1 << 12;
constexpr std::size_t kLimit = 16;  // findings of one kind
/// Fewest bits of a lift that floating point proposed.
constexpr long kLeastLiftBits = 12;
/// More of them at the first step, for lifts that become smaller: later steps then widen planes by one bit only.
constexpr long kSpareLiftBits = 12;

std::string edge_name(const HoneycombMap& map, const EdgeNumbering& edges, std::uint32_t e) {
  const std::uint32_t h = edges.half_edge[e];
  return "edge " + std::to_string(map.origin(h)) + "-" + std::to_string(map.target(h));
}

std::string at_level(const HoneycombMap& map) { return " at level " + std::to_string(map.level()); }

template <class Visit>
void for_each(std::size_t count, const Visit& visit) {
  tbb::parallel_for(Range(0, static_cast<std::uint32_t>(count), kGrain), [&](const Range& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) visit(i);
  });
}

using Numbers = std::vector<std::uint32_t>;

/// The elements for which `test` fails, in order, at most kLimit. `prepare` is called for a range before its tests.
template <class Test, class Prepare>
Numbers failures(std::size_t count, const Test& test, const Prepare& prepare) {
  return tbb::parallel_deterministic_reduce(
      Range(0, static_cast<std::uint32_t>(count), kGrain), Numbers{},
      [&](const Range& range, Numbers found) {
        prepare(range);
        for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
          if (!test(i) && found.size() < kLimit) found.push_back(i);
        }
        return found;
      },
      [](Numbers a, const Numbers& b) {
        a.insert(a.end(), b.begin(), b.begin() + static_cast<std::ptrdiff_t>(std::min(b.size(), kLimit - a.size())));
        return a;
      });
}

template <class Test>
Numbers failures(std::size_t count, const Test& test) {
  return failures(count, test, [](const Range&) {});
}

// ---------------------------------------------------------------------------------------------- integer lifts

/// Lifts of a step: machine words while scaled planes fit them, big integers otherwise.
struct IntegerLifts {
  RawVector<std::int64_t> words;
  std::vector<Integer> integers;
  Integer largest;

  [[nodiscard]] bool are_words() const noexcept { return integers.empty(); }
  [[nodiscard]] Integer operator[](std::uint32_t e) const { return are_words() ? Integer(words[e]) : integers[e]; }
};

void require_count(std::size_t found, std::size_t edges, const HoneycombMap& map) {
  if (found == edges) return;
  throw InvalidInput("BadLifts", std::to_string(found) + " lifts are given, there are " + std::to_string(edges) + " edges" +
                                     at_level(map), "");
}

void multiply_scaling(ChamferLevel& level, const Integer& factor) {
  if (factor == Integer(1)) return;
  for (Integer& w : level.weights) w *= factor;
  level.normal_bound *= factor;
  level.offset_bound *= factor;
  long e = 0;
  level.unit_mantissa *= mpz_get_d_2exp(&e, factor.raw());
  int shift = 0;
  level.unit_mantissa = std::frexp(level.unit_mantissa, &shift);
  level.unit_exponent += e + shift;
}

/// floor(x · 2^exponent) for finite x.
Integer floor_scaled(double x, long exponent) {
  int e = 0;
  const auto mantissa = static_cast<long long>(std::ldexp(std::frexp(x, &e), 53));
  const long shift = exponent + e - 53;
  if (shift >= 0) return Integer(mantissa).shifted_left(static_cast<unsigned long>(shift));
  return floor_quotient(Integer(mantissa), Integer::power_of_two(static_cast<unsigned long>(std::min(-shift, 64L))));
}

/// Rounds proposals down. The scaling of the level grows where the smallest would have too few bits.
IntegerLifts integer_lifts(const ProposedLifts& proposed, ChamferLevel& level, std::size_t edges) {
  const RawVector<double>& x = proposed.lengths;
  require_count(x.size(), edges, level.surface.map);
  const double infinity = std::numeric_limits<double>::infinity();
  struct Extent {
    double least, most;
  };
  const Extent extent = tbb::parallel_reduce(
      Range(0, static_cast<std::uint32_t>(edges), kGrain), Extent{infinity, 0},
      [&](const Range& range, Extent found) {
        for (std::uint32_t e = range.begin(); e != range.end(); ++e) {
          if (!(x[e] >= found.least)) found.least = x[e];  // keeps what is no number
          found.most = std::max(found.most, x[e]);
        }
        return found;
      },
      [](const Extent& a, const Extent& b) { return Extent{b.least >= a.least ? a.least : b.least, std::max(a.most, b.most)}; });
  if (!(extent.least > 0) || !(extent.most < infinity)) {
    throw NumericalFailure("a rule proposed a lift that is not positive" + at_level(level.surface.map));
  }
  const long bits = std::ilogb(extent.least * level.unit_mantissa) + level.unit_exponent;
  const long wanted = kLeastLiftBits + (level.weights.size() == 1 ? kSpareLiftBits : 0);
  if (bits < wanted) multiply_scaling(level, Integer::power_of_two(static_cast<unsigned long>(wanted - bits)));
  IntegerLifts lifts;
  lifts.largest = floor_scaled(extent.most * level.unit_mantissa, level.unit_exponent);
  if (lifts.largest.bit_length() <= 62) {
    const double unit = std::ldexp(level.unit_mantissa, static_cast<int>(level.unit_exponent));
    lifts.words.resize(edges);
    for_each(edges, [&](std::uint32_t e) { lifts.words[e] = static_cast<std::int64_t>(x[e] * unit); });
    return lifts;
  }
  lifts.integers.resize(edges);
  for_each(edges, [&](std::uint32_t e) { lifts.integers[e] = floor_scaled(x[e] * level.unit_mantissa, level.unit_exponent); });
  return lifts;
}

/// Exact lifts times the unit of the level, and times the common denominator that makes them integers.
IntegerLifts integer_lifts(const ExactLifts& exact, ChamferLevel& level, std::size_t edges) {
  require_count(exact.values.size(), edges, level.surface.map);
  const Rational unit = lift_scale(level).unit;
  Integer denominator(1);
  for (const Rational& x : exact.values) denominator = lcm(denominator, (x * unit).denominator());
  multiply_scaling(level, denominator);
  const Rational scaled_unit = unit * Rational(denominator);
  IntegerLifts lifts;
  lifts.integers.reserve(edges);
  for (const Rational& x : exact.values) {
    lifts.integers.push_back((x * scaled_unit).numerator());
    lifts.largest = std::max(lifts.largest, lifts.integers.back());
  }
  const bool short_enough = std::all_of(lifts.integers.begin(), lifts.integers.end(),
                                        [](const Integer& x) { return x.bit_length() <= 62; });
  if (!short_enough) return lifts;
  lifts.words.resize(edges);
  for (std::size_t e = 0; e < edges; ++e) lifts.words[e] = lifts.integers[e].to_int64();
  lifts.integers.clear();
  return lifts;
}

// ---------------------------------------------------------------------------------------------- condition 1

template <class Number>
bool is_triangle(const Number& a, const Number& b, const Number& c) {
  return a < b + c && b < c + a && c < a + b;
}

void require_triangles(const ChamferLevel& level, const EdgeNumbering& edges, const IntegerLifts& lifts) {
  const HoneycombMap& map = level.surface.map;
  std::vector<Finding> findings;
  const auto text = [&](std::uint32_t e) { return (Rational(lifts[e]) / lift_scale(level).unit).str(); };  // as in documents
  const auto is_positive = [&](std::uint32_t e) { return lifts.are_words() ? lifts.words[e] > 0 : lifts.integers[e].sign() > 0; };
  for (const std::uint32_t e : failures(map.edge_count(), is_positive)) {
    findings.push_back({"LiftNotPositive", "its lift" + at_level(map) + " is " + text(e) + ", expected a positive number",
                        edge_name(map, edges, e), {}});
  }
  const auto holds = [&](std::uint32_t v) {
    const auto& e = edges.at_vertex[v];
    if (lifts.are_words()) return is_triangle(lifts.words[e[0]], lifts.words[e[1]], lifts.words[e[2]]);
    return is_triangle(lifts.integers[e[0]], lifts.integers[e[1]], lifts.integers[e[2]]);
  };
  for (const std::uint32_t v : failures(map.vertex_count(), holds)) {
    const auto& e = edges.at_vertex[v];
    findings.push_back({"TriangleInequality",
                        "the lifts " + text(e[0]) + ", " + text(e[1]) + ", " + text(e[2]) + " of its edges" +
                            at_level(map) + " have to be smaller each than the sum of the other two",
                        "vertex " + std::to_string(v), {}});
  }
  if (!findings.empty()) throw InvalidInput(std::move(findings));
}

// ---------------------------------------------------------------------------------------------- planes

void add_planes(ChamferLevel& level, const EdgeNumbering& edges, const IntegerLifts& lifts) {
  const HoneycombMap& map = level.surface.map;
  const auto facets = static_cast<std::uint32_t>(map.facet_count());
  const detail::Coefficients coefficients(level);
  IntegerPlanes& planes = level.surface.planes;
  planes.resize(facets + map.edge_count());
  level.normal_bound *= Integer(2);
  level.offset_bound = level.offset_bound * Integer(2) + lifts.largest;
  const bool words = coefficients.are_words() && lifts.are_words() && level.normal_bound.bit_length() <= 62 &&
                     level.offset_bound.bit_length() <= 62 && planes.wide_count() == 0;
  if (words) {
    for_each(map.edge_count(), [&](std::uint32_t e) {
      const std::uint32_t h = edges.half_edge[e], f = map.facet(h), g = map.facet(map.twin(h));
      const std::int64_t kf = coefficients.word(f), kg = coefficients.word(g);
      const auto &p = planes.narrow(f), &q = planes.narrow(g);
      planes.set(facets + e, IntegerPlanes::Narrow{kf * p[0] + kg * q[0], kf * p[1] + kg * q[1], kf * p[2] + kg * q[2],
                                                  kf * p[3] + kg * q[3] - lifts.words[e]});
    });
    return;
  }
  std::vector<Plane<Integer>> made(map.edge_count());
  for_each(map.edge_count(), [&](std::uint32_t e) {
    const std::uint32_t h = edges.half_edge[e], f = map.facet(h), g = map.facet(map.twin(h));
    const Integer kf = coefficients.integer(f), kg = coefficients.integer(g);
    const Plane<Integer> p = planes[f], q = planes[g];
    made[e] = {kf * p.a + kg * q.a, kf * p.b + kg * q.b, kf * p.c + kg * q.c, kf * p.d + kg * q.d - lifts[e]};
  });
  for (std::uint32_t e = 0; e < made.size(); ++e) planes.set(facets + e, made[e]);
}

// ---------------------------------------------------------------------------------------------- vertices

struct Vertices {
  RawVector<Point3<double>> points;
  RawVector<float> errors;
};

/// The corner of half-edge h is the point of its facet and of the planes that cut its edge and the edge before. It has
/// to lie strictly inside the plane that cuts the next edge: that is condition 2 for the side of h.
bool side_is_positive(const IntegerPlanes& planes, const std::array<std::uint32_t, 3>& corner, std::uint32_t far,
                      const Point3<double>& point, float error) {
  if (error < std::numeric_limits<float>::infinity()) {
    if (const int side = detail::side_by_point(planes, far, point, static_cast<double>(error)); side != 0) return side > 0;
  }
  return detail::sign_det4(planes, corner[0], corner[1], corner[2], far) > 0;
}

/// Finds all vertices of the next level and decides condition 2 on the way.
Vertices locate_vertices(const SnappedLevel& old, const IntegerPlanes& planes, const EdgeNumbering& edges) {
  const HoneycombMap& map = old.map;
  const auto facets = static_cast<std::uint32_t>(map.facet_count());
  const auto half_edges = static_cast<std::uint32_t>(map.half_edge_count());
  const auto vertices = static_cast<std::uint32_t>(map.vertex_count());
  Vertices out;
  out.points.resize(half_edges + vertices);
  out.errors.resize(half_edges + vertices);
  // Planes and old points lie scattered in memory: those of elements to come are fetched ahead.
  constexpr std::uint32_t kAhead = 24;
  const auto cut = [&](std::uint32_t h) { return facets + edges.edge[h]; };
  const auto planes_of = [&](std::uint32_t h) -> std::array<std::uint32_t, 3> {
    return {map.facet(h), cut(map.previous(h)), cut(h)};
  };
  const auto corner_of_half_edge = [&](std::uint32_t h) {
    if (h + kAhead < half_edges) {
      __builtin_prefetch(&planes.narrow(cut(h + kAhead)));
      __builtin_prefetch(&old.points[map.origin(h + kAhead)]);
    }
    return detail::Corner{planes_of(h), old.points[map.origin(h)]};
  };
  const Numbers collapsed = failures(
      half_edges,
      [&](std::uint32_t h) { return side_is_positive(planes, planes_of(h), cut(map.next(h)), out.points[h], out.errors[h]); },
      [&](const Range& range) {
        detail::locate_range(planes, range.begin(), range.end(), corner_of_half_edge, out.points, out.errors);
      });
  if (!collapsed.empty()) {
    std::vector<Finding> findings;
    for (const std::uint32_t h : collapsed) {
      findings.push_back({"SideCollapse",
                          "its side in facet " + std::to_string(map.facet(h)) + " keeps no positive length under the lifts" +
                              at_level(map), edge_name(map, edges, edges.edge[h]), {}});
    }
    throw InvalidInput(std::move(findings));
  }
  const auto corner_of_vertex = [&](std::uint32_t i) {
    const std::uint32_t v = i - half_edges;
    if (v + kAhead < vertices) {
      for (const std::uint32_t e : edges.at_vertex[v + kAhead]) __builtin_prefetch(&planes.narrow(facets + e));
    }
    const auto& e = edges.at_vertex[v];
    return detail::Corner{{facets + e[0], facets + e[1], facets + e[2]}, old.points[v]};
  };
  tbb::parallel_for(Range(half_edges, half_edges + vertices, kGrain), [&](const Range& range) {
    detail::locate_range(planes, range.begin(), range.end(), corner_of_vertex, out.points, out.errors);
  });
  return out;
}

}  // namespace

ChamferLevel chamfer_step(ChamferLevel level, const LiftRule& rule) {
  EdgeNumbering edges = number_edges(level.surface.map);
  {
    const Lifts asked = rule(level, edges);
    const IntegerLifts lifts =
        std::visit([&](const auto& x) { return integer_lifts(x, level, level.surface.map.edge_count()); }, asked);
    require_triangles(level, edges, lifts);
    add_planes(level, edges, lifts);
  }
  Vertices vertices = locate_vertices(level.surface, level.surface.planes, edges);
  level.surface.points = std::move(vertices.points);
  level.surface.errors = std::move(vertices.errors);
  edges.at_vertex = {};  // not needed for the map, whose making is the peak of memory
  level.surface.map = level.surface.map.refined_at_edges(edges);
  for (Integer& w : level.weights) w *= Integer(2);
  level.weights.push_back(Integer(1));
  level.unit_exponent += 1;
  return level;
}

}  // namespace hexact
