// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/eigenvalues.hpp"

#include "exact/spectrum_golden.hpp"
#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace hexact {
namespace {

using test::Line;
using test::polynomial;

SubdivisionMatrix six_point(int k) { return subdivision_matrix(SpectrumScheme::midedge6, k, 3); }

Rational fraction(long p, long q) { return Rational(p) / Rational(q); }

Line product(std::initializer_list<Line> factors) {
  Line p{Rational(1)};
  for (const Line& f : factors) p = test::times(p, f);
  return p;
}

/// Coefficients of 1024 L from those of L.
Line in_1024(Line p) {
  Rational scale(1);
  for (std::size_t i = p.size(); i-- > 0; scale *= Rational(1024)) p[i] *= scale;
  return p;
}

Line descending(const nlohmann::json& coefficients) {
  Line p;
  for (const auto& c : coefficients) p.insert(p.begin(), test::rational(c));
  return test::monic(p);
}

int total(const ModeSpectrum& s) {
  int n = s.remaining;
  for (const Eigenvalue& e : s.isolated) n += e.multiplicity;
  return n;
}

}  // namespace

TEST_CASE("characteristic polynomials of mode 0, and of valence 4, factor as published", "[spectrum]") {
  const Line L{Rational(0), Rational(1)};
  const Line mode0 = product({L, polynomial({-1, 1}), polynomial({-1, 4}), polynomial({-1, 64}), polynomial({-9, 128}), polynomial({-9, 128}),
                              polynomial({-9, 512}), polynomial({9, -3840, 65536})});
  for (const int k : {3, 4, 5, 6, 7, 11, 20, 50}) CHECK(test::at_cosine(characteristic_factors(six_point(k), 0), Rational(0)) == mode0);
  const Line mode1 = product({L, polynomial({-1, 2}), polynomial({-9, 512}), test::power(polynomial({45, -2368, 16384}), 2), polynomial({9, -2688, 65536})});
  CHECK(test::at_cosine(characteristic_factors(six_point(4), 1), Rational(0)) == mode1);
  const Line mode2 = product({test::power(L, 2), test::power(polynomial({-1, 4}), 2), test::power(polynomial({-9, 128}), 2),
                              test::power(polynomial({-3, 256}), 2), polynomial({-9, 512})});
  CHECK(test::at_cosine(characteristic_factors(six_point(4), 2), Rational(-1)) == mode2);
}

TEST_CASE("the other modes have the universal polynomial in c and t = 3/(k-2)", "[spectrum]") {
  for (const int k : {7, 9, 11, 13, 20, 47}) {
    const Rational t = fraction(3, k - 2);
    for (const Rational& c : {fraction(1, 3), fraction(-2, 7), Rational(5)}) {
      Line q(9);
      for (const auto& term : test::midedge_golden()["universal_charpoly"]["terms_a_b_d_coef"]) {
        Rational w = test::rational(term[3]);
        for (int i = 0; i < term[1].get<int>(); ++i) w *= c;
        for (int i = 0; i < term[2].get<int>(); ++i) w *= t;
        q[term[0].get<std::size_t>()] += w;
      }
      const Line expected = test::times({Rational(-18), Rational(1)}, q);
      CHECK(in_1024(test::at_cosine(characteristic_factors(six_point(k), 1), c)) == expected);
      CHECK(in_1024(test::at_cosine(characteristic_factors(six_point(k), 2), c)) == expected);
    }
  }
}

TEST_CASE("minimal polynomials at valence 3 and 6, and the norm at valence 5", "[spectrum]") {
  const auto& values = test::midedge_golden()["subdominant"]["values"];
  const Line x18{Rational(-18), Rational(1)};
  for (const auto& [k, c] : {std::pair{3, fraction(-1, 2)}, {6, fraction(1, 2)}}) {
    const Line expected = descending(values[std::to_string(k)]["minimal_polynomial_of_1024_lambda"]);
    CHECK(in_1024(test::at_cosine(characteristic_factors(six_point(k), 1), c)) == test::times(x18, expected));
  }
  // Valence 5: Q(c) for the roots c of 4c² + 2c − 1 as A + B c; its norm is A² − AB/2 − B²/4.
  Line a, b;
  for (const CharacteristicFactor& f : characteristic_factors(six_point(5), 1)) {
    if (f.coefficients.size() != 9) continue;
    for (const CosinePolynomial& p : f.coefficients) {
      Rational u, v, pu(1), pv(0);  // c^i = pu + pv c
      for (const Rational& x : p) {
        u += x * pu, v += x * pv;
        const Rational next = pu - pv / Rational(2);
        pu = pv / Rational(4), pv = next;
      }
      a.push_back(u), b.push_back(v);
    }
  }
  Line norm = test::times(a, a);
  const Line ab = test::times(a, b), bb = test::times(b, b);
  for (std::size_t i = 0; i < norm.size(); ++i) norm[i] -= ab[i] / Rational(2) + bb[i] / Rational(4);
  CHECK(in_1024(norm) == descending(values["5"]["norm_polynomial_of_1024_lambda_modes_1_and_2"]));
}

TEST_CASE("classical factors over Q(cos 2pi/k)", "[spectrum]") {
  using Factor = std::vector<CosinePolynomial>;
  const auto has = [](SpectrumScheme scheme, int k, int mode, const Factor& wanted) {
    for (const CharacteristicFactor& f : characteristic_factors(subdivision_matrix(scheme, k, 3), mode)) {
      if (f.coefficients == wanted) return true;
    }
    return false;
  };
  for (const int k : {5, 7, 9, 16}) {
    // L = (5 + c ± √((c+9)(c+1)))/16
    CHECK(has(SpectrumScheme::catmull_clark, k, 1, {{fraction(1, 16)}, {fraction(-5, 8), fraction(-1, 8)}, {Rational(1)}}));
    // L = 3/8 + c/4; in mode 0 its square at mode 1's c
    CHECK(has(SpectrumScheme::loop, k, 1, {{fraction(-3, 8), fraction(-1, 4)}, {Rational(1)}}));
    CHECK(has(SpectrumScheme::loop, k, 0, {{fraction(-9, 64), fraction(-3, 16), fraction(-1, 16)}, {Rational(1)}}));
    CHECK(has(SpectrumScheme::doo_sabin, k, 1, {{fraction(-1, 2)}, {Rational(1)}}));
    CHECK(has(SpectrumScheme::doo_sabin, k, 2, {{fraction(-1, 4)}, {Rational(1)}}));
    // cos²(π m/k)
    CHECK(has(SpectrumScheme::midedge, k, 1, {{fraction(-1, 2), fraction(-1, 2)}, {Rational(1)}}));
  }
}

TEST_CASE("the polynomials of all modes at once are those of each", "[spectrum]") {
  for (const SpectrumScheme scheme : {SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop,
                                      SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
    for (const int k : {3, 4, 9, 12}) {
      const SubdivisionMatrix m = subdivision_matrix(scheme, k, 3);
      const auto all = characteristic_factors(m);
      REQUIRE(all.size() == static_cast<std::size_t>(k / 2) + 1);
      const auto spectra = mode_spectra(m);
      REQUIRE(spectra.size() == all.size());
      for (std::size_t mode = 0; mode < all.size(); ++mode) {
        const auto one = characteristic_factors(m, static_cast<int>(mode));
        REQUIRE(all[mode].size() == one.size());
        for (std::size_t i = 0; i < one.size(); ++i) {
          CHECK(all[mode][i].angle == one[i].angle);
          CHECK(all[mode][i].coefficients == one[i].coefficients);
        }
        const ModeSpectrum alone = mode_spectrum(m, static_cast<int>(mode));
        REQUIRE(spectra[mode].isolated.size() == alone.isolated.size());
        for (std::size_t i = 0; i < alone.isolated.size(); ++i) {
          CHECK(spectra[mode].isolated[i].mode == static_cast<int>(mode));
          CHECK(spectra[mode].isolated[i].enclosure == alone.isolated[i].enclosure);
        }
      }
    }
  }
}

TEST_CASE("a single vertex with weights in all sectors has the eigenvalue sum of w_d cos(2 pi dm/k)", "[spectrum]") {
  SubdivisionMatrix m;
  m.valence = 12;
  m.vertices = {{0, 0}};
  m.centre_to.resize(1);
  std::vector<Rational> w(12);
  for (int d = 0; d <= 6; ++d) w[static_cast<std::size_t>(d)] = w[static_cast<std::size_t>((12 - d) % 12)] = fraction(d * d + 1, 300);
  for (int d = 0; d < 12; ++d) m.local.push_back({0, 0, d, w[static_cast<std::size_t>(d)]});
  for (const int mode : {0, 2, 3, 4, 6}) {
    Rational sum;
    for (int d = 0; d < 12; ++d) sum += w[static_cast<std::size_t>(d)] * rational_cosine(d * mode, 12).value;
    const ModeSpectrum s = mode_spectrum(m, mode);
    REQUIRE(s.isolated.size() == 1);
    CHECK(s.isolated[0].enclosure == RationalInterval{sum, sum});
  }
  for (const int mode : {1, 5}) {
    const RationalInterval e = mode_spectrum(m, mode).isolated.at(0).enclosure;
    double sum = 0;
    for (int d = 0; d < 12; ++d) sum += w[static_cast<std::size_t>(d)].to_double() * std::cos(2 * M_PI * d * mode / 12);
    CHECK(e.lo.to_double() == Approx(sum));
  }
  m.local[1].weight += Rational(1);
  CHECK_THROWS_AS(mode_spectrum(m, 2), InvalidInput);
}

TEST_CASE("every eigenvalue of the five schemes is isolated within 2^-100", "[spectrum]") {
  for (const SpectrumScheme scheme : {SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop,
                                      SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
    for (const int k : {3, 4, 5, 6, 7, 8, 10, 12, 37}) {
      const SubdivisionMatrix m = subdivision_matrix(scheme, k, ring_reach(scheme));
      for (int mode = 0; 2 * mode <= k; ++mode) {
        const ModeSpectrum s = mode_spectrum(m, mode);
        CHECK(s.remaining == 0);
        CHECK(total(s) == static_cast<int>(m.size()) + (mode == 0 && m.has_centre ? 1 : 0));
        for (std::size_t i = 0; i < s.isolated.size(); ++i) {
          const RationalInterval& e = s.isolated[i].enclosure;
          CHECK(e.hi - e.lo < Rational(1).scaled(-100));
          if (i > 0) CHECK(e.hi < s.isolated[i - 1].enclosure.lo);
        }
      }
    }
  }
}

TEST_CASE("a double root that is not rational, and eigenvalues near 0", "[spectrum]") {
  const ModeSpectrum s = mode_spectrum(six_point(4), 1);
  REQUIRE(s.isolated.size() == 7);
  CHECK(s.isolated[0].enclosure.lo == fraction(1, 2));
  CHECK(s.isolated[1].multiplicity == 2);  // (37 + √649)/512
  CHECK(s.isolated[1].enclosure.lo.to_double() == Approx((37 + std::sqrt(649.0)) / 512));
  CHECK(s.isolated[1].enclosure.lo < s.isolated[1].enclosure.hi);
  CHECK(s.isolated.back().enclosure.lo.is_zero());
}

TEST_CASE("subdominant eigenvalues lie where the golden data has them", "[spectrum]") {
  for (const auto& [k, values] : test::midedge_golden()["subdominant"]["values"].items()) {
    const RationalInterval e = mode_spectrum(six_point(std::stoi(k)), 1).isolated.front().enclosure;
    const Rational slack = Rational(1).scaled(-103);
    CHECK(e.lo <= test::rational(values["lambda_hi"]));
    CHECK(e.hi >= test::rational(values["lambda_lo"]));
    CHECK(abs(e.lo - test::rational(values["lambda"])) < slack);
  }
}

TEST_CASE("matrices with complex or close eigenvalues say what is not isolated, and bound it", "[spectrum]") {
  SubdivisionMatrix m;
  m.valence = 3;
  m.vertices = {{0, 0}, {0, 1}};
  m.centre_to.resize(2);
  m.local = {{0, 1, 0, Rational(1)}, {1, 0, 0, fraction(-1, 4)}};  // ± i/2
  const ModeSpectrum s = mode_spectrum(m, 1);
  CHECK(s.isolated.empty());
  CHECK(s.remaining == 2);
  CHECK(s.remaining_bound > fraction(1, 2));
  CHECK(s.remaining_bound < fraction(501, 1000));
  m.local.push_back({0, 0, 1, fraction(1, 2)});  // a sector weighs only one neighbour: no mirror image
  CHECK_THROWS_AS(mode_spectrum(m, 1), InvalidInput);
}

}  // namespace hexact
