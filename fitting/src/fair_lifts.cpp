// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/fitting/fair_lifts.hpp"

#include "barrier_programme.hpp"
#include "hexact/kernel/errors.hpp"
#include "new_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexact {
namespace {

using detail::BarrierProgramme;
using detail::LiftForm;
using detail::NewEdge;
using detail::NewEdges;
using detail::SparseForm;

/// Weight of the barrier that keeps the margins, beside the weight 1 of a length: small enough not to matter away from
/// them, large enough not to come near.
constexpr double kMarginWeight = 1.0 / 32;
/// Weight of the logarithms in the objectives that would let lengths vanish.
constexpr double kLengthWeight = 0.1;
/// Relative gap at which the linear programme is solved.
constexpr double kGap = 1e-3;

/// The edges that follow each other around the new facets: around h's facet, and around the hexagon of h's edge.
template <class Visit>
void for_each_pair(const HoneycombMap& map, const NewEdges& edges, const Visit& visit) {
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const std::uint32_t after = map.next(h), g = map.twin(h);
    visit(edges.sides[h], edges.sides[after], map.facet(h));
    visit(edges.spokes[h], edges.sides[h], map.facet(h));
    visit(edges.sides[h], edges.spokes[after], map.facet(h));
    visit(edges.spokes[after], edges.spokes[g], map.facet(h));  // the hexagon's corner at the end of h
  }
}

/// Length over angle of each facet's sides before the step, taken together: the size that s/θ is compared with.
std::vector<double> facet_ratios(const HoneycombMap& map, const NewEdges& edges) {
  std::vector<double> lengths(map.facet_count()), angles(map.facet_count());
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    lengths[map.facet(h)] += edges.sides[h].length.base;
    angles[map.facet(h)] += 2 * edges.sides[h].angle;
  }
  for (std::size_t f = 0; f < lengths.size(); ++f) lengths[f] /= angles[f];
  return lengths;
}

/// The programme of one level in the unknowns x = τ / (lift of the automatic rule).
class FairProgramme {
 public:
  FairProgramme(const ChamferLevel& level, const EdgeNumbering& edges, const FairOptions& options)
      : map_(level.surface.map), options_(options), keep_(options.keep(map_.level())), edges_(detail::new_edges(level, edges)),
        ratios_(facet_ratios(map_, edges_)), programme_(map_.edge_count()) {
    HEXACT_EXPECTS(keep_ > 0 && keep_ < 1);
    HEXACT_EXPECTS(options.triangle > 0.95 && options.triangle < 1);
    const Lifts proposed = automatic_lifts(constant_keep(keep_))(level, edges);
    const auto& lengths = std::get<ProposedLifts>(proposed).lengths;
    scale_.assign(lengths.begin(), lengths.end());
    add_margins();
    switch (options.objective) {
      case FairObjective::product: add_logarithms(1); break;
      case FairObjective::harmonic: add_inverses(); break;
      case FairObjective::even:
        add_logarithms(kLengthWeight);
        add_squares();
        break;
      case FairObjective::ratio: add_ratio(); break;
    }
  }

  [[nodiscard]] double cost(const ProposedLifts& lifts) const {
    BarrierProgramme::Point at{std::vector<double>(scale_.size()), 0};
    for (std::size_t e = 0; e < scale_.size(); ++e) at.x[e] = lifts.lengths[e] / scale_[e];
    if (!programme_.is_inside(at)) return std::numeric_limits<double>::infinity();
    return options_.objective == FairObjective::ratio ? -unit_ * least_ratio(at.x) : programme_.value(at, 0);
  }

  ProposedLifts solve() {
    BarrierProgramme::Point at{std::vector<double>(scale_.size(), 0.5), 0};
    if (options_.objective == FairObjective::ratio) at.y = 0.5 * least_ratio(at.x);
    if (!programme_.is_inside(at)) {
      throw NumericalFailure("fair lifts: the automatic lifts of level " + std::to_string(map_.level()) +
                             " do not keep the margins to start from");
    }
    at = options_.objective == FairObjective::ratio ? solve_linear(std::move(at))
                                                    : programme_.minimise(std::move(at), 0, options_.most_steps);
    ProposedLifts out;
    out.lengths.resize(scale_.size());
    for (std::size_t e = 0; e < scale_.size(); ++e) out.lengths[e] = scale_[e] * at.x[e];
    return out;
  }

 private:
  [[nodiscard]] SparseForm scaled(const LiftForm& form, double factor = 1) const {
    SparseForm out;
    out.base = factor * form.base;
    for (std::size_t i = 0; i < 3; ++i) out.add(form.edge[i], factor * form.weight[i] * scale_[form.edge[i]]);
    return out;
  }

  /// A side that is short for its angle keeps more than the fraction that is asked. Its angle is halved, so that half of
  /// the length is enough for s/θ not to fall; sides below half the ratio of their facet come to that by and by.
  [[nodiscard]] double kept_at_least(const NewEdge& side, std::uint32_t f) const {
    const double ratio = side.length.base / (2 * side.angle);
    return std::max(keep_, std::min(0.5, keep_ * ratios_[f] / (2 * ratio)));
  }

  /// Sides keep their fraction, lifts their distance to the triangle inequalities.
  void add_margins() {
    for (std::uint32_t h = 0; h < edges_.sides.size(); ++h) {
      const NewEdge& side = edges_.sides[h];
      SparseForm form = scaled(side.length, 1 / side.length.base);
      form.base -= kept_at_least(side, map_.facet(h));
      programme_.add_logarithm(form, kMarginWeight);
    }
    for (const NewEdge& spoke : edges_.spokes) {
      SparseForm form;
      const auto& e = spoke.length.edge;
      form.add(e[0], options_.triangle * scale_[e[0]] / scale_[e[2]]);
      form.add(e[1], options_.triangle * scale_[e[1]] / scale_[e[2]]);
      form.add(e[2], -1);
      programme_.add_logarithm(form, kMarginWeight);
    }
  }

  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for (std::uint32_t h = 0; h < map_.half_edge_count(); ++h) {
      visit(edges_.sides[h], map_.facet(h));
      visit(edges_.spokes[h], map_.facet(h));
    }
  }

  void add_logarithms(double weight) {
    for_each_edge([&](const NewEdge& edge, std::uint32_t) { programme_.add_logarithm(scaled(edge.length), weight); });
  }
  void add_inverses() {
    for_each_edge([&](const NewEdge& edge, std::uint32_t f) {
      programme_.add_inverse(scaled(edge.length, 1 / (edge.angle * ratios_[f])), 1);
    });
  }
  void add_squares() {
    for_each_pair(map_, edges_, [&](const NewEdge& a, const NewEdge& b, std::uint32_t f) {
      SparseForm form = scaled(a.length, 1 / (a.angle * ratios_[f]));
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t e = b.length.edge[i];
        form.add(e, -b.length.weight[i] * scale_[e] / (b.angle * ratios_[f]));
      }
      form.base -= b.length.base / (b.angle * ratios_[f]);
      programme_.add_square(form, 1);
    });
  }
  void add_ratio() {
    double sum = 0;
    for (const double r : ratios_) sum += r;
    unit_ = sum / static_cast<double>(ratios_.size());
    for_each_edge([&](const NewEdge& edge, std::uint32_t) {
      SparseForm form = scaled(edge.length, 1 / (edge.angle * unit_));
      form.common = -1;
      programme_.add_logarithm(form, 1);
    });
  }

  [[nodiscard]] double least_ratio(const std::vector<double>& x) const {
    double least = std::numeric_limits<double>::infinity();
    for_each_edge([&](const NewEdge& edge, std::uint32_t) {
      double s = edge.length.base;
      for (std::size_t i = 0; i < 3; ++i) s += edge.length.weight[i] * scale_[edge.length.edge[i]] * x[edge.length.edge[i]];
      least = std::min(least, s / (edge.angle * unit_));
    });
    return least;
  }

  /// The central path of the linear programme: at price t the smallest ratio is within (number of terms)/t of the best.
  BarrierProgramme::Point solve_linear(BarrierProgramme::Point at) {
    const auto terms = static_cast<double>(programme_.term_count());
    for (double price = terms / at.y;; price *= 8) {
      at = programme_.minimise(std::move(at), price, options_.most_steps);
      if (terms / price <= kGap * at.y) return at;
    }
  }

  const HoneycombMap& map_;
  const FairOptions& options_;
  double keep_;
  NewEdges edges_;
  std::vector<double> ratios_;
  std::vector<double> scale_;
  double unit_ = 1;
  BarrierProgramme programme_;
};

}  // namespace

const std::vector<std::string>& fair_objective_names() {
  static const std::vector<std::string> names = {"product", "harmonic", "even", "ratio"};
  return names;
}

FairObjective fair_objective_named(std::string_view name) {
  const auto& names = fair_objective_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InvalidInput("UnknownObjective", "fair lifts are by product, harmonic, even or ratio, not by " + std::string(name), "");
  }
  return static_cast<FairObjective>(found - names.begin());
}

LiftRule fair_lifts(FairOptions options) {
  return [options = std::move(options)](const ChamferLevel& level, const EdgeNumbering& edges) -> Lifts {
    return FairProgramme(level, edges, options).solve();
  };
}

double fair_cost(const ChamferLevel& level, const EdgeNumbering& edges, const ProposedLifts& lifts, const FairOptions& options) {
  HEXACT_EXPECTS(lifts.lengths.size() == level.surface.map.edge_count());
  return FairProgramme(level, edges, options).cost(lifts);
}

LiftQuality lift_quality(const ChamferLevel& level, const EdgeNumbering& edges, const ProposedLifts& lifts) {
  const HoneycombMap& map = level.surface.map;
  HEXACT_EXPECTS(lifts.lengths.size() == map.edge_count());
  const std::vector<double> values(lifts.lengths.begin(), lifts.lengths.end());
  const NewEdges parts = detail::new_edges(level, edges);
  LiftQuality q;
  q.least_ratio = q.least_kept = std::numeric_limits<double>::infinity();
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    for (const NewEdge* edge : {&parts.sides[h], &parts.spokes[h]}) {
      const double ratio = edge->length.value(values) / edge->angle;
      q.least_ratio = std::min(q.least_ratio, ratio);
      q.greatest_ratio = std::max(q.greatest_ratio, ratio);
    }
    q.least_kept = std::min(q.least_kept, parts.sides[h].length.value(values) / parts.sides[h].length.base);
    const auto& e = parts.spokes[h].length.edge;
    q.most_triangle = std::max(q.most_triangle, values[e[2]] / (values[e[0]] + values[e[1]]));
  }
  return q;
}

}  // namespace hexact
