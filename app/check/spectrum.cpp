// SPDX-License-Identifier: LGPL-3.0-or-later
// Proves that the listed eigenvalues are all eigenvalues of a matrix.
#include "spectrum.hpp"


#include <algorithm>
#include <numeric>

namespace check {
namespace {

using Poly = std::vector<mpq_class>;  // coefficients, constant first, the last not 0

// ---- polynomials -------------------------------------------------------------------------------------------------

void trim(Poly& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}
mpq_class value(const Poly& p, const mpq_class& x) {
  mpq_class v;
  for (std::size_t i = p.size(); i-- > 0;) v = v * x + p[i];
  return v;
}
std::pair<Poly, Poly> divide(Poly p, const Poly& q) {
  Poly quotient;
  if (p.size() >= q.size()) quotient.resize(p.size() - q.size() + 1);
  for (std::size_t i = quotient.size(); i-- > 0;) {
    quotient[i] = p[i + q.size() - 1] / q.back();
    for (std::size_t j = 0; j < q.size(); ++j) p[i + j] -= quotient[i] * q[j];
  }
  trim(p);
  return {quotient, p};
}
Poly gcd_of(Poly p, Poly q) {
  while (!q.empty()) {
    Poly rest = divide(p, q).second;
    p = std::move(q), q = std::move(rest);
    if (!q.empty()) {
      const mpq_class lead = q.back();
      for (mpq_class& x : q) x /= lead;
    }
  }
  return p;
}
Poly slope(const Poly& p) {
  Poly d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<int>(i));
  return d;
}
// The product of (X - a) over the roots a of multiplicity n or more, for n = 1, 2, ...: p/gcd(p, p'), and so on.
std::vector<Poly> layers(Poly p) {
  std::vector<Poly> out;
  while (p.size() > 1) {
    Poly common = gcd_of(p, slope(p));
    out.push_back(divide(p, common).first);
    p = std::move(common);
  }
  return out;
}

// det(X - M) with entries that are polynomials of c = (z + 1/z)/2 in disguise: coefficient of X^i as polynomial in c.
class ModePolynomials {
 public:
  // Rules that are given may have no mirror image; that costs a second determinant in each place.
  ModePolynomials(const ModeRule& rule, bool given) : given_(given) {
    const auto& v = rule.vertices();
    n_ = v.size();
    entries_.resize(n_ * n_);
    for (std::size_t r = 0; r < n_; ++r) {
      for (const auto& [place, waves] : rule.fine(v[r].first, v[r].second)) {
        const auto c = static_cast<std::size_t>(std::find(v.begin(), v.end(), place) - v.begin());
        entries_.at(r * n_ + c) = waves;  // every vertex that is used is one of these
      }
    }
    split();
  }
  std::size_t n() const { return n_; }
  // Whether the determinants are polynomials of c at all.
  bool symmetric() const { return symmetric_; }
  const std::vector<std::vector<Poly>>& blocks() const { return blocks_; }

 private:
  // Vertices that depend on each other form a block; the determinant is the product over the blocks.
  void split() {
    std::vector<int> block(n_, -1);
    std::vector<std::vector<std::size_t>> sets;
    for (std::size_t r = 0; r < n_; ++r) {
      if (block[r] >= 0) continue;
      const std::vector<bool> needs = reach(r, false), used = reach(r, true);
      std::vector<std::size_t> set;
      for (std::size_t c = 0; c < n_; ++c) {
        if (c == r || (needs[c] && used[c])) set.push_back(c), block[c] = static_cast<int>(r);
      }
      expect_feasible(set);
      sets.push_back(std::move(set));
    }
    for (const auto& set : sets) blocks_.push_back(determinant(set));
  }
  int widest(const std::vector<std::size_t>& set) const {
    int out = 0;
    for (const std::size_t r : set) {
      for (const std::size_t c : set) {
        for (const auto& wave : entries_[r * n_ + c]) out = std::max(out, std::abs(wave.first));
      }
    }
    return out;
  }
  // Denominator and longest numerator of the weights over one denominator; of more than 2^20 bits not in full.
  std::size_t bits(const std::vector<std::size_t>& set) const {
    constexpr std::size_t kEnough = std::size_t{1} << 20;
    const auto length = [](const mpz_class& x) { return x == 0 ? 0 : mpz_sizeinbase(x.get_mpz_t(), 2); };
    mpz_class denominator = 1;
    std::size_t longest = 0;
    for (const std::size_t r : set) {
      for (const std::size_t c : set) {
        for (const auto& [exponent, w] : entries_[r * n_ + c]) {
          if (length(denominator) + length(w.get_den()) > kEnough) return kEnough;
          denominator = lcm(denominator, w.get_den());
          longest = std::max(longest, length(w.get_num()));
        }
      }
    }
    return length(denominator) + longest;
  }
  // n^4 products of integers at each of nw + 1 nodes, and divided differences, in words: the bound of docs/spectrum.md.
  void expect_feasible(const std::vector<std::size_t>& set) const {
    const auto n = static_cast<double>(set.size());
    const int w = widest(set), degree = w * static_cast<int>(set.size());
    const std::size_t node = mpz_sizeinbase(mpz_class(degree + 1).get_mpz_t(), 2);
    const double words = n * static_cast<double>(bits(set) + 2 * static_cast<std::size_t>(w) * node) / 64 + 1;
    if ((n * n * n * n * (degree + 1.0) + 8 * (n + 1) * degree * degree) * words <= 1 << 30) return;
    throw TooMuchWork("the characteristic polynomial of " + std::to_string(set.size()) + " rows that depend on each other over " +
                      std::to_string(w) + " sectors is beyond the bound of work");
  }
  std::vector<bool> reach(std::size_t from, bool backwards) const {
    std::vector<bool> seen(n_);
    std::vector<std::size_t> stack{from};
    while (!stack.empty()) {
      const std::size_t a = stack.back();
      stack.pop_back();
      for (std::size_t b = 0; b < n_; ++b) {
        if (seen[b] || (backwards ? entries_[b * n_ + a] : entries_[a * n_ + b]).empty()) continue;
        seen[b] = true;
        stack.push_back(b);
      }
    }
    return seen;
  }
  // Newton's interpolation in c through z = 2, 3, ...
  std::vector<Poly> determinant(const std::vector<std::size_t>& set) {
    const int degree = widest(set) * static_cast<int>(set.size());
    std::vector<mpq_class> nodes;
    std::vector<Poly> table;  // divided differences, by node; one entry per power of X
    for (int i = 0; i <= degree; ++i) {
      const mpq_class z(i + 2);
      nodes.push_back((z + 1 / z) / 2);
      table.push_back(at(set, z));
      // Two Laurent polynomials that agree in so many places are the same.
      if (given_ && degree > 0 && at(set, 1 / z) != table.back()) symmetric_ = false;
    }
    for (std::size_t order = 1; order < nodes.size(); ++order) {
      for (std::size_t i = nodes.size(); i-- > order;) {
        for (std::size_t x = 0; x <= set.size(); ++x) table[i][x] = (table[i][x] - table[i - 1][x]) / (nodes[i] - nodes[i - order]);
      }
    }
    std::vector<Poly> out(set.size() + 1);
    for (std::size_t x = 0; x <= set.size(); ++x) {
      for (std::size_t i = nodes.size(); i-- > 0;) {
        Poly next(out[x].size() + 1);
        for (std::size_t j = 0; j < out[x].size(); ++j) next[j + 1] += out[x][j], next[j] -= nodes[i] * out[x][j];
        next[0] += table[i][x];
        trim(next);
        out[x] = std::move(next);
      }
    }
    return out;
  }
  // Leverrier's traces: p_j = tr M^j and Newton's identities, over integers.
  Poly at(const std::vector<std::size_t>& set, const mpq_class& z) const {
    const std::size_t n = set.size();
    std::vector<mpq_class> m(n * n);
    mpz_class scale = 1;
    for (std::size_t r = 0; r < n; ++r) {
      for (std::size_t c = 0; c < n; ++c) {
        for (const auto& [exponent, w] : entries_[set[r] * n_ + set[c]]) {
          mpq_class power = 1;
          for (int e = std::abs(exponent); e > 0; --e) power *= z;
          if (exponent < 0) m[r * n + c] += w / power;
          else m[r * n + c] += w * power;
        }
        mpz_lcm(scale.get_mpz_t(), scale.get_mpz_t(), m[r * n + c].get_den_mpz_t());
      }
    }
    std::vector<mpz_class> a(n * n), power;
    for (std::size_t i = 0; i < n * n; ++i) a[i] = m[i].get_num() * (scale / m[i].get_den());
    power = a;
    std::vector<mpz_class> trace(n + 1), e(n + 1);
    e[0] = 1;
    for (std::size_t j = 1; j <= n; ++j) {
      for (std::size_t r = 0; r < n; ++r) trace[j] += power[r * n + r];
      for (std::size_t i = 1; i <= j; ++i) e[j] += (i % 2 == 1 ? 1 : -1) * e[j - i] * trace[i];
      e[j] /= static_cast<int>(j);
      std::vector<mpz_class> next(n * n);
      for (std::size_t r = 0; r < n && j < n; ++r) {
        for (std::size_t i = 0; i < n; ++i) {
          for (std::size_t c = 0; c < n; ++c) next[r * n + c] += power[r * n + i] * a[i * n + c];
        }
      }
      power = std::move(next);
    }
    Poly p(n + 1);
    mpq_class over = 1;
    for (std::size_t j = 0; j <= n; ++j, over /= scale) p[n - j] = (j % 2 == 0 ? 1 : -1) * over * e[j];
    return p;
  }
  std::size_t n_ = 0;
  bool given_, symmetric_ = true;
  std::vector<Waves> entries_;
  std::vector<std::vector<Poly>> blocks_;
};

// ---- eigenvalues -------------------------------------------------------------------------------------------------

mpq_class half_power(unsigned n) {
  mpq_class x = 1;
  mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), n);
  return x;
}

// Whether a fraction is longer than the ends of cosines may be: the recursion below multiplies their length by k.
bool too_long(const mpq_class& x) {
  constexpr std::size_t kBits = 1024;
  return mpz_sizeinbase(x.get_num_mpz_t(), 2) > kBits || mpz_sizeinbase(x.get_den_mpz_t(), 2) > kBits;
}

// Sturm: U_0, ..., U_{k-1} at x change sign as often as U_{k-1} has zeros cos(j pi/k) above x. Of these j = 2 is wanted.
// At x = p/q the integers q^j U_j have the same signs.
std::string cosine_fault(const ListedRow& row) {
  if (too_long(row.cosine_lo) || too_long(row.cosine_hi)) return "an end of the cosine interval has more than 1024 bits";
  if (row.cosine_hi <= row.cosine_lo || row.cosine_hi - row.cosine_lo > half_power(200)) return "the cosine interval is wider than 2^-200";
  const auto zeros_above = [&](const mpq_class& x) {
    const mpz_class twice = 2 * x.get_num(), square = x.get_den() * x.get_den();
    mpz_class u0 = 0, u1 = 1;
    int changes = 0, last = 1;
    for (int j = 1; j < row.k; ++j) {
      mpz_class u2 = twice * u1 - square * u0;
      u0 = std::move(u1), u1 = std::move(u2);
      if (sgn(u1) == -last) ++changes, last = -last;
    }
    return u1 == 0 ? -1 : changes;
  };
  return zeros_above(row.cosine_lo) == 2 && zeros_above(row.cosine_hi) == 1 ? "" : "the interval does not contain cos(2 pi/k)";
}

// cos of `angle`/k of a turn, where it is rational.
bool rational_cosine(int angle, int k, mpq_class& c) {
  const int turn = k / std::gcd(angle, k);
  if (turn != 1 && turn != 2 && turn != 3 && turn != 4 && turn != 6) return false;
  c = turn == 1 ? mpq_class(1) : turn == 2 ? mpq_class(-1) : turn == 3 ? mpq_class(-1, 2) : turn == 4 ? mpq_class(0) : mpq_class(1, 2);
  return true;
}

mpq_class greater(const mpq_class& a, const mpq_class& b) { return abs(a) < abs(b) ? b : a; }
Ball greater(const Ball& a, const Ball& b) { return abs(a.m) < abs(b.m) ? b : a; }
int sign_of(const mpq_class& x) { return sgn(x); }
int sign_of(const Ball& x) { return x.sign(); }
mpq_class near(const mpq_class& x) { return x; }
Ball near(const Ball& x) { return make_ball(x.m, 0); }

// How many roots have |z| < r, with multiplicities; -1 when that is not certain. On |z| = 1 a polynomial p is as great
// as its reverse q. If |p_n| > |p_0|, p_n p - p_0 q has by Rouche as many roots inside, one of them 0; if |p_0| > |p_n|,
// p_0 p - p_n q has, and its degree is less. A root on the circle stays there until nothing is certain.
template <class Coefficient>
int roots_within(std::vector<Coefficient> p, const mpq_class& r) {
  // Of p(rz), scaled: small roots in a small disc must not vanish behind the last bit of a ball.
  mpq_class power = 1;
  for (std::size_t i = p.size(); i-- > 0; power /= r) p[i] = p[i] * Coefficient(power);
  const Coefficient end = near(greater(p.front(), p.back()));
  if (sign_of(end) == 0) return -1;
  for (Coefficient& a : p) a = a / end;
  int inside = 0;
  while (p.size() > 1) {
    const std::size_t n = p.size() - 1;
    const int order = sign_of(Coefficient(p[n] * p[n] - p[0] * p[0]));
    if (order == 0) return -1;
    std::vector<Coefficient> next(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (order > 0) next[i] = p[n] * p[i + 1] - p[0] * p[n - 1 - i];
      else next[i] = p[0] * p[i] - p[n] * p[n - i];
    }
    if (order > 0) ++inside;
    const Coefficient size = near(next[order > 0 ? n - 1 : 0]);
    for (Coefficient& a : next) a = a / size;
    p = std::move(next);
  }
  return sign_of(p[0]) == 0 ? -1 : inside;
}

class ModeProof {
 public:
  explicit ModeProof(const ListedMode& mode) : mode_(mode), listed_(mode.values), found_(listed_.size()), source_(listed_.size()) {}

  std::string list_fault(std::size_t n) const {
    std::size_t sum = static_cast<std::size_t>(mode_.rest);
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (listed_[i].hi < listed_[i].lo || listed_[i].hi - listed_[i].lo > half_power(100)) return "an interval is wider than 2^-100";
      if (i > 0 && listed_[i].hi >= listed_[i - 1].lo) return "the intervals do not decrease";
      sum += static_cast<std::size_t>(listed_[i].multiplicity);
    }
    return sum == n ? "" : "there are " + std::to_string(n) + " eigenvalues";
  }
  // A polynomial with rational coefficients.
  std::string block_fault(Poly p) {
    ++blocks_;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      while (exact(i) && p.size() > 1 && value(p, listed_[i].lo) == 0) p = divide(p, {-listed_[i].lo, 1}).first, ++found_[i];
    }
    Tally tally;
    for (const Poly& layer : layers(p)) count([&](const mpq_class& x) { return sgn(value(layer, x)); }, tally);
    return rest_fault(p, tally);
  }
  // A polynomial whose coefficients are polynomials in c, which lies in a ball.
  std::string block_fault(const std::vector<Poly>& p, const Ball& c) {
    ++blocks_;
    std::vector<Ball> q;
    for (const Poly& a : p) {
      Ball v;
      for (std::size_t i = a.size(); i-- > 0;) v = v * c + Ball(a[i]);
      q.push_back(v);
    }
    Tally tally;
    const auto sign = [&](const mpq_class& x) {
      Ball v;
      const Ball at(x);
      for (std::size_t i = q.size(); i-- > 0;) v = v * at + q[i];
      return v.sign();
    };
    count(sign, tally);
    return rest_fault(q, tally);
  }
  std::string multiplicity_fault() const {
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (source_[i] < 0) return "eigenvalue " + std::to_string(i) + " is found in two factors: these may be different numbers";
      if (found_[i] != listed_[i].multiplicity) return "eigenvalue " + std::to_string(i) + " has multiplicity " + std::to_string(found_[i]);
    }
    return {};
  }

 private:
  bool exact(std::size_t i) const { return listed_[i].lo == listed_[i].hi; }
  // Changes of sign in the intervals: all, those in intervals outside the disc, and whether one is on its circle.
  struct Tally {
    std::size_t changes = 0, outside = 0;
    bool on_circle = false;
  };
  template <class Sign>
  void count(const Sign& sign, Tally& tally) {
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const ListedValue& v = listed_[i];
      if (exact(i) || sign(v.lo) * sign(v.hi) >= 0) continue;
      ++tally.changes, ++found_[i];
      source_[i] = source_[i] == 0 || source_[i] == blocks_ ? blocks_ : -1;
      const bool out = v.lo > mode_.radius || v.hi < -mode_.radius, in = v.hi < mode_.radius && v.lo > -mode_.radius;
      if (out) ++tally.outside;
      else if (!in) tally.on_circle = true;
    }
  }
  // The roots that are in no interval are in the disc: it holds all roots but those of intervals outside.
  template <class Coefficient>
  std::string rest_fault(const std::vector<Coefficient>& p, const Tally& tally) {
    const std::size_t degree = p.size() - 1;
    if (tally.changes == degree) return {};
    if (tally.changes > degree || mode_.rest == 0) return "a root is in none of the intervals";
    if (mode_.radius <= 0 || tally.on_circle) return "the disc proves nothing";
    const int inside = roots_within(p, mode_.radius);
    return inside >= 0 && static_cast<std::size_t>(inside) + tally.outside == degree ? "" : "a root is in none of the intervals, nor surely in the disc";
  }
  const ListedMode& mode_;
  const std::vector<ListedValue>& listed_;
  std::vector<int> found_;
  std::vector<int> source_;  // the polynomial that changes sign in an interval, from 1 on; -1: more than one
  int blocks_ = 0;
};

// Splits off the factor that does not depend on c: the common divisor of the coefficients of all powers of c.
std::pair<Poly, std::vector<Poly>> split(const std::vector<Poly>& p) {
  std::size_t powers = 0;
  for (const Poly& a : p) powers = std::max(powers, a.size());
  std::vector<Poly> by_power(powers);
  Poly common;
  for (std::size_t j = 0; j < powers; ++j) {
    for (const Poly& a : p) by_power[j].push_back(j < a.size() ? a[j] : mpq_class(0));
    trim(by_power[j]);
    common = gcd_of(by_power[j], common);
  }
  std::vector<Poly> rest(p.size() - common.size() + 1, Poly(powers));
  for (std::size_t j = 0; j < powers; ++j) {
    const Poly quotient = divide(by_power[j], common).first;
    for (std::size_t i = 0; i < quotient.size(); ++i) rest[i][j] = quotient[i];
  }
  for (Poly& a : rest) trim(a);
  return {common, rest};
}

std::string mode_fault(const ListedRow& row, int mode, const std::vector<ComplexBall>& turns, const ModePolynomials& all) {
  if (!all.symmetric()) return "the weights have no mirror image";
  ModeProof proof(row.modes[static_cast<std::size_t>(mode)]);
  if (std::string f = proof.list_fault(all.n()); !f.empty()) return f;
  const int angle = mode == 0 ? 1 : mode;
  mpq_class c = 0;
  const bool rational = rational_cosine(angle, row.k, c);
  for (const std::vector<Poly>& block : all.blocks()) {
    const auto [common, rest] = split(block);
    std::string fault = proof.block_fault(common);
    if (fault.empty() && rest.size() > 1) {
      Poly p;
      for (const Poly& a : rest) p.push_back(value(a, c));
      fault = rational ? proof.block_fault(p) : proof.block_fault(rest, turns[static_cast<std::size_t>(angle)].x);
    }
    if (!fault.empty()) return fault;
  }
  return proof.multiplicity_fault();
}

}  // namespace

std::vector<ComplexBall> turns(const ListedRow& row) {
  const Ball c(row.cosine_lo, row.cosine_hi), s = root(Ball(mpq_class(1)) - c * c);
  std::vector<ComplexBall> out{{Ball(mpq_class(1)), Ball()}};
  while (out.size() < static_cast<std::size_t>(row.k)) out.push_back(out.back() * ComplexBall{c, s});
  return out;
}

ComplexBall at_turn(const Waves& w, const std::vector<ComplexBall>& turns, int mode) {
  ComplexBall sum;
  const int k = static_cast<int>(turns.size());
  for (const auto& [exponent, x] : w) sum = sum + turns[static_cast<std::size_t>((exponent * mode % k + k) % k)] * Ball(x);
  return sum;
}

std::string spectrum_fault(Scheme scheme, const ListedRow& row) {
  if (std::string f = cosine_fault(row); !f.empty()) return f;
  if (std::string f = mask_fault(scheme, row); !f.empty()) return f;
  const std::vector<ComplexBall> all_turns = turns(row);
  const bool given = scheme == Scheme::blocks;
  const ModePolynomials zero(ModeRule(scheme, row, 0), given), one(ModeRule(scheme, row, 1), given);
  // The other modes have the rule of mode 1, with another z; Doo and Sabin's own has another number in the k-gon.
  const ModePolynomials two = scheme == Scheme::doo_sabin ? ModePolynomials(ModeRule(scheme, row, 2), given) : one;
  for (int m = 0; 2 * m <= row.k; ++m) {
    const std::string f = mode_fault(row, m, all_turns, m == 0 ? zero : m == 1 ? one : two);
    if (!f.empty()) return "mode " + std::to_string(m) + ": " + f;
  }
  return {};
}

}  // namespace check
