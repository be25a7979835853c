// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/regular_smoothness.hpp"

#include "exact/spectrum_golden.hpp"
#include "hexact/exact/midedge.hpp"
#include "hexact/exact/midedge_limit.hpp"
#include "hexact/exact/spectrum.hpp"
#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

#include <functional>

namespace hexact {
namespace {

using Vector = Symbol::Vector;

constexpr std::array kSchemes{SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop, SpectrumScheme::catmull_clark,
                              SpectrumScheme::doo_sabin};

Rational fraction(long p, long q) { return Rational(p) / Rational(q); }

const RegularSmoothness& six_point() {
  static const RegularSmoothness regular = regular_smoothness(SpectrumScheme::midedge6);
  return regular;
}

Symbol pseudo_random(std::uint64_t& state) {
  Symbol p;
  for (int i = 0; i < 7; ++i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const auto bits = static_cast<int>(state >> 40);
    p.add({bits % 5 - 2, bits / 8 % 7 - 3}, fraction(bits / 64 % 19 - 9, 1 + bits / 2048 % 6));
  }
  return p;
}

/// The largest sum of entries of a product of `length` matrices: between constants times the length-th power of the
/// joint spectral radius. In floating point.
double greatest_product(const std::array<RationalMatrix, 2>& exact, std::size_t n, int length) {
  std::array<std::vector<double>, 2> t;
  for (std::size_t e = 0; e < 2; ++e) {
    for (const Rational& x : exact[e]) t[e].push_back(x.to_double());
  }
  std::function<double(const std::vector<double>&, int)> greatest = [&](const std::vector<double>& x, int left) {
    if (left == 0) return *std::max_element(x.begin(), x.end());
    double most = 0;
    for (const std::vector<double>& m : t) {
      std::vector<double> y(n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) y[i] += m[i * n + j] * x[j];
      }
      most = std::max(most, greatest(y, left - 1));
    }
    return most;
  };
  return greatest(std::vector<double>(n, 1.0), length);
}

}  // namespace

TEST_CASE("symbols: a product is divided again, anything else is not", "[regular]") {
  std::uint64_t state = 3;
  const std::vector<Vector> directions{{1, 0}, {0, 1}, {1, 1}, {1, -1}, {-1, 0}, {2, -1}};
  for (int i = 0; i < 60; ++i) {
    const Symbol p = pseudo_random(state), q = pseudo_random(state);
    CHECK(p * q == q * p);
    CHECK((p + q) * q == p * q + q * q);
    CHECK((p * q).total() == p.total() * q.total());
    CHECK((p * q).mapped({1, 1}, {1, -1}) == p.mapped({1, 1}, {1, -1}) * q.mapped({1, 1}, {1, -1}));
    for (const Vector& d : directions) {
      const Symbol factor = Symbol(Rational(1)) + Symbol::monomial(d);
      CHECK((p * factor).without(d) == p);
      CHECK_FALSE((p * factor + Symbol::monomial({0, 0})).without(d));
    }
  }
}

TEST_CASE("symbols: the order of a zero is the number of factors that vanish", "[regular]") {
  const Symbol z = Symbol(Rational(1)) + Symbol::monomial({1, 0}), zw = Symbol(Rational(1)) + Symbol::monomial({1, 1});
  const Symbol p = z * z * zw;
  CHECK(zero_order(p, 1, 1) == 0);
  CHECK(zero_order(p, -1, 1) == 3);
  CHECK(zero_order(p, 1, -1) == 1);
  CHECK(zero_order(p, -1, -1) == 2);
  CHECK(zero_order(p.shifted({-5, 3}), -1, -1) == 2);
}

TEST_CASE("the symbols of regular rules, against the published masks", "[regular]") {
  // [[…]] by rows of z, in units: Doo and Sabin, Catmull and Clark, and Loop in the coordinates of its triangles.
  const auto mask = [](const std::vector<std::vector<long>>& rows, const Vector& corner, long unit) {
    Symbol p;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < rows[i].size(); ++j) p.add({corner[0] + static_cast<int>(i), corner[1] + static_cast<int>(j)}, fraction(rows[i][j], unit));
    }
    return p;
  };
  CHECK(regular_symbol(SpectrumScheme::doo_sabin) == mask({{1, 3, 3, 1}, {3, 9, 9, 3}, {3, 9, 9, 3}, {1, 3, 3, 1}}, {-1, -1}, 16));
  CHECK(regular_symbol(SpectrumScheme::catmull_clark) ==
        mask({{1, 4, 6, 4, 1}, {4, 16, 24, 16, 4}, {6, 24, 36, 24, 6}, {4, 16, 24, 16, 4}, {1, 4, 6, 4, 1}}, {-2, -2}, 64));
  CHECK(regular_symbol(SpectrumScheme::loop) ==
        mask({{0, 0, 1, 2, 1}, {0, 2, 6, 6, 2}, {1, 6, 10, 6, 1}, {2, 6, 6, 2, 0}, {1, 2, 1, 0, 0}}, {-2, -2}, 16));
  CHECK(regular_symbol(SpectrumScheme::midedge) == mask({{0, 1, 1, 0}, {1, 2, 2, 1}, {1, 2, 2, 1}, {0, 1, 1, 0}}, {-1, -1}, 4));
  const Symbol six = regular_symbol(SpectrumScheme::midedge6);
  for (const auto& [at, weight] : std::map<Vector, long>{{{0, 0}, 278}, {{-2, 0}, 69}, {{2, 0}, 178}, {{2, 2}, 120}, {{-2, -2}, 18}, {{2, -2}, 39}, {{4, -2}, 0}, {{4, 0}, 9}, {{4, 2}, 9}, {{4, 4}, 0}}) {
    CHECK(six.coefficient(at) == fraction(weight, 1024));
  }
}

TEST_CASE("one Midedge step has the symbol (x + y)(1 + 3xy)/4, and two make the double step", "[regular]") {
  const auto term = [](int a, int b, long p, long q) { return Symbol::monomial({a, b}, fraction(p, q)); };
  const Symbol x = term(1, 0, 1, 2) + term(-1, 0, 1, 2), y = term(0, 1, 1, 2) + term(0, -1, 1, 2);
  const Symbol step = midedge_step_symbol(MidedgeRule::six_point);
  CHECK(step == (x + y) * (term(0, 0, 1, 4) + x * y * term(0, 0, 3, 4)));
  CHECK(step.total() == Rational(2));
  CHECK(step.coefficient({1, 0}) == fraction(5, 16));
  CHECK(step.coefficient({1, 2}) == fraction(3, 32));
  CHECK(midedge_step_symbol(MidedgeRule::simple) == x + y);
  CHECK(double_step_symbol(step) == regular_symbol(SpectrumScheme::midedge6).mapped({2, 0}, {0, 2}).shifted({-1, -1}));
  CHECK(zero_order(step, -1, 1) == 2);
}

TEST_CASE("smoothness of the box spline schemes", "[regular]") {
  struct Known {
    SpectrumScheme scheme;
    int continuity, generates;
    std::array<std::size_t, 4> directions;  ///< how many of (1,0), (0,1), (1,1), (1,−1)
    std::array<Rational, 3> quadratic_limit;
  };
  const Rational e = fraction(1, 8), s = fraction(1, 6);
  for (const Known& known : {Known{SpectrumScheme::midedge, 1, 2, {1, 1, 1, 1}, {e, 0, e}}, Known{SpectrumScheme::loop, 2, 3, {2, 2, 0, 2}, {s, -s, s}},
                             Known{SpectrumScheme::catmull_clark, 2, 3, {4, 4, 0, 0}, {s, 0, s}}, Known{SpectrumScheme::doo_sabin, 1, 2, {3, 3, 0, 0}, {e, 0, e}}}) {
    INFO(name_of(known.scheme));
    const RegularSmoothness regular = regular_smoothness(known.scheme);
    CHECK(regular.evidence.continuity == known.continuity);
    CHECK(regular.exponent == RationalInterval{1, 1});
    CHECK(class_name(regular) == "C^" + std::to_string(known.continuity) + ",1");
    CHECK_FALSE(regular.evidence.growth);
    const std::array<Vector, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(static_cast<std::size_t>(std::count(regular.factors.directions.begin(), regular.factors.directions.end(), directions[i])) == known.directions[i]);
    }
    CHECK(product(regular.factors) == regular.symbol);
    CHECK(regular.polynomials.generates == known.generates);
    CHECK(regular.polynomials.reproduces == 1);
    CHECK(regular.polynomials.quadratic_limit == known.quadratic_limit);
    const auto& sum_rules = regular.polynomials.sum_rules;
    CHECK(*std::min_element(sum_rules.begin(), sum_rules.end()) == (known.scheme == SpectrumScheme::midedge ? 2 : known.generates + 1));
  }
  CHECK(removal_number(std::vector<Vector>{{1, 0}, {0, 1}}) == 1);
  CHECK(removal_number(std::vector<Vector>{{1, 0}, {0, 1}, {1, 1}}) == 2);
  CHECK(removal_number(std::vector<Vector>{{1, 0}, {1, 0}}) == 0);
}

TEST_CASE("six-point Midedge: golden matrices, characteristic polynomial, exponent", "[regular]") {
  const RegularSmoothness& regular = six_point();
  const auto& golden = test::midedge_golden()["regular_smoothness"];
  CHECK(regular.law == StepLaw{fraction(9, 128), fraction(36, 128), fraction(38, 128), fraction(36, 128), fraction(9, 128)});
  CHECK(regular.evidence.link == StepLaw{fraction(3, 16), fraction(10, 16), fraction(3, 16)});
  const auto t = digit_matrices(regular.law);
  for (const int e : {0, 1}) {
    const auto& rows = golden[e == 0 ? "T0_times_128" : "T1_times_128"];
    for (std::size_t i = 0; i < 16; ++i) CHECK(t[static_cast<std::size_t>(e)][i] * Rational(128) == Rational(rows[i / 4][i % 4].get<int>()));
  }
  REQUIRE(regular.evidence.growth);
  const MassGrowth& growth = *regular.evidence.growth;
  CHECK(growth.word == std::vector{0, 1});
  CHECK(growth.vertices.size() == golden["polytope_vertices"].get<std::size_t>());
  CHECK(growth.vertices.size() + growth.images.size() == 25);  // two images of each vertex; the first vertex is none
  CHECK(growth.bounds.hi / growth.bounds.lo - Rational(1) < Rational(1).scaled(-100));
  // ρ² is a root of the cubic between the squares of the bounds, and there is none above.
  test::Line cubic;
  for (const auto& c : golden["rho_squared_is_largest_root_of"]) cubic.insert(cubic.begin(), test::rational(c.get<std::string>()));
  const Rational lo = growth.bounds.lo * growth.bounds.lo, hi = growth.bounds.hi * growth.bounds.hi;
  CHECK(test::at(cubic, lo).sign() < 0);
  CHECK(test::at(cubic, hi).sign() > 0);
  // The characteristic polynomial of T0 T1 is its product with 4096 X − 225, up to a factor: at five points, degree 4.
  const auto determinant = [&](const Rational& x) {
    test::Line m(16);
    for (std::size_t i = 0; i < 16; ++i) {
      for (std::size_t k = 0; k < 4; ++k) m[i] -= t[0][i / 4 * 4 + k] * t[1][k * 4 + i % 4];
      if (i % 5 == 0) m[i] += x;
    }
    Rational value(1);
    for (std::size_t i = 0; i < 4; ++i) {
      value *= m[i * 4 + i];
      for (std::size_t r = i + 1; r < 4; ++r) {
        const Rational factor = m[r * 4 + i] / m[i * 4 + i];
        for (std::size_t c = 0; c < 4; ++c) m[r * 4 + c] -= factor * m[i * 4 + c];
      }
    }
    return value;
  };
  const test::Line quartic = test::monic(test::times(cubic, {Rational(-225), Rational(4096)}));
  for (int x = 2; x < 7; ++x) CHECK(determinant(Rational(x)) == test::at(quartic, Rational(x)));
  const DecimalEnclosure exponent = decimal_enclosure(regular.exponent, 28);
  CHECK(exponent.lo == "0.9816730980429215485290212254");
  CHECK(exponent.hi == "0.9816730980429215485290212255");
  CHECK(std::abs(regular.exponent.lo.to_double() - golden["alpha"].get<double>()) < 1e-15);
  CHECK(class_name(regular) == "C^2,0.9816730980429");
  CHECK(regular.evidence.continuity == 2);
  CHECK(regular.polynomials.sum_rules == std::array{3, 3, 2});
  CHECK(regular.polynomials.step_sum_rules == 2);
  CHECK(regular.polynomials.generates == 2);
  CHECK(regular.polynomials.quadratic_limit == std::array<Rational, 3>{fraction(5, 16), 0, fraction(5, 16)});
}

TEST_CASE("evidence holds for its own scheme and for no other", "[regular]") {
  for (const SpectrumScheme own : kSchemes) {
    const RegularEvidence evidence = own == SpectrumScheme::midedge6 ? six_point().evidence : regular_smoothness(own).evidence;
    for (const SpectrumScheme other : kSchemes) CHECK(regular_fault(other, evidence).empty() == (own == other));
  }
}

TEST_CASE("evidence that claims something else is refused", "[regular]") {
  const RegularEvidence& good = six_point().evidence;
  const auto refused = [&](auto&& edit) {
    RegularEvidence bad = good;
    edit(bad);
    return !regular_fault(SpectrumScheme::midedge6, bad).empty();
  };
  CHECK_FALSE(refused([](RegularEvidence&) {}));
  CHECK(refused([](RegularEvidence& e) { e.continuity = 3; }));
  CHECK(refused([](RegularEvidence& e) { e.continuity = 1; }));
  CHECK(refused([](RegularEvidence& e) { std::swap(e.directions[0], e.directions[1]); }));
  CHECK(refused([](RegularEvidence& e) { e.directions.pop_back(); }));
  CHECK(refused([](RegularEvidence& e) { e.link = {fraction(1, 4), fraction(1, 2), fraction(1, 4)}; }));
  CHECK(refused([](RegularEvidence& e) { e.link = {1}; }));
  CHECK(refused([](RegularEvidence& e) { e.growth.reset(); }));
  CHECK(refused([](RegularEvidence& e) { e.link.clear(); }));
}

TEST_CASE("growth of masses of other laws, against the largest product", "[regular]") {
  int proved = 0;
  for (const auto& weights : {std::vector<long>{9, 36, 38, 36, 9}, {5, 30, 58, 30, 5}, {10, 30, 48, 30, 10}, {9, 35, 40, 30, 14}, {30, 68, 30}, {1, 40, 46, 40, 1}, {20, 25, 38, 25, 20}}) {
    StepLaw law;
    for (const long w : weights) law.push_back(fraction(w, 128));
    const std::size_t n = law.size() - 1;
    MassGrowth growth;
    try {
      growth = find_mass_growth(law);
    } catch (const NumericalFailure&) {
      continue;  // another product grows most
    }
    ++proved;
    CHECK(mass_growth_fault(law, growth).empty());
    // ‖products of length 14‖^(1/14), a constant factor each way.
    const double rate = std::pow(greatest_product(digit_matrices(law), n, 14), 1.0 / 14);
    CHECK(rate > growth.bounds.lo.to_double() * 0.999999);  // the spectral radius is at most the norm
    CHECK(rate < growth.bounds.hi.to_double() * 1.25);
    StepLaw other = law;
    std::swap(other[0], other[1]);
    CHECK_FALSE(mass_growth_fault(other, growth).empty());
  }
  CHECK(proved >= 3);
}

TEST_CASE("every number of the evidence matters", "[regular]") {
  const StepLaw& law = six_point().law;
  const MassGrowth& good = *six_point().evidence.growth;
  REQUIRE(mass_growth_fault(law, good).empty());
  const auto refused = [&](auto&& edit) {  // by the growth alone
    MassGrowth bad = good;
    edit(bad);
    return !mass_growth_fault(law, bad).empty();
  };
  const Rational ulp = Rational(1).scaled(-60);
  CHECK(refused([&](MassGrowth& g) { g.bounds.hi = g.bounds.lo; }));
  CHECK(refused([&](MassGrowth& g) { g.bounds.hi -= Rational(1).scaled(-102); }));  // below ρ
  CHECK(refused([&](MassGrowth& g) { g.bounds.lo = good.bounds.hi - Rational(1).scaled(-110); }));  // above ρ
  CHECK(refused([&](MassGrowth& g) { g.bounds.lo -= ulp; }));
  CHECK(refused([&](MassGrowth& g) { g.word = {0}; }));
  CHECK(refused([&](MassGrowth& g) { g.word.clear(); }));
  CHECK_FALSE(refused([&](MassGrowth& g) { g.word = {1, 0}; }));  // the same eigenvalues
  for (std::size_t v = 0; v < good.vertices.size(); ++v) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (const long change : {-1L, 1L, 1L << 40}) {
        if (v == 0 && std::abs(change) == 1) continue;  // the eigenvector is rounded, and other roundings do as well
        CHECK(refused([&](MassGrowth& g) { g.vertices[v].entries[i] += Integer(change); }));
      }
    }
    if (v == 0) continue;
    CHECK(refused([&](MassGrowth& g) { g.vertices[v].digit = 1 - g.vertices[v].digit; }));
    CHECK(refused([&](MassGrowth& g) { g.vertices[v].parent = (g.vertices[v].parent + 1) % v + (v == 1 ? 1 : 0); }));
  }
  for (std::size_t i = 0; i < good.images.size(); ++i) {
    CHECK(refused([&](MassGrowth& g) { g.images.erase(g.images.begin() + static_cast<std::ptrdiff_t>(i)); }));
    CHECK(refused([&](MassGrowth& g) { g.images[i].digit = 1 - g.images[i].digit; }));
    CHECK(refused([&](MassGrowth& g) { g.images[i].vertex += 1; }));
    for (std::size_t j = 0; j < good.images[i].combination.size(); ++j) {
      CHECK(refused([&](MassGrowth& g) { g.images[i].combination[j].second += ulp; }));
      CHECK(refused([&](MassGrowth& g) { g.images[i].combination[j].second -= ulp; }));
      CHECK(refused([&](MassGrowth& g) { g.images[i].combination[j].first = 12; }));
    }
  }
  CHECK(refused([&](MassGrowth& g) { g.vertices.pop_back(); }));
}

// The exponent in the limit surface itself: heights that depend on x only, one column raised; the program's own double
// steps, and its limits of facet centres on both sides. Third differences of these over h² are jumps of second
// derivatives at distance h, averaged; the greatest must shrink as ρ^n, with a factor that settles after two levels.
TEST_CASE("jumps of second derivatives of limits shrink as the exponent says", "[regular]") {
  constexpr std::uint32_t columns = 12, rows = 9;
  FacetLoops loops;
  const auto vertex = [](std::uint32_t i, std::uint32_t j) { return make_id<VertexId>(i * rows + j); };
  for (std::uint32_t i = 0; i + 1 < columns; ++i) {
    for (std::uint32_t j = 0; j + 1 < rows; ++j) loops.add(std::array{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
  }
  MidedgeLevel<Rational> level{MidedgeMap(loops, std::size_t{columns} * rows), {}};
  for (std::uint32_t i = 0; i < columns; ++i) {
    for (std::uint32_t j = 0; j < rows; ++j) level.points.push_back({i == columns / 2 ? 1 : 0, static_cast<int>(i), static_cast<int>(j)});
  }
  const auto& weights = midedge_centre_weights();
  std::vector<Rational> jumps;
  const Rational middle = fraction(rows - 1, 2);
  for (int n = 0; n < 6; ++n) {
    if (n > 0) level = midedge_double_step(level, MidedgeRule::six_point);
    const Rational h = Rational(1).scaled(-n);
    std::map<Rational, Rational> height;  // at the limits of the facets along the middle
    for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
      if (level.map.facet_size(f) != 4) continue;
      Rational y;
      for (std::uint32_t c = 0; c < 4; ++c) y += level.points[level.map.origin(level.map.facet_start(f) + c)].z.scaled(-2);
      if (y <= middle - h || y > middle) continue;  // one row
      const std::vector<std::uint32_t> net = midedge_net(level.map, f);
      if (net.size() != 36) continue;
      std::array<Rational, 2> limit;
      for (std::size_t p = 0; p < 36; ++p) {
        const Rational w = fraction(weights[p % 9 / 3][p % 3], 4 * 243712L);
        limit[0] += w * level.points[net[p]].x;
        limit[1] += w * level.points[net[p]].y;
      }
      const auto [at, is_new] = height.try_emplace(limit[1], limit[0]);
      CHECK((is_new || at->second == limit[0]));
    }
    Rational greatest;
    for (const auto& [x, first] : height) {
      const auto second = height.find(x + h), third_point = height.find(x + h * Rational(2)), last = height.find(x + h * Rational(3));
      if (second == height.end() || third_point == height.end() || last == height.end()) continue;
      const Rational third = last->second - first + Rational(3) * (second->second - third_point->second);
      greatest = std::max(greatest, abs(third) / (h * h));
    }
    jumps.push_back(greatest);
  }
  const Rational square = six_point().evidence.growth->bounds.lo * six_point().evidence.growth->bounds.lo;
  for (std::size_t n = 2; n + 2 < jumps.size(); ++n) {
    const Rational ratio = jumps[n + 2] / jumps[n];
    INFO(n << ": " << ratio.to_double());
    CHECK(abs(ratio / square - Rational(1)) < (n == 2 ? fraction(6, 100) : fraction(5, 1000)));
  }
}

}  // namespace hexact
