// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bernstein_ring.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hexact {
namespace {

struct Weighted {
  int place = 0;
  Rational weight;
};

/// Bernstein coefficients of a uniform B-spline's piece between two knots, from its degree + 1 control points.
std::vector<std::vector<Weighted>> spline_to_bernstein(int degree) {
  const auto w = [](int p, int q) { return Rational(p) / Rational(q); };
  if (degree == 2) return {{{0, w(1, 2)}, {1, w(1, 2)}}, {{1, w(1, 1)}}, {{1, w(1, 2)}, {2, w(1, 2)}}};
  return {{{0, w(1, 6)}, {1, w(2, 3)}, {2, w(1, 6)}},
          {{1, w(2, 3)}, {2, w(1, 3)}},
          {{1, w(1, 3)}, {2, w(2, 3)}},
          {{1, w(1, 6)}, {2, w(2, 3)}, {3, w(1, 6)}}};
}

/// The piece on the cell (x, y) … (x+1, y+1); its control points begin at (x + first, y + first).
BernsteinPiece square_piece(const CharacteristicNet& net, int degree, int x, int y, int first) {
  const auto weights = spline_to_bernstein(degree);
  BernsteinPiece piece{degree, false, {}};
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; j <= degree; ++j) {
      ComplexInterval sum;
      for (const Weighted& a : weights[static_cast<std::size_t>(i)]) {
        for (const Weighted& b : weights[static_cast<std::size_t>(j)]) {
          sum = sum + net.at(x + first + a.place, y + first + b.place) * Interval(a.weight * b.weight);
        }
      }
      piece.coefficients.push_back(std::move(sum));
    }
  }
  return piece;
}

/// 24 times the Bernstein coefficients on the triangle (0,0) (1,0) (0,1) of the quartic box spline with its centre at
/// each of the twelve control points: for i = 0 … 4 those of (i, 0) … (i, 4 − i). From values at the 15 points of
/// quarters, which refinement gives exactly.
struct BoxSplineRow {
  int x, y;
  std::array<int, 15> coefficients;
};
constexpr std::array<BoxSplineRow, 12> kBoxSpline = {{
    {-1, 0, {2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {-1, 1, {2, 3, 4, 3, 2, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0}},
    {-1, 2, {0, 0, 0, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {0, -1, {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {0, 0, {12, 12, 8, 4, 2, 12, 10, 6, 3, 8, 6, 4, 4, 3, 2}},
    {0, 1, {2, 4, 8, 12, 12, 3, 6, 10, 12, 4, 6, 8, 3, 4, 2}},
    {0, 2, {0, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}},
    {1, -1, {2, 1, 0, 0, 0, 3, 1, 0, 0, 4, 1, 0, 3, 1, 2}},
    {1, 0, {2, 3, 4, 3, 2, 4, 6, 6, 4, 8, 10, 8, 12, 12, 12}},
    {1, 1, {0, 0, 0, 1, 2, 0, 0, 1, 3, 0, 1, 4, 1, 3, 2}},
    {2, -1, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 2}},
    {2, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2}},
}};

/// The piece on the triangle with one corner at (x, y) and the others one step of `direction` (1 or −1) from it.
BernsteinPiece triangle_piece(const CharacteristicNet& net, int x, int y, int direction) {
  BernsteinPiece piece{4, true, std::vector<ComplexInterval>(25)};
  for (const BoxSplineRow& row : kBoxSpline) {
    const ComplexInterval point = net.at(x + direction * row.x, y + direction * row.y);
    std::size_t next = 0;
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; i + j <= 4; ++j) {
        const int w = row.coefficients[next++];
        ComplexInterval& c = piece.coefficients[static_cast<std::size_t>(5 * i + j)];
        if (w != 0) c = c + point * Interval(Rational(w) / Rational(24));
      }
    }
  }
  return piece;
}

long binomial(int n, int k) {
  long r = 1;
  for (int i = 1; i <= k; ++i) r = r * (n - k + i) / i;
  return r;
}

/// det(a, b) = Im(conj(a) b).
Interval determinant(const ComplexInterval& a, const ComplexInterval& b) { return a.re * b.im - a.im * b.re; }

/// Bernstein coefficients of the Jacobian, a polynomial of degree 2d − 1 in x and in y.
std::vector<Interval> square_jacobian(const BernsteinPiece& p) {
  const int d = p.degree, n = 2 * d - 1;
  std::vector<Interval> out(static_cast<std::size_t>((n + 1) * (n + 1)));
  for (int i = 0; i < d; ++i) {
    for (int j = 0; j <= d; ++j) {
      const ComplexInterval dx = p.at(i + 1, j) - p.at(i, j);
      for (int k = 0; k <= d; ++k) {
        for (int l = 0; l < d; ++l) {
          const ComplexInterval dy = p.at(k, l + 1) - p.at(k, l);
          const Rational weight = Rational(binomial(d - 1, i) * binomial(d, k)) / Rational(binomial(n, i + k)) *
                                  (Rational(binomial(d, j) * binomial(d - 1, l)) / Rational(binomial(n, j + l)));
          out[static_cast<std::size_t>((i + k) * (n + 1) + j + l)] += determinant(dx, dy) * Interval(weight);
        }
      }
    }
  }
  return out;
}

/// The same on a triangle, of degree 2d − 2.
std::vector<Interval> triangle_jacobian(const BernsteinPiece& p) {
  const int d = p.degree - 1, n = 2 * d;
  const auto multinomial = [](int m, int i, int j) { return binomial(m, i) * binomial(m - i, j); };
  std::vector<Interval> out;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      Interval sum(0);
      for (int a = 0; a <= std::min(i, d); ++a) {
        for (int b = 0; a + b <= d && b <= j; ++b) {
          const int k = i - a, l = j - b;
          if (k + l > d) continue;
          const Rational weight = Rational(multinomial(d, a, b) * multinomial(d, k, l)) / Rational(multinomial(n, i, j));
          sum += determinant(p.at(a + 1, b) - p.at(a, b), p.at(k, l + 1) - p.at(k, l)) * Interval(weight);
        }
      }
      out.push_back(std::move(sum));
    }
  }
  return out;
}

/// A multiple of 10^-6 that is at most the lower end of x.
Rational rounded_down(const Interval& x) {
  const Rational scaled = x.lower() * Rational(1000000);
  return Rational(floor_quotient(scaled.numerator(), scaled.denominator())) / Rational(1000000);
}

Interval half_plane_cosine(const ComplexInterval& p) {
  const Interval length = sqrt(norm(p));
  return length.sign() > 0 ? p.re / length : Interval(-1);
}

}  // namespace

std::vector<BernsteinPiece> ring_pieces(SpectrumScheme scheme, const CharacteristicNet& net) {
  if (scheme == SpectrumScheme::loop) return {triangle_piece(net, 1, 0, 1), triangle_piece(net, 1, 1, -1)};
  // The cell (a, b) of a dual lattice has its control points from (a − 1, b − 1): vertices stand at half-integers.
  const int degree = scheme == SpectrumScheme::doo_sabin ? 2 : 3;
  return {square_piece(net, degree, 1, 0, -1), square_piece(net, degree, 1, 1, -1)};
}

RingProof prove_bernstein_ring(const std::vector<BernsteinPiece>& pieces) {
  std::optional<Interval> least, greatest, cosine;
  const auto lower = [](std::optional<Interval>& x, const Interval& y) {
    if (!x || y.lower() < x->lower()) x = y;
  };
  for (const BernsteinPiece& p : pieces) {
    for (const Interval& c : p.triangle ? triangle_jacobian(p) : square_jacobian(p)) {
      lower(least, c);
      if (!greatest || greatest->upper() < c.upper()) greatest = c;
    }
    for (int i = 0; i <= p.degree; ++i) {
      for (int j = 0; j <= (p.triangle ? p.degree - i : p.degree); ++j) lower(cosine, half_plane_cosine(p.at(i, j)));
    }
  }
  RingProof proof;
  proof.jacobian = greatest->sign() > 0 ? rounded_down(*least / *greatest) : Rational(-1);
  proof.half_plane = rounded_down(*cosine);
  const bool regular = proof.jacobian.sign() > 0, winds_once = proof.half_plane.sign() > 0;
  proof.verdict = regular && winds_once ? Verdict::proved : Verdict::undecided;
  if (!regular) proof.reason = "a Bernstein coefficient of the Jacobian is not positive";
  else if (!winds_once) proof.reason = "the Bernstein coefficients of a sector lie in no half-plane";
  return proof;
}

}  // namespace hexact
