// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/midedge_boundary_limit.hpp"

#include "midedge_operator.hpp"
#include "midedge_walk.hpp"

#include <algorithm>

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

/// Where each corner of the facet stands in its net, and last the size of the net.
std::vector<std::uint32_t> corner_places(const Pattern& pattern) {
  std::vector<std::uint32_t> places{0};
  for (std::size_t s = 0; s < pattern.size(); ++s) {
    const MidedgeCorner before = pattern[(s + pattern.size() - 1) % pattern.size()];
    std::uint32_t size = pattern[s] == MidedgeCorner::inner ? 8 : 1;
    if (pattern[s] == MidedgeCorner::gap) size += 2;
    if (pattern[s] != MidedgeCorner::inner && before != MidedgeCorner::rim) size += 2;
    places.push_back(places.back() + size);
  }
  return places;
}

/// Whether a power of the matrix has only positive entries in column c.
bool reaches_everywhere(const Matrix& m, std::size_t c) {
  std::vector<char> positive(m.size(), 0);
  positive[c] = 1;
  for (std::size_t power = 0; power < m.size(); ++power) {
    std::vector<char> next(m.size(), 0);
    for (std::size_t r = 0; r < m.size(); ++r) {
      for (std::size_t i = 0; i < m.size() && next[r] == 0; ++i) next[r] = positive[i] != 0 && m[r][i].sign() > 0 ? 1 : 0;
    }
    positive = std::move(next);
    if (std::all_of(positive.begin(), positive.end(), [](char x) { return x != 0; })) return true;
  }
  return false;
}

/// Solves A x = b for an M-matrix A, whose pivots on the diagonal are positive. Column b stands behind the others.
std::vector<Rational> solved(std::vector<SparseRow> a) {
  const auto n = static_cast<std::uint32_t>(a.size());
  for (std::uint32_t i = 0; i < n; ++i) {
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
  std::vector<Rational> x(n);
  for (std::uint32_t i = n; i-- > 0;) {
    for (auto at = a[i].upper_bound(i); at != a[i].end(); ++at) {
      x[i] = at->first == n ? x[i] + at->second : x[i] - at->second * x[at->first];
    }
    x[i] = x[i] / a[i].at(i);
  }
  return x;
}

void check_weights(const Matrix& m, const std::vector<Rational>& w) {
  Rational sum;
  for (std::size_t c = 0; c < m.size(); ++c) {
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

Matrix midedge_boundary_operator(const Pattern& pattern) {
  const MidedgeMap coarse = detail::midedge_patch(pattern), fine = coarse.double_stepped();
  const auto from = midedge_boundary_net(coarse, 0), to = midedge_boundary_net(fine, 0);
  HEXACT_INVARIANT(from && to && from->pattern == to->pattern);
  const std::size_t n = from->vertices.size();
  Matrix m(n, std::vector<Rational>(n));
  for (std::size_t c = 0; c < n; c += 3) {  // three columns at a time, one in each coordinate
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

/// M = B + u t, t being 1 at the facet's corners and u_r the smallest weight of a corner in vertex r: what is left in B couples
/// neighbouring sectors only. w M = w becomes w (1 − B) = (w · u) t, and up to a factor (1 − B)^T w = t.
std::vector<Rational> midedge_boundary_weights(const Pattern& pattern) {
  HEXACT_EXPECTS(touches_boundary(pattern) && !stands_alone(pattern));
  const Matrix m = midedge_boundary_operator(pattern);
  std::vector<std::uint32_t> corners = corner_places(pattern);
  corners.pop_back();
  if (!reaches_everywhere(m, corners[0])) throw NumericalFailure("the limit at the boundary could not be proved");
  const auto n = static_cast<std::uint32_t>(m.size());
  std::vector<SparseRow> a(n);
  for (std::uint32_t r = 0; r < n; ++r) {
    Rational shared = m[r][corners[0]];
    for (const std::uint32_t c : corners) shared = std::min(shared, m[r][c]);
    std::vector<Rational> rest = m[r];
    for (const std::uint32_t c : corners) rest[c] = rest[c] - shared;
    rest[r] = rest[r] - Rational(1);
    for (std::uint32_t c = 0; c < n; ++c) {
      if (!rest[c].is_zero()) a[c][r] = -rest[c];
    }
  }
  for (const std::uint32_t c : corners) a[c][n] = Rational(1);
  std::vector<Rational> w = solved(std::move(a));
  Rational sum;
  for (const Rational& x : w) sum += x;
  for (Rational& x : w) x = x / sum;
  check_weights(m, w);
  return w;
}

void MidedgeBoundaryLimits::prepare(Pattern pattern) {
  std::rotate(pattern.begin(), pattern.begin() + static_cast<std::ptrdiff_t>(first_corner(pattern)), pattern.end());
  if (weights_.count(pattern) > 0 || corner_places(pattern).back() > kLargestNet) return;
  std::vector<Rational> weights = midedge_boundary_weights(pattern);
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
