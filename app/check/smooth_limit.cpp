// SPDX-License-Identifier: LGPL-3.0-or-later
#include "smooth_limit.hpp"

#include "corner_cut.hpp"
#include "surface.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace check {
namespace {

constexpr std::size_t kMostBits = 2048;  // of multipliers; a file that needs more is left undecided

// ---- integers of 128 bits, or of any size where these do not suffice ------------------------------------------------

using Wide = __int128;
struct TooWide {};

int width(Wide x) {
  const auto m = static_cast<unsigned __int128>(x < 0 ? -x : x);
  const auto high = static_cast<std::uint64_t>(m >> 64);
  return high != 0 ? 64 + std::bit_width(high) : std::bit_width(static_cast<std::uint64_t>(m));
}
Wide times(Wide x, Wide y) {
  if (width(x) + width(y) > 120) throw TooWide{};
  return x * y;
}
mpz_class times(const mpz_class& x, const mpz_class& y) { return x * y; }
mpz_class big(Wide x) {
  const auto m = static_cast<unsigned __int128>(x < 0 ? -x : x);
  mpz_class z(static_cast<unsigned long>(m >> 64));
  z <<= 64;
  z += static_cast<unsigned long>(m);
  return x < 0 ? mpz_class(-z) : z;
}
mpz_class big(const mpz_class& x) { return x; }
void assign(Wide& to, const mpz_class& x) {
  if (!x.fits_slong_p()) throw TooWide{};
  to = x.get_si();
}
void assign(mpz_class& to, const mpz_class& x) { to = x; }

// ---- before the chamfer steps ----------------------------------------------------------------------------------

// The surface before a step that cut all edges with `added` hexagons H + a, ., g, H + b, ., h.
std::optional<Surface> before_edges_cut(const Surface& s, std::size_t added) {
  const std::size_t facets = s.facets() - added, half_edges = 2 * added, vertices = s.triple.size() / 4;
  std::vector<Index> origin(half_edges, kNone);
  for (std::size_t f = facets; f < s.facets(); ++f) {
    if (s.size(f) != 6) return std::nullopt;
    const Index* c = s.corner.data() + s.start[f];
    for (const auto& [h, v] : {std::pair(c[5], c[0]), std::pair(c[2], c[3])}) {
      if (h >= half_edges || v < half_edges || v - half_edges >= vertices) return std::nullopt;
      origin[h] = static_cast<Index>(v - half_edges);
    }
  }
  if (s.start[facets] != half_edges || std::find(origin.begin(), origin.end(), kNone) != origin.end()) return std::nullopt;
  Surface r;
  r.start.assign(s.start.begin(), s.start.begin() + static_cast<std::ptrdiff_t>(facets) + 1);
  r.corner = origin;
  r.triple.assign(vertices, {kNone, kNone, kNone});
  std::vector<int> filled(vertices, 0);
  for (std::size_t f = 0; f < facets; ++f) {
    for (Index h = r.start[f]; h < r.start[f + 1]; ++h) {
      int& k = filled[r.corner[h]];
      if (k == 3) return std::nullopt;
      r.triple[r.corner[h]][static_cast<std::size_t>(k++)] = static_cast<Index>(f);
    }
  }
  if (std::find_if(filled.begin(), filled.end(), [](int k) { return k != 3; }) != filled.end()) return std::nullopt;
  return r;
}

struct Start {
  Surface surface;
  Index steps = 0, first_level = 0;
};

Start before_chamfers(const Body& body) {
  Start start{body.surface, 0, 0};
  for (;;) {
    Surface& s = start.surface;
    const std::size_t end = s.facets();
    std::size_t begin = end;
    while (begin > 0 && body.address[begin - 1].level == body.address[end - 1].level) --begin;
    if (begin == 0 || body.address[begin].level == 0 || 8 * (end - begin) != s.corner.size() || s.triple.size() % 4 != 0) return start;
    std::optional<Surface> before = before_edges_cut(s, end - begin);
    if (!before) return start;
    s = std::move(*before);
    start.first_level = body.address[begin].level;
    ++start.steps;
  }
}

// ---- the scale in which E = (F + G − t) / 2 ---------------------------------------------------------------------

std::array<mpq_class, 3> cross_product(const Plane& p, const Plane& q) {
  std::array<mpq_class, 3> r;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    r[k] = p[i].a * q[j].a - p[j].a * q[i].a;
  }
  return r;
}

// Multipliers of the first planes with x_F n_F + x_G n_G along n_E, from facet 0 on; none where there are none.
std::vector<mpz_class> multipliers(const Planes& planes, const Surface& s, const Edges& e, Index steps) {
  const std::vector<Index> list = edge_list(s, e);
  std::vector<Index> number(s.corner.size());
  for (Index i = 0; i < list.size(); ++i) number[list[i]] = number[e.twin[list[i]]] = i;
  std::vector<mpq_class> x(s.facets(), 0);
  std::vector<Index> queue{0};
  x[0] = 1;
  mpz_class common = 1;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const Index f = queue[i];
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) {
      const Index g = e.facet[e.twin[h]];
      if (x[g] != 0) continue;
      const Plane mean = planes[s.facets() + number[h]];
      const auto left = cross_product(planes[f], mean), right = cross_product(mean, planes[g]);
      for (std::size_t k = 0; k < 3 && x[g] == 0; ++k) {
        if (right[k] != 0) x[g] = x[f] * left[k] / right[k];
      }
      mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), x[g].get_den_mpz_t());
      if (sgn(x[g]) <= 0 || mpz_sizeinbase(common.get_mpz_t(), 2) > kMostBits) return {};
      if (mpz_sizeinbase(x[g].get_num_mpz_t(), 2) > kMostBits) return {};
      queue.push_back(g);
    }
  }
  std::vector<mpz_class> out;
  for (const mpq_class& q : x) out.push_back(mpz_class(mpq_class(q * common).get_num()) << steps);
  return out;
}

// ---- lifts and budgets ------------------------------------------------------------------------------------------

template <class T>
class Budgets {
 public:
  explicit Budgets(const Body& body) : body_(body) {}

  // One chamfer step, `left` of them to come with it: its lifts, what they take from budgets, and new budgets.
  std::string step(const Surface& s, const Edges& e, Index left) {
    if (scaled_.empty() && !begin(s, e, left)) return "the planes of the first chamfer step are no means in any scale";
    const std::vector<Index> list = edge_list(s, e);
    lift_.assign(s.corner.size(), T(0));
    for (const Index h : list) {
      const Index f = e.facet[h], g = e.facet[e.twin[h]];
      if (std::string gap = add_mean(f, g); !gap.empty()) return gap;
      lift_[h] = lift_[e.twin[h]] = times(weight_, T(scaled_[f][3] + scaled_[g][3] - 2 * scaled_.back()[3]));
      if (lift_[h] <= 0) return facet_name(scaled_.size() - 1) + ": its lift is not positive";
    }
    for (Index h = 0; h < left_.size(); ++h) {
      if (!has_budget_[h]) continue;
      left_[h] -= lift_[h];
      if (left_[h] <= 0) return facet_name(e.facet[h]) + ": its lifts towards " + facet_name(e.facet[e.twin[h]]) + " use up their budget";
    }
    if (left > 1) earn(s, e, list);
    weight_ = times(weight_, T(2));
    return {};
  }

 private:
  using Vector = std::array<T, 4>;

  bool begin(const Surface& s, const Edges& e, Index steps) {
    const std::vector<mpz_class> factor = multipliers(body_.planes, s, e, steps);
    for (std::size_t f = 0; f < factor.size(); ++f) {
      T k;
      assign(k, factor[f]);
      Vector p = stored(f);
      for (T& x : p) x = times(x, k);
      scaled_.push_back(p);
    }
    return !factor.empty();
  }

  Vector stored(std::size_t f) const {
    Vector v;
    for (std::size_t k = 0; k < 4; ++k) {
      if (body_.planes.is_short(f)) v[k] = static_cast<long>(body_.planes.row(f)[k]);
      else assign(v[k], integers(f)[k]);
    }
    return v;
  }
  // A plane of fractions, times their common denominator.
  std::array<mpz_class, 4> integers(std::size_t f) const {
    const Plane p = body_.planes[f];
    mpz_class common = 1;
    for (const Number& x : p) mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), x.a.get_den_mpz_t());
    std::array<mpz_class, 4> v;
    for (std::size_t k = 0; k < 4; ++k) v[k] = mpq_class(p[k].a * common).get_num();
    return v;
  }
  static Vector primitive(const Vector& v) {
    mpz_class g = 0;
    for (const T& x : v) g = gcd(g, big(x));
    Vector r;
    for (std::size_t k = 0; k < 4; ++k) assign(r[k], mpz_class(big(v[k]) / g));
    return r;
  }

  // Appends the next plane, which has to be the mean of planes f and g, moved in.
  std::string add_mean(Index f, Index g) {
    const std::size_t own = scaled_.size();
    Vector e = stored(own), mean;
    const auto k = static_cast<std::size_t>(std::find_if(e.begin(), e.end(), [](const T& x) { return x != 0; }) - e.begin());
    const auto fill = [&] {
      for (std::size_t i = 0; i < 3; ++i) mean[i] = (scaled_[f][i] + scaled_[g][i]) / 2;  // even, see `multipliers`
    };
    fill();
    for (std::size_t i = 0; i < 3; ++i) {
      if (times(mean[i], e[k]) != times(e[i], mean[k])) return facet_name(own) + ": its normal is no mean of two neighbours";
    }
    if (mean[k] == 0 || (mean[k] > 0) != (e[k] > 0)) return facet_name(own) + ": its normal is no mean of two neighbours";
    if (mean[k] % e[k] != 0) e = primitive(e);
    if (mean[k] % e[k] != 0) {
      if (!stretch(abs(big(e[k])) / gcd(big(mean[k]), big(e[k])))) return "the planes have no scale of reasonable size";
      fill();
    }
    mean[3] = times(T(mean[k] / e[k]), e[3]);
    scaled_.push_back(mean);
    return {};
  }

  // Multiplies everything by `by`, so that the offset of one more plane is an integer.
  bool stretch(const mpz_class& by) {
    stretched_ *= by;
    T k;
    assign(k, by);
    for (Vector& p : scaled_) {
      for (T& x : p) x = times(x, k);
    }
    for (T& x : left_) x = times(x, k);
    for (T& x : lift_) x = times(x, k);
    return mpz_sizeinbase(stretched_.get_mpz_t(), 2) <= kMostBits;
  }

  // Budgets of the new hexagons H + a, q, q, H + b, q, q: towards the facets on both sides of the old edge, the smaller
  // defect of the lifts at its ends. Half-edges keep their numbers, so later steps find what is left.
  void earn(const Surface& s, const Edges& e, const std::vector<Index>& list) {
    const std::size_t half_edges = s.corner.size();
    left_.resize(half_edges + 6 * list.size(), T(0));
    has_budget_.resize(left_.size(), false);
    const auto set = [&](std::size_t at, Index h) {
      const Index g = e.twin[h];
      const T begin = lift_[h] + lift_[e.previous[h]] - lift_[e.next[g]], end = lift_[h] + lift_[e.next[h]] - lift_[e.previous[g]];
      left_[at] = begin < end ? begin : end;
      has_budget_[at] = true;
    };
    for (std::size_t i = 0; i < list.size(); ++i) {
      set(half_edges + 6 * i + 1, e.twin[list[i]]);
      set(half_edges + 6 * i + 4, list[i]);
    }
  }

  const Body& body_;
  std::vector<Vector> scaled_;
  std::vector<T> lift_, left_;     // of each half-edge: its lift in this step; what is left of its budget
  std::vector<bool> has_budget_;
  T weight_ = 1;                   // lifts count twice as much at each level
  mpz_class stretched_ = 1;
};

template <class T>
std::string gap_over(const Body& body, const Start& start) {
  Budgets<T> budgets(body);
  Index left = start.steps;
  std::vector<Address> address(body.address.begin(), body.address.begin() + static_cast<std::ptrdiff_t>(start.surface.facets()));
  return replay(body, start.surface, std::move(address), start.first_level,
                [&](const Surface& s, const Edges& e) { return budgets.step(s, e, left--); });
}

}  // namespace

std::string smooth_limit_gap(const Body& body) {
  if (body.root5) return "only decided over the rational numbers";
  if (std::string fault = trivalent_fault(body.surface); !fault.empty()) return fault;
  const Start start = before_chamfers(body);
  if (start.steps == 0) return "the last level does not come from a chamfer step";
  try {
    return gap_over<Wide>(body, start);
  } catch (const TooWide&) {
    return gap_over<mpz_class>(body, start);
  }
}

}  // namespace check
