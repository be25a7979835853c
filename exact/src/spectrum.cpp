// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/spectrum.hpp"

#include <mpfr.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace hexact {
namespace {

/// An eigenvalue of the whole matrix, or what is known of several that were not isolated.
struct Candidate {
  Eigenvalue value;     ///< multiplicity is that in the whole matrix
  Rational low, high;   ///< of the modulus
  bool isolated = true;
};

std::vector<Candidate> candidates(const SpectrumRow& row) {
  std::vector<Candidate> out;
  for (std::size_t m = 0; m < row.modes.size(); ++m) {
    const int copies = m == 0 || 2 * static_cast<int>(m) == row.valence ? 1 : 2;
    for (Eigenvalue e : row.modes[m].isolated) {
      e.multiplicity *= copies;
      const Rational a = abs(e.enclosure.lo), b = abs(e.enclosure.hi);
      const bool straddles = e.enclosure.lo.sign() * e.enclosure.hi.sign() < 0;
      out.push_back({e, straddles ? Rational() : std::min(a, b), std::max(a, b), true});
    }
    if (row.modes[m].remaining > 0) {
      const Eigenvalue unknown{static_cast<int>(m), {}, row.modes[m].remaining * copies};
      out.push_back({unknown, Rational(), row.modes[m].remaining_bound, false});
    }
  }
  // The same rational number in several modes is one eigenvalue.
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) { return a.low != b.low ? a.low > b.low : a.high > b.high; });
  std::vector<Candidate> merged;
  for (Candidate& c : out) {
    const bool exact = c.isolated && c.value.enclosure.lo == c.value.enclosure.hi;
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const Candidate& o) {
      return exact && o.isolated && o.value.enclosure == c.value.enclosure;
    });
    if (same != merged.end()) same->value.multiplicity += c.value.multiplicity;
    else merged.push_back(std::move(c));
  }
  return merged;
}

std::string times(const Candidate& c) {
  const DecimalEnclosure d = decimal_enclosure(c.value.enclosure, 15);
  return (d.lo == d.hi ? d.lo : "[" + d.lo + ", " + d.hi + "]") + ", of multiplicity " + std::to_string(c.value.multiplicity);
}

struct Decision {
  Verdict verdict = Verdict::proved;
  std::string witness;
};

bool is_one(const Candidate& c) {
  return c.isolated && c.value.enclosure.lo == Rational(1) && c.value.enclosure.hi == Rational(1);
}

/// Whether an eigenvalue whose exact value is not known can be 1.
bool may_be_one(const Candidate& c) {
  if (!c.isolated) return c.high >= Rational(1);
  return c.value.enclosure.lo <= Rational(1) && c.value.enclosure.hi >= Rational(1);
}

/// The leading 1: simple, and all others are smaller.
Decision decide_one(std::vector<Candidate>& all) {
  const auto one = std::find_if(all.begin(), all.end(), is_one);
  const int multiplicity = one == all.end() ? 0 : one->value.multiplicity;
  if (multiplicity > 1) return {Verdict::refuted, "1 is an eigenvalue of multiplicity " + std::to_string(multiplicity)};
  if (one != all.end()) all.erase(one);
  for (const Candidate& c : all) {
    if (c.low >= Rational(1)) return {Verdict::refuted, "an eigenvalue has modulus at least 1: " + times(c)};
  }
  if (multiplicity == 0) {
    const bool possible = std::any_of(all.begin(), all.end(), may_be_one);
    return {possible ? Verdict::undecided : Verdict::refuted, "1 is not found among the eigenvalues"};
  }
  for (const Candidate& c : all) {
    if (c.high >= Rational(1)) return {Verdict::undecided, "the modulus of an eigenvalue of mode " + std::to_string(c.value.mode) + " may reach 1"};
  }
  return {};
}

Decision decide_pair(const std::vector<Candidate>& all) {
  if (all.empty()) return {Verdict::refuted, "there is no second eigenvalue"};
  const Candidate& top = all.front();  // of the greatest lower bound
  if (!top.isolated) return {Verdict::undecided, "the eigenvalues of mode " + std::to_string(top.value.mode) + " are not isolated"};
  bool has_equal = false;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].high < top.low) continue;
    const bool equal = all[i].isolated && all[i].low == all[i].high && top.low == top.high && all[i].low == top.low;
    has_equal = has_equal || equal;
    if (equal) continue;
    return {Verdict::undecided, "the second eigenvalue, " + times(top) + ", is not separated from one of mode " + std::to_string(all[i].value.mode)};
  }
  if (has_equal) return {Verdict::refuted, "two eigenvalues have the modulus of " + times(top)};
  if (top.value.enclosure.hi.sign() <= 0) return {Verdict::refuted, "the second eigenvalue is not positive: " + times(top)};
  if (top.value.enclosure.lo.sign() <= 0) return {Verdict::undecided, "the sign of the second eigenvalue is not certain: " + times(top)};
  if (top.value.multiplicity != 2) return {Verdict::refuted, "the second eigenvalue is " + times(top)};
  return {};
}

/// The third eigenvalue in modulus, where it is certain which one that is. `all` begins with the second.
std::optional<Eigenvalue> greatest_after_pair(const std::vector<Candidate>& all) {
  if (all.size() < 2 || !all[1].isolated) return std::nullopt;
  for (std::size_t i = 2; i < all.size(); ++i) {
    if (all[i].high > all[1].low) return std::nullopt;
  }
  return all[1].value;
}

Verdict both(Verdict a, Verdict b) {
  if (a == Verdict::refuted || b == Verdict::refuted) return Verdict::refuted;
  return a == Verdict::proved && b == Verdict::proved ? Verdict::proved : Verdict::undecided;
}

std::string decimal(const Integer& scaled, int digits) {
  std::string s = abs(Rational(scaled)).str();
  if (static_cast<int>(s.size()) <= digits) s.insert(0, static_cast<std::size_t>(digits) + 1 - s.size(), '0');
  s.insert(s.size() - static_cast<std::size_t>(digits), ".");
  while (s.back() == '0') s.pop_back();
  if (s.back() == '.') s.pop_back();
  return (scaled.sign() < 0 ? "-" : "") + s;
}

}  // namespace

SpectrumSubject scheme_subject(SpectrumScheme scheme, int valence) {
  return {subdivision_matrix(scheme, valence, ring_reach(scheme)), scheme};
}

void decide_ordering(SpectrumRow& row) {
  row.subdominant.reset();
  row.next.reset();
  std::vector<Candidate> all = candidates(row);
  Decision decision = decide_one(all);
  if (decision.verdict == Verdict::proved) {
    decision = decide_pair(all);
    if (decision.verdict == Verdict::proved) {
      row.subdominant = all[0].value;
      row.next = greatest_after_pair(all);
    }
  }
  row.ordering = decision.verdict;
  row.ordering_witness = decision.witness;
}

SpectrumRow spectrum_row(const SpectrumSubject& subject) {
  SpectrumRow row;
  row.valence = subject.matrix.valence;
  row.modes = mode_spectra(subject.matrix);
  decide_ordering(row);
  if (row.ordering != Verdict::proved) {
    row.ring.reason = "there is no characteristic map without the ordering of the eigenvalues";
  } else if (!subject.regular) {
    row.ring.reason = "the rules away from the centre are not given";
  } else if (!reproduces_constants(subject.matrix)) {
    row.ring.reason = "the weights do not add up to 1: constant data does not stay constant";
  } else if (row.subdominant->mode > 1 && 2 * row.subdominant->mode < row.valence) {
    row.ring.verdict = Verdict::refuted;
    row.ring.reason = "the second eigenvalue belongs to mode " + std::to_string(row.subdominant->mode) + ": the ring winds so many times";
  } else if (row.subdominant->mode != 1) {
    row.ring.reason = "the second eigenvalue belongs to no pair of modes";
  } else {
    row.ring = prove_ring(*subject.regular, subject.matrix, row.subdominant->enclosure);
  }
  if (row.ordering == Verdict::proved) row.c1 = row.ring.verdict;
  mpfr_free_cache();
  return row;
}

std::vector<SpectrumRow> spectrum_rows(const std::vector<SpectrumSubject>& subjects, const ProgressPart& progress) {
  std::vector<SpectrumRow> rows(subjects.size());
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows.size(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      progress.check();
      rows[i] = spectrum_row(subjects[i]);
      progress.report(static_cast<double>(++done) / static_cast<double>(rows.size()));
    }
  });
  return rows;
}

Verdict overall(const SpectrumRow& row) noexcept { return both(row.ordering, both(row.ring.verdict, row.c1)); }

DecimalEnclosure decimal_enclosure(const RationalInterval& interval, int digits) {
  Rational scale(1);
  for (int i = 0; i < digits; ++i) scale *= Rational(10);
  const Rational lo = interval.lo * scale, hi = interval.hi * scale;
  return {decimal(floor_quotient(lo.numerator(), lo.denominator()), digits), decimal(ceil_quotient(hi.numerator(), hi.denominator()), digits)};
}

}  // namespace hexact
