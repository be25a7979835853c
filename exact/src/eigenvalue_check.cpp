// SPDX-License-Identifier: LGPL-3.0-or-later
#include "eigenvalue_check.hpp"

#include "interval.hpp"
#include "polynomial.hpp"
#include "schur_cohn.hpp"

#include <algorithm>

namespace hexact {
namespace {

/// The widest intervals that are accepted.
const Rational kWidth = Rational(1).scaled(-100);

bool is_exact(const Eigenvalue& e) { return e.enclosure.lo == e.enclosure.hi; }

std::optional<std::size_t> count_in_disc(const Polynomial& p, const Rational& r) {
  return roots_in_disc(p, r, [](Polynomial q, std::size_t i) { return scaled(q, Rational(1) / q[i]); });
}

std::optional<std::size_t> count_in_disc(const std::vector<Interval>& p, const Rational& r) {
  return roots_in_disc(p, Interval(r), [](std::vector<Interval> q, std::size_t i) {
    const Interval size = q[i].middle();
    for (Interval& a : q) a = a / size;
    return q;
  });
}

/// Changes of sign of a factor in the listed intervals.
struct Changes {
  std::size_t all = 0, outside = 0;  ///< `outside`: where every number has a modulus above the bound
  bool on_circle = false;            ///< an interval of those may hold a number of this modulus
};

class ModeCheck {
 public:
  ModeCheck(const ModeSpectrum& mode, int k) : listed_(mode.isolated), mode_(mode), k_(k), found_(listed_.size()), sources_(listed_.size()) {}

  std::string fault(const std::vector<CharacteristicFactor>& factors, std::size_t n) {
    if (std::string f = list_fault(n); !f.empty()) return f;
    for (const CharacteristicFactor& factor : factors) {
      const RationalCosine c = rational_cosine(factor.angle, k_);
      const bool constant = std::all_of(factor.coefficients.begin(), factor.coefficients.end(), [](const auto& p) { return p.size() <= 1; });
      const std::string f = c.found || constant ? check_rational(factor, c.value) : check_enclosed(factor);
      if (!f.empty()) return f;
    }
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (sources_[i] > 1) return name(i) + " is found in more than one factor: these may be different numbers";
      if (found_[i] != listed_[i].multiplicity) return name(i) + " is found with multiplicity " + std::to_string(found_[i]);
    }
    return {};
  }

 private:
  static std::string name(std::size_t i) { return "eigenvalue " + std::to_string(i); }

  std::string list_fault(std::size_t n) const {
    std::size_t total = static_cast<std::size_t>(mode_.remaining);
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const RationalInterval& e = listed_[i].enclosure;
      if (e.hi < e.lo || e.hi - e.lo > kWidth) return name(i) + " is no interval of width 2^-100 at most";
      if (i > 0 && e.hi >= listed_[i - 1].enclosure.lo) return name(i) + " is not below the one before it";
      total += static_cast<std::size_t>(listed_[i].multiplicity);
    }
    return total == n ? "" : std::to_string(total) + " eigenvalues are listed of " + std::to_string(n);
  }

  std::string check_rational(const CharacteristicFactor& factor, const Rational& c) {
    Polynomial p;
    for (const CosinePolynomial& a : factor.coefficients) p.push_back(value(a, c));
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      while (is_exact(listed_[i]) && p.size() > 1 && value(p, listed_[i].enclosure.lo).is_zero()) {
        p = divided(p, {-listed_[i].enclosure.lo, Rational(1)}).first;
        ++found_[i];
      }
    }
    if (p.size() <= 1) return {};
    Changes sum;
    for (const SquareFreeFactor& f : square_free_factors(p)) {
      const Changes of_factor = count_changes(f.multiplicity, [&f = f](const Rational& x) { return value(f.factor, x).sign(); });
      sum.all += of_factor.all * static_cast<std::size_t>(f.multiplicity);
      sum.outside += of_factor.outside * static_cast<std::size_t>(f.multiplicity);
      sum.on_circle = sum.on_circle || of_factor.on_circle;
    }
    return rest_fault(p, sum);
  }

  std::string check_enclosed(const CharacteristicFactor& factor) {
    const Interval c = Interval::cosine(factor.angle, k_);
    std::vector<Interval> p;
    for (const CosinePolynomial& a : factor.coefficients) {
      Interval v(0);
      for (std::size_t i = a.size(); i-- > 0;) v = v * c + Interval(a[i]);
      p.push_back(std::move(v));
    }
    const Changes changes = count_changes(1, [&](const Rational& x) {
      Interval v(0);
      for (std::size_t i = p.size(); i-- > 0;) v = v * Interval(x) + p[i];
      return v.sign();
    });
    return rest_fault(p, changes);
  }

  template <class Sign>
  Changes count_changes(int multiplicity, const Sign& sign) {
    Changes out;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const RationalInterval& e = listed_[i].enclosure;
      if (is_exact(listed_[i]) || sign(e.lo) * sign(e.hi) >= 0) continue;
      found_[i] += multiplicity;
      ++sources_[i];
      ++out.all;
      const Rational& r = mode_.remaining_bound;
      if (e.lo > r || e.hi < -r) ++out.outside;
      else if (e.hi >= r || e.lo <= -r) out.on_circle = true;
    }
    return out;
  }

  /// Whether the roots of a factor beside its changes of sign are in the disc.
  template <class Number>
  std::string rest_fault(const std::vector<Number>& p, const Changes& changes) {
    const std::size_t degree = p.size() - 1;
    if (changes.all == degree) return {};
    const std::string what = "a factor of degree " + std::to_string(degree) + " changes sign in " + std::to_string(changes.all) + " of the intervals";
    if (changes.all > degree || mode_.remaining == 0) return what;
    if (mode_.remaining_bound.sign() <= 0 || changes.on_circle) return what + ", the disc proves nothing of the others";
    const auto inside = count_in_disc(p, mode_.remaining_bound);
    if (inside && *inside + changes.outside == degree) return {};
    return what + ", the others are not proved to be in the disc";
  }

  const std::vector<Eigenvalue>& listed_;
  const ModeSpectrum& mode_;
  int k_;
  std::vector<int> found_;
  std::vector<int> sources_;  ///< square-free factors that change sign in the interval
};

bool meet(const RationalInterval& a, const RationalInterval& b) { return a.lo <= b.hi && b.lo <= a.hi; }

}  // namespace

ModeSpectrum disjoint_eigenvalues(const ModeSpectrum& mode) {
  ModeSpectrum out;
  out.remaining = mode.remaining;
  out.remaining_bound = mode.remaining_bound;
  for (std::size_t i = 0; i < mode.isolated.size(); ++i) {
    const Eigenvalue& e = mode.isolated[i];
    bool alone = true;
    for (std::size_t j = 0; j < mode.isolated.size(); ++j) alone = alone && (i == j || !meet(e.enclosure, mode.isolated[j].enclosure));
    if (alone || is_exact(e)) {
      out.isolated.push_back(e);
      continue;
    }
    out.remaining += e.multiplicity;
    const Rational size = std::max(abs(e.enclosure.lo), abs(e.enclosure.hi)) + Rational(1).scaled(-60);
    out.remaining_bound = std::max(out.remaining_bound, size);
  }
  return out;
}

std::string eigenvalue_fault(const ModeSpectrum& listed, const std::vector<CharacteristicFactor>& factors, int k, std::size_t n) {
  return ModeCheck(listed, k).fault(factors, n);
}

}  // namespace hexact
