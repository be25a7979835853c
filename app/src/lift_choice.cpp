// SPDX-License-Identifier: GPL-3.0-or-later
#include "lift_choice.hpp"

#include "hexact/exact/lift_rules.hpp"
#ifdef HEXACT_WITH_FITTING
#include "hexact/fitting/fair_lifts.hpp"
#endif
#include "hexact/io/lifts_file.hpp"

#include <fmt/format.h>

#include <string_view>

namespace hexact::app {
namespace {

constexpr double kAutomaticKeep = 0.5, kFairKeep = 0.25;

KeptFraction kept_fraction(const std::string& text, std::uint32_t start, double otherwise) {
  if (text.empty()) return constant_keep(otherwise);
  if (text == "smooth") return smooth_keep(start);
  Rational keep;
  const bool is_number = Rational::parse(text, keep) == Rational::ParseResult::ok;
  if (!is_number || !(keep.to_double() > 0) || !(keep.to_double() < 1)) {
    throw UsageError("--keep needs a number between 0 and 1, or smooth; found " + text);
  }
  return constant_keep(keep.to_double());
}

bool are_fair(const std::string& lifts) { return lifts == "fair" || lifts.starts_with("fair="); }

#ifdef HEXACT_WITH_FITTING
LiftRule fair_rule(const SubdivideOptions& options, std::uint32_t start) {
  FairOptions fair;
  fair.keep = kept_fraction(options.keep, start, kFairKeep);
  const std::string name = options.lifts == "fair" ? "product" : options.lifts.substr(std::string_view("fair=").size());
  try {
    fair.objective = fair_objective_named(name);
  } catch (const InvalidInput& e) {
    throw UsageError(std::string("--lifts: ") + e.what());
  }
  return fair_lifts(fair);
}
#else
LiftRule fair_rule(const SubdivideOptions&, std::uint32_t) {
  throw UsageError("--lifts fair: this hexact was built without hexact::fitting");
}
#endif

}  // namespace

LiftChoice lift_choice(const SubdivideOptions& options, std::uint32_t start) {
  constexpr std::string_view kFile = "file=";
  if (are_fair(options.lifts)) return {fair_rule(options, start), {}};
  LiftRule automatic = automatic_lifts(kept_fraction(options.keep, start, kAutomaticKeep));
  if (options.lifts.empty() || options.lifts == "auto") return {std::move(automatic), {}};
  if (options.lifts.starts_with(kFile)) {
    LiftDocument document = io::read_lifts(options.lifts.substr(kFile.size()));
    LiftRule rule = document_lifts(document, std::move(automatic));
    return {std::move(rule), std::move(document.factors)};
  }
  throw UsageError("--lifts needs auto, fair, fair=OBJECTIVE or file=JSON, found " + options.lifts);
}

std::string lift_provenance(const SubdivideOptions& options) {
  const std::string keep = fmt::format("{}", are_fair(options.lifts) ? kFairKeep : kAutomaticKeep);
  return fmt::format("--lifts {} --keep {}", options.lifts.empty() ? "auto" : options.lifts,
                     options.keep.empty() ? keep : options.keep);
}

unsigned chamfer_levels(const std::string& then) {
  if (then.empty()) return 0;
  constexpr std::string_view kChamfer = "chamfer:";
  const std::string digits = then.starts_with(kChamfer) ? then.substr(kChamfer.size()) : "";
  const bool is_number = !digits.empty() && digits.size() <= 4 && digits.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number || std::stoul(digits) > 1000) throw UsageError("--then needs chamfer:K with K from 0 to 1000, found " + then);
  return static_cast<unsigned>(std::stoul(digits));
}

}  // namespace hexact::app
