// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/midedge_boundary_limit.hpp"

#include "midedge_operator.hpp"
#include "midedge_walk.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

namespace hexact {
namespace {

using Pattern = MidedgeBoundaryPattern;
using Matrix = std::vector<std::vector<Rational>>;
using SparseRow = std::map<std::uint32_t, Rational>;

/// The corner with which the smallest rotation begins.
std::size_t first_corner(const Pattern& pattern) {
  const std::size_t k = pattern.size();
  std::size_t best = 0;
  for (std::size_t r = 1; r < k; ++r) {
    for (std::size_t i = 0; i < k; ++i) {
      const MidedgeCorner a = pattern[(r + i) % k], b = pattern[(best + i) % k];
      if (a == b) continue;
      if (a < b) best = r;
      break;
    }
  }
  return best;
}

/// Where things stand in a net.
struct NetPlaces {
  std::vector<std::uint32_t> corners;    ///< of the facet
  std::vector<std::uint32_t> opposites;  ///< the vertices (0, 1) and (1, 0): the other corners of the facets across the sides
  std::uint32_t size = 0;                ///< of the net
};

NetPlaces net_places(const Pattern& pattern) {
  NetPlaces places;
  for (std::size_t s = 0; s < pattern.size(); ++s) {
    const bool inner = pattern[s] == MidedgeCorner::inner, after = pattern[s] != MidedgeCorner::rim;
    const bool before = pattern[(s + pattern.size() - 1) % pattern.size()] != MidedgeCorner::rim;
    std::uint32_t at = places.size;
    places.corners.push_back(at);
    if (after) places.opposites.push_back(at + 1);
    if (before) places.opposites.push_back(at + (after ? 3 : 1));
    at += inner ? 8 : 1u + (after ? 2 : 0) + (before ? 2 : 0);
    places.size = at;
  }
  return places;
}

/// Whether a power of the matrix has only positive entries in column c.
bool reaches_everywhere(const Matrix& m, std::size_t c, const ProgressPart& progress) {
  std::vector<char> positive(m.size(), 0);
  positive[c] = 1;
  for (std::size_t power = 0; power < m.size(); ++power) {
    progress.check();
    std::vector<char> next(m.size(), 0);
    for (std::size_t r = 0; r < m.size(); ++r) {
      for (std::size_t i = 0; i < m.size() && next[r] == 0; ++i) next[r] = positive[i] != 0 && m[r][i].sign() > 0 ? 1 : 0;
    }
    positive = std::move(next);
    if (std::all_of(positive.begin(), positive.end(), [](char x) { return x != 0; })) return true;
  }
  return false;
}

/// Solves A x = b and A y = c for an M-matrix A, whose pivots on the diagonal are positive. Columns b and c stand behind A.
std::array<std::vector<Rational>, 2> solved(std::vector<SparseRow> a, const ProgressPart& progress) {
  const auto n = static_cast<std::uint32_t>(a.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    progress.check();
    HEXACT_INVARIANT(a[i].count(i) > 0 && a[i].at(i).sign() > 0);
    const Rational inverse = Rational(1) / a[i].at(i);
    for (std::uint32_t r = i + 1; r < n; ++r) {
      const auto entry = a[r].find(i);
      if (entry == a[r].end()) continue;
      const Rational factor = entry->second * inverse;
      a[r].erase(entry);
      for (auto at = a[i].upper_bound(i); at != a[i].end(); ++at) {
        Rational& x = a[r][at->first];
        x = x - factor * at->second;
      }
    }
  }
  std::array<std::vector<Rational>, 2> x{std::vector<Rational>(n), std::vector<Rational>(n)};
  for (std::uint32_t i = n; i-- > 0;) {
    progress.check();
    for (std::uint32_t side = 0; side < 2; ++side) {
      Rational rest;
      for (auto at = a[i].upper_bound(i); at != a[i].end(); ++at) {
        if (at->first < n) rest = rest - at->second * x[side][at->first];
        if (at->first == n + side) rest = rest + at->second;
      }
      x[side][i] = rest / a[i].at(i);
    }
  }
  return x;
}

/// The same unknowns in another order, the rows with many entries last: what is eliminated before them stays in a band.
std::vector<std::uint32_t> elimination_order(const std::vector<SparseRow>& a) {
  constexpr std::size_t kDense = 48;
  std::vector<std::uint32_t> order(a.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_partition(order.begin(), order.end(), [&](std::uint32_t i) { return a[i].size() <= kDense; });
  return order;
}

std::array<std::vector<Rational>, 2> solved_in_order(const std::vector<SparseRow>& a, const ProgressPart& progress) {
  const std::vector<std::uint32_t> order = elimination_order(a);
  const auto n = static_cast<std::uint32_t>(a.size());
  std::vector<std::uint32_t> place(a.size());
  for (std::uint32_t i = 0; i < n; ++i) place[order[i]] = i;
  std::vector<SparseRow> turned(a.size());
  for (std::uint32_t r = 0; r < n; ++r) {
    for (const auto& [c, value] : a[r]) turned[place[r]][c < n ? place[c] : c] = value;
  }
  const auto there = solved(std::move(turned), progress);
  std::array<std::vector<Rational>, 2> x{std::vector<Rational>(n), std::vector<Rational>(n)};
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::size_t side = 0; side < 2; ++side) x[side][i] = there[side][place[i]];
  }
  return x;
}

Rational dot(const std::vector<Rational>& a, const std::vector<Rational>& b) {
  Rational sum;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Takes from a row the least of its entries at some places; returns it.
Rational take_shared(std::vector<Rational>& row, std::span<const std::uint32_t> places) {
  Rational shared = row[places[0]];
  for (const std::uint32_t c : places) shared = std::min(shared, row[c]);
  for (const std::uint32_t c : places) row[c] = row[c] - shared;
  return shared;
}

void check_weights(const Matrix& m, const std::vector<Rational>& w, const ProgressPart& progress) {
  Rational sum;
  for (std::size_t c = 0; c < m.size(); ++c) {
    progress.check();
    Rational image;
    for (std::size_t r = 0; r < m.size(); ++r) {
      if (!m[r][c].is_zero()) image += w[r] * m[r][c];
    }
    HEXACT_INVARIANT(image == w[c] && w[c].sign() >= 0);
    sum += w[c];
  }
  HEXACT_INVARIANT(sum == Rational(1));
}

}  // namespace

Pattern midedge_boundary_pattern(const MidedgeMap& map, std::uint32_t f) {
  const std::uint32_t start = map.facet_start(f), k = map.facet_size(f);
  Pattern pattern(k, MidedgeCorner::inner);
  for (std::uint32_t s = 0; s < k; ++s) {
    std::uint32_t h = start + s;
    do {
      h = map.twin(map.previous(h));
    } while (h != kNoTwin && h != start + s);
    if (h == kNoTwin) pattern[s] = map.twin(start + s) == kNoTwin ? MidedgeCorner::rim : MidedgeCorner::gap;
  }
  return pattern;
}

bool touches_boundary(const Pattern& pattern) {
  return std::any_of(pattern.begin(), pattern.end(), [](MidedgeCorner c) { return c != MidedgeCorner::inner; });
}

bool stands_alone(const Pattern& pattern) {
  return std::all_of(pattern.begin(), pattern.end(), [](MidedgeCorner c) { return c == MidedgeCorner::rim; });
}

std::optional<MidedgeBoundaryNet> midedge_boundary_net(const MidedgeMap& map, std::uint32_t f) {
  const Pattern given = midedge_boundary_pattern(map, f);
  const auto k = static_cast<std::uint32_t>(given.size()), turn = static_cast<std::uint32_t>(first_corner(given));
  const std::uint32_t start = map.facet_start(f);
  MidedgeBoundaryNet net;
  detail::MidedgeWalk walk(map);
  const auto side = [&](std::uint32_t s) { return start + (turn + s) % k; };
  for (std::uint32_t s = 0; s < k; ++s) net.pattern.push_back(given[(turn + s) % k]);
  for (std::uint32_t s = 0; s < k; ++s) {
    net.vertices.push_back(map.origin(side(s)));
    const MidedgeCorner before = net.pattern[(s + k - 1) % k];
    if (net.pattern[s] == MidedgeCorner::inner) {
      const auto sector = detail::midedge_sector(walk, walk.across(side(s + k - 1)));
      net.vertices.insert(net.vertices.end(), sector.begin() + 1, sector.end() - 1);
    }
    if (net.pattern[s] == MidedgeCorner::gap) {
      // (s + 1, 0, 0) → (s, 0, 0) → (s, 0, 1) → (s + 1, 1, 0), and the same in the next cell.
      const std::uint32_t near = walk.across(side(s)), far = walk.across(walk.on(near, 2));
      walk.expect_boundary(walk.on(near, 1));
      net.vertices.insert(net.vertices.end(), {walk.start_of(walk.on(near, 2)), walk.start_of(walk.on(far, 2))});
    }
    if (net.pattern[s] != MidedgeCorner::inner && before != MidedgeCorner::rim) {
      // (s, 0, 0) → (s − 1, 0, 0) → (s − 1, 0, 1) → (s, 1, 0), and the same in the next cell.
      const std::uint32_t near = walk.across(side(s + k - 1)), far = walk.across(walk.on(near, 2));
      walk.expect_boundary(walk.on(near, 3));
      net.vertices.insert(net.vertices.end(), {walk.start_of(walk.on(near, 3)), walk.start_of(walk.on(far, 3))});
    }
    if (walk.failed()) return std::nullopt;
  }
  return net;
}

Matrix midedge_boundary_operator(const Pattern& pattern, const ProgressPart& progress) {
  const MidedgeMap coarse = detail::midedge_patch(pattern), fine = coarse.double_stepped();
  const auto from = midedge_boundary_net(coarse, 0), to = midedge_boundary_net(fine, 0);
  HEXACT_INVARIANT(from && to && from->pattern == to->pattern);
  const std::size_t n = from->vertices.size();
  Matrix m(n, std::vector<Rational>(n));
  for (std::size_t c = 0; c < n; c += 3) {  // three columns at a time, one in each coordinate
    progress.check();
    PointArray<Rational> unit(coarse.vertex_count());
    unit[from->vertices[c]].x = Rational(1);
    if (c + 1 < n) unit[from->vertices[c + 1]].y = Rational(1);
    if (c + 2 < n) unit[from->vertices[c + 2]].z = Rational(1);
    const PointArray<Rational> result = corner_points<Rational>(coarse, unit, MidedgeRule::six_point);
    for (std::size_t r = 0; r < n; ++r) {
      const Point3<Rational>& p = result[to->vertices[r]];
      m[r][c] = p.x;
      if (c + 1 < n) m[r][c + 1] = p.y;
      if (c + 2 < n) m[r][c + 2] = p.z;
    }
  }
  for (const auto& row : m) {
    Rational sum;
    for (const Rational& x : row) sum += x;
    HEXACT_INVARIANT(sum == Rational(1));  // so nothing outside the net has a part in it
  }
  return m;
}

/// M = B + u t + v q, where t is 1 at the facet's corners and q at the corners across its sides, and u_r and v_r are the least
/// weights that vertex r takes from these: what is left in B couples neighbouring sectors, but for corners next to boundary
/// edges. w M = w becomes w (1 − B) = (w · u) t + (w · v) q. With (1 − B)^T y = t and (1 − B)^T z = q, w is a y + b z for
/// a = w · u = a y · u + b z · u.
std::vector<Rational> midedge_boundary_weights(const Pattern& pattern, const ProgressPart& progress) {
  HEXACT_EXPECTS(touches_boundary(pattern) && !stands_alone(pattern));
  const Matrix m = midedge_boundary_operator(pattern, progress);
  const NetPlaces places = net_places(pattern);
  if (!reaches_everywhere(m, places.corners[0], progress)) throw NumericalFailure("the limit at the boundary could not be proved");
  const auto n = static_cast<std::uint32_t>(m.size());
  std::vector<SparseRow> a(n);
  std::vector<Rational> u;
  for (std::uint32_t r = 0; r < n; ++r) {
    std::vector<Rational> rest = m[r];
    u.push_back(take_shared(rest, places.corners));
    (void)take_shared(rest, places.opposites);
    rest[r] = rest[r] - Rational(1);
    for (std::uint32_t c = 0; c < n; ++c) {
      if (!rest[c].is_zero()) a[c][r] = -rest[c];
    }
  }
  for (const std::uint32_t c : places.corners) a[c][n] = Rational(1);
  for (const std::uint32_t c : places.opposites) a[c][n + 1] = Rational(1);
  const auto [y, z] = solved_in_order(a, progress);
  const Rational first = dot(z, u), second = Rational(1) - dot(y, u);
  std::vector<Rational> w(n);
  Rational sum;
  for (std::uint32_t i = 0; i < n; ++i) {
    w[i] = first * y[i] + second * z[i];
    sum += w[i];
  }
  for (Rational& x : w) x = x / sum;
  check_weights(m, w, progress);
  return w;
}

void MidedgeBoundaryLimits::prepare(Pattern pattern) {
  std::rotate(pattern.begin(), pattern.begin() + static_cast<std::ptrdiff_t>(first_corner(pattern)), pattern.end());
  if (weights_.count(pattern) > 0 || net_places(pattern).size > kLargestNet) return;
  std::vector<Rational> weights = midedge_boundary_weights(pattern, progress_);
  weights_.emplace(std::move(pattern), std::move(weights));
}

std::optional<Point3<Rational>> MidedgeBoundaryLimits::operator()(const MidedgeLevel<Rational>& level, std::uint32_t f) const {
  const auto net = midedge_boundary_net(level.map, f);
  if (!net || net->vertices.size() > kLargestNet) return std::nullopt;
  const std::vector<Rational>& w = weights_.at(net->pattern);
  Point3<Rational> limit;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const Point3<Rational>& p = level.points[net->vertices[i]];
    limit = {limit.x + w[i] * p.x, limit.y + w[i] * p.y, limit.z + w[i] * p.z};
  }
  return limit;
}

}  // namespace hexact
