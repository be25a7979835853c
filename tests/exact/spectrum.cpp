// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/spectrum.hpp"
#include "hexact/exact/spectrum_masks.hpp"

#include "exact/spectrum_golden.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

namespace hexact {
namespace {

std::vector<SpectrumRow> rows(SpectrumScheme scheme, int first, int last) {
  std::vector<SpectrumSubject> subjects;
  for (int k = first; k <= last; ++k) subjects.push_back(scheme_subject(scheme, k));
  return spectrum_rows(subjects);
}

Rational fraction(long p, long q) { return Rational(p) / Rational(q); }

}  // namespace

TEST_CASE("six-point Midedge is C1 for face sizes 3 to 20, with the golden margins", "[spectrum]") {
  for (const SpectrumRow& row : rows(SpectrumScheme::midedge6, 3, 20)) {
    CHECK(row.ordering == Verdict::proved);
    CHECK(row.ring.verdict == Verdict::proved);
    CHECK(row.c1 == Verdict::proved);
    CHECK(overall(row) == Verdict::proved);
    REQUIRE(row.subdominant);
    CHECK(row.subdominant->mode == 1);
    CHECK(row.subdominant->multiplicity == 2);
    REQUIRE(row.next);
    const auto& values = test::midedge_golden()["subdominant"]["values"];
    if (!values.contains(std::to_string(row.valence))) continue;
    const auto& golden = values[std::to_string(row.valence)];
    CHECK(row.next->mode == golden["next_mode"].get<int>());
    CHECK(row.next->enclosure.lo.to_double() == Approx(std::stod(golden["next_eigenvalue"].get<std::string>())).epsilon(1e-14));
    const auto& certificate = golden["certificate"];
    CHECK(row.ring.level == certificate["level"].get<int>());
    // Proven lower bounds, rounded down to six digits, of what the reference computed in doubles.
    for (const auto& [bound, value] : {std::pair{row.ring.jacobian, certificate["jac"].get<double>()}, {row.ring.half_plane, certificate["wedge"].get<double>()}}) {
      CHECK(bound.to_double() <= value);
      CHECK(bound.to_double() > value - 2e-6);
    }
  }
}

TEST_CASE("the gap of the eigenvalues at the far end of the table", "[spectrum]") {
  const SpectrumRow row = spectrum_row(scheme_subject(SpectrumScheme::midedge6, 50));
  CHECK(overall(row) == Verdict::proved);
  CHECK(row.ring.level == 4);
  CHECK(row.ring.jacobian >= fraction(1, 4));
}

TEST_CASE("simple Midedge: refuted at triangles, where 1/4 is eightfold; C1 beyond", "[spectrum]") {
  const auto table = rows(SpectrumScheme::midedge, 3, 12);
  CHECK(table[0].ordering == Verdict::refuted);
  CHECK(table[0].ordering_witness.find("0.25, of multiplicity 8") != std::string::npos);
  CHECK(table[0].c1 == Verdict::undecided);
  CHECK(overall(table[0]) == Verdict::refuted);
  for (std::size_t i = 1; i < table.size(); ++i) CHECK(overall(table[i]) == Verdict::proved);
}

TEST_CASE("the classical schemes are C1, with their subdominant eigenvalues", "[spectrum]") {
  for (const SpectrumScheme scheme : {SpectrumScheme::loop, SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
    for (const SpectrumRow& row : rows(scheme, 3, 24)) {
      CHECK(overall(row) == Verdict::proved);
      REQUIRE(row.subdominant);
      const RationalInterval& e = row.subdominant->enclosure;
      const double c = std::cos(2 * M_PI / row.valence);
      const double expected = scheme == SpectrumScheme::loop            ? 3.0 / 8 + c / 4
                              : scheme == SpectrumScheme::catmull_clark ? (5 + c + std::sqrt((c + 9) * (c + 1))) / 16
                                                                        : 0.5;
      CHECK(e.lo.to_double() == Approx(expected).epsilon(1e-14));
      if (scheme == SpectrumScheme::doo_sabin) CHECK((e.lo == fraction(1, 2) && e.hi == fraction(1, 2)));
    }
  }
}

TEST_CASE("regular nets have the identity as characteristic map", "[spectrum]") {
  // Every Jacobian is constant: the least relative coefficient and the least sine are 1 but for the rounding of bounds.
  for (const auto& [scheme, k] : {std::pair{SpectrumScheme::midedge, 4}, {SpectrumScheme::midedge6, 4}, {SpectrumScheme::loop, 6},
                                  {SpectrumScheme::catmull_clark, 4}, {SpectrumScheme::doo_sabin, 4}}) {
    const SpectrumRow row = spectrum_row(scheme_subject(scheme, k));
    CHECK(row.subdominant->enclosure.lo == fraction(1, 2));
    CHECK(row.ring.jacobian == fraction(999999, 1000000));
  }
}

TEST_CASE("the table does not depend on the number of threads", "[spectrum]") {
  const auto all = rows(SpectrumScheme::midedge6, 3, 8);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto again = rows(SpectrumScheme::midedge6, 3, 8);
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(all[i].ring.jacobian == again[i].ring.jacobian);
    for (std::size_t m = 0; m < all[i].modes.size(); ++m) {
      REQUIRE(all[i].modes[m].isolated.size() == again[i].modes[m].isolated.size());
      for (std::size_t j = 0; j < all[i].modes[m].isolated.size(); ++j) {
        CHECK(all[i].modes[m].isolated[j].enclosure == again[i].modes[m].isolated[j].enclosure);
      }
    }
  }
}

TEST_CASE("orderings that fail name the eigenvalue, and overlaps are undecided", "[spectrum]") {
  const auto exact = [](int mode, Rational x, int multiplicity) { return Eigenvalue{mode, {x, x}, multiplicity}; };
  SpectrumRow row;
  row.valence = 5;
  row.modes.resize(3);
  row.modes[0].isolated = {exact(0, Rational(1), 1), exact(0, fraction(1, 4), 1)};
  row.modes[1].isolated = {exact(1, fraction(1, 2), 1)};
  row.modes[2].isolated = {exact(2, fraction(1, 3), 1)};
  decide_ordering(row);
  CHECK(row.ordering == Verdict::proved);
  CHECK(row.next->enclosure.lo == fraction(1, 3));
  row.modes[2].isolated = {exact(2, fraction(-1, 2), 1)};
  decide_ordering(row);
  CHECK(row.ordering == Verdict::refuted);  // |−1/2| = 1/2
  row.modes[2].isolated = {Eigenvalue{2, {fraction(49, 100), fraction(51, 100)}, 1}};
  decide_ordering(row);
  CHECK(row.ordering == Verdict::undecided);
  row.modes[2].isolated = {exact(2, fraction(1, 3), 1)};
  row.modes[2].remaining = 1, row.modes[2].remaining_bound = fraction(2, 5);
  decide_ordering(row);
  CHECK(row.ordering == Verdict::proved);
  row.modes[2].remaining_bound = fraction(3, 5);
  decide_ordering(row);
  CHECK(row.ordering == Verdict::undecided);
  row.modes[2].remaining = 0;
  row.modes[0].isolated[0].multiplicity = 2;
  decide_ordering(row);
  CHECK(row.ordering == Verdict::refuted);
  row.modes[0].isolated.erase(row.modes[0].isolated.begin());
  decide_ordering(row);
  CHECK(row.ordering == Verdict::refuted);  // no 1 at all
}

TEST_CASE("what may be otherwise is undecided, not refuted", "[spectrum]") {
  const auto exact = [](int mode, Rational x, int multiplicity) { return Eigenvalue{mode, {x, x}, multiplicity}; };
  const auto decided = [](const SpectrumRow& row) {
    SpectrumRow r = row;
    decide_ordering(r);
    return r.ordering;
  };
  SpectrumRow row;
  row.valence = 5;
  row.modes.resize(3);
  row.modes[0].isolated = {exact(0, Rational(1), 1)};
  row.modes[1].isolated = {exact(1, fraction(1, 2), 1)};
  row.modes[2].isolated = {exact(2, fraction(-1, 2), 1)};
  CHECK(decided(row) == Verdict::refuted);
  row.modes[2].remaining = 1, row.modes[2].remaining_bound = fraction(4, 5);  // a pair of modes: the second eigenvalue may be there
  CHECK(decided(row) == Verdict::undecided);
  row.modes[2] = {};
  row.modes[0].isolated = {Eigenvalue{0, {fraction(99, 100), fraction(101, 100)}, 1}};  // may be 1
  CHECK(decided(row) == Verdict::undecided);
  row.modes[0].isolated = {Eigenvalue{0, {fraction(98, 100), fraction(99, 100)}, 1}};
  CHECK(decided(row) == Verdict::refuted);
  row.modes[0] = {{}, 1, fraction(11, 10)};
  CHECK(decided(row) == Verdict::undecided);
  row.modes[0].remaining_bound = fraction(9, 10);
  CHECK(decided(row) == Verdict::refuted);
  row.modes[0] = {{exact(0, Rational(1), 1)}, 0, {}};
  for (const Rational& hi : {fraction(1, 100), Rational(0), fraction(-1, 100)}) {  // of which sign the only other one is
    row.modes[1].isolated = {Eigenvalue{1, {fraction(-1, 50), hi}, 1}};
    CHECK(decided(row) == (hi.sign() > 0 ? Verdict::undecided : Verdict::refuted));
  }
}

TEST_CASE("a mask whose eigenvalues are 1 but in intervals is undecided", "[spectrum]") {
  // 11/10 − c/5 − 2c²/5 with 4c² + 2c = 1 is 1 in modes 1 and 2, and mode 0 has 1/2.
  const Rational w = fraction(-1, 10);
  const SpectrumRow row = spectrum_row(mask_subject({"", SpectrumScheme::doo_sabin, {}}, {5, {fraction(9, 10), w, w, w, w}, {}}));
  CHECK(row.ordering == Verdict::undecided);
}

TEST_CASE("decimal enclosures round outward and keep exact decimals", "[spectrum]") {
  const auto text = [](const Rational& lo, const Rational& hi, int digits) {
    const DecimalEnclosure d = decimal_enclosure({lo, hi}, digits);
    return d.lo + " " + d.hi;
  };
  CHECK(text(fraction(1, 3), fraction(1, 3), 3) == "0.333 0.334");
  CHECK(text(fraction(-1, 3), fraction(-1, 3), 3) == "-0.334 -0.333");
  CHECK(text(fraction(9, 512), fraction(9, 512), 30) == "0.017578125 0.017578125");
  CHECK(text(Rational(0), Rational(1), 5) == "0 1");
  CHECK(text(fraction(-1, 1000), fraction(1999, 1000), 2) == "-0.01 2");
}

}  // namespace hexact
