// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/characteristic_ring.hpp"

#include "bernstein_ring.hpp"
#include "midedge_ring.hpp"

#include <algorithm>

namespace hexact {
namespace {

constexpr int kLastLevel = 7;

/// Control points of a cell far from the extraordinary one must lie in one sector and its neighbours.
int first_level(SpectrumScheme scheme) { return scheme == SpectrumScheme::midedge6 ? 3 : 1; }

/// Where the search for a level begins: the levels at which the proof succeeds with a margin (0.2 and more).
int good_level(SpectrumScheme scheme, int valence) {
  if (scheme == SpectrumScheme::midedge) return 3;
  return valence <= 5 ? 5 : valence <= 15 ? 3 : 4;
}

std::array<double, 2> midpoint(const ComplexInterval& p) {
  return {p.re.middle().lower_double(), p.im.middle().lower_double()};
}

/// De Casteljau's evaluation, once per direction; pictures only.
std::array<double, 2> point_of(const BernsteinPiece& p, double x, double y) {
  std::vector<std::vector<std::array<double, 2>>> b;
  for (int i = 0; i <= p.degree; ++i) {
    b.emplace_back();
    for (int j = 0; j <= (p.triangle ? p.degree - i : p.degree); ++j) b.back().push_back(midpoint(p.at(i, j)));
  }
  const auto blend = [](const std::array<double, 2>& u, const std::array<double, 2>& v, double t) {
    return std::array<double, 2>{u[0] + t * (v[0] - u[0]), u[1] + t * (v[1] - u[1])};
  };
  for (std::size_t d = static_cast<std::size_t>(p.degree); d > 0; --d) {
    for (std::size_t i = 0; i < d; ++i) {
      for (std::size_t j = 0; j < (p.triangle ? d - i : d); ++j) {
        if (p.triangle) {
          for (std::size_t c = 0; c < 2; ++c) b[i][j][c] = (1 - x - y) * b[i][j][c] + x * b[i + 1][j][c] + y * b[i][j + 1][c];
        } else {
          b[i][j] = blend(blend(b[i][j], b[i + 1][j], x), blend(b[i][j + 1], b[i + 1][j + 1], x), y);
        }
      }
    }
  }
  return b[0][0];
}

/// The lines of a piece and their mirror images.
void add_lines(RingLines& lines, const BernsteinPiece& p) {
  constexpr int kLines = 4, kPoints = 24;
  for (int i = 0; i <= kLines; ++i) {
    const double t = static_cast<double>(i) / kLines, end = p.triangle ? 1 - t : 1;
    for (const bool along_x : {true, false}) {
      std::vector<std::array<double, 2>> line, mirrored;
      for (int j = 0; j <= kPoints; ++j) {
        const double u = end * j / kPoints;
        line.push_back(along_x ? point_of(p, u, t) : point_of(p, t, u));
        mirrored.push_back({line.back()[0], -line.back()[1]});
      }
      lines.push_back(std::move(line));
      lines.push_back(std::move(mirrored));
    }
  }
}

/// Rows and columns of the control net of the ring, which is near the surface after these double steps.
void add_lines(RingLines& lines, const RefinedNet& net, int level) {
  const int n = 1 << level, stride = std::max(1, n / 16);
  for (int i = 0; i < n; i += stride) {
    std::vector<std::array<double, 2>> line, mirrored;
    for (int j = i < n / 2 ? n / 2 : 0; j <= n; ++j) {
      line.push_back(midpoint(net.at(j, i)));
      mirrored.push_back({line.back()[0], -line.back()[1]});
    }
    lines.push_back(std::move(line));
    lines.push_back(std::move(mirrored));
  }
}

}  // namespace

bool is_bspline_scheme(SpectrumScheme scheme) noexcept {
  return scheme != SpectrumScheme::midedge && scheme != SpectrumScheme::midedge6;
}

RingProof prove_ring(SpectrumScheme scheme, const SubdivisionMatrix& matrix, const RationalInterval& eigenvalue, std::optional<int> level) {
  const auto net = characteristic_net(matrix, eigenvalue);
  if (!net) return {Verdict::undecided, 0, {}, {}, "the eigenvector of mode 1 is not certain to be unique"};
  if (is_bspline_scheme(scheme)) return prove_bernstein_ring(ring_pieces(scheme, *net));
  if (level && (*level < first_level(scheme) || *level > kLastLevel)) {
    return {Verdict::undecided, *level, {}, {}, "there is no proof at this level"};
  }
  RingProof proof;
  const int first = level.value_or(good_level(scheme, matrix.valence)), last = level.value_or(kLastLevel);
  for (int l = first; l <= last && proof.verdict != Verdict::proved; ++l) {
    proof = prove_midedge_ring(scheme, refined_net(scheme, matrix, *net, eigenvalue, l), l);
  }
  return proof;
}

RingLines ring_lines(SpectrumScheme scheme, const SubdivisionMatrix& matrix, const RationalInterval& eigenvalue) {
  RingLines lines;
  const auto net = characteristic_net(matrix, eigenvalue);
  if (!net) return lines;
  if (!is_bspline_scheme(scheme)) {
    constexpr int kLevel = 5;
    add_lines(lines, refined_net(scheme, matrix, *net, eigenvalue, kLevel), kLevel);
  } else {
    for (const BernsteinPiece& p : ring_pieces(scheme, *net)) add_lines(lines, p);
  }
  return lines;
}

}  // namespace hexact
