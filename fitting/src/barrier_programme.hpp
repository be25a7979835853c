// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace hexact::detail {

/// base + Σ weight[i]·x(unknown[i]), over the first `count` entries, + common·y.
struct SparseForm {
  std::array<std::uint32_t, 4> unknown{};
  std::array<double, 4> weight{};
  std::uint32_t count = 0;
  double base = 0;
  double common = 0;

  /// Adds `factor` times x(u).
  void add(std::uint32_t u, double factor);
};

/// A convex function of unknowns x, and where `common` weights are not zero of one more unknown y, as a sum of terms
/// that are each a function of a sparse linear form s:  −w log s,  w/s,  w s²/2;  and of −t·y.
/// Minimised by damped Newton steps; the Hessian is factorized by a sparse Cholesky decomposition.
class BarrierProgramme {
 public:
  explicit BarrierProgramme(std::size_t unknowns);
  BarrierProgramme(const BarrierProgramme&) = delete;
  BarrierProgramme& operator=(const BarrierProgramme&) = delete;
  ~BarrierProgramme();

  // All terms are added before the first call of the functions below.
  void add_logarithm(const SparseForm& form, double weight);
  void add_inverse(const SparseForm& form, double weight);
  void add_square(const SparseForm& form, double weight);

  struct Point {
    std::vector<double> x;
    double y = 0;
  };
  /// Whether all logarithms and inverses are defined.
  [[nodiscard]] bool is_inside(const Point& at) const;
  /// The sum of all terms and −t·y; infinite outside. `price` is t.
  [[nodiscard]] double value(const Point& at, double price) const;
  /// The minimum, from a point inside. Newton steps are counted in `steps()`.
  /// Throws NumericalFailure when that takes more than `most_steps` steps in all, or a factorization fails.
  [[nodiscard]] Point minimise(Point start, double price, int most_steps);
  [[nodiscard]] int steps() const noexcept { return steps_; }
  [[nodiscard]] std::size_t term_count() const noexcept { return terms_.size(); }

 private:
  enum class Kind : std::uint8_t { logarithm, inverse, square };
  struct Term {
    SparseForm form;
    double weight = 1;
    Kind kind = Kind::logarithm;
  };
  struct Hessian;  // of Eigen
  struct Direction {
    Point step;
    double decrement = 0;  ///< squared length of the step in the norm of the Hessian
  };

  [[nodiscard]] Direction newton_step(const Point& at, double price);
  [[nodiscard]] double longest_step(const Point& at, const Point& step) const;

  std::size_t unknowns_;
  std::vector<Term> terms_;
  std::unique_ptr<Hessian> hessian_;
  int steps_ = 0;
};

}  // namespace hexact::detail
