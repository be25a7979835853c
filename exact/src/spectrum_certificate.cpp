// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/spectrum_certificate.hpp"

#include "hexact/kernel/errors.hpp"
#include "interval.hpp"
#include "polynomial.hpp"

#include <mpfr.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace hexact {
namespace {

/// Widest intervals that are accepted.
const Rational kEigenvalueWidth = Rational(1).scaled(-100), kCosineWidth = Rational(1).scaled(-200);

bool is_exact(const Eigenvalue& e) { return e.enclosure.lo == e.enclosure.hi; }

/// Proves that a list holds all eigenvalues of a mode.
class ModeCheck {
 public:
  ModeCheck(const std::vector<Eigenvalue>& listed, int k) : listed_(listed), k_(k), found_(listed.size()) {}

  /// What is wrong; empty if nothing is.
  std::string fault(const std::vector<CharacteristicFactor>& factors, std::size_t n) {
    if (std::string f = list_fault(n); !f.empty()) return f;
    for (const CharacteristicFactor& factor : factors) {
      const RationalCosine c = rational_cosine(factor.angle, k_);
      const bool constant = std::all_of(factor.coefficients.begin(), factor.coefficients.end(), [](const auto& p) { return p.size() <= 1; });
      const std::string f = c.found || constant ? check_rational(factor, c.value) : check_enclosed(factor);
      if (!f.empty()) return f;
    }
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (found_[i] != listed_[i].multiplicity) return name(i) + " is found with multiplicity " + std::to_string(found_[i]);
    }
    return {};
  }

 private:
  static std::string name(std::size_t i) { return "eigenvalue " + std::to_string(i); }

  std::string list_fault(std::size_t n) const {
    std::size_t total = 0;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const RationalInterval& e = listed_[i].enclosure;
      if (e.hi < e.lo || e.hi - e.lo > kEigenvalueWidth) return name(i) + " is no interval of width 2^-100 at most";
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
    for (const SquareFreeFactor& f : square_free_factors(p)) {
      const auto sign = [&f = f](const Rational& x) { return value(f.factor, x).sign(); };
      if (std::string fault = count_changes(f.factor.size() - 1, f.multiplicity, sign); !fault.empty()) return fault;
    }
    return {};
  }

  std::string check_enclosed(const CharacteristicFactor& factor) {
    const Interval c = Interval::cosine(factor.angle, k_);
    std::vector<Interval> p;
    for (const CosinePolynomial& a : factor.coefficients) {
      Interval v(0);
      for (std::size_t i = a.size(); i-- > 0;) v = v * c + Interval(a[i]);
      p.push_back(std::move(v));
    }
    return count_changes(p.size() - 1, 1, [&](const Rational& x) {
      Interval v(0);
      for (std::size_t i = p.size(); i-- > 0;) v = v * Interval(x) + p[i];
      return v.sign();
    });
  }

  /// A polynomial of this degree has a change of sign in as many of the listed intervals.
  template <class Sign>
  std::string count_changes(std::size_t degree, int multiplicity, const Sign& sign) {
    std::size_t changes = 0;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (is_exact(listed_[i]) || sign(listed_[i].enclosure.lo) * sign(listed_[i].enclosure.hi) >= 0) continue;
      ++changes;
      found_[i] += multiplicity;
    }
    if (changes == degree) return {};
    return "a factor of degree " + std::to_string(degree) + " changes sign in " + std::to_string(changes) + " of the intervals";
  }

  const std::vector<Eigenvalue>& listed_;
  int k_;
  std::vector<int> found_;
};

std::string spectrum_fault(const SpectrumCertificate::Row& row, const SubdivisionMatrix& matrix) {
  if (row.cosine.hi - row.cosine.lo > kCosineWidth) return "the cosine interval is wider than 2^-200";
  if (!encloses_cosine(row.cosine, row.valence)) return "the interval does not contain cos(2 pi/k)";
  if (row.modes.size() != static_cast<std::size_t>(row.valence / 2) + 1) return "a mode is missing";
  for (std::size_t m = 0; m < row.modes.size(); ++m) {
    const int mode = static_cast<int>(m);
    const std::size_t n = matrix.size() + (m == 0 && matrix.has_centre ? 1 : 0);
    ModeCheck check(row.modes[m], row.valence);
    const std::string fault = check.fault(characteristic_factors(matrix, mode), n);
    if (!fault.empty()) return "mode " + std::to_string(m) + ": " + fault;
  }
  return {};
}

struct RowVerdict {
  std::string ordering, ring;  ///< what is wrong, empty if nothing is
};

RowVerdict verify_row(SpectrumScheme scheme, const SpectrumCertificate::Row& row) {
  const SpectrumSubject subject = scheme_subject(scheme, row.valence);
  RowVerdict out;
  out.ordering = spectrum_fault(row, subject.matrix);
  SpectrumRow decided;
  if (out.ordering.empty()) {
    decided.valence = row.valence;
    for (const auto& listed : row.modes) decided.modes.push_back({listed, 0, {}});
    decide_ordering(decided);
    if (decided.ordering != Verdict::proved) out.ordering = decided.ordering_witness;
  }
  if (!out.ordering.empty()) {
    out.ring = "rests on the ordering";
  } else if (decided.subdominant->mode != 1) {
    out.ring = "the second eigenvalue is not of mode 1";
  } else if (row.jacobian.sign() <= 0 || row.half_plane.sign() <= 0) {
    out.ring = "a bound is not positive";
  } else if (is_bspline_scheme(scheme) && row.level != 0) {
    out.ring = "rings of B-splines have level 0";
  } else {
    const RingProof proof = prove_ring(scheme, subject.matrix, decided.subdominant->enclosure, row.level);
    if (proof.verdict != Verdict::proved) out.ring = proof.reason;
    else if (proof.jacobian < row.jacobian) out.ring = "the bound of the Jacobian is only " + proof.jacobian.str();
    else if (proof.half_plane < row.half_plane) out.ring = "the bound of the half-plane is only " + proof.half_plane.str();
  }
  mpfr_free_cache();
  return out;
}

}  // namespace

SpectrumCertificate make_spectrum_certificate(SpectrumScheme scheme, const std::vector<SpectrumRow>& rows, std::vector<std::string> provenance) {
  SpectrumCertificate certificate;
  certificate.provenance = std::move(provenance);
  certificate.scheme = scheme;
  for (const SpectrumRow& row : rows) {
    if (overall(row) != Verdict::proved) {
      throw InvalidInput("NotProved", "a certificate holds proved rows only", "valence " + std::to_string(row.valence));
    }
    SpectrumCertificate::Row r;
    r.valence = row.valence;
    const Interval c = Interval::cosine(1, row.valence);
    const Rational ulp = Rational(1).scaled(-256);
    const auto grid = [](const Rational& x) {
      const Rational s = x.scaled(256);
      return Rational(floor_quotient(s.numerator(), s.denominator())).scaled(-256);
    };
    r.cosine = {grid(c.lower()) - ulp, grid(c.upper()) + ulp + ulp};
    for (const ModeSpectrum& m : row.modes) r.modes.push_back(m.isolated);
    r.level = row.ring.level;
    r.jacobian = row.ring.jacobian;
    r.half_plane = row.ring.half_plane;
    certificate.rows.push_back(std::move(r));
  }
  return certificate;
}

bool encloses_cosine(const RationalInterval& interval, int k) {
  HEXACT_EXPECTS(k >= 3);
  // U_0, U_1, … is a Sturm sequence: it changes sign at x as often as U_{k−1} has zeros greater than x.
  const auto greater_zeros = [k](const Rational& x) {
    Rational before(0), now(1);  // U_{−1}, U_0
    int changes = 0, sign = 1;
    for (int j = 1; j < k; ++j) {
      Rational next = Rational(2) * x * now - before;
      before = std::move(now);
      now = std::move(next);
      if (now.sign() * sign < 0) ++changes, sign = -sign;
    }
    return now.is_zero() ? -1 : changes;
  };
  return interval.lo < interval.hi && greater_zeros(interval.lo) == 2 && greater_zeros(interval.hi) == 1;
}

std::vector<ClaimVerdict> verify(const SpectrumCertificate& certificate) {
  std::vector<RowVerdict> verdicts(certificate.rows.size());
  tbb::parallel_for(std::size_t{0}, verdicts.size(), [&](std::size_t i) { verdicts[i] = verify_row(certificate.scheme, certificate.rows[i]); });
  std::vector<ClaimVerdict> out;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const std::string k = std::to_string(certificate.rows[i].valence);
    const auto add = [&](const std::string& claim, const std::string& fault) {
      out.push_back({claim + k, fault.empty() ? Verdict::proved : Verdict::refuted, fault});
    };
    add("ordering=", verdicts[i].ordering);
    add("ring=", verdicts[i].ring);
    add("c1=", verdicts[i].ordering.empty() ? verdicts[i].ring : verdicts[i].ordering);
  }
  return out;
}

}  // namespace hexact
