// SPDX-License-Identifier: LGPL-3.0-or-later
#include "midedge_ring.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hexact {
namespace {

/// Coarse rows beside the one that a fine vertex stands next to: 2 for the six-point rule, 1 for the simple one.
int mask_reach(SpectrumScheme scheme) { return scheme == SpectrumScheme::midedge6 ? 2 : 1; }

/// A number in units of 2^-50, known up to `error` units.
constexpr long kFixedBits = 50;
struct Fixed {
  std::int64_t middle = 0, error = 0;
};

Fixed fixed(const Interval& x) {
  const auto [lo, hi] = x.scaled_ends(kFixedBits);
  HEXACT_INVARIANT(lo.bit_length() < 60 && hi.bit_length() < 60);
  const std::int64_t a = lo.to_int64(), b = hi.to_int64(), middle = a + (b - a) / 2;
  return {middle, b - middle};
}

struct FixedVector {
  Fixed x, y;
  friend FixedVector operator-(const FixedVector& a, const FixedVector& b) {
    return {{a.x.middle - b.x.middle, a.x.error + b.x.error}, {a.y.middle - b.y.middle, a.y.error + b.y.error}};
  }
  /// An upper bound of the length, in units.
  [[nodiscard]] double length() const {
    const auto end = [](const Fixed& f) { return std::fabs(static_cast<double>(f.middle)) + static_cast<double>(f.error) + 1; };
    return std::hypot(end(x), end(y)) * (1 + 0x1p-40);
  }
};

/// A lower bound of det(a, b), exact but for the errors of the operands.
__int128 determinant_bound(const FixedVector& a, const FixedVector& b) {
  const auto product_error = [](const Fixed& p, const Fixed& q) {
    return static_cast<__int128>(std::abs(p.middle)) * q.error + static_cast<__int128>(std::abs(q.middle)) * p.error +
           static_cast<__int128>(p.error) * q.error;
  };
  return static_cast<__int128>(a.x.middle) * b.y.middle - static_cast<__int128>(a.y.middle) * b.x.middle -
         product_error(a.x, b.y) - product_error(a.y, b.x);
}

/// The least sine of the angle from any difference in x to any difference in y, bounded from below.
double least_sine(const std::vector<FixedVector>& dx, const std::vector<FixedVector>& dy) {
  std::vector<double> lengths;
  for (const FixedVector& b : dy) lengths.push_back(b.length());
  double least = 2;
  for (const FixedVector& a : dx) {
    const double length = a.length();
    for (std::size_t i = 0; i < dy.size(); ++i) {
      // A quotient of a negative bound may be rounded either way: it only has to stay negative.
      least = std::min(least, static_cast<double>(determinant_bound(a, dy[i])) / (length * lengths[i]));
    }
  }
  return least;
}

/// A multiple of 10^-6 that is at most x; the factor absorbs the rounding of the doubles that led to x.
Rational rounded_down(double x) {
  return Rational(static_cast<long>(std::floor((x - std::fabs(x) * 0x1p-30) * 1e6))) / Rational(1000000);
}

}  // namespace

ComplexInterval RefinedNet::at(int i, int j) const {
  const Place p = dual_place(i, j);
  const ComplexInterval& u = points[static_cast<std::size_t>(p.i * side + p.j)];
  if (p.shift == 0) return u;
  const ComplexInterval omega = {Interval::cosine(1, valence), Interval::sine(1, valence)};
  return u * (p.shift > 0 ? omega : conjugate(omega));
}

std::array<Rational, 16> regular_weights(SpectrumScheme scheme) {
  const SubdivisionMatrix m = subdivision_matrix(scheme, 4, 6);
  const std::size_t row = m.index(3, 3);
  std::array<Rational, 16> out;
  for (const SectorWeight& w : m.local) {
    if (w.row != row) continue;
    const auto [i, j] = m.vertices[w.column];
    HEXACT_INVARIANT(w.shift == 0 && i < 4 && j < 4);
    out[static_cast<std::size_t>(4 * i + j)] = w.weight;
  }
  return out;
}

RefinedNet refined_net(SpectrumScheme scheme, const SubdivisionMatrix& matrix, const CharacteristicNet& net,
                       const RationalInterval& eigenvalue, int level) {
  const auto weights = regular_weights(scheme);
  const int reach = matrix.vertices.back()[0] + 1;
  std::vector<Interval> mask;
  for (const Rational& w : weights) mask.push_back(Interval(w));
  RefinedNet r{reach, matrix.valence, {}};
  for (int i = 0; i < reach; ++i) {
    for (int j = 0; j < reach; ++j) r.points.push_back(net.at(i, j));
  }
  const auto coarse = [](int t, int a) { return t % 2 == 1 ? t / 2 - 1 + a : t / 2 + 1 - a; };
  const Interval lambda(eigenvalue.lo, eigenvalue.hi);
  for (int step = 0; step < level; ++step) {
    RefinedNet fine{2 * (r.side - mask_reach(scheme)) + 1, matrix.valence, {}};
    for (int i = 0; i < fine.side; ++i) {
      for (int j = 0; j < fine.side; ++j) {
        ComplexInterval sum;
        if (i < reach && j < reach) sum = r.at(i, j) * lambda;
        for (int a = 0; a < 4 && (i >= reach || j >= reach); ++a) {
          for (int b = 0; b < 4; ++b) {
            const auto w = static_cast<std::size_t>(4 * a + b);
            if (!weights[w].is_zero()) sum = sum + r.at(coarse(i, a), coarse(j, b)) * mask[w];
          }
        }
        fine.points.push_back(std::move(sum));
      }
    }
    r = std::move(fine);
  }
  return r;
}

RingProof prove_midedge_ring(SpectrumScheme scheme, const RefinedNet& net, int level) {
  const int n = 1 << level, reach = 2 * mask_reach(scheme) - 1, low = -reach, side = n + reach + 1 - low;
  HEXACT_EXPECTS(level >= 1 && net.side >= n + reach);
  std::vector<FixedVector> points(static_cast<std::size_t>(side * side));
  const auto at = [&](int i, int j) -> FixedVector& { return points[static_cast<std::size_t>((i - low) * side + j - low)]; };
  const int last = n - 1 + reach;
  for (int i = low; i <= last; ++i) {
    for (int j = low; j <= last; ++j) {
      if (i < 0 && j < 0) continue;
      const ComplexInterval p = net.at(i, j);
      at(i, j) = {fixed(p.re), fixed(p.im)};
    }
  }
  double sine = 2, cosine = 2;
  for (int a = n / 2; a < n; ++a) {
    for (int b = 0; b <= a; ++b) {  // the other half of the sector is the mirror image
      std::vector<FixedVector> dx, dy;
      for (int i = a - reach; i <= a + reach; ++i) {
        for (int j = b - reach; j <= b + reach; ++j) {
          if (i < a + reach) dx.push_back(at(i + 1, j) - at(i, j));
          if (j < b + reach) dy.push_back(at(i, j + 1) - at(i, j));
          cosine = std::min(cosine, static_cast<double>(at(i, j).x.middle - at(i, j).x.error) / at(i, j).length());
        }
      }
      sine = std::min(sine, least_sine(dx, dy));
    }
  }
  RingProof proof;
  proof.level = level;
  proof.jacobian = rounded_down(sine);
  proof.half_plane = rounded_down(cosine);
  const bool regular = proof.jacobian.sign() > 0, winds_once = proof.half_plane.sign() > 0;
  proof.verdict = regular && winds_once ? Verdict::proved : Verdict::undecided;
  if (!regular) proof.reason = "the differences of the control points do not prove the Jacobian positive";
  else if (!winds_once) proof.reason = "the control points of a sector lie in no half-plane";
  return proof;
}

}  // namespace hexact
