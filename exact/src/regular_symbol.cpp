// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/regular_symbol.hpp"

#include "hexact/exact/eigenvalues.hpp"
#include "hexact/exact/midedge.hpp"
#include "hexact/kernel/errors.hpp"
#include "polynomial.hpp"

#include <algorithm>

namespace hexact {
namespace {

using Vector = Symbol::Vector;

/// The vertex (i, j) of sector s in the plane lattice.
Vector turned(SectorLattice lattice, Vector v, int s) {
  for (; s > 0; --s) {
    v = lattice == SectorLattice::dual        ? Vector{-v[1] - 1, v[0]}
        : lattice == SectorLattice::triangles ? Vector{-v[1], v[0] + v[1]}
                                              : Vector{-v[1], v[0]};
  }
  return v;
}

using Stencil = std::map<Vector, Rational>;  ///< coarse vertex → weight

/// The rows of the matrix in sector 0, and the centre's.
std::vector<std::pair<Vector, Stencil>> stencils(const SubdivisionMatrix& m) {
  const std::size_t n = m.size();
  const Rational cosine = rational_cosine(1, m.valence).value;
  std::vector<std::pair<Vector, Stencil>> rows(n);
  std::pair<Vector, Stencil> centre{{0, 0}, {}};
  for (std::size_t r = 0; r < n; ++r) {
    rows[r].first = m.vertices[r];
    if (m.has_centre) rows[r].second[{0, 0}] = m.centre_to[r];
  }
  for (int d = 0; d < m.valence; ++d) {
    const std::vector<CosinePolynomial> block = sector_block(m, d);
    for (std::size_t c = 0; c < n; ++c) {
      const Vector at = turned(m.lattice, m.vertices[c], d);
      for (std::size_t r = 0; r < n; ++r) rows[r].second[at] += value(block[r * n + c], cosine);
      if (m.has_centre) centre.second[at] += value(m.centre_from[c], cosine);
    }
  }
  if (m.has_centre) {
    centre.second[{0, 0}] += value(m.centre, cosine);
    rows.push_back(std::move(centre));
  }
  return rows;
}

int parity(const Vector& v) { return (v[0] & 1) + 2 * (v[1] & 1); }

}  // namespace

Symbol regular_symbol(SpectrumScheme scheme) {
  const SubdivisionMatrix m = subdivision_matrix(scheme, scheme == SpectrumScheme::loop ? 6 : 4, ring_reach(scheme) + 1);
  std::array<std::optional<Symbol>, 4> found;  // by parity of the fine vertex
  for (const auto& [fine, stencil] : stencils(m)) {
    Symbol part;
    for (const auto& [coarse, weight] : stencil) part.add({fine[0] - 2 * coarse[0], fine[1] - 2 * coarse[1]}, weight);
    auto& known = found[static_cast<std::size_t>(parity(fine))];
    HEXACT_INVARIANT(!known || *known == part);
    known = std::move(part);
  }
  Symbol symbol;
  for (const auto& part : found) {
    HEXACT_INVARIANT(part && part->total() == Rational(1));
    symbol = symbol + *part;
  }
  return symbol;
}

Symbol midedge_step_symbol(MidedgeRule rule) {
  constexpr std::uint32_t n = 8;  // wide enough that no two weights of the stencil meet around the torus
  FacetLoops loops;
  const auto vertex = [](std::uint32_t i, std::uint32_t j) { return make_id<VertexId>((i % n) * n + j % n); };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) loops.add(std::array{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
  }
  const MidedgeMap map(loops, n * n);
  PointArray<Rational> unit(n * n);
  unit[0].x = Rational(1);
  const PointArray<Rational> points = edge_points<Rational>(map, unit, rule);
  const auto doubled = [](std::uint32_t a, std::uint32_t b) {  // twice the middle of a and b, in −n … n−1
    if (b != a && (b + n - a) % n != 1) std::swap(a, b);
    const int twice = static_cast<int>(2 * a + (a == b ? 0 : 1));
    return twice < static_cast<int>(n) ? twice : twice - 2 * static_cast<int>(n);
  };
  Symbol symbol;
  std::size_t edge = 0;  // numbered as half-edges first show them
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    if (map.twin(h) < h) continue;
    const std::uint32_t a = map.origin(h), b = map.target(h);
    symbol.add({doubled(a / n, b / n), doubled(a % n, b % n)}, points[edge++].x);
  }
  return symbol;
}

Symbol double_step_symbol(const Symbol& step) { return step.mapped({2, 0}, {0, 2}) * step.mapped({1, 1}, {1, -1}); }

BoxSplineFactors box_spline_factors(const Symbol& symbol) {
  HEXACT_EXPECTS(!symbol.terms().empty());
  BoxSplineFactors out;
  out.smoothing = symbol * Symbol(Rational(1) / Rational(4));
  for (const Vector direction : {Vector{1, 0}, Vector{0, 1}, Vector{1, 1}, Vector{1, -1}}) {
    while (auto quotient = out.smoothing.without(direction)) {
      out.smoothing = *quotient * Symbol(Rational(2));
      out.directions.push_back(direction);
    }
  }
  for (const std::size_t axis : {0U, 1U}) {
    const auto [least, greatest] = std::minmax_element(out.smoothing.terms().begin(), out.smoothing.terms().end(),
                                                       [axis](const auto& a, const auto& b) { return a.first[axis] < b.first[axis]; });
    out.shift[axis] = (least->first[axis] + greatest->first[axis]) / 2;
  }
  out.smoothing = out.smoothing.shifted({-out.shift[0], -out.shift[1]});
  return out;
}

Symbol product(const BoxSplineFactors& factors) {
  Symbol p = factors.smoothing.shifted(factors.shift) * Symbol(Rational(4));
  for (const Vector& direction : factors.directions) {
    p = p * (Symbol(Rational(1)) + Symbol::monomial(direction)) * Symbol(Rational(1) / Rational(2));
  }
  return p;
}

int removal_number(const std::vector<Vector>& directions) {
  int most = 0;
  for (const Vector& a : directions) {
    most = std::max(most, static_cast<int>(std::count_if(directions.begin(), directions.end(), [&](const Vector& b) { return a[0] * b[1] == a[1] * b[0]; })));
  }
  return static_cast<int>(directions.size()) - most;
}

}  // namespace hexact
