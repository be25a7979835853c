// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/spectrum_certificate.hpp"

#include "eigenvalue_check.hpp"
#include "hexact/kernel/errors.hpp"
#include "interval.hpp"

#include <mpfr.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace hexact {
namespace {

using Row = SpectrumCertificate::Row;
using Scheme = std::optional<SpectrumScheme>;

/// The widest interval that is accepted.
const Rational kCosineWidth = Rational(1).scaled(-200);
/// The longest numerator and denominator of its ends: to prove that it contains the cosine multiplies them by k.
constexpr std::size_t kCosineBits = 1024;

bool too_long(const Rational& x) { return x.numerator().bit_length() > kCosineBits || x.denominator().bit_length() > kCosineBits; }

SpectrumSubject subject_of(const Scheme& scheme, const Row& row) {
  if (row.mask) return mask_subject({"", scheme, {}}, *row.mask);
  if (!scheme) throw InvalidInput("BadMask", "a row of a matrix of blocks gives them", "valence " + std::to_string(row.valence));
  return scheme_subject(*scheme, row.valence);
}

std::string spectrum_fault(const Row& row, const SubdivisionMatrix& matrix) {
  if (too_long(row.cosine.lo) || too_long(row.cosine.hi)) return "an end of the cosine interval has more than 1024 bits";
  if (row.cosine.hi - row.cosine.lo > kCosineWidth) return "the cosine interval is wider than 2^-200";
  if (!encloses_cosine(row.cosine, row.valence)) return "the interval does not contain cos(2 pi/k)";
  if (row.modes.size() != static_cast<std::size_t>(row.valence / 2) + 1) return "a mode is missing";
  const auto factors = characteristic_factors(matrix);
  for (std::size_t m = 0; m < row.modes.size(); ++m) {
    const std::size_t n = matrix.size() + (m == 0 && matrix.has_centre ? 1 : 0);
    const std::string fault = eigenvalue_fault(row.modes[m], factors[m], row.valence, n);
    if (!fault.empty()) return "mode " + std::to_string(m) + ": " + fault;
  }
  return {};
}

std::string ring_fault(SpectrumScheme scheme, const SubdivisionMatrix& matrix, const Row& row, const Eigenvalue& second) {
  if (second.mode != 1) return "the second eigenvalue is not of mode 1";
  if (!row.ring) return "there is no proof of the ring";
  const SpectrumCertificate::Ring& ring = *row.ring;
  if (ring.jacobian.sign() <= 0 || ring.half_plane.sign() <= 0) return "a bound is not positive";
  const Rational unit(1000000);  // what proofs round to: finer bounds would ask for the same arithmetic
  const Integer one(1);
  if ((unit * ring.jacobian).denominator() != one || (unit * ring.half_plane).denominator() != one) return "a bound is no multiple of 10^-6";
  if (is_bspline_scheme(scheme) && ring.level != 0) return "rings of B-splines have level 0";
  const RingProof proof = prove_ring(scheme, matrix, second.enclosure, ring.level);
  if (proof.verdict != Verdict::proved) return proof.reason;
  if (proof.jacobian < ring.jacobian) return "the bound of the Jacobian is only " + proof.jacobian.str();
  if (proof.half_plane < ring.half_plane) return "the bound of the half-plane is only " + proof.half_plane.str();
  return {};
}

/// What is wrong with each statement about a row; empty if nothing is.
struct RowFaults {
  std::string ordering, ring, ordering_fails, ring_fails;
};

void decide(RowFaults& out, const Scheme& scheme, const Row& row, bool with_ring) {
  const SpectrumSubject subject = subject_of(scheme, row);
  out.ordering = out.ordering_fails = spectrum_fault(row, subject.matrix);
  out.ring = out.ring_fails = "rests on the ordering";
  if (!out.ordering.empty()) return;
  SpectrumRow decided;
  decided.valence = row.valence;
  decided.modes = row.modes;
  decide_ordering(decided);
  out.ordering = decided.ordering_witness;
  if (decided.ordering == Verdict::proved) out.ordering_fails = "the ordering holds";
  else if (decided.ordering == Verdict::undecided) out.ordering_fails = "it may hold: " + decided.ordering_witness;
  if (!out.ordering.empty()) return;
  if (!scheme) {
    out.ring = out.ring_fails = "the rules away from the centre are not given";
    return;
  }
  if (!reproduces_constants(subject.matrix)) {
    out.ring = out.ring_fails = "the weights do not add up to 1: constant data does not stay constant";
    return;
  }
  const Eigenvalue& second = *decided.subdominant;
  const bool winds = second.mode > 1 && 2 * second.mode < row.valence;
  out.ring_fails = winds ? "" : "the second eigenvalue is of mode " + std::to_string(second.mode);
  if (with_ring) out.ring = ring_fault(*scheme, subject.matrix, row, second);
}

RowFaults row_faults(const Scheme& scheme, const Row& row, bool with_ring) {
  RowFaults out;
  try {
    decide(out, scheme, row, with_ring);
  } catch (const InvalidInput& e) {  // a mask that is none
    out.ordering = out.ordering_fails = e.findings().front().message;
    out.ring = out.ring_fails = "rests on the ordering";
  }
  mpfr_free_cache();
  return out;
}

bool rests_on_ring(SpectrumClaimKind kind) { return kind == SpectrumClaimKind::ring || kind == SpectrumClaimKind::c1; }

const std::string& fault_of(const RowFaults& faults, SpectrumClaimKind kind) {
  switch (kind) {
    case SpectrumClaimKind::ordering: return faults.ordering;
    case SpectrumClaimKind::ring: return faults.ring;
    case SpectrumClaimKind::c1: return faults.ordering.empty() ? faults.ring : faults.ordering;
    case SpectrumClaimKind::ordering_fails: return faults.ordering_fails;
    case SpectrumClaimKind::ring_fails: return faults.ring_fails;
    case SpectrumClaimKind::c1_fails:
    case SpectrumClaimKind::regular: break;
  }
  return faults.ordering.empty() ? faults.ring_fails : faults.ordering;
}

RationalInterval cosine_interval(int valence) {
  const Interval c = Interval::cosine(1, valence);
  const Rational ulp = Rational(1).scaled(-256);
  const auto grid = [](const Rational& x) {
    const Rational s = x.scaled(256);
    return Rational(floor_quotient(s.numerator(), s.denominator())).scaled(-256);
  };
  return {grid(c.lower()) - ulp, grid(c.upper()) + ulp + ulp};
}

/// Whether the claim about the ordering holds with every disc `excess` wider. The radii were found by interval
/// arithmetic; the exact count fails where a root or a coefficient happens to lie on the circle.
bool holds(const Scheme& scheme, Row& row, SpectrumClaimKind claim, const Rational& excess) {
  Row wider = row;
  for (ModeSpectrum& m : wider.modes) {
    if (m.remaining > 0) m.remaining_bound += excess;
  }
  if (!fault_of(row_faults(scheme, wider, false), claim).empty()) return false;
  row = std::move(wider);
  return true;
}

void add_row(SpectrumCertificate& certificate, const SpectrumRow& proved, std::optional<ExtraordinaryMask> mask) {
  std::vector<SpectrumClaim> claims = proved_claims(proved);
  if (!certificate.scheme) {
    std::erase_if(claims, [](const SpectrumClaim& c) { return c.kind != SpectrumClaimKind::ordering && c.kind != SpectrumClaimKind::ordering_fails; });
  }
  if (claims.empty()) return;
  Row row;
  row.valence = proved.valence;
  row.mask = std::move(mask);
  row.cosine = cosine_interval(proved.valence);
  for (const ModeSpectrum& m : proved.modes) row.modes.push_back(disjoint_eigenvalues(m));
  const bool bounded = std::any_of(row.modes.begin(), row.modes.end(), [](const ModeSpectrum& m) { return m.remaining > 0; });
  if (bounded || row.mask) {  // of masks anything may come; the program's schemes are known to need no disc
    bool found = false;
    for (long step = 0; step < 8 && !found; ++step) found = holds(certificate.scheme, row, claims.front().kind, Rational(step).scaled(-20));
    if (!found) return;
  }
  if (proved.ring.verdict == Verdict::proved) row.ring = {proved.ring.level, proved.ring.jacobian, proved.ring.half_plane};
  certificate.rows.push_back(std::move(row));
  certificate.claims.insert(certificate.claims.end(), claims.begin(), claims.end());
}

}  // namespace

SpectrumCertificate make_spectrum_certificate(SpectrumScheme scheme, const std::vector<SpectrumRow>& rows, std::vector<std::string> provenance) {
  SpectrumCertificate certificate{std::move(provenance), scheme, {}, {}, {}};
  for (const SpectrumRow& row : rows) add_row(certificate, row, std::nullopt);
  return certificate;
}

SpectrumCertificate make_spectrum_certificate(const MasksDocument& masks, const std::vector<SpectrumRow>& rows, std::vector<std::string> provenance) {
  SpectrumCertificate certificate{std::move(provenance), masks.scheme, {}, {}, {}};
  for (const SpectrumRow& row : rows) {
    const auto mask = std::find_if(masks.masks.begin(), masks.masks.end(), [&](const auto& m) { return m.valence == row.valence; });
    HEXACT_EXPECTS(mask != masks.masks.end());
    add_row(certificate, row, *mask);
  }
  return certificate;
}

bool encloses_cosine(const RationalInterval& interval, int k) {
  HEXACT_EXPECTS(k >= 3);
  // U_0, U_1, … is a Sturm sequence: it changes sign at x as often as U_{k−1} has zeros greater than x. At x = p/q the
  // integers q^j U_j have the same signs, and no fraction needs to be reduced.
  const auto greater_zeros = [k](const Rational& x) {
    const Integer twice = Integer(2) * x.numerator(), square = x.denominator() * x.denominator();
    Integer before(0), now(1);  // of U_{−1}, U_0
    int changes = 0, sign = 1;
    for (int j = 1; j < k; ++j) {
      Integer next = twice * now - square * before;
      before = std::move(now);
      now = std::move(next);
      if (now.sign() * sign < 0) ++changes, sign = -sign;
    }
    return now.is_zero() ? -1 : changes;
  };
  return interval.lo < interval.hi && greater_zeros(interval.lo) == 2 && greater_zeros(interval.hi) == 1;
}

namespace {

/// `faults` are those of the rows, in order.
std::string claim_fault(const SpectrumCertificate& certificate, const std::vector<RowFaults>& faults, const SpectrumClaim& claim) {
  if (claim.kind == SpectrumClaimKind::regular) {
    if (!certificate.regular || !certificate.scheme) return "there is no evidence";
    const bool masks = std::any_of(certificate.rows.begin(), certificate.rows.end(), [](const Row& row) { return row.mask.has_value(); });
    if (masks) return "masks say nothing of regular regions";
    return regular_fault(*certificate.scheme, *certificate.regular);
  }
  for (std::size_t i = 0; i < faults.size(); ++i) {
    if (certificate.rows[i].valence == claim.valence) return fault_of(faults[i], claim.kind);
  }
  return "there is no row of this valence";
}

}  // namespace

std::vector<ClaimVerdict> verify(const SpectrumCertificate& certificate) {
  const std::vector<SpectrumClaim>& claims = certificate.claims;
  std::vector<RowFaults> faults(certificate.rows.size());
  tbb::parallel_for(std::size_t{0}, faults.size(), [&](std::size_t i) {
    const Row& row = certificate.rows[i];
    const auto about_row = [&](const SpectrumClaim& c) { return c.valence == row.valence; };
    if (std::none_of(claims.begin(), claims.end(), about_row)) return;
    const bool with_ring = std::any_of(claims.begin(), claims.end(), [&](const SpectrumClaim& c) { return about_row(c) && rests_on_ring(c.kind); });
    faults[i] = row_faults(certificate.scheme, row, with_ring);
  });
  std::vector<ClaimVerdict> out;
  for (const SpectrumClaim& claim : claims) {
    const std::string fault = claim_fault(certificate, faults, claim);
    out.push_back({text_of(claim), fault.empty() ? Verdict::proved : Verdict::refuted, fault});
  }
  return out;
}

}  // namespace hexact
