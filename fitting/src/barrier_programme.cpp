// SPDX-License-Identifier: LGPL-3.0-or-later
#include "barrier_programme.hpp"

#include "hexact/kernel/errors.hpp"

#define EIGEN_MPL2_ONLY
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hexact::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A step ends this share of the way to where a logarithm is no longer defined.
constexpr double kToBoundary = 0.95;
/// Squared Newton decrement below which full steps converge quadratically; the value is then too flat to be compared.
constexpr double kQuadratic = 1e-4;
/// Squared Newton decrement at which the minimum is reached: the step then leaves all s_i within 1e-9 of themselves.
constexpr double kReached = 1e-10;

double form_value(const SparseForm& form, const BarrierProgramme::Point& at) {
  double s = form.base + form.common * at.y;
  for (std::uint32_t i = 0; i < form.count; ++i) s += form.weight[i] * at.x[form.unknown[i]];
  return s;
}

/// The change of a form along a step.
double form_slope(const SparseForm& form, const BarrierProgramme::Point& step) {
  double s = form.common * step.y;
  for (std::uint32_t i = 0; i < form.count; ++i) s += form.weight[i] * step.x[form.unknown[i]];
  return s;
}

BarrierProgramme::Point moved(const BarrierProgramme::Point& at, const BarrierProgramme::Point& step, double share) {
  BarrierProgramme::Point out = at;
  for (std::size_t i = 0; i < out.x.size(); ++i) out.x[i] += share * step.x[i];
  out.y += share * step.y;
  return out;
}

}  // namespace

void SparseForm::add(std::uint32_t u, double factor) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (unknown[i] == u) {
      weight[i] += factor;
      return;
    }
  }
  HEXACT_EXPECTS(count < unknown.size());
  unknown[count] = u;
  weight[count++] = factor;
}

/// The lower triangle of the Hessian; the pattern is that of all terms, and each knows its places.
struct BarrierProgramme::Hessian {
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
  Matrix matrix;
  std::vector<std::array<std::uint32_t, 10>> places;  ///< of the entry (i, j), j <= i, of each term, row by row
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> factors;

  Hessian(const std::vector<Term>& terms, std::size_t unknowns) : matrix(static_cast<int>(unknowns), static_cast<int>(unknowns)) {
    std::vector<Eigen::Triplet<double, int>> entries;
    for_each_pair(terms, [&](std::size_t, std::size_t, int row, int column) { entries.emplace_back(row, column, 1.0); });
    matrix.setFromTriplets(entries.begin(), entries.end());
    places.resize(terms.size());
    for_each_pair(terms, [&](std::size_t term, std::size_t pair, int row, int column) {
      const int* begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column];
      const int* end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
      places[term][pair] = static_cast<std::uint32_t>(std::lower_bound(begin, end, row) - matrix.innerIndexPtr());
    });
    factors.analyzePattern(matrix);
  }

  template <class Visit>
  static void for_each_pair(const std::vector<Term>& terms, const Visit& visit) {
    for (std::size_t t = 0; t < terms.size(); ++t) {
      const SparseForm& form = terms[t].form;
      std::size_t pair = 0;
      for (std::uint32_t i = 0; i < form.count; ++i) {
        for (std::uint32_t j = 0; j <= i; ++j, ++pair) {
          const auto a = static_cast<int>(form.unknown[i]), b = static_cast<int>(form.unknown[j]);
          visit(t, pair, std::max(a, b), std::min(a, b));
        }
      }
    }
  }

  void add(std::size_t term, const SparseForm& form, double curvature) {
    std::size_t pair = 0;
    for (std::uint32_t i = 0; i < form.count; ++i) {
      for (std::uint32_t j = 0; j <= i; ++j, ++pair) {
        matrix.valuePtr()[places[term][pair]] += curvature * form.weight[i] * form.weight[j];
      }
    }
  }

  /// Where rounding spoils definiteness, the diagonal is raised a little: this changes the direction of a step, not the
  /// minimum that the steps lead to.
  void factorize() {
    for (const double raise : {0.0, 1e-12, 1e-10, 1e-8}) {
      if (raise > 0) {
        for (int column = 0; column < matrix.cols(); ++column) matrix.valuePtr()[matrix.outerIndexPtr()[column]] *= 1 + raise;
      }
      factors.factorize(matrix);
      if (factors.info() == Eigen::Success && factors.vectorD().minCoeff() > 0) return;
    }
    throw NumericalFailure("fair lifts: the matrix of a Newton step is not positive definite to working precision");
  }
};

BarrierProgramme::BarrierProgramme(std::size_t unknowns) : unknowns_(unknowns) {}
BarrierProgramme::~BarrierProgramme() = default;

void BarrierProgramme::add_logarithm(const SparseForm& form, double weight) { terms_.push_back({form, weight, Kind::logarithm}); }
void BarrierProgramme::add_inverse(const SparseForm& form, double weight) { terms_.push_back({form, weight, Kind::inverse}); }
void BarrierProgramme::add_square(const SparseForm& form, double weight) { terms_.push_back({form, weight, Kind::square}); }

bool BarrierProgramme::is_inside(const Point& at) const {
  return std::all_of(terms_.begin(), terms_.end(), [&](const Term& term) {
    return term.kind == Kind::square || form_value(term.form, at) > 0;
  });
}

double BarrierProgramme::value(const Point& at, double price) const {
  double sum = -price * at.y;
  for (const Term& term : terms_) {
    const double s = form_value(term.form, at);
    if (term.kind == Kind::square) {
      sum += term.weight * s * s / 2;
    } else if (!(s > 0)) {
      return kInfinity;
    } else {
      sum += term.kind == Kind::inverse ? term.weight / s : -term.weight * std::log(s);
    }
  }
  return sum;
}

BarrierProgramme::Direction BarrierProgramme::newton_step(const Point& at, double price) {
  if (!hessian_) hessian_ = std::make_unique<Hessian>(terms_, unknowns_);
  Hessian& hessian = *hessian_;
  const auto size = static_cast<Eigen::Index>(unknowns_);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size), border = Eigen::VectorXd::Zero(size);
  double slope = -price, corner = 0;
  std::fill(hessian.matrix.valuePtr(), hessian.matrix.valuePtr() + hessian.matrix.nonZeros(), 0.0);
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    const Term& term = terms_[t];
    const double s = form_value(term.form, at);
    const double first = term.kind == Kind::square ? term.weight * s
                         : term.kind == Kind::inverse ? -term.weight / (s * s) : -term.weight / s;
    const double second = term.kind == Kind::square ? term.weight
                          : term.kind == Kind::inverse ? 2 * term.weight / (s * s * s) : term.weight / (s * s);
    hessian.add(t, term.form, second);
    for (std::uint32_t i = 0; i < term.form.count; ++i) {
      gradient[term.form.unknown[i]] += first * term.form.weight[i];
      border[term.form.unknown[i]] += second * term.form.common * term.form.weight[i];
    }
    slope += first * term.form.common;
    corner += second * term.form.common * term.form.common;
  }
  hessian.factorize();
  Eigen::VectorXd step = hessian.factors.solve(-gradient);
  Direction out;
  if (corner > 0) {  // y by its Schur complement
    const Eigen::VectorXd back = hessian.factors.solve(border);
    const double complement = corner - border.dot(back);
    if (!(complement > 0)) throw NumericalFailure("fair lifts: a Newton step is not determined to working precision");
    out.step.y = (-slope - border.dot(step)) / complement;
    step -= out.step.y * back;
  }
  out.decrement = -(gradient.dot(step) + slope * out.step.y);
  out.step.x.assign(step.data(), step.data() + size);
  return out;
}

double BarrierProgramme::longest_step(const Point& at, const Point& step) const {
  double longest = 1;
  for (const Term& term : terms_) {
    if (term.kind == Kind::square) continue;
    const double ds = form_slope(term.form, step);
    if (ds < 0) longest = std::min(longest, kToBoundary * form_value(term.form, at) / -ds);
  }
  return longest;
}

BarrierProgramme::Point BarrierProgramme::minimise(Point at, double price, int most_steps) {
  HEXACT_EXPECTS(is_inside(at));
  double before = kInfinity;
  for (; steps_ < most_steps; ++steps_) {
    const Direction direction = newton_step(at, price);
    const double d = direction.decrement;
    if (!std::isfinite(d)) throw NumericalFailure("fair lifts: a Newton step is not finite");
    if (d < kQuadratic) {
      // Full steps; where the decrement falls no more, rounding is all that is left of it.
      Point next = moved(at, direction.step, 1);
      if (!is_inside(next) || d >= before / 4) return at;
      at = std::move(next);
      if (d < kReached) return at;
      before = d;
      continue;
    }
    double share = longest_step(at, direction.step);
    const double now = value(at, price);
    while (!(value(moved(at, direction.step, share), price) <= now - 0.1 * share * d)) {
      share /= 2;
      if (share < 1e-9) throw NumericalFailure("fair lifts: no progress is possible to working precision");
    }
    at = moved(at, direction.step, share);
  }
  throw NumericalFailure("fair lifts: the programme is not solved after " + std::to_string(most_steps) + " Newton steps");
}

}  // namespace hexact::detail
