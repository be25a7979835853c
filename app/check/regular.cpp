// SPDX-License-Identifier: LGPL-3.0-or-later
// Proves from a rule's weights, and the numbers of a certificate, how smooth limits are where the mesh is regular.
#include "regular.hpp"

#include "spectrum.hpp"

#include <algorithm>
#include <map>

namespace check {
namespace {

using Place = std::pair<int, int>;
using Weights = std::map<Place, mpq_class>;  // weights, none of them 0
using Line = std::map<int, mpq_class>;    // the same on a line
using Vector = std::vector<mpq_class>;
using Matrix = std::vector<Vector>;       // rows

template <class Key>
void add(std::map<Key, mpq_class>& to, const Key& at, const mpq_class& weight) {
  mpq_class& x = to[at];
  x += weight;
  if (x == 0) to.erase(at);
}

// ---- the symbol --------------------------------------------------------------------------------------------------

// Of a fine vertex f far from the centre, by f - 2c: the weights of the coarse vertices c. One of each parity.
Weights dyadic_mask(Scheme scheme) {
  ListedRow row;
  row.k = scheme == Scheme::loop ? 6 : 4;
  const ModeRule rule(scheme, row, 1);
  Weights mask;
  for (const int i : {16, 17}) {
    for (const int j : {16, 17}) {
      for (const auto& [c, waves] : rule.fine(i, j)) add(mask, {i - 2 * c.first, j - 2 * c.second}, waves.at(0));
    }
  }
  return mask;
}

struct Box {
  int left, right, low, high;
  bool holds(const Place& p) const { return left <= p.first && p.first <= right && low <= p.second && p.second <= high; }
};

// Precondition: there are weights.
Box box_of(const Weights& mask) {
  const Place first = mask.begin()->first;
  Box box{first.first, first.first, first.second, first.second};
  for (const auto& [at, weight] : mask) {
    box.left = std::min(box.left, at.first), box.right = std::max(box.right, at.first);
    box.low = std::min(box.low, at.second), box.high = std::max(box.high, at.second);
  }
  return box;
}

// Divides by (1 + z^d)/2. In the order of pairs d is positive, so the first term that is left is one of the quotient;
// this and what it makes lie within the box of the mask if there is a quotient.
bool divide(Weights& mask, const Place& d) {
  const Box box = box_of(mask);
  Weights quotient;
  while (!mask.empty()) {
    const auto [at, weight] = *mask.begin();
    const Place next{at.first + d.first, at.second + d.second};
    if (!box.holds(next)) return false;
    add(quotient, at, mpq_class(2 * weight));
    add(mask, at, mpq_class(-weight));
    add(mask, next, mpq_class(-weight));
  }
  mask = std::move(quotient);
  return true;
}

// Moves the middle of the box to 0.
Weights centred(const Weights& mask) {
  const Box box = box_of(mask);
  Weights out;
  for (const auto& [at, weight] : mask) out[{at.first - (box.left + box.right) / 2, at.second - (box.low + box.high) / 2}] = weight;
  return out;
}

// The most directions that are parallel to each other.
int most_parallel(const std::vector<Place>& directions) {
  std::map<Place, int> count;  // the four directions that are accepted are not parallel to each other
  int most = 0;
  for (const Place& d : directions) most = std::max(most, ++count[d]);
  return most;
}

// Every direction is one of four, in this order.
bool in_order(const std::vector<Place>& directions) {
  const std::vector<Place> known{{1, 0}, {0, 1}, {1, 1}, {1, -1}};
  auto from = known.begin();
  return std::all_of(directions.begin(), directions.end(), [&](const Place& d) {
    from = std::find(from, known.end(), d);
    return from != known.end();
  });
}

// One step's points stay together when the axes e1, e2 are among the directions and the others are neither all parallel
// to e1 nor all to e2.
bool converges(const std::vector<Place>& directions) {
  const auto count = [&](auto&& wanted) { return std::count_if(directions.begin(), directions.end(), wanted); };
  const auto level = count([](const Place& d) { return d.second == 0; }), upright = count([](const Place& d) { return d.first == 0; });
  const auto all = static_cast<std::ptrdiff_t>(directions.size());
  return level > 0 && upright > 0 && all - level > 1 && all - upright > 1;
}

// ---- what smoothing does along a line ----------------------------------------------------------------------------

Line seen(const Weights& mask, int a, int b) {
  Line line;
  for (const auto& [at, weight] : mask) add(line, a * at.first + b * at.second, weight);
  return line;
}

Line product(const Line& p, const Line& q) {
  Line r;
  for (const auto& [i, x] : p) {
    for (const auto& [j, y] : q) add(r, i + j, mpq_class(x * y));
  }
  return r;
}

// d(t) c(t) = q(t) c(t^2), c having the weights of the block around 0.
bool linked(const Line& d, const Line& q, const std::vector<mpq_class>& weights) {
  Line once, twice;
  mpq_class sum;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const int at = static_cast<int>(i) - static_cast<int>(weights.size() / 2);
    if (weights[i] < 0) return false;
    add(once, at, weights[i]), add(twice, 2 * at, weights[i]);
    sum += weights[i];
  }
  return sum == 1 && weights.size() % 2 == 1 && product(d, once) == product(q, twice);
}

// The masses of the unit intervals from -reach to reach under the digit e.
Matrix digit_matrix(const Line& q, int reach, int e) {
  Matrix t;
  for (int i = -reach; i < reach; ++i) {
    t.emplace_back();
    for (int l = -reach; l < reach; ++l) {
      const auto at = q.find(2 * i + e - l);
      t.back().push_back(at == q.end() ? mpq_class(0) : at->second);
    }
  }
  return t;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c(a.size(), Vector(b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      for (std::size_t k = 0; k < b.size(); ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

// Sign of det(x - m), by elimination.
int sign_of_determinant(Matrix m, const mpq_class& x) {
  const std::size_t n = m.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (mpq_class& entry : m[i]) entry = -entry;
    m[i][i] += x;
  }
  int sign = 1;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    while (pivot < n && m[pivot][i] == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != i) std::swap(m[pivot], m[i]), sign = -sign;
    sign *= sgn(m[i][i]);
    for (std::size_t r = i + 1; r < n; ++r) {
      const mpq_class factor = m[r][i] / m[i][i];
      for (std::size_t c = i; c < n && factor != 0; ++c) m[r][c] -= factor * m[i][c];
    }
  }
  return sign;
}

// ---- bounds of the joint spectral radius --------------------------------------------------------------------------

class Polytope {
 public:
  Polytope(const Line& q, int reach, const RegularBlock& block)
      : t_{digit_matrix(q, reach, 0), digit_matrix(q, reach, 1)}, n_(static_cast<std::size_t>(2 * reach)), block_(block) {}

  std::string fault() {
    if (std::string f = bounds_fault(); !f.empty()) return f;
    if (block_.vertices.empty()) return "there are no vertices";
    std::map<std::pair<int, int>, bool> is_vertex;
    for (std::size_t v = 0; v < block_.vertices.size(); ++v) {
      if (!vertex_is_right(v)) return "vertex " + std::to_string(v) + " is not what it should be";
      if (v > 0) is_vertex[{block_.vertices[v].parent, block_.vertices[v].digit}] = true;
    }
    auto next = block_.images.begin();
    for (int v = 0; v < static_cast<int>(block_.vertices.size()); ++v) {
      for (const int digit : {0, 1}) {
        if (is_vertex.count({v, digit}) != 0) continue;
        if (next == block_.images.end() || next->vertex != v || next->digit != digit || !covered(*next++)) {
          return "the image of vertex " + std::to_string(v) + " by T" + std::to_string(digit) + " is not shown to be inside";
        }
      }
    }
    return next == block_.images.end() ? "" : "there are images of no vertex";
  }

 private:
  // A root of the characteristic polynomial above low^length: its sign there is negative, and in the end positive.
  std::string bounds_fault() const {
    if (block_.low <= 0 || block_.high <= block_.low) return "the bounds of the growth do not increase";
    mpq_class width = block_.low;
    mpq_div_2exp(width.get_mpq_t(), width.get_mpq_t(), 64);
    if (block_.high - block_.low > width) return "the bounds of the growth are too far apart";
    if (block_.word.empty()) return "the word is empty";
    Matrix p = t_[static_cast<std::size_t>(block_.word[0])];
    mpq_class x = block_.low;
    for (std::size_t i = 1; i < block_.word.size(); ++i) p = product(p, t_[static_cast<std::size_t>(block_.word[i])]), x *= block_.low;
    return sign_of_determinant(p, x) < 0 ? "" : "the product does not grow so fast";
  }

  Vector image(int vertex, int digit) const {
    Vector y(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) y[i] += t_[static_cast<std::size_t>(digit)][i][j] * block_.vertices[static_cast<std::size_t>(vertex)].entries[j];
      y[i] /= block_.high;
    }
    return y;
  }

  bool vertex_is_right(std::size_t v) const {
    const PolytopeVertex& vertex = block_.vertices[v];
    if (vertex.entries.size() != n_) return false;
    if (v == 0) return std::all_of(vertex.entries.begin(), vertex.entries.end(), [](const mpz_class& x) { return x > 0; });
    if (vertex.parent >= static_cast<int>(v)) return false;
    const Vector y = image(vertex.parent, vertex.digit);
    for (std::size_t i = 0; i < n_; ++i) {
      if (vertex.entries[i] < y[i] || vertex.entries[i] >= y[i] + 1) return false;
    }
    return true;
  }

  bool covered(const PolytopeImage& image_of) const {
    mpq_class sum;
    Vector cover(n_);
    for (const auto& [v, weight] : image_of.weights) {
      if (v >= static_cast<int>(block_.vertices.size()) || weight <= 0) return false;
      sum += weight;
      for (std::size_t i = 0; i < n_; ++i) cover[i] += weight * block_.vertices[static_cast<std::size_t>(v)].entries[i];
    }
    const Vector y = image(image_of.vertex, image_of.digit);
    for (std::size_t i = 0; i < n_; ++i) {
      if (cover[i] < y[i]) return false;
    }
    return sum == 1;
  }

  std::array<Matrix, 2> t_;
  std::size_t n_;
  const RegularBlock& block_;
};

std::string smoothing_fault(const Weights& smoothing, const RegularBlock& block) {
  if (block.directions.size() != 4 || most_parallel(block.directions) != 1) return "there are not four different directions";
  const Line q = seen(smoothing, 1, 0), d = seen(smoothing, 1, 1);
  if (seen(smoothing, 0, 1) != q || seen(smoothing, -1, 1) != d) return "the smoothing looks different along the axes or the diagonals";
  if (!linked(d, q, block.link)) return "the link between axes and diagonals does not hold";
  const int reach = q.rbegin()->first;
  if (reach < 1 || q.begin()->first != -reach) return "the smoothing is not centred";
  for (int i = -reach; i <= reach; ++i) {
    if (q.count(i) == 0 || q.at(i) < 0) return "a weight is not positive";
  }
  if (2 * block.low <= 1 || block.high >= 1) return "the growth is not between 1/2 and 1";
  return Polytope(q, reach, block).fault();
}

}  // namespace

std::string regular_fault(Scheme scheme, const RegularBlock& block) {
  Weights rest = dyadic_mask(scheme);
  if (!in_order(block.directions)) return "these are not the known directions in order";
  for (const Place& d : block.directions) {
    if (!divide(rest, d)) return "the symbol has no factor of the direction (" + std::to_string(d.first) + ", " + std::to_string(d.second) + ")";
  }
  if (!converges(block.directions)) return "the directions do not make a converging scheme";
  for (auto& [at, weight] : rest) weight /= 4;
  const Weights smoothing = centred(rest);
  mpq_class sum;
  for (const auto& [at, weight] : smoothing) {
    if (weight < 0) return "the smoothing has a negative weight";
    sum += weight;
  }
  if (sum != 1) return "the weights of the smoothing do not add up to 1";
  const bool smooths = smoothing.size() > 1;
  if (smooths == block.link.empty()) return smooths ? "the smoothing is not accounted for" : "there is no smoothing";
  const int continuity = static_cast<int>(block.directions.size()) - most_parallel(block.directions) - 2 + (smooths ? 1 : 0);
  if (block.continuity != continuity) return "the directions give C^" + std::to_string(continuity);
  return smooths ? smoothing_fault(smoothing, block) : "";
}

}  // namespace check
