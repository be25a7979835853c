// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/smooth_limit.hpp"

#include "chamfer_samples.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace hexact;

namespace {

bool is_convex(const PlaneBody& b) {
  return overall(verify(make_certificate(b, {{"convex", ""}}, {}, {}))) == Verdict::proved;
}

/// The cube [−1, 1]³ cut twice, its top and bottom with budgets of 10.
PlaneBody narrow_budget(long long lift) { return samples::narrow_budget(samples::cube(), {4, 5}, lift); }

}  // namespace

TEST_CASE("chamfers that halve their lifts have a smooth limit", "[smooth-limit]") {
  PlaneBody body = samples::with_equal_normals(samples::cube(), 20);
  for (std::uint32_t l = 1; l <= 4; ++l) {
    body = samples::chamfer_step(body, l, [&](std::size_t, std::size_t, std::size_t) { return Integer((1 << 18) >> l); });
    REQUIRE(is_convex(body));
    const SmoothLimit limit = smooth_limit(body);
    CHECK(limit.reason.empty());
    CHECK(limit.verdict == Verdict::proved);
    REQUIRE(limit.levels.size() == l);
    // Equal lifts leave each facet the defect τ; then a half, a quarter of it, …, of what is left: a half each time.
    const SmoothLevel& last = limit.levels.back();
    CHECK(last.level == l);
    CHECK(last.largest_share == Approx(l == 1 ? 0 : 0.5));
  }
  // 60°, 33.557°, 17.341°, 8.746° are the largest angles.
  const std::vector<double> angles = {60, 33.557, 17.341, 8.746};
  const SmoothLimit limit = smooth_limit(body);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(limit.levels[i].angle_bound_deg >= angles[i]);
    CHECK(limit.levels[i].angle_bound_deg <= angles[i] + 0.001);
  }
}

TEST_CASE("lifts that reach the depth of the vertices beside them leave the limit undecided", "[smooth-limit]") {
  const SmoothLimit within = smooth_limit(narrow_budget(9));
  CHECK(within.verdict == Verdict::proved);
  CHECK(within.levels.back().largest_share == Approx(0.9));
  for (const long long lift : {10, 11}) {
    const PlaneBody body = narrow_budget(lift);
    REQUIRE(is_convex(body));
    const SmoothLimit beyond = smooth_limit(body);
    CHECK(beyond.verdict == Verdict::undecided);
    INFO(beyond.reason);
    CHECK(beyond.reason.find("use up their budget") != std::string::npos);
    CHECK(beyond.levels.size() == 1);
  }
}

TEST_CASE("the verdict on the limit does not depend on the multiples in which planes are written", "[smooth-limit]") {
  for (const long long lift : {9, 10}) {
    const PlaneBody body = narrow_budget(lift);
    PlaneBody multiples = body;
    for (std::size_t i = 0; i < body.planes.size(); ++i) {
      const Plane<Integer> p = body.planes[i];
      const Integer g = gcd(gcd(p.a, p.b), gcd(p.c, p.d)), k(static_cast<long long>(1 + i * i % 7));
      const auto part = [&](const Integer& x) { return exact_quotient(x, g) * k; };
      multiples.planes.set(i, Plane<Integer>{part(p.a), part(p.b), part(p.c), part(p.d)});
    }
    CHECK(smooth_limit(multiples).verdict == smooth_limit(body).verdict);
    // Planes of more than 128 bits.
    PlaneBody wide = body;
    for (std::size_t i = 0; i < body.planes.size(); ++i) {
      const Plane<Integer> p = body.planes[i];
      const Integer k = Integer::power_of_two(100 + i % 3);
      wide.planes.set(i, Plane<Integer>{p.a * k, p.b * k, p.c * k, p.d * k});
    }
    CHECK(smooth_limit(wide).verdict == smooth_limit(body).verdict);
  }
}

TEST_CASE("no smooth limit is claimed where the last steps are no chamfers", "[smooth-limit]") {
  const auto reason = [](const PlaneBody& b) {
    const SmoothLimit limit = smooth_limit(b);
    CHECK(limit.verdict == Verdict::undecided);
    return limit.reason;
  };
  CHECK(reason(samples::cube()) == "the last level does not come from a chamfer step");
  CHECK(reason(samples::honeycomb(samples::cube(), 2)) == "the last level does not come from a chamfer step");
  PlaneBody tilted = narrow_budget(9);  // one plane turned a little: still the same lattice, but no chamfer
  Plane<Integer> p = tilted.planes[9];
  tilted.planes.set(9, Plane<Integer>{p.a + Integer(1), p.b, p.c, p.d});
  REQUIRE(is_convex(tilted));
  CHECK_FALSE(reason(tilted).empty());
  PlaneBody other = narrow_budget(9);
  std::swap(other.addresses[20].parent, other.addresses[21].parent);
  CHECK(reason(other).find("level or parent") != std::string::npos);
  // Behind honeycomb steps only the chamfer steps count.
  const SmoothLimit behind = smooth_limit(samples::chamfer(samples::honeycomb(samples::cube(), 1), 2, 2));
  CHECK(behind.levels.size() == 2);
}
