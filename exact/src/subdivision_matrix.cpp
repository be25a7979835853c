// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/subdivision_matrix.hpp"

#include "hexact/kernel/errors.hpp"
#include "polynomial.hpp"
#include "sector_place.hpp"

#include <algorithm>
#include <map>

namespace hexact {
namespace {

/// A row of the matrix while it is made: single weights, and weights on all sectors alike.
struct Row {
  std::map<Place, Rational> local;
  std::map<std::array<int, 2>, Rational> uniform;

  void add(const Place& p, const Rational& w) { local[p] += w; }
  void add(const Row& other, const Rational& factor) {
    for (const auto& [p, w] : other.local) local[p] += w * factor;
    for (const auto& [p, w] : other.uniform) uniform[p] += w * factor;
  }
  /// The sum of `other` over all k sectors.
  void add_all_sectors(const Row& other, const Rational& factor, int k) {
    for (const auto& [p, w] : other.local) uniform[{p.i, p.j}] += w * factor;
    for (const auto& [p, w] : other.uniform) uniform[p] += w * factor * Rational(k);
  }
};

/// The two steps of Midedge near a k-gon. Cells are quads (x, y) … (x+1, y+1); cell (−1, −1) is the k-gon.
class MidedgeRows {
 public:
  MidedgeRows(int k, bool six_point) : k_(k), six_point_(six_point), q_(Rational(3) / Rational(16 * (k - 2))) {}

  /// The fine vertex (i, j): corner of the coarse cell that it lies in.
  [[nodiscard]] Row fine(int i, int j) const {
    const int x = i / 2, y = j / 2, cx = i % 2 == 1 ? x : x - 1, cy = j % 2 == 1 ? y : y - 1;
    const int dx = cx == x ? 1 : -1, dy = cy == y ? 1 : -1;  // from the corner into the cell
    const Row along = middle({x, y}, {x + dx, y}), across = middle({x, y}, {x, y + dy});
    Row row;
    const Rational end = six_point_ ? Rational(5) / Rational(16) : Rational(1) / Rational(2);
    row.add(along, end);
    row.add(across, end);
    if (!six_point_) return row;
    if (cx == -1 && cy == -1) {
      row.add_all_sectors(across, q_, k_);
      row.add(along, -q_);
      row.add(across, -q_);
    } else {
      row.add(middle({x, y + dy}, {x + dx, y + dy}), kSide);
      row.add(middle({x + dx, y}, {x + dx, y + dy}), kSide);
    }
    row.add(middle({x, y}, {x - dx, y}), kSide);
    row.add(middle({x, y}, {x, y - dy}), kSide);
    return row;
  }

 private:
  using Corner = std::array<int, 2>;

  void add(Row& row, const Corner& v, const Rational& w) const { row.add(dual_place(v[0], v[1]), w); }

  /// The new vertex of an edge. The cells beside it contribute their other vertices.
  [[nodiscard]] Row middle(const Corner& a, const Corner& b) const {
    Row row;
    const Rational end = six_point_ ? Rational(5) / Rational(16) : Rational(1) / Rational(2);
    add(row, a, end);
    add(row, b, end);
    if (!six_point_) return row;
    const Corner low = {std::min(a[0], b[0]), std::min(a[1], b[1])};
    const bool horizontal = a[1] == b[1];
    for (const int side : {1, -1}) {
      const Corner cell = horizontal ? Corner{low[0], side > 0 ? low[1] : low[1] - 1}
                                     : Corner{side > 0 ? low[0] : low[0] - 1, low[1]};
      if (cell == Corner{-1, -1}) {
        row.uniform[{0, 0}] += q_;
        add(row, a, -q_);
        add(row, b, -q_);
      } else if (horizontal) {
        add(row, {a[0], a[1] + side}, kSide);
        add(row, {b[0], b[1] + side}, kSide);
      } else {
        add(row, {a[0] + side, a[1]}, kSide);
        add(row, {b[0] + side, b[1]}, kSide);
      }
    }
    return row;
  }

  inline static const Rational kSide = Rational(3) / Rational(32);
  int k_;
  bool six_point_;
  Rational q_;
};

/// Doo and Sabin: (9, 3, 3, 1)/16 in a quad; in the k-gon (δ + (3 + 2 cos(2πd/k))/k)/4.
Row doo_sabin_row(int i, int j) {
  const int x = i / 2, y = j / 2, dx = i % 2 == 1 ? 1 : -1, dy = j % 2 == 1 ? 1 : -1;
  Row row;
  if (i == 0 && j == 0) return row;
  row.add(dual_place(x, y), Rational(9) / Rational(16));
  row.add(dual_place(x + dx, y), Rational(3) / Rational(16));
  row.add(dual_place(x, y + dy), Rational(3) / Rational(16));
  row.add(dual_place(x + dx, y + dy), Rational(1) / Rational(16));
  return row;
}

/// Bicubic B-splines: products of (1, 6, 1)/8 at vertices and (1, 1)/2 between them.
Row catmull_clark_row(int i, int j) {
  const auto line = [](int t) {
    std::vector<std::pair<int, Rational>> w;
    if (t % 2 == 0) {
      w = {{t / 2 - 1, Rational(1) / Rational(8)}, {t / 2, Rational(3) / Rational(4)}, {t / 2 + 1, Rational(1) / Rational(8)}};
    } else {
      w = {{t / 2, Rational(1) / Rational(2)}, {t / 2 + 1, Rational(1) / Rational(2)}};
    }
    return w;
  };
  Row row;
  for (const auto& [x, wx] : line(i)) {
    for (const auto& [y, wy] : line(j)) row.add(quad_place(x, y), wx * wy);
  }
  return row;
}

/// Loop's regular rules: (10, 1, …, 1)/16 at vertices, (3, 3, 1, 1)/8 on edges.
Row loop_row(int i, int j) {
  constexpr std::array<std::array<int, 2>, 6> kDirections = {{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
  const int x = i / 2, y = j / 2;
  Row row;
  const auto add = [&](int a, int b, int eighths_twice) { row.add(triangle_place(a, b), Rational(eighths_twice) / Rational(16)); };
  if (i % 2 == 0 && j % 2 == 0) {
    add(x, y, 10);
    for (const auto& d : kDirections) add(x + d[0], y + d[1], 1);
  } else if (j % 2 == 0) {
    add(x, y, 6), add(x + 1, y, 6), add(x, y + 1, 2), add(x + 1, y - 1, 2);
  } else if (i % 2 == 0) {
    add(x, y, 6), add(x, y + 1, 6), add(x + 1, y, 2), add(x - 1, y + 1, 2);
  } else {
    add(x + 1, y, 6), add(x, y + 1, 6), add(x, y, 2), add(x + 1, y + 1, 2);
  }
  return row;
}

/// Stores a row, and checks that it needs no vertex beyond those that there are.
void store(SubdivisionMatrix& m, std::size_t row, const Row& weights) {
  const auto column = [&](int i, int j) {
    const std::size_t c = m.index(i, j);
    if (c == m.size()) {
      throw InvalidInput("BadReach", "these vertices do not determine themselves", "(" + std::to_string(i) + ", " + std::to_string(j) + ")");
    }
    return c;
  };
  for (const auto& [p, w] : weights.local) {
    if (w.is_zero()) continue;
    if (m.has_centre && p.i == 0 && p.j == 0) m.centre_to[row] += w;
    else m.local.push_back({row, column(p.i, p.j), p.shift, w});
  }
  for (const auto& [p, w] : weights.uniform) {
    if (!w.is_zero()) m.uniform.push_back({row, column(p[0], p[1]), 0, w});
  }
}

void set_centre(SubdivisionMatrix& m, SpectrumScheme scheme) {
  m.centre_from.assign(m.size(), {});
  const Rational k(m.valence);
  if (scheme == SpectrumScheme::catmull_clark) {
    m.centre = {Rational(1) - Rational(7) / (Rational(4) * k)};
    m.centre_from[m.index(1, 0)] = {Rational(3) / (Rational(2) * k * k)};
    m.centre_from[m.index(1, 1)] = {Rational(1) / (Rational(4) * k * k)};
  } else {  // 1 − a and a/k with a = 5/8 − (3/8 + c/4)²
    const Polynomial square = product({Rational(3) / Rational(8), Rational(1) / Rational(4)}, {Rational(3) / Rational(8), Rational(1) / Rational(4)});
    const Polynomial a = difference({Rational(5) / Rational(8)}, square);
    m.centre = difference({Rational(1)}, a);
    m.centre_from[m.index(1, 0)] = scaled(a, Rational(1) / k);
  }
}

SectorLattice lattice_of(SpectrumScheme scheme) {
  return scheme == SpectrumScheme::loop            ? SectorLattice::triangles
         : scheme == SpectrumScheme::catmull_clark ? SectorLattice::quads
                                                   : SectorLattice::dual;
}

std::vector<std::array<int, 2>> sector_vertices(SectorLattice lattice, int reach) {
  std::vector<std::array<int, 2>> out;
  const int first = lattice == SectorLattice::dual ? 0 : 1, last = lattice == SectorLattice::dual ? reach - 1 : reach;
  for (int i = first; i <= last; ++i) {
    for (int j = 0; j <= (lattice == SectorLattice::triangles ? last - i : last); ++j) out.push_back({i, j});
  }
  return out;
}

}  // namespace

const char* name_of(SpectrumScheme scheme) noexcept {
  switch (scheme) {
    case SpectrumScheme::midedge: return "midedge";
    case SpectrumScheme::midedge6: return "midedge6";
    case SpectrumScheme::loop: return "loop";
    case SpectrumScheme::catmull_clark: return "catmull-clark";
    case SpectrumScheme::doo_sabin: break;
  }
  return "doo-sabin";
}

std::size_t SubdivisionMatrix::index(int i, int j) const noexcept {
  return static_cast<std::size_t>(std::find(vertices.begin(), vertices.end(), std::array<int, 2>{i, j}) - vertices.begin());
}

int ring_reach(SpectrumScheme scheme) noexcept { return scheme == SpectrumScheme::midedge6 ? 4 : 3; }

SubdivisionMatrix subdivision_matrix(SpectrumScheme scheme, int valence, int reach) {
  if (valence < 3) throw InvalidInput("BadValence", "a valence is at least 3", "valence " + std::to_string(valence));
  if (reach < 1) throw InvalidInput("BadReach", "a reach is at least 1", "reach " + std::to_string(reach));
  SubdivisionMatrix m;
  m.scheme = name_of(scheme);
  m.lattice = lattice_of(scheme);
  m.valence = valence;
  m.vertices = sector_vertices(m.lattice, reach);
  m.has_centre = m.lattice != SectorLattice::dual;
  m.centre_to.assign(m.size(), Rational());
  const MidedgeRows midedge(valence, scheme == SpectrumScheme::midedge6);
  for (std::size_t r = 0; r < m.size(); ++r) {
    const auto [i, j] = m.vertices[r];
    store(m, r,
          scheme == SpectrumScheme::loop            ? loop_row(i, j)
          : scheme == SpectrumScheme::catmull_clark ? catmull_clark_row(i, j)
          : scheme == SpectrumScheme::doo_sabin     ? doo_sabin_row(i, j)
                                                    : midedge.fine(i, j));
  }
  if (scheme == SpectrumScheme::doo_sabin) {
    m.local.push_back({0, 0, 0, Rational(1) / Rational(4)});
    m.uniform.push_back({0, 0, 0, Rational(3) / Rational(4 * valence)});
    m.harmonic.push_back({0, 0, 0, Rational(1) / Rational(2 * valence)});
  }
  if (m.has_centre) set_centre(m, scheme);
  return m;
}

bool reproduces_constants(const SubdivisionMatrix& matrix) {
  std::vector<Rational> sums(matrix.size());
  for (const SectorWeight& w : matrix.local) sums[w.row] += w.weight;
  for (const SectorWeight& w : matrix.uniform) sums[w.row] += Rational(matrix.valence) * w.weight;
  // Harmonic weights add up to 0 over the sectors.
  for (std::size_t r = 0; matrix.has_centre && r < sums.size(); ++r) sums[r] += matrix.centre_to[r];
  if (std::any_of(sums.begin(), sums.end(), [](const Rational& x) { return x != Rational(1); })) return false;
  if (!matrix.has_centre) return true;
  Polynomial centre = matrix.centre;
  for (const CosinePolynomial& p : matrix.centre_from) centre = sum(centre, scaled(p, Rational(matrix.valence)));
  return trimmed(difference(centre, {Rational(1)})).empty();
}

std::vector<CosinePolynomial> sector_block(const SubdivisionMatrix& matrix, int d) {
  const std::size_t n = matrix.size();
  const int k = matrix.valence;
  std::vector<CosinePolynomial> block(n * n);
  const auto add = [&](const SectorWeight& w, const Polynomial& p) {
    block[w.row * n + w.column] = sum(block[w.row * n + w.column], p);
  };
  for (const SectorWeight& w : matrix.local) {
    if ((w.shift - d) % k == 0) add(w, {w.weight});
  }
  for (const SectorWeight& w : matrix.uniform) add(w, {w.weight});
  Polynomial previous{Rational(1)}, chebyshev{Rational(0), Rational(1)};  // T_0, T_1
  for (int i = 0; i < ((d % k) + k) % k; ++i) {
    Polynomial next = difference(product({Rational(0), Rational(2)}, chebyshev), previous);
    previous = std::move(chebyshev);
    chebyshev = std::move(next);
  }
  for (const SectorWeight& w : matrix.harmonic) add(w, scaled(previous, w.weight));
  return block;
}

}  // namespace hexact
