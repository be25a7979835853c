// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads certificates of spectra and proves that the listed eigenvalues are all eigenvalues, in this order.
#include "spectrum.hpp"

#include "certificate_text.hpp"
#include "exact_signs.hpp"
#include "sha256.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>

namespace check {
namespace {

using Poly = std::vector<mpq_class>;  // coefficients, constant first, the last not 0

// ---- text --------------------------------------------------------------------------------------------------------

class SpectrumReader {
 public:
  SpectrumReader(const std::string& bytes, const std::string& path) : in_(bytes, path) {}
  SpectrumFile read() {
    word("hexact-spectrum"), word("1"), word("scheme");
    const std::string name(in_.word());
    const std::vector<std::string> names{"midedge", "midedge6", "loop", "catmull-clark", "doo-sabin"};
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) in_.fail("there is no scheme " + name);
    SpectrumFile file;
    file.scheme = static_cast<Scheme>(found - names.begin());
    word("rows");
    for (std::int64_t n = in_.integer(0, 1000); n > 0; --n) {
      file.rows.push_back(row());
      for (std::size_t i = 0; i + 1 < file.rows.size(); ++i) {
        if (file.rows[i].k == file.rows.back().k) in_.fail("a second row of this valence");
      }
    }
    word("sha256"), (void)in_.word();
    if (!in_.word().empty()) in_.fail("bytes follow the digest");
    return file;
  }

 private:
  void word(const std::string& expected) {
    if (in_.word() != expected) in_.fail("expected " + expected);
  }
  mpq_class number() { return in_.number(in_.word(), false).a; }
  ListedRow row() {
    ListedRow r;
    word("row"), r.k = static_cast<int>(in_.integer(3, 1000));
    word("cosine"), r.cosine_lo = number(), r.cosine_hi = number();
    for (int m = 0; 2 * m <= r.k; ++m) {
      word("mode"), in_.integer(m, m);
      r.modes.emplace_back();
      for (std::int64_t n = in_.integer(0, 64); n > 0; --n) {
        const mpq_class lo = number(), hi = number();
        r.modes.back().push_back({lo, hi, static_cast<int>(in_.integer(1, 64))});
      }
    }
    word("ring"), r.level = static_cast<int>(in_.integer(0, 64));
    r.jacobian = number(), r.half_plane = number();
    return r;
  }
  Scanner in_;
};

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
  ModePolynomials(const ModeRule& rule) {
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
  const std::vector<std::vector<Poly>>& blocks() const { return blocks_; }

 private:
  // Vertices that depend on each other form a block; the determinant is the product over the blocks.
  void split() {
    std::vector<int> block(n_, -1);
    for (std::size_t r = 0; r < n_; ++r) {
      if (block[r] >= 0) continue;
      const std::vector<bool> needs = reach(r, false), used = reach(r, true);
      std::vector<std::size_t> set;
      for (std::size_t c = 0; c < n_; ++c) {
        if (c == r || (needs[c] && used[c])) set.push_back(c), block[c] = static_cast<int>(r);
      }
      blocks_.push_back(determinant(set));
    }
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
  std::vector<Poly> determinant(const std::vector<std::size_t>& set) const {
    int widest = 0;
    for (const std::size_t r : set) {
      for (const std::size_t c : set) {
        for (const auto& wave : entries_[r * n_ + c]) widest = std::max(widest, std::abs(wave.first));
      }
    }
    const int degree = widest * static_cast<int>(set.size());
    std::vector<mpq_class> nodes;
    std::vector<Poly> table;  // divided differences, by node; one entry per power of X
    for (int i = 0; i <= degree; ++i) {
      const mpq_class z(i + 2);
      nodes.push_back((z + 1 / z) / 2);
      table.push_back(at(set, z));
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
  std::vector<Waves> entries_;
  std::vector<std::vector<Poly>> blocks_;
};

// ---- eigenvalues -------------------------------------------------------------------------------------------------

mpq_class half_power(unsigned n) {
  mpq_class x = 1;
  mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), n);
  return x;
}

// Sturm: U_0, ..., U_{k-1} at x change sign as often as U_{k-1} has zeros cos(j pi/k) above x. Of these j = 2 is wanted.
std::string cosine_fault(const ListedRow& row) {
  if (row.cosine_hi <= row.cosine_lo || row.cosine_hi - row.cosine_lo > half_power(200)) return "the cosine interval is wider than 2^-200";
  const auto zeros_above = [&](const mpq_class& x) {
    mpq_class u0 = 0, u1 = 1;
    int changes = 0, last = 1;
    for (int j = 1; j < row.k; ++j) {
      const mpq_class u2 = 2 * x * u1 - u0;
      u0 = u1, u1 = u2;
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

class ModeProof {
 public:
  explicit ModeProof(const std::vector<ListedValue>& listed) : listed_(listed), found_(listed.size()) {}

  std::string list_fault(std::size_t n) const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (listed_[i].hi < listed_[i].lo || listed_[i].hi - listed_[i].lo > half_power(100)) return "an interval is wider than 2^-100";
      if (i > 0 && listed_[i].hi >= listed_[i - 1].lo) return "the intervals do not decrease";
      sum += static_cast<std::size_t>(listed_[i].multiplicity);
    }
    return sum == n ? "" : "there are " + std::to_string(n) + " eigenvalues";
  }
  // A block whose polynomial has rational coefficients.
  std::string block_fault(Poly p) {
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      while (exact(i) && p.size() > 1 && value(p, listed_[i].lo) == 0) p = divide(p, {-listed_[i].lo, 1}).first, ++found_[i];
    }
    for (const Poly& layer : layers(p)) {
      if (!count(layer.size() - 1, [&](const mpq_class& x) { return sgn(value(layer, x)); })) return "a root is in none of the intervals";
    }
    return {};
  }
  // A block whose coefficients are polynomials in c, which lies in a ball.
  std::string block_fault(std::vector<Poly> p, const Ball& c) {
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      while (exact(i) && p.size() > 1 && divided(p, listed_[i].lo)) ++found_[i];
    }
    std::vector<Ball> q;
    for (const Poly& a : p) {
      Ball v;
      for (std::size_t i = a.size(); i-- > 0;) v = v * c + Ball(a[i]);
      q.push_back(v);
    }
    const auto sign = [&](const mpq_class& x) {
      Ball v;
      const Ball at(x);
      for (std::size_t i = q.size(); i-- > 0;) v = v * at + q[i];
      return v.sign();
    };
    return count(q.size() - 1, sign) ? "" : "a root is in none of the intervals";
  }
  std::string multiplicity_fault() const {
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (found_[i] != listed_[i].multiplicity) return "eigenvalue " + std::to_string(i) + " has multiplicity " + std::to_string(found_[i]);
    }
    return {};
  }

 private:
  bool exact(std::size_t i) const { return listed_[i].lo == listed_[i].hi; }
  // Divides by X - r if that leaves no rest, whatever c is.
  static bool divided(std::vector<Poly>& p, const mpq_class& r) {
    std::vector<Poly> quotient(p.size() - 1);
    Poly carry;
    for (std::size_t i = p.size(); i-- > 0;) {
      for (mpq_class& x : carry) x *= r;
      carry.resize(std::max(carry.size(), p[i].size()));
      for (std::size_t j = 0; j < p[i].size(); ++j) carry[j] += p[i][j];
      if (i > 0) quotient[i - 1] = carry;
    }
    trim(carry);
    if (!carry.empty()) return false;
    for (Poly& a : quotient) trim(a);
    p = std::move(quotient);
    return true;
  }
  template <class Sign>
  bool count(std::size_t degree, const Sign& sign) {
    std::size_t changes = 0;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (!exact(i) && sign(listed_[i].lo) * sign(listed_[i].hi) < 0) ++changes, ++found_[i];
    }
    return changes == degree;
  }
  const std::vector<ListedValue>& listed_;
  std::vector<int> found_;
};

std::string mode_fault(const ListedRow& row, int mode, const std::vector<ComplexBall>& turns, const ModePolynomials& all) {
  ModeProof proof(row.modes[static_cast<std::size_t>(mode)]);
  if (std::string f = proof.list_fault(all.n()); !f.empty()) return f;
  const int angle = mode == 0 ? 1 : mode;
  mpq_class c = 0;
  const bool rational = rational_cosine(angle, row.k, c);
  for (const std::vector<Poly>& block : all.blocks()) {
    const bool constant = std::all_of(block.begin(), block.end(), [](const Poly& p) { return p.size() <= 1; });
    std::string fault;
    if (rational || constant) {
      Poly p;
      for (const Poly& a : block) p.push_back(value(a, c));
      fault = proof.block_fault(p);
    } else {
      fault = proof.block_fault(block, turns[static_cast<std::size_t>(angle)].x);
    }
    if (!fault.empty()) return fault;
  }
  return proof.multiplicity_fault();
}

// 1 once, then one of multiplicity two in all modes, and all others smaller in modulus.
std::string order_fault(const ListedRow& row, const ListedValue*& second, int& second_mode) {
  struct Entry {
    const ListedValue* value;
    int mode, multiplicity;
  };
  std::vector<Entry> entries;
  for (std::size_t m = 0; m < row.modes.size(); ++m) {
    const int copies = m == 0 || 2 * m == static_cast<std::size_t>(row.k) ? 1 : 2;
    for (const ListedValue& v : row.modes[m]) {
      const auto same = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return v.lo == v.hi && e.value->lo == v.lo && e.value->hi == v.hi; });
      if (same != entries.end()) same->multiplicity += copies * v.multiplicity;
      else entries.push_back({&v, static_cast<int>(m), copies * v.multiplicity});
    }
  }
  const auto one = std::find_if(entries.begin(), entries.end(), [](const Entry& e) { return e.value->lo == 1 && e.value->hi == 1; });
  if (one == entries.end() || one->multiplicity != 1) return "1 is no simple eigenvalue";
  entries.erase(one);
  if (entries.empty()) return "there is no second eigenvalue";
  const auto top = std::max_element(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.value->lo < b.value->lo; });
  second = top->value, second_mode = top->mode;
  if (second->lo <= 0 || second->hi >= 1) return "the second eigenvalue is not between 0 and 1";
  if (top->multiplicity != 2) return "the second eigenvalue has multiplicity " + std::to_string(top->multiplicity);
  for (const Entry& e : entries) {
    if (e.value != second && !(e.value->hi < second->lo && -e.value->lo < second->lo)) return "the third eigenvalue is not smaller than the second";
  }
  return {};
}

std::string spectrum_fault(Scheme scheme, const ListedRow& row, const std::vector<ComplexBall>& all_turns) {
  const ModePolynomials zero(ModeRule(scheme, row.k, 0)), one(ModeRule(scheme, row.k, 1));
  // The other modes have the rule of mode 1, with another z; Doo and Sabin's has another number in the k-gon.
  const ModePolynomials two = scheme == Scheme::doo_sabin ? ModePolynomials(ModeRule(scheme, row.k, 2)) : one;
  for (int m = 0; 2 * m <= row.k; ++m) {
    const std::string f = mode_fault(row, m, all_turns, m == 0 ? zero : m == 1 ? one : two);
    if (!f.empty()) return "mode " + std::to_string(m) + ": " + f;
  }
  return {};
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

bool is_spectrum_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string first(15, '\0');
  in.read(first.data(), 15);
  return first == "hexact-spectrum";
}

SpectrumFile read_spectrum(const std::string& path) {
  const std::string bytes = read_file(path);
  SpectrumFile file = SpectrumReader(bytes, path).read();
  const std::size_t last = bytes.rfind("\nsha256 ");
  const std::string expected = sha256(std::string_view(bytes).substr(0, last + 1));
  if (last == std::string::npos || bytes.compare(last + 8, 64, expected) != 0 || bytes.find_first_not_of(" \t\r\n", last + 72) != std::string::npos) {
    throw Malformed(path, 0, "the digest does not match the bytes before it, which have " + expected);
  }
  return file;
}

std::vector<std::pair<std::string, std::string>> spectrum_faults(const SpectrumFile& file) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const ListedRow& row : file.rows) {
    const std::string k = std::to_string(row.k);
    std::string order = cosine_fault(row), ring = "rests on the ordering";
    const ListedValue* second = nullptr;
    int second_mode = 0;
    if (order.empty()) order = spectrum_fault(file.scheme, row, turns(row));
    if (order.empty()) order = order_fault(row, second, second_mode);
    if (order.empty()) ring = second_mode != 1 ? "the second eigenvalue is not of mode 1" : ring_fault(file.scheme, row, *second);
    out.emplace_back("ordering=" + k, order);
    out.emplace_back("ring=" + k, ring);
    out.emplace_back("c1=" + k, order.empty() ? ring : order);
  }
  return out;
}

}  // namespace check
