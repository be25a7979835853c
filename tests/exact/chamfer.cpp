// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/chamfer.hpp"

#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/lift_rules.hpp"
#include "hexact/exact/sample_solids.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

using namespace hexact;

namespace {

double largest_angle(const ChamferLevel& level) {
  const RawVector<Point3<double>> n = scaled_normals(level);
  const HoneycombMap& map = level.surface.map;
  double smallest = 1;
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const auto &p = n[map.facet(h)], &q = n[map.facet(map.twin(h))];
    const auto dot = [](const auto& a, const auto& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    smallest = std::min(smallest, dot(p, q) / std::sqrt(dot(p, p) * dot(q, q)));
  }
  return std::acos(smallest) * 180 / std::acos(-1.0);
}

LiftRule half() { return automatic_lifts(constant_keep(0.5)); }

PlaneBody random_body(std::size_t facets, std::uint64_t seed) { return body_from_soup(random_solid(facets, seed)); }

/// n·x <= d of a scaled plane at a vertex of the level, by Cramer's rule: d·w − n·x·w and w > 0.
struct Slack {
  Integer value, w;
};
Slack slack_at(const Plane<Integer>& s, const std::array<Plane<Integer>, 3>& p) {
  const Integer w = samples::det(p[0], p[1], p[2]);
  const auto replaced = [&](Integer Plane<Integer>::* column) {
    auto q = p;
    for (std::size_t i = 0; i < 3; ++i) q[i].*column = p[i].d;
    return samples::det(q[0], q[1], q[2]);
  };
  const Integer x = replaced(&Plane<Integer>::a), y = replaced(&Plane<Integer>::b), z = replaced(&Plane<Integer>::c);
  return {s.d * w - s.a * x - s.b * y - s.c * z, w};
}

std::array<Plane<Integer>, 3> planes_at(const SnappedLevel& surface, std::uint32_t v) {
  const auto f = surface.map.facets_at(v);
  return {surface.planes[f[0]], surface.planes[f[1]], surface.planes[f[2]]};
}

/// Lifts of a step, read off the planes: τ = d_F + d_G − d_E.
std::vector<Integer> lifts_between(const ChamferLevel& before, const ChamferLevel& after) {
  const EdgeNumbering edges = number_edges(before.surface.map);
  std::vector<Integer> lifts;
  for (std::uint32_t e = 0; e < edges.half_edge.size(); ++e) {
    const std::uint32_t h = edges.half_edge[e];
    const auto scaled = [&](std::uint32_t f) {
      // Steps may have multiplied the scaling; half of what the planes are scaled by afterwards is what was used.
      const Plane<Integer> p = scaled_plane(after, f);
      const Integer two(2);
      return Plane<Integer>{exact_quotient(p.a, two), exact_quotient(p.b, two), exact_quotient(p.c, two), exact_quotient(p.d, two)};
    };
    const Plane<Integer> f = scaled(before.surface.map.facet(h)), g = scaled(before.surface.map.facet(before.surface.map.twin(h)));
    const Plane<Integer> cut = after.surface.planes[before.surface.map.facet_count() + e];
    CHECK(cut.a == f.a + g.a);
    CHECK(cut.b == f.b + g.b);
    CHECK(cut.c == f.c + g.c);
    lifts.push_back(f.d + g.d - cut.d);
  }
  return lifts;
}

struct Finds {
  std::string code, element, message;
};
template <class Work>
Finds refusal(const Work& work) {
  try {
    work();
  } catch (const InvalidInput& e) {
    return {e.code(), e.findings().front().element, e.findings().front().message};
  }
  return {};
}

/// The same lift for all edges.
ExactLifts constant(const HoneycombMap& map, const Rational& lift) {
  return {std::vector<Rational>(map.edge_count(), lift)};
}

}  // namespace

TEST_CASE("largest angles of the cube halve, and those of the tetrahedron one step later", "[chamfer]") {
  const std::vector<double> expected = {60, 33.5573, 17.3414, 8.7460, 4.3826};
  for (const std::size_t delay : {0U, 1U}) {
    ChamferLevel level = chamfer_start(delay == 0 ? samples::cube() : samples::tetrahedron());
    if (delay == 1) level = chamfer_step(std::move(level), half());
    for (const double angle : expected) {
      level = chamfer_step(std::move(level), half());
      CHECK(largest_angle(level) == Approx(angle).margin(5e-4));
      CHECK(sign_violations(level.surface.map, level.surface.planes).empty());
    }
  }
}

TEST_CASE("identity (2): m_v is v with each facet moved in by half its triangle defect", "[chamfer]") {
  for (const PlaneBody& base : {samples::cube(), samples::tetrahedron(), samples::generic_dodecahedron(), random_body(17, 4)}) {
    ChamferLevel before = chamfer_start(base);
    for (int k = 0; k < 2; ++k) {
      const ChamferLevel after = chamfer_step(before, half());
      const std::vector<Integer> lifts = lifts_between(before, after);
      const HoneycombMap& map = before.surface.map;
      const EdgeNumbering edges = number_edges(map);
      for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
        const auto s = map.star(v);
        const auto corner = planes_at(after.surface, static_cast<std::uint32_t>(map.half_edge_count()) + v);
        for (std::size_t i = 0; i < 3; ++i) {
          // In facet i the sides are the edges of s[i] and s[i + 1]; the third edge is that of s[i + 2].
          const Integer defect = lifts[edges.edge[s[i]]] + lifts[edges.edge[s[(i + 1) % 3]]] - lifts[edges.edge[s[(i + 2) % 3]]];
          CHECK(defect.sign() > 0);
          const Slack slack = slack_at(scaled_plane(after, map.facet(s[i])), corner);  // of the doubled plane
          CHECK(slack.value == defect * slack.w);
        }
      }
      before = after;
    }
  }
}

TEST_CASE("planes stay, and widen by one bit a level", "[chamfer]") {
  for (const PlaneBody& base : {samples::cube(), samples::tetrahedron(), random_body(12, 1), random_body(29, 7)}) {
    ChamferLevel level = chamfer_start(base);
    std::size_t bits = 0;
    for (int k = 0; k < 4; ++k) {
      const ChamferLevel before = level;
      level = chamfer_step(std::move(level), half());
      for (std::size_t f = 0; f < before.surface.planes.size(); ++f) REQUIRE(level.surface.planes[f] == before.surface.planes[f]);
      std::size_t widest = 0;
      for (std::size_t f = before.surface.planes.size(); f < level.surface.planes.size(); ++f) {
        const Plane<Integer> p = level.surface.planes[f];
        widest = std::max({widest, p.a.bit_length(), p.b.bit_length(), p.c.bit_length(), p.d.bit_length()});
      }
      if (k > 0) CHECK(widest <= bits + 1);
      bits = widest;
    }
  }
}

TEST_CASE("scaled normals are equally long to 2^-12", "[chamfer]") {
  for (const PlaneBody& base : {samples::cube(), samples::tetrahedron(), samples::generic_dodecahedron(), random_body(40, 3)}) {
    const ChamferLevel level = chamfer_start(base);
    double least = 1e300, most = 0;
    for (const auto& n : scaled_normals(level)) {
      const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
      least = std::min(least, length);
      most = std::max(most, length);
    }
    CHECK(most <= least * (1 + 0x1p-11));
    CHECK(most == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("lifts that are not positive, no triangle, or too large are refused by element", "[chamfer]") {
  const ChamferLevel start = chamfer_start(samples::cube());  // [−1, 1]³, edges of length 2, every κ is 1
  const HoneycombMap& map = start.surface.map;
  const EdgeNumbering edges = number_edges(map);
  const auto name = [&](std::uint32_t e) {
    const std::uint32_t h = edges.half_edge[e];
    return "edge " + std::to_string(map.origin(h)) + "-" + std::to_string(map.target(h));
  };
  const auto step = [&](const ExactLifts& lifts) {
    return refusal([&] { (void)chamfer_step(start, [&](const ChamferLevel&, const EdgeNumbering&) -> Lifts { return lifts; }); });
  };
  CHECK(step(constant(map, Rational(Integer(1), Integer(2)))).code.empty());
  // A side of length 2 ends where it has lost 2·τ: τ = 1 leaves nothing, any τ below leaves something.
  CHECK(step(constant(map, Rational(1))).code == "SideCollapse");
  CHECK(step(constant(map, Rational(1) - Rational(1).scaled(-60))).code.empty());

  ExactLifts lifts = constant(map, Rational(Integer(1), Integer(4)));
  lifts.values[5] = Rational(0);
  CHECK(step(lifts).code == "LiftNotPositive");
  CHECK(step(lifts).element == name(5));
  lifts.values[5] = Rational(-1);
  CHECK(step(lifts).code == "LiftNotPositive");

  // By one unit: 1/4 + 1/4 against 1/2 is no triangle, anything less is one.
  lifts.values[5] = Rational(Integer(1), Integer(2));
  const Finds flat = step(lifts);
  CHECK(flat.code == "TriangleInequality");
  const std::uint32_t h = edges.half_edge[5];
  const std::uint32_t first = std::min(map.origin(h), map.target(h));
  CHECK(flat.element == "vertex " + std::to_string(first));
  lifts.values[5] -= Rational(1).scaled(-60);
  CHECK(step(lifts).code.empty());

  lifts.values.pop_back();
  CHECK(step(lifts).code == "BadLifts");
}

TEST_CASE("a side that has lost its length by one unit is named with its facet", "[chamfer]") {
  // A box of 2 × 2 × 6: on its long sides the short edges vanish first.
  const PlaneBody box = samples::simple_body({{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, -1, 0, 1}, {0, 1, 0, 1}, {0, 0, -1, 3}, {0, 0, 1, 3}});
  const ChamferLevel start = chamfer_start(box);
  const HoneycombMap& map = start.surface.map;
  const EdgeNumbering edges = number_edges(map);
  // The four edges along z get the lift 1 − x; a side across has the length 2 − 2·(1 − x) = 2x left.
  const auto lifts_with = [&](const Rational& x) {
    ExactLifts lifts = constant(map, Rational(Integer(2), Integer(3)));
    for (std::uint32_t e = 0; e < lifts.values.size(); ++e) {
      const std::uint32_t h = edges.half_edge[e];
      if (map.facet(h) < 4 && map.facet(map.twin(h)) < 4) lifts.values[e] = Rational(1) - x;
    }
    return lifts;
  };
  const auto step = [&](const Rational& x) {
    return refusal([&] {
      (void)chamfer_step(start, [&](const ChamferLevel&, const EdgeNumbering&) -> Lifts { return lifts_with(x); });
    });
  };
  CHECK(step(Rational(1).scaled(-80)).code.empty());
  const Finds gone = step(Rational(0));
  CHECK(gone.code == "SideCollapse");
  CHECK_THAT(gone.element, Catch::StartsWith("edge "));
  CHECK_THAT(gone.message, Catch::Contains("facet 0"));
}

TEST_CASE("a chamfer is affinely covariant when the factors are kept", "[chamfer]") {
  const PlaneBody base = random_body(14, 9);
  // x' = M x with M unimodular, so that coprime planes stay coprime: n' = n M⁻¹.
  PlaneBody moved = base;
  moved.planes = {};
  const auto image = [](const Plane<Integer>& p) {  // M⁻¹ = (1 0 0; −2 1 0; 3 −1 1) by columns below
    return Plane<Integer>{p.a - Integer(2) * p.b + Integer(3) * p.c, p.b - p.c, p.c, p.d};
  };
  for (std::size_t f = 0; f < base.planes.size(); ++f) moved.planes.push_back(image(base.planes[f]));
  ChamferLevel one = chamfer_start(base);
  std::vector<Rational> factors;
  for (const Integer& k : lift_scale(one).factors) factors.emplace_back(k);
  ChamferLevel two = chamfer_start(moved, factors);
  for (int k = 0; k < 2; ++k) {
    const ChamferLevel before = one;
    one = chamfer_step(std::move(one), half());
    // The lifts of the first, in the scale of documents, are those of the second.
    const Rational unit = lift_scale(one).unit;
    std::vector<Rational> lifts;
    for (const Integer& lift : lifts_between(before, one)) lifts.push_back(Rational(lift) / unit);
    two = chamfer_step(std::move(two), [&](const ChamferLevel&, const EdgeNumbering&) -> Lifts { return ExactLifts{lifts}; });
    CHECK(sign_violations(two.surface.map, two.surface.planes).empty());
  }
  const PlaneBody a = to_plane_body(one.surface), b = to_plane_body(two.surface);
  for (std::size_t f = 0; f < a.planes.size(); ++f) {
    // Both in file coordinates (no shift: both frames keep the origin), up to a positive factor.
    REQUIRE((a.shift == std::array<Rational, 3>{} && b.shift == std::array<Rational, 3>{}));
    const Plane<Integer> p = image(a.planes[f]), q = b.planes[f];
    const Rational pd = Rational(p.d).scaled(a.scale), qd = Rational(q.d).scaled(b.scale);
    CHECK(p.a * q.b == p.b * q.a);
    CHECK(p.b * q.c == p.c * q.b);
    CHECK(p.a * q.c == p.c * q.a);
    CHECK(Rational(p.a) * qd == Rational(q.a) * pd);
    CHECK(Rational(p.b) * qd == Rational(q.b) * pd);
    CHECK(Rational(p.c) * qd == Rational(q.c) * pd);
  }
}

TEST_CASE("constant lifts keep the symmetry of the cube", "[chamfer]") {
  ChamferLevel level = chamfer_start(samples::cube());
  level = chamfer_step(std::move(level), [](const ChamferLevel& l, const EdgeNumbering&) -> Lifts {
    return constant(l.surface.map, Rational(Integer(1), Integer(3)));
  });
  // All twelve planes are x + y <= 5/3 and its images: |n| entries 1, 1, 0 and equal offsets.
  const PlaneBody body = to_plane_body(level.surface);
  for (std::size_t f = 6; f < 18; ++f) {
    const Plane<Integer> p = body.planes[f];
    const auto magnitude = [](const Integer& x) { return x.sign() < 0 ? -x : x; };
    const Integer one = std::max({magnitude(p.a), magnitude(p.b), magnitude(p.c)});
    CHECK(magnitude(p.a) + magnitude(p.b) + magnitude(p.c) == one + one);
    CHECK(Rational(p.d).scaled(body.scale) / Rational(one) == Rational(Integer(5), Integer(3)));
  }
}

TEST_CASE("chamfer steps go on from honeycomb steps", "[chamfer]") {
  for (const PlaneBody& base : {samples::cube(), samples::tetrahedron(), random_body(12, 1)}) {
    SnappedLevel honeycomb = snapped_start(base);
    for (int k = 0; k < 3; ++k) honeycomb = snapped_step(std::move(honeycomb), static_policy_rational(), {}).level;
    ChamferLevel level = chamfer_start(std::move(honeycomb));
    double angle = largest_angle(level);
    for (int k = 0; k < 2; ++k) {
      const std::size_t facets = level.surface.map.facet_count(), edges = level.surface.map.edge_count();
      level = chamfer_step(std::move(level), half());
      CHECK(level.surface.map.facet_count() == facets + edges);
      CHECK(sign_violations(level.surface.map, level.surface.planes).empty());
      const double now = largest_angle(level);
      CHECK(now < 0.75 * angle);
      angle = now;
      CHECK(level.surface.map.facet_level(static_cast<std::uint32_t>(facets)) == static_cast<std::uint32_t>(4 + k));
      CHECK(level.surface.map.facet_parent(static_cast<std::uint32_t>(facets)) == 0);
    }
  }
}

TEST_CASE("wide input planes are refined exactly with big integers", "[chamfer]") {
  // A cube whose planes need hundreds of bits: [−1, 1]³ with offsets moved by 2^-200.
  PlaneBody wide = samples::cube();
  for (std::size_t f = 0; f < 6; ++f) {
    Plane<Integer> p = wide.planes[f];
    const Integer one = Integer::power_of_two(200);
    p = {p.a * one, p.b * one, p.c * one, one + Integer(static_cast<long long>(f) + 1)};
    wide.planes.set(f, p);
  }
  ChamferLevel level = chamfer_start(wide);
  for (int k = 0; k < 4; ++k) level = chamfer_step(std::move(level), half());
  CHECK(level.surface.planes.wide_count() == level.surface.planes.size());
  CHECK(sign_violations(level.surface.map, level.surface.planes).empty());
  CHECK(largest_angle(level) == Approx(8.7460).margin(5e-4));
}

TEST_CASE("keeping more and more of the sides, as smoothness asks for, stays exact", "[chamfer]") {
  ChamferLevel level = chamfer_start(samples::cube());
  const LiftRule rule = automatic_lifts(smooth_keep(0));
  for (int k = 0; k < 6; ++k) {
    level = chamfer_step(std::move(level), rule);
    CHECK(sign_violations(level.surface.map, level.surface.planes).empty());
  }
}

TEST_CASE("the fraction that is to be kept is kept, exactly", "[chamfer]") {
  for (const double keep : {0.25, 0.5, 0.875}) {
    for (const PlaneBody& base : {samples::cube(), samples::tetrahedron(), random_body(12, 1), random_body(29, 7)}) {
      ChamferLevel before = chamfer_start(base);
      for (int k = 0; k < 2; ++k) {
        const ChamferLevel after = chamfer_step(before, automatic_lifts(constant_keep(keep)));
        const HoneycombMap& map = before.surface.map;
        const auto cut = [&, edges = number_edges(map)](std::uint32_t h) {
          return static_cast<std::uint32_t>(map.facet_count()) + edges.edge[h];
        };
        for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
          // The neighbours' planes move in by the lifts: n_G·x <= d_E − d_F on F. All cofactors of the two det4 are the
          // same, so their quotient is new length over old length.
          const Plane<Integer> f = scaled_plane(after, map.facet(h));
          const auto side = [&](std::uint32_t side_of, Plane<Integer>& old_line, Plane<Integer>& new_line) {
            old_line = scaled_plane(after, map.facet(map.twin(side_of)));
            new_line = old_line;
            const Integer two(2);
            new_line.d = two * after.surface.planes[cut(side_of)].d - f.d;
          };
          std::array<Plane<Integer>, 3> was, is;
          side(map.previous(h), was[0], is[0]);
          side(h, was[1], is[1]);
          side(map.next(h), was[2], is[2]);
          const Slack old_slack = slack_at(was[2], {f, was[0], was[1]}), new_slack = slack_at(is[2], {f, is[0], is[1]});
          REQUIRE(old_slack.w == new_slack.w);
          REQUIRE(Rational(new_slack.value) >= Rational::from_double(keep) * Rational(old_slack.value));
        }
        before = after;
      }
    }
  }
}

TEST_CASE("chamfer results do not depend on the number of threads", "[chamfer]") {
  const auto run = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ChamferLevel level = chamfer_start(random_body(29, 2));
    for (int k = 0; k < 5; ++k) level = chamfer_step(std::move(level), half());
    return level;
  };
  const ChamferLevel one = run(1), two = run(2);
  for (std::size_t f = 0; f < one.surface.planes.size(); ++f) REQUIRE(one.surface.planes[f] == two.surface.planes[f]);
  CHECK(one.surface.points == two.surface.points);
  CHECK(one.surface.errors == two.surface.errors);
}

TEST_CASE("bodies that cannot be chamfered are refused", "[chamfer]") {
  PlaneBody inverted = samples::cube();
  inverted.planes.set(5, IntegerPlanes::Narrow{0, 0, -1, -1});
  CHECK(refusal([&] { (void)chamfer_start(inverted); }).code == "NotConvex");
  PlaneBody flat = samples::cube();
  flat.planes.set(5, IntegerPlanes::Narrow{1, 1, 0, 1});
  CHECK(refusal([&] { (void)chamfer_start(flat); }).code == "DegenerateVertex");
  PlaneBody root = samples::cube();
  root.field = Field::sqrt5;
  CHECK(refusal([&] { (void)chamfer_start(root); }).code == "FieldNotRational");
  const PlaneBody cube = samples::cube();
  CHECK(refusal([&] { (void)chamfer_start(cube, std::vector<Rational>(5, Rational(1))); }).code == "BadLifts");
  CHECK(refusal([&] { (void)chamfer_start(cube, std::vector<Rational>{1, 1, 1, 0, 1, 1}); }).element == "facet 3");
}

TEST_CASE("no sign is refuted on random solids", "[chamfer]") {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const std::size_t facets = 6 + seed * 7919 % 55;
    CAPTURE(seed, facets);
    ChamferLevel level = chamfer_start(random_body(facets, seed));
    for (int k = 0; k < 3; ++k) level = chamfer_step(std::move(level), half());
    REQUIRE(sign_violations(level.surface.map, level.surface.planes).empty());
  }
}

TEST_CASE("no sign is refuted on 1000 random solids", "[.chamfer-1000]") {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const std::size_t facets = 6 + seed * 7919 % 55;
    CAPTURE(seed, facets);
    ChamferLevel level = chamfer_start(random_body(facets, seed));
    for (int k = 0; k < 3; ++k) {
      level = chamfer_step(std::move(level), half());
      REQUIRE(sign_violations(level.surface.map, level.surface.planes).empty());
    }
  }
}
