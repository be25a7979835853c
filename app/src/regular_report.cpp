// SPDX-License-Identifier: GPL-3.0-or-later
#include "regular_report.hpp"

#include "hexact/exact/spectrum.hpp"

#include <fmt/format.h>

namespace hexact::app {
namespace {

constexpr int kDigits = 28, kShortDigits = 14;

using Json = nlohmann::ordered_json;

Json decimals(const RationalInterval& interval) {
  const DecimalEnclosure d = decimal_enclosure(interval, kDigits);
  return Json::array({d.lo, d.hi});
}

const char* step_symbol(SpectrumScheme scheme) { return scheme == SpectrumScheme::midedge6 ? "(x + y)(1 + 3xy)/4" : "x + y"; }

std::string product_name(const std::vector<int>& word) {
  std::string name;
  for (const int digit : word) name += (name.empty() ? "T" : " T") + std::to_string(digit);
  return name;
}

Json growth_json(const MassGrowth& growth) {
  return {{"joint_spectral_radius", decimals(growth.bounds)}, {"product", product_name(growth.word)}, {"vertices", growth.vertices.size()}};
}

std::string directions_text(const std::vector<Symbol::Vector>& directions) {
  std::string text;
  for (const Symbol::Vector& v : directions) text += fmt::format(" ({}, {})", v[0], v[1]);
  return text;
}

std::string smoothness_text(const RegularSmoothness& regular) {
  const int r = regular.evidence.continuity;
  if (!regular.evidence.growth) return fmt::format("C^{}, derivatives of order {} Lipschitz continuous, not C^{}", r, r, r + 1);
  const DecimalEnclosure a = decimal_enclosure(regular.exponent, kShortDigits);
  return fmt::format("C^{}, derivatives of order {} Hoelder continuous with exponent {}, of generic data not with {}, not C^{}", r, r, a.lo, a.hi, r + 1);
}

}  // namespace

nlohmann::ordered_json regular_json(const RegularSmoothness& regular) {
  const PolynomialFacts& facts = regular.polynomials;
  Json json;
  json["verdict"] = name_of(Verdict::proved);
  json["continuity"] = regular.evidence.continuity;
  json["exponent"] = decimals(regular.exponent);
  if (regular.step) json["step_symbol"] = step_symbol(regular.scheme);
  json["directions"] = regular.factors.directions;
  json["smoothing"] = Json::array();
  for (const auto& [v, weight] : regular.factors.smoothing.terms()) json["smoothing"].push_back(Json::array({v[0], v[1], weight.str()}));
  json["growth"] = regular.evidence.growth ? growth_json(*regular.evidence.growth) : Json();
  json["sum_rules"] = facts.sum_rules;
  if (facts.step_sum_rules) json["step_sum_rules"] = *facts.step_sum_rules;
  json["reproduces"] = facts.reproduces;
  json["generates"] = facts.generates;
  json["quadratic_limit"] = Json::array();
  for (const Rational& x : facts.quadratic_limit) json["quadratic_limit"].push_back(x.str());
  return json;
}

std::string regular_text(const RegularSmoothness& regular) {
  std::string text = "regular regions: " + smoothness_text(regular) + "\n";
  if (regular.step) text += std::string("  symbol of a step: ") + step_symbol(regular.scheme) + ", x = (z + 1/z)/2, y = (w + 1/w)/2\n";
  text += "  box spline of the directions" + directions_text(regular.factors.directions) + (regular.step ? " (two steps)" : "");
  if (const auto& growth = regular.evidence.growth) {
    const DecimalEnclosure d = decimal_enclosure(growth->bounds, kShortDigits);
    text += fmt::format(", smoothed\n  joint spectral radius in [{}, {}]: {} from below, a polytope of {} vertices from above", d.lo, d.hi,
                        product_name(growth->word), growth->vertices.size());
  }
  const PolynomialFacts& facts = regular.polynomials;
  return text + fmt::format("\n  polynomials: reproduces degree {}, generates degree {}\n", facts.reproduces, facts.generates);
}

}  // namespace hexact::app
