// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/subdivision_matrix.hpp"

#include "exact/spectrum_golden.hpp"
#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

namespace hexact {
namespace {

constexpr SpectrumScheme kSchemes[] = {SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop,
                                       SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin};

double at_cosine(const CosinePolynomial& p, int k) {
  double v = 0;
  for (std::size_t i = p.size(); i-- > 0;) v = v * std::cos(2 * M_PI / k) + p[i].to_double();
  return v;
}

std::map<std::array<int, 2>, Rational> regular_row(SpectrumScheme scheme) {
  const SubdivisionMatrix m = subdivision_matrix(scheme, 4, 6);
  std::map<std::array<int, 2>, Rational> row;
  for (const SectorWeight& w : m.local) {
    if (w.row == m.index(3, 3)) {
      CHECK(w.shift == 0);
      row[m.vertices[w.column]] += w.weight;
    }
  }
  return row;
}

}  // namespace

TEST_CASE("the blocks of two six-point Midedge steps are the golden ones", "[spectrum]") {
  const auto& golden = test::midedge_golden()["S2"];
  for (int k = 3; k <= 6; ++k) {
    const SubdivisionMatrix m = subdivision_matrix(SpectrumScheme::midedge6, k, 3);
    const auto& blocks = golden[std::to_string(k)];
    std::vector<std::size_t> order;
    for (const auto& p : golden["local_order"]) order.push_back(m.index(p[0], p[1]));
    for (int d = 0; d < k; ++d) {
      const auto block = sector_block(m, d);
      for (std::size_t r = 0; r < 9; ++r) {
        for (std::size_t c = 0; c < 9; ++c) {
          const CosinePolynomial& p = block[order[r] * 9 + order[c]];
          REQUIRE(p.size() <= 1);
          const Rational expected = test::rational(blocks[static_cast<std::size_t>(d)][r][c]);
          CHECK((p.empty() ? Rational() : p[0]) == expected);
        }
      }
    }
  }
}

TEST_CASE("two steps far from the k-gon have the sixteen weights of equation (7)", "[spectrum]") {
  const auto& masks = test::midedge_golden()["masks"];
  auto six = regular_row(SpectrumScheme::midedge6), simple = regular_row(SpectrumScheme::midedge);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      CHECK(six[{i, j}] * Rational(1024) == Rational(masks["two_step_mask_times_1024"][i][j].get<int>()));
      CHECK(simple[{i, j}] * Rational(4) == Rational(masks["two_step_mask_simple_times_4"][i][j].get<int>()));
    }
  }
}

TEST_CASE("masks of a difference have no negative weight, so derivatives are convex combinations of differences", "[spectrum]") {
  for (const SpectrumScheme scheme : {SpectrumScheme::midedge, SpectrumScheme::midedge6}) {
    const auto row = regular_row(scheme);
    // The fine vertex t stands in coarse coordinates at (t + 1/2)/2, with the weights of (3, 3) or their mirror images.
    const auto weight = [&](int t, int u, int i, int j) {
      const int a = t % 2 == 1 ? i - t / 2 + 1 : t / 2 + 1 - i, b = u % 2 == 1 ? j - u / 2 + 1 : u / 2 + 1 - j;
      const auto w = row.find({a, b});
      return w == row.end() ? Rational() : w->second;
    };
    for (const int t : {6, 7}) {
      for (const int u : {6, 7}) {
        Rational total;
        for (int j = 0; j < 10; ++j) {
          Rational sum;  // fine difference = Σ_i sum_i · (coarse vertex i+1 − coarse vertex i)
          for (int i = 0; i < 10; ++i) {
            sum += weight(t, u, i, j) - weight(t + 1, u, i, j);
            CHECK(sum.sign() >= 0);
            total += sum;
          }
          CHECK(sum.is_zero());
        }
        CHECK(total == Rational(1) / Rational(2));
      }
    }
  }
}

TEST_CASE("rows sum to 1, weights are not negative, and sectors have mirror images", "[spectrum]") {
  for (const SpectrumScheme scheme : kSchemes) {
    for (const int k : {3, 4, 5, 6, 7, 12}) {
      const SubdivisionMatrix m = subdivision_matrix(scheme, k, ring_reach(scheme));
      const std::size_t n = m.size();
      std::vector<double> sums(n);
      std::vector<std::vector<CosinePolynomial>> blocks;
      for (int d = 0; d < k; ++d) blocks.push_back(sector_block(m, d));
      // The mirror image of (i, j) in sector s is (j, i) in sector −s; on an axis of a primal lattice (i, 0) in −s.
      const bool dual = m.lattice == SectorLattice::dual;
      const auto mirror = [&](std::size_t v) {
        const auto [i, j] = m.vertices[v];
        return std::pair(dual || j > 0 ? m.index(j, i) : v, dual || j > 0 ? -1 : 0);
      };
      for (std::size_t r = 0; r < n; ++r) {
        for (int d = 0; d < k; ++d) {
          for (std::size_t c = 0; c < n; ++c) {
            const double w = at_cosine(blocks[static_cast<std::size_t>(d)][r * n + c], k);
            CHECK(w >= 0);
            sums[r] += w;
            const auto [mr, sr] = mirror(r);
            const auto [mc, sc] = mirror(c);
            const int md = (((sc - d) - sr) % k + k) % k;
            CHECK(at_cosine(blocks[static_cast<std::size_t>(md)][mr * n + mc], k) == Approx(w).margin(1e-15));
          }
        }
        if (m.has_centre) sums[r] += m.centre_to[r].to_double();
        CHECK(sums[r] == Approx(1));
      }
      if (!m.has_centre) continue;
      double centre = at_cosine(m.centre, k);
      for (const CosinePolynomial& p : m.centre_from) centre += k * at_cosine(p, k);
      CHECK(centre == Approx(1));
    }
  }
}

TEST_CASE("the vertices behind the third ring add a block of norm 36/1024 at most", "[spectrum]") {
  for (const int k : {3, 4, 5, 8, 12, 31, 50}) {
    const SubdivisionMatrix m = subdivision_matrix(SpectrumScheme::midedge6, k, 4);
    std::vector<Rational> sums(m.size());
    Rational largest;
    for (const SectorWeight& w : m.local) {
      const bool outer_row = std::max(m.vertices[w.row][0], m.vertices[w.row][1]) == 3;
      const bool outer_column = std::max(m.vertices[w.column][0], m.vertices[w.column][1]) == 3;
      CHECK((outer_row || !outer_column));  // split off triangularly
      if (outer_row && outer_column) sums[w.row] += abs(w.weight);
    }
    for (const Rational& s : sums) largest = std::max(largest, s);
    CHECK(largest == Rational(36) / Rational(1024));
  }
}

TEST_CASE("matrices that do not exist are refused", "[spectrum]") {
  CHECK_THROWS_AS(subdivision_matrix(SpectrumScheme::loop, 2, 3), InvalidInput);
  CHECK_THROWS_AS(subdivision_matrix(SpectrumScheme::midedge6, 5, 2), InvalidInput);
  CHECK_THROWS_AS(subdivision_matrix(SpectrumScheme::midedge6, 5, 0), InvalidInput);
  CHECK_NOTHROW(subdivision_matrix(SpectrumScheme::midedge6, 5, 3));
  CHECK_NOTHROW(subdivision_matrix(SpectrumScheme::midedge, 5, 2));
}

}  // namespace hexact
