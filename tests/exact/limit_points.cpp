// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/limit_points.hpp"

#include "exact/honeycomb_golden.hpp"
#include "hexact/exact/honeycomb.hpp"
#include "hexact/exact/rounding.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace hexact;

namespace {

HoneycombLevel<Rational> refined(HoneycombLevel<Rational> level, const CutPolicy& policy, int steps) {
  for (int i = 0; i < steps; ++i) level = honeycomb_step(level, policy).level;
  return level;
}

std::vector<LimitPoint> limits_of(const HoneycombLevel<Rational>& level, const std::optional<SizePolicy>& policy) {
  return limit_points(level.map, to_plane_body(level), policy);
}

std::vector<std::array<double, 3>> corners_of(const HoneycombLevel<Rational>& level, std::uint32_t f) {
  std::vector<std::array<double, 3>> corners;
  const std::uint32_t start = level.map.facet_start(f);
  for (std::uint32_t h = start; h < start + level.map.facet_size(f); ++h) {
    const auto& p = level.points[level.map.origin(h)];
    corners.push_back({p.x.to_double(), p.y.to_double(), p.z.to_double()});
  }
  return corners;
}

double distance(const Point3<double>& p, const std::array<double, 3>& q) {
  return std::sqrt((p.x - q[0]) * (p.x - q[0]) + (p.y - q[1]) * (p.y - q[1]) + (p.z - q[2]) * (p.z - q[2]));
}

double determinant(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Glick's fixed point of the pentagram map, phs (b.3), in the plane of the first two axes.
std::array<double, 2> glick_point(const std::vector<std::array<double, 3>>& polygon) {
  const std::size_t n = polygon.size();
  double cx = 0, cy = 0, size = 0;
  for (const auto& p : polygon) cx += p[0] / static_cast<double>(n), cy += p[1] / static_cast<double>(n);
  for (const auto& p : polygon) size = std::max(size, std::hypot(p[0] - cx, p[1] - cy));
  std::vector<std::array<double, 3>> a;
  for (const auto& p : polygon) a.push_back({(p[0] - cx) / size, (p[1] - cy) / size, 1});
  std::array<double, 3> v{0, 0, 1};
  for (int step = 0; step < 3000; ++step) {
    std::array<double, 3> t{};
    for (int k = 0; k < 3; ++k) t[k] = static_cast<double>(n) * v[k];
    for (std::size_t i = 0; i < n; ++i) {
      const auto &before = a[(i + n - 1) % n], &after = a[(i + 1) % n];
      const double share = determinant(before, v, after) / determinant(before, a[i], after);
      for (int k = 0; k < 3; ++k) t[k] -= share * a[i][k];
    }
    const double length = std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
    for (int k = 0; k < 3; ++k) v[k] = t[k] / length;
  }
  return {cx + size * v[0] / v[2], cy + size * v[1] / v[2]};
}

/// How far the point is beyond the edges of a convex polygon at most; negative inside.
double outside(const std::vector<std::array<double, 3>>& polygon, const Point3<double>& p, const Plane<Rational>& plane) {
  const std::array<double, 3> n{plane.a.to_double(), plane.b.to_double(), plane.c.to_double()};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  double worst = -1e300;
  for (std::size_t j = 0; j < polygon.size(); ++j) {
    const auto &a = polygon[j], &b = polygon[(j + 1) % polygon.size()];
    const std::array<double, 3> e{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, d{p.x - a[0], p.y - a[1], p.z - a[2]};
    worst = std::max(worst, -determinant(n, e, d) / length / std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]));
  }
  return worst;
}

}  // namespace

TEST_CASE("equal parameters shrink a triangle to its mean corner", "[limit]") {
  const auto level = honeycomb_start<Rational>(samples::tetrahedron());
  const auto limits = limits_of(level, static_policy_rational());
  for (std::uint32_t f = 0; f < 4; ++f) {
    const auto c = corners_of(level, f);
    const std::array<double, 3> mean{(c[0][0] + c[1][0] + c[2][0]) / 3, (c[0][1] + c[1][1] + c[2][1]) / 3, (c[0][2] + c[1][2] + c[2][2]) / 3};
    REQUIRE(limits[f].bound);
    CHECK(*limits[f].bound < 1e-15);
    CHECK(distance(limits[f].point, mean) <= *limits[f].bound + 1e-15);
  }
}

TEST_CASE("without parameters the limit is Glick's point of the pentagram map", "[limit]") {
  const auto level = refined(honeycomb_start<Rational>(samples::generic_dodecahedron()), static_policy_rational(), 2);
  const auto limits = limits_of(level, static_policy_rational());
  int compared = 0;
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    if (level.map.facet_size(f) < 6 || level.map.facet_level(f) == level.map.level()) continue;
    const auto corners = corners_of(level, f);
    const auto& plane = level.planes[f];
    // Seen along an axis that the plane is not steep to.
    if (std::fabs(plane.c.to_double()) * 3 < std::fabs(plane.a.to_double()) + std::fabs(plane.b.to_double())) continue;
    const auto glick = glick_point(corners);
    REQUIRE(limits[f].bound);
    CHECK(std::hypot(limits[f].point.x - glick[0], limits[f].point.y - glick[1]) < 1e-9 * limits[f].radius + 1e-13);
    ++compared;
  }
  CHECK(compared > 5);
}

TEST_CASE("limit points lie in the polygons of all later levels, within tight bounds", "[limit]") {
  for (const PlaneBody& base : {samples::cube(), samples::tetrahedron(), samples::generic_dodecahedron()}) {
    const auto level = refined(honeycomb_start<Rational>(base), static_policy_rational(), 1);
    const auto limits = limits_of(level, static_policy_rational());
    const auto later = refined(level, static_policy_rational(), 3);
    const auto limits_later = limits_of(later, static_policy_rational());
    for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
      CAPTURE(f);
      REQUIRE(limits[f].bound);
      CHECK(*limits[f].bound < 1e-12 * limits[f].radius + 1e-15);
      for (const auto& p : corners_of(level, f)) CHECK(distance(limits[f].point, p) <= limits[f].radius * (1 + 1e-12));
      CHECK(outside(corners_of(later, f), limits[f].point, later.planes[f]) < *limits[f].bound + 1e-14);
      const auto& q = limits_later[f].point;
      CHECK(distance(limits[f].point, {q.x, q.y, q.z}) <= *limits[f].bound + *limits_later[f].bound);
    }
  }
}

TEST_CASE("over Q(sqrt5) the limit points of the dodecahedron's facets are their centres", "[limit]") {
  const nlohmann::json data = test::golden();
  for (const auto& closed : data.at("closed")) {
    if (closed.at("name") != "dodecahedron" || !closed.contains("initial")) continue;
    const auto level = honeycomb_start<QuadraticField>(test::body_of(test::solid(closed.at("initial"))));
    const auto limits = limit_points(level.map, to_plane_body(level), static_policy_sqrt5());
    for (std::uint32_t f = 0; f < 12; ++f) {
      Point3<QuadraticField> mean;
      const std::uint32_t start = level.map.facet_start(f);
      for (std::uint32_t h = start; h < start + 5; ++h) {
        const auto& p = level.points[level.map.origin(h)];
        mean = {mean.x + p.x, mean.y + p.y, mean.z + p.z};
      }
      const QuadraticField five(5);
      const auto& p = limits[f].point;
      REQUIRE(limits[f].bound);
      CHECK(*limits[f].bound < 1e-15);
      CHECK(distance(p, {(mean.x / five).to_double(), (mean.y / five).to_double(), (mean.z / five).to_double()}) <= *limits[f].bound + 1e-16);
    }
  }
}

TEST_CASE("a policy that is not known or would be refused gives the facet itself", "[limit]") {
  const auto level = honeycomb_start<Rational>(samples::cube());
  const auto constant = [](const char* beta) { return SizePolicy{{test::number(beta)}}; };
  for (const auto& policy : {std::optional<SizePolicy>(), std::optional(constant("0")), std::optional(constant("1/2"))}) {
    for (const LimitPoint& limit : limits_of(level, policy)) {
      CHECK_FALSE(limit.bound);
      CHECK(limit.radius == Approx(std::sqrt(2.0)));
      CHECK(limit.radius >= std::sqrt(2.0));
    }
  }
  // Quadrilaterals beside triangles would go on with 0 for themselves: refused at the next level.
  const auto cut = refined(level, constant("1/4"), 1);
  for (const LimitPoint& limit : limits_of(cut, SizePolicy{{test::number("0")}})) {
    CHECK_FALSE(limit.bound);
  }
}

TEST_CASE("limit points can be cancelled", "[limit]") {
  const auto level = honeycomb_start<Rational>(samples::cube());
  Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(limit_points(level.map, to_plane_body(level), static_policy_rational(), ProgressPart(progress)), Cancelled);
  CHECK_THROWS_AS(honeycomb_step(level, static_policy_rational(), ProgressPart(progress)), Cancelled);
}
