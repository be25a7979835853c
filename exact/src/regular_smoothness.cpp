// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/regular_smoothness.hpp"

#include "hexact/exact/spectrum.hpp"
#include "hexact/kernel/errors.hpp"
#include "interval.hpp"

#include <algorithm>

namespace hexact {
namespace {

using Vector = Symbol::Vector;

const Symbol kOne = Rational(1);

Rational half() { return Rational(1) / Rational(2); }

/// The weights of p seen along a line, as q(−L) … q(L): a vector v is at place normal · v. Empty if they are not centred.
StepLaw projected(const Symbol& p, const Vector& normal) {
  std::map<int, Rational> line;
  for (const auto& [v, weight] : p.terms()) line[v[0] * normal[0] + v[1] * normal[1]] += weight;
  const int last = line.rbegin()->first;
  if (last < 1 || line.begin()->first != -last) return {};
  StepLaw law;
  for (int i = -last; i <= last; ++i) law.push_back(line.count(i) != 0 ? line[i] : Rational());
  return law;
}

StepLaw convolved(const StepLaw& p, const StepLaw& q) {
  StepLaw r(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
  }
  return r;
}

/// c(t²).
StepLaw spread(const StepLaw& c) {
  StepLaw r(2 * c.size() - 1);
  for (std::size_t i = 0; i < c.size(); ++i) r[2 * i] = c[i];
  return r;
}

// ---- checking ----------------------------------------------------------------------------------------------------

/// The symbol is the product of its box spline and weights of sum 1 that are not negative, and steps converge.
std::string box_spline_fault(const Symbol& symbol, const BoxSplineFactors& factors) {
  if (product(factors) != symbol) return "the symbol is not the product of its factors";
  if (factors.smoothing.has_negative_coefficient() || factors.smoothing.total() != Rational(1)) return "the smoothing is no average";
  std::vector<Vector> rest = factors.directions;
  for (const Vector& axis : {Vector{1, 0}, Vector{0, 1}}) {
    const auto at = std::find(rest.begin(), rest.end(), axis);
    if (at == rest.end()) return "an axis is missing among the directions";
    rest.erase(at);
  }
  const bool crosses = std::any_of(rest.begin(), rest.end(), [](const Vector& v) { return v[0] != 0; }) &&
                       std::any_of(rest.begin(), rest.end(), [](const Vector& v) { return v[1] != 0; });
  return crosses ? "" : "the directions beside the axes do not leave both axes";
}

std::string smoothing_fault(const BoxSplineFactors& factors, const RegularEvidence& evidence) {
  if (factors.directions.size() != 4 || removal_number(factors.directions) != 3) return "the box spline has not four different directions";
  const StepLaw q = projected(factors.smoothing, {1, 0}), d = projected(factors.smoothing, {1, 1});
  if (q.empty() || d.empty() || q != projected(factors.smoothing, {0, 1}) || d != projected(factors.smoothing, {-1, 1})) {
    return "the smoothing is not the same along both axes and both diagonals";
  }
  const StepLaw& c = evidence.link;
  Rational total;
  for (const Rational& x : c) total += x;
  const bool average = total == Rational(1) && std::none_of(c.begin(), c.end(), [](const Rational& x) { return x.sign() < 0; });
  if (!average || convolved(d, c) != convolved(q, spread(c))) return "the link between axes and diagonals is not given";
  if (evidence.growth->bounds.lo <= half() || evidence.growth->bounds.hi >= Rational(1)) return "the growth is not between 1/2 and 1";
  return mass_growth_fault(q, *evidence.growth);
}

std::string evidence_fault(const Symbol& symbol, const RegularEvidence& evidence) {
  const BoxSplineFactors factors = box_spline_factors(symbol);
  if (evidence.directions != factors.directions) return "these are not the directions of the symbol";
  if (std::string f = box_spline_fault(symbol, factors); !f.empty()) return f;
  const bool smooths = factors.smoothing != kOne;
  if (smooths != evidence.growth.has_value() || smooths == evidence.link.empty()) {
    return smooths ? "the growth of the smoothing's masses is not given" : "there is no smoothing";
  }
  const int continuity = removal_number(factors.directions) - 2 + (smooths ? 1 : 0);
  if (evidence.continuity != continuity) return "the directions give C^" + std::to_string(continuity);
  return smooths ? smoothing_fault(factors, evidence) : "";
}

// ---- proving -----------------------------------------------------------------------------------------------------

/// (x + y) (1 + 3xy)/4 or x + y, with x = (z + 1/z)/2 and y = (w + 1/w)/2.
Symbol claimed_step(MidedgeRule rule) {
  const Symbol x = (Symbol::monomial({1, 0}) + Symbol::monomial({-1, 0})) * Symbol(half());
  const Symbol y = (Symbol::monomial({0, 1}) + Symbol::monomial({0, -1})) * Symbol(half());
  if (rule == MidedgeRule::simple) return x + y;
  return (x + y) * (kOne + x * y * Symbol(Rational(3))) * Symbol(Rational(1) / Rational(4));
}

/// The second of two steps' smoothings, seen along an axis of the mesh; along a diagonal the first one is the same on a
/// lattice twice as wide.
StepLaw link_of(const Symbol& step) {
  const BoxSplineFactors factors = box_spline_factors(step);
  const Symbol average = factors.smoothing * Symbol(Rational(1) / factors.smoothing.total());
  const StepLaw wide = projected(average.mapped({1, 1}, {1, -1}), {1, 0});
  StepLaw link;
  for (std::size_t i = 0; i < wide.size(); i += 2) link.push_back(wide[i]);
  return link;
}

/// Proves that the symbol of the program's own step is the product in closed form, and that two steps make `symbol`.
Symbol proved_step(SpectrumScheme scheme, const Symbol& symbol) {
  const MidedgeRule rule = scheme == SpectrumScheme::midedge ? MidedgeRule::simple : MidedgeRule::six_point;
  Symbol step = midedge_step_symbol(rule);
  HEXACT_INVARIANT(step == claimed_step(rule));
  HEXACT_INVARIANT(double_step_symbol(step) == symbol.mapped({2, 0}, {0, 2}).shifted({-1, -1}));
  return step;
}

/// Half the covariance of Σ 2^−j D_j, D_j with the weights symbol/4: a third of that of D_1.
std::array<Rational, 3> quadratic_limit(const Symbol& symbol) {
  std::array<Rational, 2> mean;
  std::array<Rational, 3> second;
  for (const auto& [v, weight] : symbol.terms()) {
    const Rational share = weight / Rational(4), x(v[0]), y(v[1]);
    mean[0] += share * x, mean[1] += share * y;
    second[0] += share * x * x, second[1] += share * x * y, second[2] += share * y * y;
  }
  const Rational sixth = Rational(1) / Rational(6), third = Rational(1) / Rational(3);
  return {(second[0] - mean[0] * mean[0]) * sixth, (second[1] - mean[0] * mean[1]) * third, (second[2] - mean[1] * mean[1]) * sixth};
}

/// Whether the characteristic function of ν is not 0 at 2π: the product of q at the angles π, π/2, π/4, … From π/4 on all
/// cosines of two steps and fewer are not negative.
bool keeps_ripple(const StepLaw& q) {
  if (q.empty()) return true;
  const auto reach = static_cast<int>(q.size()) / 2;
  Rational at_half_turn, at_quarter_turn;
  for (int i = -reach; i <= reach; ++i) {
    const Rational& w = q[static_cast<std::size_t>(i + reach)];
    at_half_turn += i % 2 == 0 ? w : -w;
    if (i % 2 == 0) at_quarter_turn += i % 4 == 0 ? w : -w;
  }
  return reach <= 2 && !at_half_turn.is_zero() && !at_quarter_turn.is_zero();
}

PolynomialFacts polynomial_facts(const RegularSmoothness& regular) {
  PolynomialFacts facts;
  facts.sum_rules = {zero_order(regular.symbol, -1, 1), zero_order(regular.symbol, 1, -1), zero_order(regular.symbol, -1, -1)};
  if (regular.step) facts.step_sum_rules = zero_order(*regular.step, -1, 1);
  const auto& directions = regular.factors.directions;
  const int n = removal_number(directions);
  // At the frequency 2π(1, 0) all factors vanish but those of the direction (0, 1), of which there are as many as of any.
  const auto upright = std::count(directions.begin(), directions.end(), Vector{0, 1});
  HEXACT_INVARIANT(static_cast<std::size_t>(upright) == directions.size() - static_cast<std::size_t>(n) && keeps_ripple(regular.law));
  facts.generates = n - 1;
  facts.quadratic_limit = quadratic_limit(regular.symbol);
  facts.reproduces = std::min(1, facts.generates);
  return facts;
}

}  // namespace

RegularSmoothness regular_smoothness(SpectrumScheme scheme) {
  RegularSmoothness out;
  out.scheme = scheme;
  out.symbol = regular_symbol(scheme);
  if (scheme == SpectrumScheme::midedge || scheme == SpectrumScheme::midedge6) out.step = proved_step(scheme, out.symbol);
  out.factors = box_spline_factors(out.symbol);
  const bool smooths = out.factors.smoothing != kOne;
  out.evidence.directions = out.factors.directions;
  out.evidence.continuity = removal_number(out.factors.directions) - 2 + (smooths ? 1 : 0);
  out.exponent = {Rational(1), Rational(1)};
  if (smooths) {
    HEXACT_INVARIANT(out.step);
    out.law = projected(out.factors.smoothing, {1, 0});
    out.evidence.link = link_of(*out.step);
    out.evidence.growth = find_mass_growth(out.law);
    const RationalInterval& growth = out.evidence.growth->bounds;
    const Interval exponent = -log2(Interval(growth.lo, growth.hi));
    out.exponent = {exponent.lower(), exponent.upper()};
  }
  const std::string fault = evidence_fault(out.symbol, out.evidence);
  if (!fault.empty()) throw NumericalFailure("the smoothness of regular regions could not be proved: " + fault);
  out.polynomials = polynomial_facts(out);
  mpfr_free_cache();
  return out;
}

std::string regular_fault(SpectrumScheme scheme, const RegularEvidence& evidence) { return evidence_fault(regular_symbol(scheme), evidence); }

std::string class_name(const RegularSmoothness& regular) {
  const std::string order = "C^" + std::to_string(regular.evidence.continuity) + ",";
  return order + (regular.evidence.growth ? decimal_enclosure(regular.exponent, 13).lo : "1");
}

}  // namespace hexact
