// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/policies.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

namespace hexact {
namespace {

[[noreturn]] void reject(std::string_view text, const std::string& reason) {
  throw InvalidInput("BadParameters", "--parameters " + std::string(text) + ": " + reason, "");
}

std::uint64_t splitmix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// phs (21), with the values that are rational (N₀ = 6 and n = 3, 4, 6) exactly.
Rational equal_u_value(std::size_t n, std::size_t n0) {
  if (n == n0) return Rational(0);
  if (n0 == 6 && n == 3) return Rational(Integer(2), Integer(5));
  if (n0 == 6 && n == 4) return Rational(Integer(1), Integer(4));
  const double ratio = std::cos(std::numbers::pi / static_cast<double>(n)) /
                       std::cos(std::numbers::pi / static_cast<double>(n0));
  const double tau = ratio * ratio;
  return Rational(static_cast<long long>(std::llround(std::ldexp((1 - tau) / (2 - tau), 40)))).scaled(-40);
}

QuadraticField parse_number(std::string_view text, std::string_view whole, Arithmetic arithmetic) {
  Rational value;
  if (Rational::parse(text, value) == Rational::ParseResult::ok) return value;
  QuadraticField in_field;
  if (arithmetic == Arithmetic::qsqrt5 && QuadraticField::parse(text, in_field)) return in_field;
  reject(whole, "'" + std::string(text) + "' is not a number");
}

std::map<std::size_t, QuadraticField> parse_sizes(std::string_view list, std::string_view whole, Arithmetic arithmetic) {
  std::map<std::size_t, QuadraticField> sizes;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string_view entry = list.substr(0, comma);
    list.remove_prefix(std::min(comma + 1, list.size()));
    const std::size_t colon = entry.find(':');
    if (colon == std::string_view::npos) reject(whole, "expected SIZE:NUMBER, found '" + std::string(entry) + "'");
    unsigned size = 0;
    const auto [end, error] = std::from_chars(entry.data(), entry.data() + colon, size);
    if (error != std::errc{} || end != entry.data() + colon || size < 3 || size > 1000) {
      reject(whole, "a facet size is a number from 3 to 1000, found '" + std::string(entry.substr(0, colon)) + "'");
    }
    if (!sizes.emplace(size, parse_number(entry.substr(colon + 1), whole, arithmetic)).second) {
      reject(whole, "size " + std::to_string(size) + " is given twice");
    }
  }
  if (sizes.empty()) reject(whole, "there is no number");
  return sizes;
}

struct UnitPlane {
  std::array<double, 3> n;
  double d;
};

/// The facet planes with unit normals, in file coordinates.
std::vector<UnitPlane> unit_planes(const PlaneBody& body) {
  std::vector<UnitPlane> planes;
  const auto add = [&](std::array<double, 3> n, double d) {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (double& x : n) x /= length;
    double offset = std::ldexp(d / length, static_cast<int>(body.scale));
    for (std::size_t k = 0; k < 3; ++k) offset += n[k] * body.shift[k].to_double();
    planes.push_back({n, offset});
  };
  for (std::size_t f = 0; f < body.plane_count(); ++f) {
    if (body.loops[f].empty()) continue;
    if (body.field == Field::sqrt5) {
      const auto& p = body.planes_sqrt5[f];
      add({p.a.to_double(), p.b.to_double(), p.c.to_double()}, p.d.to_double());
    } else {
      const Plane<Integer> p = body.planes[f];
      const Rational size(std::max({p.a * p.a, p.b * p.b, p.c * p.c}));
      const auto bits = static_cast<long>(size.numerator().bit_length() / 2);
      const auto entry = [bits](const Integer& x) { return Rational(x).scaled(-bits).to_double(); };
      add({entry(p.a), entry(p.b), entry(p.c)}, entry(p.d));
    }
  }
  return planes;
}

/// Solves the normal equations of rows·x ≈ right by elimination with pivots. Throws NumericalFailure when singular.
template <std::size_t N>
std::array<double, N> least_squares(const std::vector<std::array<double, N>>& rows, const std::vector<double>& right) {
  std::array<std::array<double, N + 1>, N> m{};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) m[i][j] += rows[r][i] * rows[r][j];
      m[i][N] += rows[r][i] * right[r];
    }
  }
  for (std::size_t i = 0; i < N; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i + 1; r < N; ++r) {
      if (std::fabs(m[r][i]) > std::fabs(m[pivot][i])) pivot = r;
    }
    std::swap(m[i], m[pivot]);
    if (!(std::fabs(m[i][i]) > 1e-12)) throw NumericalFailure("the facets do not determine a body to be tangent to");
    for (std::size_t r = 0; r < N; ++r) {
      if (r == i) continue;
      const double factor = m[r][i] / m[i][i];
      for (std::size_t k = i; k <= N; ++k) m[r][k] -= factor * m[i][k];
    }
  }
  std::array<double, N> x;
  for (std::size_t i = 0; i < N; ++i) x[i] = m[i][N] / m[i][i];
  return x;
}

/// Scales an ellipsoid about its centre by the largest factor that keeps it inside all planes.
Ellipsoid shrunk_into(Ellipsoid e, const std::vector<UnitPlane>& planes) {
  double factor = std::numeric_limits<double>::infinity();
  for (const UnitPlane& p : planes) {
    const double to_centre = p.n[0] * e.centre[0] + p.n[1] * e.centre[1] + p.n[2] * e.centre[2];
    factor = std::min(factor, (p.d - to_centre) / (e.support(p.n) - to_centre));
  }
  // Outward by more than the rounding here, so that planes through a point of the surface never cut too deep.
  constexpr double kOutward = 1 + 0x1p-42;
  if (!(factor > 0) || !std::isfinite(factor)) throw NumericalFailure("no body to be tangent to fits into the solid");
  for (auto& row : e.q) {
    for (double& x : row) x *= factor * factor * kOutward;
  }
  return e;
}

PolicySchedule always(CutPolicy policy) {
  return [policy = std::move(policy)](const HoneycombMap&) { return policy; };
}

std::size_t largest_facet(const PlaneBody& body) {
  std::size_t n = 0;
  for (std::size_t f = 0; f < body.loops.size(); ++f) n = std::max(n, body.loops[f].size());
  return n;
}

}  // namespace

SizePolicy static_policy(Arithmetic arithmetic) {
  return arithmetic == Arithmetic::qsqrt5 || arithmetic == Arithmetic::floating ? static_policy_sqrt5()
                                                                                 : static_policy_rational();
}

SizePolicy equal_u_policy(std::size_t largest) {
  const std::size_t n0 = std::max<std::size_t>(largest, 6);
  SizePolicy policy{std::vector<QuadraticField>(n0 + 1)};
  for (std::size_t n = 3; n <= n0; ++n) policy.by_size[n] = equal_u_value(n, n0);
  return policy;
}

SizePolicy constant_policy(const std::map<std::size_t, QuadraticField>& by_size) {
  HEXACT_EXPECTS(!by_size.empty());
  SizePolicy policy;
  QuadraticField value = by_size.begin()->second;
  for (std::size_t n = 0; n <= by_size.rbegin()->first; ++n) {
    if (const auto found = by_size.find(n); found != by_size.end()) value = found->second;
    policy.by_size.push_back(value);
  }
  return policy;
}

std::vector<std::uint32_t> edge_ranks(const HoneycombMap& map) {
  const std::size_t vertices = map.vertex_count();
  std::vector<std::uint32_t> first(vertices + 1, 0), ranks(map.half_edge_count());
  for (std::uint32_t v = 0; v < vertices; ++v) {
    for (const std::uint32_t h : map.star(v)) first[v + 1] += map.target(h) > v ? 1 : 0;
    first[v + 1] += first[v];
  }
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const auto star = map.star(v);
    for (const std::uint32_t h : star) {
      const std::uint32_t w = map.target(h);
      if (w < v) continue;
      std::uint32_t rank = first[v];
      for (const std::uint32_t other : star) rank += map.target(other) > v && map.target(other) < w ? 1 : 0;
      ranks[h] = ranks[map.twin(h)] = rank;
    }
  }
  return ranks;
}

HalfEdgePolicy random_policy(const HoneycombMap& map, std::uint64_t seed) {
  const auto ranks = std::make_shared<const std::vector<std::uint32_t>>(edge_ranks(map));
  const std::uint64_t of_level = splitmix64(splitmix64(seed) ^ map.level());
  return [ranks, of_level](const HoneycombMap& m, HalfEdgeId id) -> QuadraticField {
    const auto h = static_cast<std::uint32_t>(id);
    const long long k = 1 + static_cast<long long>(splitmix64(of_level ^ (*ranks)[h]) % 255);
    const bool triangle = std::min(m.facet_size(m.facet(h)), m.facet_size(m.facet(m.twin(h)))) == 3;
    // lo + (1/2 − lo)·k/256 with lo = 1/3 or 0.
    return triangle ? Rational(Integer(512 + k), Integer(1536)) : Rational(Integer(k), Integer(512));
  };
}

double Ellipsoid::support(const std::array<double, 3>& n) const {
  double quadratic = 0, linear = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    linear += n[i] * centre[i];
    for (std::size_t j = 0; j < 3; ++j) quadratic += n[i] * q[i][j] * n[j];
  }
  return linear + std::sqrt(quadratic);
}

PlanePolicy tangent_policy(const Ellipsoid& ellipsoid) {
  return {[](const CornerView& view) {
            std::array<double, 3> n{};
            for (const auto& u : view.unit_normals) {
              for (std::size_t k = 0; k < 3; ++k) n[k] += u[k];
            }
            return n;
          },
          [ellipsoid](const std::array<double, 3>& n) { return ellipsoid.support(n); }};
}

Ellipsoid fitted_sphere(const PlaneBody& body) {
  const std::vector<UnitPlane> planes = unit_planes(body);
  std::vector<std::array<double, 4>> rows;
  std::vector<double> right;
  for (const UnitPlane& p : planes) {
    rows.push_back({p.n[0], p.n[1], p.n[2], 1});
    right.push_back(p.d);
  }
  const auto x = least_squares<4>(rows, right);
  Ellipsoid sphere{{x[0], x[1], x[2]}, {}};
  for (std::size_t k = 0; k < 3; ++k) sphere.q[k][k] = x[3] * x[3];
  return shrunk_into(sphere, planes);
}

Ellipsoid fitted_ellipsoid(const PlaneBody& body) {
  const std::vector<UnitPlane> planes = unit_planes(body);
  const Ellipsoid start = fitted_sphere(body);  // its centre is inside the solid
  std::vector<std::array<double, 6>> rows;
  std::vector<double> right;
  for (const UnitPlane& p : planes) {
    const auto& n = p.n;
    const double reach = p.d - n[0] * start.centre[0] - n[1] * start.centre[1] - n[2] * start.centre[2];
    rows.push_back({n[0] * n[0], n[1] * n[1], n[2] * n[2], 2 * n[0] * n[1], 2 * n[0] * n[2], 2 * n[1] * n[2]});
    right.push_back(reach * reach);
  }
  const double size = *std::max_element(right.begin(), right.end());
  // A small pull towards the sphere decides what few facets leave open, as the products of a box's normals do.
  const double pull = 1e-4;
  const double sphere = start.q[0][0];
  for (std::size_t k = 0; k < 6; ++k) {
    std::array<double, 6> row{};
    row[k] = pull;
    rows.push_back(row);
    right.push_back(k < 3 ? pull * sphere : 0);
  }
  const auto x = least_squares<6>(rows, right);
  const Ellipsoid fitted{start.centre, {{{x[0], x[3], x[4]}, {x[3], x[1], x[5]}, {x[4], x[5], x[2]}}}};
  const double minor = x[0] * x[1] - x[3] * x[3];
  const double det = x[0] * (x[1] * x[2] - x[5] * x[5]) - x[3] * (x[3] * x[2] - x[5] * x[4]) + x[4] * (x[3] * x[5] - x[1] * x[4]);
  if (!(x[0] > 1e-9 * size) || !(minor > 0) || !(det > 0)) {
    throw NumericalFailure("the facets do not determine an ellipsoid to be tangent to");
  }
  return shrunk_into(fitted, planes);
}

PolicySchedule parse_policy(std::string_view text, Arithmetic arithmetic, const PlaneBody& base) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? std::string_view{} : text.substr(equals + 1);
  if (text == "static") return always(static_policy(arithmetic));
  if (text == "equal-u") return always(equal_u_policy(largest_facet(base)));
  if (text == "tangent=sphere") return always(tangent_policy(fitted_sphere(base)));
  if (text == "tangent=ellipsoid") return always(tangent_policy(fitted_ellipsoid(base)));
  if (name == "constant" && value.find(':') == std::string_view::npos) {
    return always(SizePolicy{{parse_number(value, text, arithmetic)}});
  }
  if (name == "constant") return always(constant_policy(parse_sizes(value, text, arithmetic)));
  if (name == "random") {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), seed);
    if (value.empty() || error != std::errc{} || end != value.data() + value.size()) reject(text, "the seed is not a 64-bit number");
    return [seed](const HoneycombMap& map) { return CutPolicy(random_policy(map, seed)); };
  }
  reject(text, "there is no such policy");
}

}  // namespace hexact
