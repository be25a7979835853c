// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/fitting/fair_lifts.hpp"

#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/sample_solids.hpp"
#include "hexact/exact/snap_planes.hpp"
#include "hexact/kernel/errors.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace hexact;

namespace {

const double kPi = std::acos(-1.0);

PlaneBody sample_body(const std::string& name) {
  return body_from_soup(std::get<PolygonSoup<Rational>>(sample_solid(name)));
}
PlaneBody dodecahedron() {
  return snap_planes(std::get<PolygonSoup<QuadraticField>>(sample_solid("dodecahedron")), 30).body;
}
PlaneBody random_body(std::size_t facets, std::uint64_t seed) { return body_from_soup(random_solid(facets, seed)); }

FairOptions by(FairObjective objective) {
  FairOptions options;
  options.objective = objective;
  return options;
}

constexpr std::array kObjectives = {FairObjective::product, FairObjective::harmonic, FairObjective::even, FairObjective::ratio};

ProposedLifts lifts_of(const ChamferLevel& level, const LiftRule& rule) {
  return std::get<ProposedLifts>(rule(level, number_edges(level.surface.map)));
}
LiftQuality quality(const ChamferLevel& level, const LiftRule& rule) {
  return lift_quality(level, number_edges(level.surface.map), lifts_of(level, rule));
}

struct Ratios {
  double least, greatest;
};
/// Length over angle, least and greatest, from the points of a level.
Ratios ratios(const ChamferLevel& level) {
  const RawVector<Point3<double>> n = scaled_normals(level);
  const HoneycombMap& map = level.surface.map;
  Ratios out{1e300, 0};
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const auto &f = n[map.facet(h)], &g = n[map.facet(map.twin(h))];
    const auto &p = level.surface.points[map.origin(h)], &q = level.surface.points[map.target(h)];
    const double sine = std::hypot(f.y * g.z - f.z * g.y, f.z * g.x - f.x * g.z, f.x * g.y - f.y * g.x);
    const double ratio = std::hypot(q.x - p.x, q.y - p.y, q.z - p.z) / std::atan2(sine, f.x * g.x + f.y * g.y + f.z * g.z);
    out = {std::min(out.least, ratio), std::max(out.greatest, ratio)};
  }
  return out;
}

/// Number of clusters of lifts, values within 1e-6 of each other being the same.
std::size_t distinct(const ProposedLifts& lifts) {
  std::vector<double> values(lifts.lengths.begin(), lifts.lengths.end());
  std::sort(values.begin(), values.end());
  std::size_t count = 1;
  for (std::size_t i = 1; i < values.size(); ++i) count += values[i] > values[i - 1] * (1 + 1e-6) ? 1 : 0;
  return count;
}

/// Where a decreasing function vanishes between a and b.
template <class F>
double root(const F& f, double a, double b) {
  for (int i = 0; i < 200; ++i) {
    const double m = (a + b) / 2;
    (f(m) > 0 ? a : b) = m;
  }
  return a;
}

}  // namespace

TEST_CASE("fair lifts of the cube are those that a calculation by hand gives", "[fair]") {
  // Cube of side 2, all lifts t: sides keep 2 − 2t across 45°, the edges at the corners are t√3/2 long across 60°.
  const ChamferLevel cube = chamfer_start(sample_body("cube"));
  const auto& x = cube.surface.points;
  const double half = std::abs(x[0].x - x[6].x) / 2;  // length of one of the cube's units in the level's coordinates
  REQUIRE(half > 0);

  SECTION("ratio: both kinds are equal") {
    const double t = 8 / (8 + 1.5 * std::sqrt(3.0));
    FairOptions options = by(FairObjective::ratio);
    options.keep = constant_keep(0.2);  // a quarter would not let the sides become as short as they are here
    const LiftQuality q = quality(cube, fair_lifts(options));
    CHECK(q.least_ratio / half == Approx(1.5 * std::sqrt(3.0) / kPi * t).epsilon(2e-3));
    CHECK(q.least_ratio / half <= 1.5 * std::sqrt(3.0) / kPi * t * (1 + 1e-9));
  }
  SECTION("product: log (1 − t) + log t, and the barriers of weight 1/32 on 3/4 − t and t") {
    const double mu = 1.0 / 32;
    const double t = root([&](double s) { return -1 / (1 - s) + 1 / s - mu / (0.75 - s) + mu / s; }, 0.01, 0.74);
    for (const double lift : lifts_of(cube, fair_lifts()).lengths) CHECK(lift / half == Approx(t).epsilon(1e-6));
  }
  SECTION("harmonic: θ/s summed, the facet's ratio being 2/(π/2) for all") {
    const double mu = 1.0 / 32, r = 4 / kPi;
    const double a = kPi / 4 * r, b = kPi / 3 * r * 2 / std::sqrt(3.0);
    const double t = root(
        [&](double s) { return -a * 2 / std::pow(2 - 2 * s, 2) + b / (s * s) - mu / (0.75 - s) + mu / s; }, 0.01, 0.7499);
    for (const double lift : lifts_of(cube, fair_lifts(by(FairObjective::harmonic))).lengths) {
      CHECK(lift / half == Approx(t).epsilon(1e-6));
    }
  }
}

TEST_CASE("fair lifts satisfy the conditions exactly, with their margins, level by level", "[fair]") {
  std::vector<PlaneBody> bodies = {sample_body("cube"), sample_body("tetrahedron"), dodecahedron()};
  for (std::uint64_t seed = 1; seed <= 8; ++seed) bodies.push_back(random_body(6 + 7 * seed % 31, seed));
  for (const FairObjective objective : kObjectives) {
    const FairOptions options = by(objective);
    const LiftRule rule = fair_lifts(options);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      INFO("objective " << fair_objective_names()[static_cast<std::size_t>(objective)] << ", body " << i);
      ChamferLevel level = chamfer_start(bodies[i]);
      for (int k = 0; k < 2; ++k) {
        const LiftQuality q = quality(level, rule);
        CHECK(q.least_kept >= 0.25);
        CHECK(q.most_triangle <= options.triangle);
        level = chamfer_step(std::move(level), rule);  // throws where a condition does not hold exactly
        // Lengths foreseen by the programme are those of the level, up to the rounding of lifts to integers.
        const Ratios seen = ratios(level);
        CHECK(seen.least == Approx(q.least_ratio).epsilon(0.03));
        CHECK(seen.greatest == Approx(q.greatest_ratio).epsilon(0.03));
      }
    }
  }
}

TEST_CASE("fair lifts are not worse than automatic ones by their own measure", "[fair]") {
  std::vector<PlaneBody> bodies = {sample_body("cube"), sample_body("tetrahedron"), dodecahedron()};
  for (std::uint64_t seed = 21; seed < 27; ++seed) bodies.push_back(random_body(8 + seed % 5 * 8, seed));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    ChamferLevel level = chamfer_start(bodies[i]);
    for (int k = 0; k < 2; ++k) {
      INFO("body " << i << ", level " << k);
      const EdgeNumbering edges = number_edges(level.surface.map);
      const ProposedLifts automatic = lifts_of(level, automatic_lifts(constant_keep(0.5)));
      for (const FairObjective objective : kObjectives) {
        const FairOptions options = by(objective);
        const double fair = fair_cost(level, edges, lifts_of(level, fair_lifts(options)), options);
        const double before = fair_cost(level, edges, automatic, options);
        INFO(fair_objective_names()[static_cast<std::size_t>(objective)] << ": " << fair << " instead of " << before);
        CHECK(fair <= before + (objective == FairObjective::ratio ? 2e-3 : 1e-9) * std::abs(before));
      }
      level = chamfer_step(std::move(level), fair_lifts());
    }
  }
}

TEST_CASE("fair lifts do not squeeze edges from level to level as automatic ones do", "[fair]") {
  // The spread of length over angle after five levels; a round body has one that stays bounded.
  const auto spread = [](const char* name, const LiftRule& rule) {
    ChamferLevel level = chamfer_start(sample_body(name));
    for (int k = 0; k < 5; ++k) level = chamfer_step(std::move(level), rule);
    const Ratios r = ratios(level);
    return r.greatest / r.least;
  };
  for (const char* name : {"cube", "tetrahedron"}) {
    const double fair = spread(name, fair_lifts()), automatic = spread(name, automatic_lifts(constant_keep(0.5)));
    INFO(name << ": fair " << fair << ", automatic " << automatic);
    CHECK(4 * fair < automatic);
  }
}

TEST_CASE("symmetric solids get symmetric fair lifts", "[fair]") {
  for (const FairObjective objective : kObjectives) {
    INFO(fair_objective_names()[static_cast<std::size_t>(objective)]);
    const LiftRule rule = fair_lifts(by(objective));
    for (const char* name : {"cube", "tetrahedron"}) {
      ChamferLevel level = chamfer_start(sample_body(name));
      CHECK(distinct(lifts_of(level, rule)) == 1);
      // All edges alike gives an exactly symmetric level: sides are one orbit, edges at the old corners another.
      level = chamfer_step(std::move(level), rule);
      const ProposedLifts lifts = lifts_of(level, rule);
      if (objective != FairObjective::ratio) CHECK(distinct(lifts) == 2);
      const HoneycombMap& map = level.surface.map;
      const EdgeNumbering edges = number_edges(map);
      const std::size_t old_facets = map.facet_count_at(0);
      double sides = 0, others = 0;
      for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
        const bool side = map.facet(h) < old_facets || map.facet(map.twin(h)) < old_facets;
        double& first = side ? sides : others;
        if (first == 0) first = lifts.lengths[edges.edge[h]];
        CHECK(lifts.lengths[edges.edge[h]] == Approx(first).epsilon(objective == FairObjective::ratio ? 1e-3 : 1e-6));
      }
    }
  }
}

TEST_CASE("fair lifts scale with the body and do not depend on threads", "[fair]") {
  PolygonSoup<Rational> soup = random_solid(17, 5);
  const LiftRule rule = fair_lifts();
  const ChamferLevel level = chamfer_start(body_from_soup(soup));
  const ProposedLifts lifts = lifts_of(level, rule);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(std::ranges::equal(lifts_of(level, rule).lengths, lifts.lengths));
  }
  for (auto& p : soup.points) p = {p.x * Rational(8), p.y * Rational(8), p.z * Rational(8)};
  const ChamferLevel larger = chamfer_start(body_from_soup(soup));
  const double factor = std::ldexp(8.0, static_cast<int>(level.surface.scale - larger.surface.scale));
  const ProposedLifts scaled = lifts_of(larger, rule);
  for (std::size_t e = 0; e < lifts.lengths.size(); ++e) {
    CHECK(scaled.lengths[e] == Approx(factor * lifts.lengths[e]).epsilon(1e-6));
  }
}

TEST_CASE("fair lifts behind honeycomb steps", "[fair]") {
  SnappedLevel honeycomb = snapped_start(sample_body("cube"));
  for (int k = 0; k < 3; ++k) honeycomb = snapped_step(std::move(honeycomb), static_policy_rational(), {}).level;
  ChamferLevel level = chamfer_start(std::move(honeycomb));
  for (int k = 0; k < 2; ++k) level = chamfer_step(std::move(level), fair_lifts());
  CHECK(level.surface.map.facet_count() == 110 + 324 + 4 * 324);
  CHECK(sign_violations(level.surface).empty());
}

TEST_CASE("a programme that is not solved is a numerical failure; unknown objectives are refused", "[fair]") {
  const ChamferLevel level = chamfer_start(random_body(29, 1));
  FairOptions options;
  options.most_steps = 2;
  try {
    (void)lifts_of(level, fair_lifts(options));
    FAIL("no exception");
  } catch (const NumericalFailure& e) {
    CHECK(std::string(e.what()).find("not solved after 2 Newton steps") != std::string::npos);
  }
  CHECK_THROWS_AS(fair_objective_named("roundest"), InvalidInput);
  for (const FairObjective o : kObjectives) {
    CHECK(fair_objective_named(fair_objective_names()[static_cast<std::size_t>(o)]) == o);
  }
}
