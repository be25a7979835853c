// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/midedge_limit.hpp"

#include "hexact/exact/midedge_boundary_limit.hpp"
#include "midedge_operator.hpp"
#include "midedge_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace hexact {

using detail::Complex;
using detail::FixedInterval;
using detail::kNet;

/// Weights l_r of the tangent functional Σ_s ω^-s Σ_r l_r P(s, r); of the corners alone under the simple rule.
struct MidedgeLimits::Tangent {
  std::vector<Complex<FixedInterval>> turns;  ///< ω^-s
  std::variant<detail::NetVector<FixedInterval>, detail::NetVector<Rational>> weights;
  std::size_t used = kNet;  ///< leading entries of a sector that have a weight
  std::pair<Rational, Rational> eigenvalue;
};

namespace {

using Point = Point3<Rational>;

Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(const Rational& w, const Point& a) { return {w * a.x, w * a.y, w * a.z}; }

constexpr std::uint32_t kLargestTangent = 512;

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

/// The unit vector along n, and an upper bound of the distance to the unit vector along any m with |m − n| <= radius:
/// with q = radius/|n| < 1/2 that is at most 2q, and rounding n and its length costs less than 2^-49.
std::optional<NormalEnclosure> enclosure_of(Point n, const Rational& radius) {
  const Rational largest = std::max({abs(n.x), abs(n.y), abs(n.z)});
  if (largest.is_zero() || largest <= Rational(2) * radius) return std::nullopt;
  n = Rational(1) / largest * n;
  const Point3<double> d{n.x.to_double(), n.y.to_double(), n.z.to_double()};
  const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  const double spread = up(up((radius / largest).to_double()) * 2);
  return NormalEnclosure{{d.x / length, d.y / length, d.z / length}, up(spread + 0x1p-49), std::nullopt};
}

/// Im T × Re T for the exact functional.
std::optional<NormalEnclosure> exact_normal(const std::vector<Point>& net, const detail::NetVector<Rational>& weights, std::size_t used) {
  Point re, im;
  for (std::size_t s = 0; s < 4; ++s) {
    for (std::size_t r = 0; r < used; ++r) {
      // i^-s (a + ib) for s = 0 … 3: a + ib, b − ia, −a − ib, −b + ia.
      const Rational &a = weights[r].re, &b = weights[r].im;
      const Point& p = net[kNet * s + r];
      re = re + (s == 0 ? a : s == 1 ? b : s == 2 ? -a : -b) * p;
      im = im + (s == 0 ? b : s == 1 ? -a : s == 2 ? -b : a) * p;
    }
  }
  const Point n{im.y * re.z - im.z * re.y, im.z * re.x - im.x * re.z, im.x * re.y - im.y * re.x};
  auto result = enclosure_of(n, Rational(0));
  if (result) result->exact = n;
  return result;
}

/// The same over intervals. `net` is relative to a point of its middle.
std::optional<NormalEnclosure> enclosed_normal(const std::vector<Point>& net, const std::vector<Complex<FixedInterval>>& turns,
                                               const detail::NetVector<FixedInterval>& weights, std::size_t used) {
  Rational largest;
  for (const Point& p : net) largest = std::max({largest, abs(p.x), abs(p.y), abs(p.z)});
  if (largest.is_zero()) return std::nullopt;
  using Three = std::array<FixedInterval, 3>;
  const FixedInterval zero(0);
  Three re{zero, zero, zero}, im{zero, zero, zero};
  for (std::size_t s = 0; s < turns.size(); ++s) {
    for (std::size_t r = 0; r < used; ++r) {
      const Complex<FixedInterval> w = turns[s] * weights[r];
      const Point p = Rational(1) / largest * net[kNet * s + r];
      const Three x{FixedInterval(p.x), FixedInterval(p.y), FixedInterval(p.z)};
      for (std::size_t c = 0; c < 3; ++c) {
        re[c] = re[c] + w.re * x[c];
        im[c] = im[c] + w.im * x[c];
      }
    }
  }
  Point middle;
  Rational radius;
  Rational* const parts[] = {&middle.x, &middle.y, &middle.z};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
    const FixedInterval n = im[d] * re[e] - im[e] * re[d];
    *parts[c] = n.middle();
    radius += n.radius();
  }
  return enclosure_of(middle, radius);
}

}  // namespace

std::vector<std::uint32_t> midedge_net(const MidedgeMap& map, std::uint32_t f) {
  detail::MidedgeWalk walk(map);
  const std::uint32_t k = map.facet_size(f), start = map.facet_start(f);
  std::vector<std::uint32_t> net;
  net.reserve(kNet * k);
  for (std::uint32_t s = 0; s < k; ++s) {
    // The side from corner s − 1 to corner s; its other half-edge begins axis s.
    const auto v = detail::midedge_sector(walk, walk.across(start + (s + k - 1) % k));
    if (walk.failed()) return {};
    net.insert(net.end(), v.begin(), v.end());
  }
  return net;
}

const std::array<std::array<int, 3>, 3>& midedge_centre_weights() {
  static constexpr std::array<std::array<int, 3>, 3> kWeights{{{163156, 35805, 783}, {35805, 7218, 81}, {783, 81, 0}}};
  return kWeights;
}

MidedgeLimits::MidedgeLimits(MidedgeRule rule) : rule_(rule) {}
MidedgeLimits::MidedgeLimits(MidedgeLimits&&) noexcept = default;
MidedgeLimits::~MidedgeLimits() = default;

void MidedgeLimits::prepare(std::uint32_t k) {
  HEXACT_EXPECTS(k >= 3);
  if (tangents_.count(k) > 0) return;
  auto tangent = std::make_unique<Tangent>();
  if (k > kLargestTangent) {
    tangent->used = 0;
    tangents_.emplace(k, std::move(tangent));
    return;
  }
  for (std::uint32_t s = 0; s < k; ++s) tangent->turns.push_back(detail::root_of_unity((k - s) % k, k));
  if (rule_ == MidedgeRule::simple) {
    tangent->used = 1;
    if (k == 4) {
      detail::NetVector<Rational> corner;
      corner[0].re = Rational(1);
      tangent->weights = corner;
    } else {
      detail::NetVector<FixedInterval> corner;
      corner[0] = {FixedInterval(1), FixedInterval(0)};
      tangent->weights = corner;
    }
    const FixedInterval lambda = (FixedInterval(1) + detail::root_of_unity(1, k).re) / FixedInterval(2);
    tangent->eigenvalue = {lambda.middle(), lambda.radius()};
  } else if (k == 4) {
    const auto l = detail::exact_left_eigenvector();
    tangent->weights = l.entries;
    tangent->eigenvalue = {l.eigenvalue, Rational(0)};
  } else {
    const auto l = detail::enclosed_left_eigenvector(k);
    tangent->weights = l.entries;
    tangent->eigenvalue = {l.eigenvalue.middle(), l.eigenvalue.radius()};
  }
  tangents_.emplace(k, std::move(tangent));
}

std::pair<Rational, Rational> MidedgeLimits::eigenvalue(std::uint32_t k) const { return tangents_.at(k)->eigenvalue; }

std::optional<MidedgeLimit> MidedgeLimits::operator()(const MidedgeLevel<Rational>& level, std::uint32_t f) const {
  const auto loop = level.map.loop(f);
  const auto k = static_cast<std::uint32_t>(loop.size());
  const Tangent& tangent = *tangents_.at(k);
  std::vector<Point> net(kNet * k);
  MidedgeLimit limit;
  if (rule_ == MidedgeRule::simple) {
    for (std::size_t s = 0; s < k; ++s) {
      net[kNet * s] = level.points[loop[s]];
      limit.point = limit.point + net[kNet * s];
    }
    limit.point = Rational(1) / Rational(static_cast<long>(k)) * limit.point;
    if (k == 3 || tangent.used == 0 || touches_boundary(midedge_boundary_pattern(level.map, f))) return limit;
  } else {
    const std::vector<std::uint32_t> vertices = midedge_net(level.map, f);
    if (vertices.empty()) return std::nullopt;
    std::array<Point, kNet> sums;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      net[i] = level.points[vertices[i]];
      sums[i % kNet] = sums[i % kNet] + net[i];
    }
    for (std::size_t r = 0; r < kNet; ++r) {
      limit.point = limit.point + Rational(midedge_centre_weights()[r / 3][r % 3]) * sums[r];
    }
    limit.point = Rational(1) / Rational(243712L * static_cast<long>(k)) * limit.point;
  }
  if (tangent.used == 0) return limit;
  for (std::size_t i = 0; i < net.size(); ++i) {
    if (i % kNet < tangent.used) net[i] = net[i] - limit.point;
  }
  if (const auto* exact = std::get_if<detail::NetVector<Rational>>(&tangent.weights)) {
    limit.normal = exact_normal(net, *exact, tangent.used);
  } else {
    limit.normal = enclosed_normal(net, tangent.turns, std::get<detail::NetVector<FixedInterval>>(tangent.weights), tangent.used);
  }
  return limit;
}

}  // namespace hexact
