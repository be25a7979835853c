// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/mass_growth.hpp"

#include "hexact/kernel/errors.hpp"
#include "nonnegative_cover.hpp"
#include "polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace hexact {
namespace {

using Vector = std::vector<Rational>;

constexpr int kVertexBits = 128, kBoundBits = 112;
constexpr std::size_t kLongestWord = 4, kMostVertices = 64;

Vector times(const RationalMatrix& m, const Vector& x) {
  Vector y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) y[i] += m[i * x.size() + j] * x[j];
  }
  return y;
}

RationalMatrix product(const std::array<RationalMatrix, 2>& t, const std::vector<int>& word, std::size_t n) {
  RationalMatrix p(n * n);
  for (std::size_t i = 0; i < n; ++i) p[i * n + i] = Rational(1);
  for (const int digit : word) {
    RationalMatrix next(n * n);
    const RationalMatrix& m = t[static_cast<std::size_t>(digit)];
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t j = 0; j < n; ++j) next[i * n + j] += p[i * n + k] * m[k * n + j];
      }
    }
    p = std::move(next);
  }
  return p;
}

Integer rounded_up(const Rational& x) { return ceil_quotient(x.numerator(), x.denominator()); }
Vector numbers(const std::vector<Integer>& entries) { return {entries.begin(), entries.end()}; }

/// T_digit v / high.
Vector image(const std::array<RationalMatrix, 2>& t, const MassGrowth& growth, std::size_t vertex, int digit) {
  Vector y = times(t[static_cast<std::size_t>(digit)], numbers(growth.vertices[vertex].entries));
  for (Rational& x : y) x /= growth.bounds.hi;
  return y;
}

Rational power(const Rational& x, std::size_t n) {
  Rational p(1);
  for (std::size_t i = 0; i < n; ++i) p *= x;
  return p;
}

// ---- finding -----------------------------------------------------------------------------------------------------

/// The leading eigenvector by power iteration, of sum 2^kVertexBits, rounded to integers; positive if the matrix is primitive.
std::vector<Integer> leading_vector(const RationalMatrix& m, std::size_t n) {
  Vector x(n, Rational(1));
  for (int i = 0; i < 120; ++i) {
    Vector y = times(m, x);
    Rational sum;
    for (const Rational& e : y) sum += e;
    for (std::size_t j = 0; j < n; ++j) x[j] = rounded_up((y[j] / sum).scaled(kVertexBits));
  }
  std::vector<Integer> entries;
  for (const Rational& e : x) entries.push_back(e.numerator());
  return entries;
}

/// An estimate of the spectral radius per factor, to choose a word by.
double estimated_growth(const RationalMatrix& m, std::size_t n, std::size_t length) {
  std::vector<double> a, x(n, 1.0);
  for (const Rational& e : m) a.push_back(e.to_double());
  double growth = 0;
  for (int step = 0; step < 100; ++step) {
    std::vector<double> y(n, 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) y[i] += a[i * n + j] * x[j];
      sum += y[i];
    }
    growth = 0;
    for (std::size_t i = 0; i < n; ++i) growth += y[i];
    for (std::size_t i = 0; i < n; ++i) x[i] = y[i] / sum;
  }
  return std::pow(growth, 1.0 / static_cast<double>(length));
}

std::vector<int> best_word(const std::array<RationalMatrix, 2>& t, std::size_t n) {
  std::vector<int> best;
  double most = 0;
  for (std::size_t length = 1; length <= kLongestWord; ++length) {
    for (unsigned bits = 0; bits < 1U << length; ++bits) {
      std::vector<int> word;
      for (std::size_t i = length; i-- > 0;) word.push_back(static_cast<int>(bits >> i & 1U));
      const double growth = estimated_growth(product(t, word, n), n, length);
      if (growth > most * (1 + 1e-9)) most = growth, best = word;  // the shortest, and of these the first
    }
  }
  return best;
}

/// Numbers a little below and above the root of degree `length` of the spectral radius of a product with the
/// approximate eigenvector x: the radius lies between the least and the greatest quotient of entries (Collatz).
RationalInterval radius_bounds(const RationalMatrix& m, const Vector& x, std::size_t length) {
  const Vector y = times(m, x);
  Rational least = y[0] / x[0], greatest = least;
  for (std::size_t i = 1; i < x.size(); ++i) {
    least = std::min(least, y[i] / x[i]);
    greatest = std::max(greatest, y[i] / x[i]);
  }
  if (greatest - least > least.scaled(-kBoundBits)) throw NumericalFailure("the leading eigenvector of the product that grows most is not isolated enough");
  Integer low(0), high = Integer::power_of_two(kBoundBits);  // in units of 2^−kBoundBits
  while (high - low > Integer(1)) {
    const Integer middle = floor_quotient(low + high, Integer(2));
    (power(Rational(middle).scaled(-kBoundBits), length) < least ? low : high) = middle;
  }
  // Room for what the quotients differ by, and for the rounding of the vertices, which would otherwise push images of a
  // cycle out.
  return {Rational(low).scaled(-kBoundBits), Rational(high + Integer::power_of_two(8)).scaled(-kBoundBits)};
}

/// Weights of a cover with short numbers: rounded up, and the rest of 1 on the greatest. Precondition: their sum is at most 1.
std::vector<std::pair<std::size_t, Rational>> convex_weights(const std::vector<Rational>& cover) {
  for (int bits = 16;; bits *= 2) {
    std::vector<std::pair<std::size_t, Rational>> out;
    Rational rest(1);
    for (std::size_t i = 0; i < cover.size(); ++i) {
      if (cover[i].is_zero()) continue;
      out.emplace_back(i, Rational(rounded_up(cover[i].scaled(bits))).scaled(-bits));
      rest -= out.back().second;
    }
    if (rest.sign() < 0) continue;
    std::max_element(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->second += rest;
    return out;
  }
}

/// One vertex that is nowhere smaller than y, or a least cover.
std::vector<std::pair<std::size_t, Rational>> combination(const Vector& y, const std::vector<Vector>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::equal(y.begin(), y.end(), points[i].begin(), [](const Rational& a, const Rational& b) { return a <= b; })) return {{i, Rational(1)}};
  }
  return convex_weights(least_cover(y, points)->weights);
}

/// Adds the images that are not inside, and those of the new vertices.
void close_polytope(const std::array<RationalMatrix, 2>& t, MassGrowth& growth) {
  std::vector<Vector> points{numbers(growth.vertices[0].entries)};
  for (std::size_t v = 0; v < growth.vertices.size(); ++v) {
    for (const int digit : {0, 1}) {
      const Vector y = image(t, growth, v, digit);
      const auto cover = least_cover(y, points);
      if (cover && cover->total <= Rational(1)) continue;
      if (growth.vertices.size() == kMostVertices) throw NumericalFailure("the polytope of the joint spectral radius does not close");
      MassGrowth::Vertex vertex{v, digit, {}};
      for (const Rational& x : y) vertex.entries.push_back(rounded_up(x));
      points.push_back(numbers(vertex.entries));
      growth.vertices.push_back(std::move(vertex));
    }
  }
}

bool is_vertex(const MassGrowth& growth, std::size_t v, int digit) {
  return std::any_of(growth.vertices.begin() + 1, growth.vertices.end(), [&](const auto& w) { return w.parent == v && w.digit == digit; });
}

// ---- checking ----------------------------------------------------------------------------------------------------

std::string name(std::size_t v, int digit) { return "the image of vertex " + std::to_string(v) + " by T" + std::to_string(digit); }

std::string bounds_fault(const std::array<RationalMatrix, 2>& t, const MassGrowth& growth, std::size_t n) {
  const auto& [low, high] = growth.bounds;
  if (low.sign() <= 0 || high <= low) return "the bounds of the growth are not positive and increasing";
  if (high - low > low.scaled(-64)) return "the bounds of the growth are not close";
  const auto is_digit = [](int d) { return d == 0 || d == 1; };
  if (growth.word.empty() || growth.word.size() > kLongestWord || !std::all_of(growth.word.begin(), growth.word.end(), is_digit)) {
    return "the word is not one of 1 to 4 binary digits";
  }
  const Polynomial p = characteristic_polynomial(product(t, growth.word, n), n);
  if (value(p, power(low, growth.word.size())).sign() >= 0) return "the characteristic polynomial of the product does not show the lower bound";
  return {};
}

std::string vertices_fault(const std::array<RationalMatrix, 2>& t, const MassGrowth& growth, std::size_t n) {
  const auto& vertices = growth.vertices;
  if (vertices.empty() || vertices.size() > kMostVertices) return "there are no vertices, or too many";
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const std::string at = "vertex " + std::to_string(v);
    if (vertices[v].entries.size() != n) return at + " has a wrong number of entries";
    if (v == 0) {
      const auto positive = [](const Integer& x) { return x.sign() > 0; };
      if (!std::all_of(vertices[0].entries.begin(), vertices[0].entries.end(), positive)) return "vertex 0 is not positive";
      continue;
    }
    if (vertices[v].parent >= v || (vertices[v].digit != 0 && vertices[v].digit != 1)) return at + " comes from no earlier one";
    const Vector y = image(t, growth, vertices[v].parent, vertices[v].digit);
    for (std::size_t i = 0; i < n; ++i) {
      if (rounded_up(y[i]) != vertices[v].entries[i]) return at + " is not its image rounded up";
    }
  }
  return {};
}

std::string image_fault(const std::array<RationalMatrix, 2>& t, const MassGrowth& growth, const MassGrowth::Image& entry, std::size_t n) {
  Rational sum;
  Vector cover(n);
  for (const auto& [v, weight] : entry.combination) {
    if (v >= growth.vertices.size() || weight.sign() <= 0) return name(entry.vertex, entry.digit) + " has no combination";
    sum += weight;
    const Vector x = numbers(growth.vertices[v].entries);
    for (std::size_t i = 0; i < n; ++i) cover[i] += weight * x[i];
  }
  if (sum != Rational(1)) return "the weights of " + name(entry.vertex, entry.digit) + " have the sum " + sum.str();
  const Vector y = image(t, growth, entry.vertex, entry.digit);
  for (std::size_t i = 0; i < n; ++i) {
    if (cover[i] < y[i]) return name(entry.vertex, entry.digit) + " is not covered in entry " + std::to_string(i);
  }
  return {};
}

}  // namespace

std::array<RationalMatrix, 2> digit_matrices(const StepLaw& law) {
  HEXACT_EXPECTS(law.size() % 2 == 1 && law.size() >= 3);
  const int reach = static_cast<int>(law.size()) / 2, n = 2 * reach;
  std::array<RationalMatrix, 2> t;
  for (int e = 0; e < 2; ++e) {
    for (int i = -reach; i < reach; ++i) {
      for (int l = -reach; l < reach; ++l) {
        const int at = 2 * i + e - l + reach;
        t[static_cast<std::size_t>(e)].push_back(at >= 0 && at <= n ? law[static_cast<std::size_t>(at)] : Rational());
      }
    }
  }
  return t;
}

MassGrowth find_mass_growth(const StepLaw& law) {
  const std::array<RationalMatrix, 2> t = digit_matrices(law);
  const std::size_t n = law.size() - 1;
  MassGrowth growth;
  growth.word = best_word(t, n);
  const RationalMatrix m = product(t, growth.word, n);
  growth.vertices.push_back({0, 0, leading_vector(m, n)});
  if (std::any_of(growth.vertices[0].entries.begin(), growth.vertices[0].entries.end(), [](const Integer& x) { return x.sign() <= 0; })) {
    throw NumericalFailure("the leading eigenvector of the product that grows most is not positive");
  }
  growth.bounds = radius_bounds(m, numbers(growth.vertices[0].entries), growth.word.size());
  close_polytope(t, growth);
  std::vector<Vector> points;
  for (const auto& v : growth.vertices) points.push_back(numbers(v.entries));
  for (std::size_t v = 0; v < growth.vertices.size(); ++v) {
    for (const int digit : {0, 1}) {
      if (is_vertex(growth, v, digit)) continue;
      growth.images.push_back({v, digit, combination(image(t, growth, v, digit), points)});
    }
  }
  const std::string fault = mass_growth_fault(law, growth);
  if (!fault.empty()) throw NumericalFailure("the joint spectral radius could not be bounded: " + fault);
  return growth;
}

std::string mass_growth_fault(const StepLaw& law, const MassGrowth& growth) {
  const auto positive = [](const Rational& q) { return q.sign() > 0; };
  Rational total;
  for (const Rational& q : law) total += q;
  if (law.size() % 2 == 0 || law.size() < 3 || !std::all_of(law.begin(), law.end(), positive) || total != Rational(1)) {
    return "the projected weights are not a positive law";
  }
  const std::array<RationalMatrix, 2> t = digit_matrices(law);
  const std::size_t n = law.size() - 1;
  if (std::string f = bounds_fault(t, growth, n); !f.empty()) return f;
  if (std::string f = vertices_fault(t, growth, n); !f.empty()) return f;
  auto next = growth.images.begin();
  for (std::size_t v = 0; v < growth.vertices.size(); ++v) {
    for (const int digit : {0, 1}) {
      if (is_vertex(growth, v, digit)) continue;
      if (next == growth.images.end() || next->vertex != v || next->digit != digit) return "there is no combination for " + name(v, digit);
      if (std::string f = image_fault(t, growth, *next++, n); !f.empty()) return f;
    }
  }
  return next == growth.images.end() ? "" : "there are combinations of no image";
}

}  // namespace hexact
