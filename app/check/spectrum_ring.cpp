// SPDX-License-Identifier: LGPL-3.0-or-later
// The ring of a characteristic map: eigenvector in balls, then convex combinations of differences (midedge schemes) or
// Bernstein coefficients (schemes of B-splines).
#include "spectrum.hpp"

#include <algorithm>
#include <cstdint>

namespace check {
namespace {

using Net = std::map<std::pair<int, int>, ComplexBall>;  // control points of sector 0

Ball whole(int n) { return make_ball(mpz_class(n) << kFraction, 0); }
mpq_class ratio(int p, int q) {
  mpq_class x(p, q);
  x.canonicalize();
  return x;
}

// Value of a form on a net of mode 1.
ComplexBall apply(const Form& f, const Net& net, const std::vector<ComplexBall>& turns) {
  ComplexBall sum;
  for (const auto& [place, waves] : f) sum = sum + net.at(place) * at_turn(waves, turns, 1);
  return sum;
}

// Solves (M - lambda) u = 0, u(first) = 1, by Gauss and Jordan without one of the rows. When every pivot excludes 0 the
// solution is the only one. Then turns it so that the middle of sector 0 is the positive x-axis; empty when it fails.
Net eigenvector(const ModeRule& rule, const ListedValue& eigenvalue, const std::vector<ComplexBall>& turns) {
  const auto& v = rule.vertices();
  const std::size_t n = v.size();
  std::vector<std::vector<ComplexBall>> m(n, std::vector<ComplexBall>(n));
  for (std::size_t r = 0; r < n; ++r) {
    const Form f = rule.fine(v[r].first, v[r].second);
    for (std::size_t c = 0; c < n; ++c) {
      if (const auto w = f.find(v[c]); w != f.end()) m[r][c] = at_turn(w->second, turns, 1);
    }
    m[r][r].x = m[r][r].x - Ball(eigenvalue.lo, eigenvalue.hi);
  }
  const auto weight = [](const ComplexBall& a) { return mpz_class(abs(a.x.m) + abs(a.y.m)); };
  for (std::size_t c = 1; c < n; ++c) {
    const std::size_t at = c - 1;
    std::size_t best = at;
    for (std::size_t r = at; r < n; ++r) {
      if (weight(m[r][c]) > weight(m[best][c])) best = r;
    }
    std::swap(m[at], m[best]);
    if (length2(m[at][c]).sign() <= 0) return {};
    for (std::size_t r = 0; r < n; ++r) {
      if (r == at || (weight(m[r][c]) == 0 && m[r][c].x.r == 0 && m[r][c].y.r == 0)) continue;
      const ComplexBall factor = m[r][c] / m[at][c];
      m[r][0] = m[r][0] - factor * m[at][0];
      for (std::size_t i = c; i < n; ++i) m[r][i] = m[r][i] - factor * m[at][i];
      m[r][c] = {};
    }
  }
  ComplexBall start{whole(1), Ball()};
  if (rule.primal()) {  // the first vertex is on a side of the sector
    const Ball c = turns[1].x, half(ratio(1, 2));
    start = {root((whole(1) + c) * half), Ball() - root((whole(1) - c) * half)};
  }
  Net net;
  net[v[0]] = start;
  for (std::size_t c = 1; c < n; ++c) net[v[c]] = start * (ComplexBall{} - m[c - 1][0] / m[c - 1][c]);
  return net;
}

// ---- midedge -----------------------------------------------------------------------------------------------------

// Weights of the fine vertex (3, 3) on the coarse ones (0 ... 3, 0 ... 3); those of all vertices but a few near the
// centre are mirror images of them.
constexpr std::array<std::array<int, 4>, 4> kSix = {{{18, 69, 39, 0}, {69, 278, 178, 9}, {39, 178, 120, 9}, {0, 9, 9, 0}}};
constexpr std::array<std::array<int, 4>, 4> kSimple = {{{0, 0, 0, 0}, {0, 512, 256, 0}, {0, 256, 0, 0}, {0, 0, 0, 0}}};

// Coordinates in units of 2^-50, each off by at most kError units.
struct Whole {
  std::int64_t x, y;
};
constexpr std::int64_t kError = 2;

class MidedgeRing {
 public:
  MidedgeRing(const ModeRule& rule, bool six, Net net, const ListedValue& eigenvalue, const std::vector<ComplexBall>& turns)
      : rule_(rule), six_(six), net_(std::move(net)), side_(six ? 4 : 3), first_(side_), lambda_(eigenvalue.lo, eigenvalue.hi), turns_(turns) {}

  void refine() {
    Net fine;
    const int next = 2 * (side_ - (six_ ? 2 : 1)) + 1;
    for (int i = 0; i < next; ++i) {
      for (int j = 0; j < next; ++j) fine[{i, j}] = i < first_ && j < first_ ? at(i, j) * lambda_ : point(i, j);
    }
    net_ = std::move(fine);
    side_ = next;
  }

  // The net has been refined `level` times: the ring consists of cells of a grid with 2^level of them to the unit.
  std::string fault(int level, const mpq_class& sine, const mpq_class& cosine) {
    const int cells = 1 << level, reach = six_ ? 3 : 1;
    std::map<std::pair<int, int>, Whole> p;
    for (int i = -reach; i < cells + reach; ++i) {
      for (int j = -reach; j < cells + reach; ++j) {
        if (i < 0 && j < 0) continue;
        const ComplexBall b = at(i, j);
        if ((b.x.r >> (kFraction - 50)) != 0 || (b.y.r >> (kFraction - 50)) != 0) return "the control points are not known well enough";
        p[{i, j}] = {rounded(b.x), rounded(b.y)};
      }
    }
    for (int a = cells / 2; a < cells; ++a) {
      for (int b = 0; b <= a; ++b) {  // below the bisector of the sector; the rest is its mirror image
        std::vector<Whole> dx, dy;
        for (int i = a - reach; i <= a + reach; ++i) {
          for (int j = b - reach; j <= b + reach; ++j) {
            const Whole here = p[{i, j}];
            if (!in_wedge(here, cosine)) return "a control point is not in the half-plane";
            if (i < a + reach) dx.push_back(minus(p[{i + 1, j}], here));
            if (j < b + reach) dy.push_back(minus(p[{i, j + 1}], here));
          }
        }
        if (!all_left(dx, dy, sine)) return "differences in the cell (" + std::to_string(a) + ", " + std::to_string(b) + ") do not turn left enough";
      }
    }
    return {};
  }

 private:
  ComplexBall at(int i, int j) const { return apply(rule_.vertex(i, j), net_, turns_); }
  ComplexBall point(int i, int j) const {
    ComplexBall sum;
    const auto coarse = [](int t, int w) { return t % 2 != 0 ? t / 2 - 1 + w : t / 2 + 1 - w; };
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        const int w = six_ ? kSix[a][b] : kSimple[a][b];
        if (w == 0) continue;
        const ComplexBall u = at(coarse(i, static_cast<int>(a)), coarse(j, static_cast<int>(b)));
        sum = sum + u * make_ball(mpz_class(w) << (kFraction - 10), 0);
      }
    }
    return sum;
  }
  static std::int64_t rounded(const Ball& b) {
    const mpz_class m = b.m >> (kFraction - 50);
    return m.get_si();
  }
  static Whole minus(const Whole& a, const Whole& b) { return {a.x - b.x, a.y - b.y}; }
  // Not less than the length; coordinates of differences are off by 2 kError at most.
  static long double longest(const Whole& a) {
    const long double x = static_cast<long double>(std::abs(a.x) + 2 * kError), y = static_cast<long double>(std::abs(a.y) + 2 * kError);
    return __builtin_sqrtl(x * x + y * y) * (1 + 0x1p-50L);
  }
  static bool in_wedge(const Whole& p, const mpq_class& cosine) {
    return static_cast<long double>(p.x - kError) >= static_cast<long double>(cosine.get_d()) * (1 + 0x1p-50L) * longest(p);
  }
  static bool all_left(const std::vector<Whole>& dx, const std::vector<Whole>& dy, const mpq_class& sine) {
    const long double least = static_cast<long double>(sine.get_d()) * (1 + 0x1p-50L);
    for (const Whole& u : dx) {
      const long double length = longest(u) * least;
      for (const Whole& v : dy) {
        const __int128 e = 2 * kError;
        const __int128 error = e * (static_cast<__int128>(std::abs(u.x)) + std::abs(u.y) + std::abs(v.x) + std::abs(v.y)) + 2 * e * e;
        const __int128 turn = static_cast<__int128>(u.x) * v.y - static_cast<__int128>(u.y) * v.x - error;
        if (turn <= 0 || static_cast<long double>(turn) * (1 - 0x1p-50L) < length * longest(v)) return false;
      }
    }
    return true;
  }

  const ModeRule& rule_;
  bool six_;
  Net net_;
  int side_, first_;
  Ball lambda_;
  const std::vector<ComplexBall>& turns_;
};

// ---- B-splines ---------------------------------------------------------------------------------------------------

// Bernstein coefficients by (i, j): of degree d in x and in y, or on a triangle of degree d.
struct Piece {
  int d;
  bool triangle;
  std::map<std::pair<int, int>, ComplexBall> b;
};

// Rows: a Bernstein coefficient of one uniform B-spline piece, in sixths of the control points.
Piece square(const ModeRule& rule, const Net& net, const std::vector<ComplexBall>& turns, int d, int x, int y) {
  static const std::vector<std::vector<int>> quadratic{{3, 3, 0}, {0, 6, 0}, {0, 3, 3}};
  static const std::vector<std::vector<int>> cubic{{1, 4, 1, 0}, {0, 4, 2, 0}, {0, 2, 4, 0}, {0, 1, 4, 1}};
  const auto& rows = d == 2 ? quadratic : cubic;
  Piece piece{d, false, {}};
  for (int i = 0; i <= d; ++i) {
    for (int j = 0; j <= d; ++j) {
      ComplexBall sum;
      for (int a = 0; a <= d; ++a) {
        for (int b = 0; b <= d; ++b) {
          const int w = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(a)] * rows[static_cast<std::size_t>(j)][static_cast<std::size_t>(b)];
          if (w != 0) sum = sum + apply(rule.vertex(x - 1 + a, y - 1 + b), net, turns) * Ball(ratio(w, 36));
        }
      }
      piece.b[{i, j}] = sum;
    }
  }
  return piece;
}

// The quartic box spline on the triangle (0,0) (1,0) (0,1): the coefficients at a corner, and at the quarter, half and
// three quarters of an edge, and inside, each a sum of control points, in 24ths.
Piece triangle(const ModeRule& rule, const Net& net, const std::vector<ComplexBall>& turns, int x, int y, int s) {
  const auto point = [&](int a, int b) { return apply(rule.vertex(x + s * a, y + s * b), net, turns); };
  // Corners of the triangle in cyclic order, with the two neighbours of the lattice across each edge.
  constexpr std::array<std::array<int, 2>, 3> corner{{{0, 0}, {1, 0}, {0, 1}}};
  constexpr std::array<std::array<int, 2>, 6> around{{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
  const auto place = [&](int p, int q, int a, int b) {  // a steps of four towards corner p from r, b towards q
    return std::pair(a * corner[static_cast<std::size_t>(p)][0] + b * corner[static_cast<std::size_t>(q)][0] + (4 - a - b) * corner[static_cast<std::size_t>(3 - p - q)][0],
                     a * corner[static_cast<std::size_t>(p)][1] + b * corner[static_cast<std::size_t>(q)][1] + (4 - a - b) * corner[static_cast<std::size_t>(3 - p - q)][1]);
  };
  const auto at = [&](std::array<int, 2> v) { return point(v[0], v[1]); };
  const auto times = [](const ComplexBall& u, int w) { return u * make_ball(mpz_class(w) << kFraction, 0); };
  Piece piece{4, true, {}};
  for (int p = 0; p < 3; ++p) {
    for (int q = 0; q < 3; ++q) {
      if (p == q) continue;
      const auto P = corner[static_cast<std::size_t>(p)], Q = corner[static_cast<std::size_t>(q)], R = corner[static_cast<std::size_t>(3 - p - q)];
      const std::array<int, 2> opposite{P[0] + Q[0] - R[0], P[1] + Q[1] - R[1]};  // across the edge PQ
      const std::array<int, 2> beside{P[0] + R[0] - Q[0], P[1] + R[1] - Q[1]}, other{2 * P[0] - R[0], 2 * P[1] - R[1]};
      // At P: 12 P + 2 (its six neighbours).
      ComplexBall sum = times(at(P), 12);
      for (const auto& d : around) sum = sum + times(point(P[0] + d[0], P[1] + d[1]), 2);
      piece.b[place(p, q, 4, 0)] = sum;
      // A quarter from P to Q: 12 P + 4 Q + 3 R + 3 opposite + the neighbours of P that follow R and opposite.
      sum = times(at(P), 12) + times(at(Q), 4) + times(at(R), 3) + times(at(opposite), 3) + at(beside) + at(other);
      piece.b[place(p, q, 3, 1)] = sum;
      // Half way: 8 P + 8 Q + 4 R + 4 opposite.
      piece.b[place(p, q, 2, 2)] = times(at(P), 8) + times(at(Q), 8) + times(at(R), 4) + times(at(opposite), 4);
      // Inside, near P: 10 P + 6 Q + 6 R + the two neighbours across PQ and PR.
      piece.b[place(p, q, 2, 1)] = times(at(P), 10) + times(at(Q), 6) + times(at(R), 6) + at(opposite) + at(beside);
    }
  }
  for (auto& [where, u] : piece.b) u = u * Ball(ratio(1, 24));
  return piece;
}

int choose(int n, int k) { return k == 0 ? 1 : choose(n - 1, k - 1) * n / k; }

// Bernstein coefficients of det(du/dx, du/dy), up to one positive factor for all.
std::map<std::pair<int, int>, Ball> jacobian(const Piece& p) {
  std::map<std::pair<int, int>, Ball> out;
  const int d = p.d, n = p.triangle ? 2 * d - 2 : 2 * d - 1;
  const auto basis = [&](int m, int l, int i, int j) { return p.triangle ? choose(m, i) * choose(m - i, j) : choose(m, i) * choose(l, j); };
  for (const auto& [a, u] : p.b) {
    const auto right = p.b.find({a.first + 1, a.second});
    if (right == p.b.end()) continue;
    for (const auto& [b, v] : p.b) {
      const auto up = p.b.find({b.first, b.second + 1});
      if (up == p.b.end()) continue;
      const int i = a.first + b.first, j = a.second + b.second;
      const int w = basis(d - 1, p.triangle ? 0 : d, a.first, a.second) * (p.triangle ? basis(d - 1, 0, b.first, b.second) : basis(d, d - 1, b.first, b.second));
      Ball& sum = out[{i, j}];
      sum = sum + cross(right->second - u, up->second - v) * Ball(ratio(w, basis(n, n, i, j)));
    }
  }
  return out;
}

std::string spline_fault(const std::vector<Piece>& pieces, const mpq_class& jacobian_bound, const mpq_class& cosine) {
  mpz_class greatest = 0;
  std::vector<Ball> all;
  for (const Piece& p : pieces) {
    for (const auto& [place, x] : jacobian(p)) {
      all.push_back(x);
      greatest = std::max(greatest, x.upper());
    }
    for (const auto& [place, u] : p.b) {
      const Ball rest = u.x * u.x - Ball(mpq_class(cosine * cosine)) * length2(u);
      if (u.x.sign() <= 0 || rest.sign() <= 0) return "a Bernstein coefficient is not in the half-plane";
    }
  }
  const Ball bound = Ball(jacobian_bound) * make_ball(greatest, 0);
  for (const Ball& x : all) {
    if (x.sign() <= 0 || (x - bound).sign() <= 0) return "a Bernstein coefficient of the Jacobian is too small";
  }
  return {};
}

}  // namespace

std::string ring_fault(Scheme scheme, const ListedRow& row, const ListedValue& eigenvalue) {
  const RingBounds& bounds = *row.ring;
  if (sgn(bounds.jacobian) <= 0 || sgn(bounds.half_plane) <= 0) return "a bound is not positive";
  const mpq_class unit(1000000);
  if (mpq_class(unit * bounds.jacobian).get_den() != 1 || mpq_class(unit * bounds.half_plane).get_den() != 1) return "a bound is no multiple of 10^-6";
  if (bounds.jacobian > 1 || bounds.half_plane > 1) return "a bound is greater than 1";
  const std::vector<ComplexBall> all = turns(row);
  const ModeRule rule(scheme, row, 1);
  const bool six = scheme == Scheme::midedge6, spline = !six && scheme != Scheme::midedge;
  if (spline ? bounds.level != 0 : bounds.level < (six ? 3 : 1) || bounds.level > 7) return "there is no proof at this level";
  Net net = eigenvector(rule, eigenvalue, all);
  if (net.empty()) return "the eigenvector is not certain to be unique";
  if (!spline) {
    MidedgeRing ring(rule, six, std::move(net), eigenvalue, all);
    for (int l = 0; l < bounds.level; ++l) ring.refine();
    return ring.fault(bounds.level, bounds.jacobian, bounds.half_plane);
  }
  std::vector<Piece> pieces;
  if (scheme == Scheme::loop) {
    pieces = {triangle(rule, net, all, 1, 0, 1), triangle(rule, net, all, 1, 1, -1)};
  } else {
    const int d = scheme == Scheme::doo_sabin ? 2 : 3;
    pieces = {square(rule, net, all, d, 1, 0), square(rule, net, all, d, 1, 1)};
  }
  return spline_fault(pieces, bounds.jacobian, bounds.half_plane);
}

}  // namespace check
