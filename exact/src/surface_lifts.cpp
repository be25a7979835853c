// SPDX-License-Identifier: LGPL-3.0-or-later
#include "surface_step.hpp"

#include <algorithm>
#include <cmath>

// Lifts that floating point proposes for a chamfer surface.
namespace hexact {
namespace {

using namespace detail;

constexpr double kShare = 0.2;        // of the shortest edge beside
constexpr double kTriangle = 0.9;     // of the sum of the other two lifts at a vertex
constexpr int kRounds = 60;
constexpr long kLiftBits = 14;        // kept of a lift
constexpr long kStartBits = 24;       // of the smallest lift at the first step

Point3<double> difference(const Point3<double>& p, const Point3<double>& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
double length(const Point3<double>& p) { return std::hypot(p.x, p.y, p.z); }
Point3<double> cross_product(const Point3<double>& p, const Point3<double>& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

/// Length of the scaled normals as mantissa·2^exponent, and unit normals.
struct Normals {
  std::vector<Point3<double>> unit;
  double mantissa = 0;
  long exponent = 0;

  explicit Normals(const IntegerPlanes& planes) {
    for (std::size_t f = 0; f < planes.size(); ++f) {
      const Plane<Integer> p = planes[f];
      exponent = std::max(exponent, static_cast<long>(std::max({p.a.bit_length(), p.b.bit_length(), p.c.bit_length()})));
    }
    for (std::size_t f = 0; f < planes.size(); ++f) {
      const Plane<Integer> p = planes[f];
      const auto entry = [&](const Integer& x) { return Rational(x).scaled(-exponent).to_double(); };
      const Point3<double> n{entry(p.a), entry(p.b), entry(p.c)};
      const double l = length(n);
      mantissa = std::max(mantissa, l);
      unit.push_back({n.x / l, n.y / l, n.z / l});
    }
  }
};

/// Magnitudes of lifts over the length of the normals.
std::vector<double> first_proposal(const ChamferSurface& surface, const SurfaceMap& map, const Normals& normals) {
  PlaneBody body = surface.body;
  body.scale = 0;
  body.shift = {};
  const std::vector<Point3<double>> points = rounded_vertices(body).points;
  const std::size_t count = map.edges.half_edge.size();
  std::vector<double> side(count), out(count);
  const auto half_edge = [&](std::size_t e) { return map.edges.half_edge[e]; };
  for (std::size_t e = 0; e < count; ++e) {
    side[e] = length(difference(points[map.half_edges.origin[half_edge(e)]], points[map.half_edges.target(half_edge(e))]));
  }
  for (std::size_t e = 0; e < count; ++e) {
    const std::uint32_t h = half_edge(e);
    double shortest = side[e];
    for (const std::size_t v : {std::size_t{map.half_edges.origin[h]}, std::size_t{map.half_edges.target(h)}}) {
      for (const std::uint32_t k : map.at_vertex[v]) {
        if (k != kNoTwin) shortest = std::min(shortest, side[k]);
      }
    }
    out[e] = kShare * shortest * length(cross_product(normals.unit[map.half_edges.facet[h]], normals.unit[surface.right[h]]));
  }
  return out;
}

/// Lowers lifts until the triangle inequalities hold with room at every vertex, all of them from those of the round before.
void lower_to_triangles(const SurfaceMap& map, std::vector<double>& lifts) {
  for (int round = 0; round < 300; ++round) {
    std::vector<double> lower = lifts;
    bool changed = false;
    for (const auto& e : map.at_vertex) {
      if (e[2] == kNoTwin) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const double bound = kTriangle * (lifts[e[(i + 1) % 3]] + lifts[e[(i + 2) % 3]]);
        if (lifts[e[i]] <= bound * (1 + 1e-6)) continue;
        lower[e[i]] = std::min(lower[e[i]], bound);
        changed = true;
      }
    }
    lifts = std::move(lower);
    if (!changed) return;
  }
  // All equal is always feasible.
  const double least = *std::min_element(lifts.begin(), lifts.end());
  std::fill(lifts.begin(), lifts.end(), least);
}

void multiply_planes(ChamferSurface& surface, unsigned long power) {
  IntegerPlanes out;
  out.reserve(surface.body.planes.size());
  for (std::size_t f = 0; f < surface.body.planes.size(); ++f) {
    const Plane<Integer> p = surface.body.planes[f];
    out.push_back(Plane<Integer>{p.a.shifted_left(power), p.b.shifted_left(power), p.c.shifted_left(power), p.d.shifted_left(power)});
  }
  surface.body.planes = std::move(out);
}

/// Rounded down to kLiftBits bits of the smallest one, with the signs of the edges. Widens the planes where the smallest
/// has fewer bits than `wanted`.
std::vector<Integer> rounded_lifts(ChamferSurface& surface, const SurfaceMap& map, const std::vector<double>& lifts, Normals& normals, long wanted) {
  const double least = *std::min_element(lifts.begin(), lifts.end());
  if (!(least > 0)) throw NumericalFailure("a lift vanishes at level " + std::to_string(surface.level));
  long bits = std::ilogb(least * normals.mantissa) + normals.exponent;
  if (bits < wanted) {
    multiply_planes(surface, static_cast<unsigned long>(wanted - bits));
    normals.exponent += wanted - bits;
    bits = wanted;
  }
  const long unit = std::max(0L, bits - kLiftBits);
  std::vector<Integer> out;
  for (std::size_t e = 0; e < lifts.size(); ++e) {
    const Rational exact = Rational::from_double(lifts[e] * normals.mantissa).scaled(normals.exponent - unit);
    const Integer magnitude = floor_quotient(exact.numerator(), exact.denominator()).shifted_left(static_cast<unsigned long>(unit));
    out.push_back(surface.sign[map.edges.half_edge[e]] < 0 ? -magnitude : magnitude);
  }
  return out;
}

}  // namespace

ChamferSurface chamfer_surface_step(const ChamferSurface& surface) {
  ChamferSurface level = surface;
  const SurfaceMap map(level);
  Normals normals(level.body.planes);
  std::vector<double> proposal = first_proposal(level, map, normals);
  std::vector<SurfaceFault> faults;
  for (int round = 0; round < kRounds; ++round) {
    lower_to_triangles(map, proposal);
    const std::vector<Integer> lifts = rounded_lifts(level, map, proposal, normals, level.level == 0 && round == 0 ? kStartBits : kLiftBits);
    faults = lift_faults(level, map, lifts);
    if (faults.empty()) {
      ChamferSurface next = cut_edges(level, map, lifts);
      faults = cut_faults(level, map, next);
      if (faults.empty()) return next;
    }
    std::vector<char> lower(proposal.size(), 0);
    for (const SurfaceFault& f : faults) {
      for (const std::uint32_t e : f.edges) {
        if (e != kNoTwin) lower[e] = 1;
      }
    }
    for (std::size_t e = 0; e < lower.size(); ++e) {
      if (lower[e] != 0) proposal[e] /= 2;
    }
  }
  throw NumericalFailure("no lifts were found at level " + std::to_string(surface.level) + "; " + faults.front().finding.element + ": " +
                         faults.front().finding.message);
}

}  // namespace hexact
