// SPDX-License-Identifier: LGPL-3.0-or-later
#include "locate_vertex.hpp"

#include "homogeneous.hpp"
#include "instruction_sets.hpp"
#include "plane_determinants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexact::detail {
namespace {

/// A float above the bound: the conversion is off by at most 2^-24 of it (bounds here are far from underflow).
float upward(double bound) { return static_cast<float>(bound * (1 + 0x1p-22)); }

Located locate_exactly(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h) {
  const auto m = oriented_meet(planes[f], planes[g], planes[h]);
  if (m.w.is_zero()) return {{0, 0, 0}, std::numeric_limits<float>::infinity()};
  // Three coordinates below 2^19 in magnitude, each rounded down to a multiple of 2^-34: off by less than 2^-33.
  const auto coordinate = [&](const Integer& x) {
    return std::ldexp(mpz_get_d(floor_quotient(x.shifted_left(34), m.w).raw()), -34);
  };
  const bool proper = m.w.sign() > 0;
  return {{coordinate(m.x), coordinate(m.y), coordinate(m.z)}, proper ? 0x1p-33f : std::numeric_limits<float>::infinity()};
}

/// Multiples of 2^-34, in which coordinates below 2^19 are exact in floating point.
constexpr double kGrid = 0x1p34;

/// Iterative refinement for corners too flat for doubles: residuals of a point of the grid, cross products and the
/// determinant are exact in 128 bits (normals below 2^40, offsets below 2^62), so that a correction is known to 2^-49
/// of its terms. Falls back on big integers when the bound that remains is above two steps of the grid.
Located locate_in_words(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h, const Point3<double>& x) {
  using Wide = __int128;
  const Row* n[3] = {&planes.narrow(f), &planes.narrow(g), &planes.narrow(h)};
  const std::uint64_t spread = normal_spread(*n[0]) | normal_spread(*n[1]) | normal_spread(*n[2]);
  const bool in_range = std::fabs(x.x) < 0x1p19 && std::fabs(x.y) < 0x1p19 && std::fabs(x.z) < 0x1p19;
  if ((spread >> 40) != 0 || !in_range) return locate_exactly(planes, f, g, h);
  double cross[3][3];
  Wide det = 0;
  for (int i = 0; i < 3; ++i) {
    const Row &u = *n[(i + 1) % 3], &v = *n[(i + 2) % 3];
    const Wide exact[3] = {Wide(u[1]) * v[2] - Wide(u[2]) * v[1], Wide(u[2]) * v[0] - Wide(u[0]) * v[2],
                           Wide(u[0]) * v[1] - Wide(u[1]) * v[0]};
    for (int k = 0; k < 3; ++k) cross[i][k] = static_cast<double>(exact[k]);
    if (i == 0) det = exact[0] * (*n[0])[0] + exact[1] * (*n[0])[1] + exact[2] * (*n[0])[2];
  }
  if (det <= 0) return locate_exactly(planes, f, g, h);
  const double inverse = 1 / static_cast<double>(det);
  std::int64_t at[3] = {std::llrint(x.x * kGrid), std::llrint(x.y * kGrid), std::llrint(x.z * kGrid)};
  for (int round = 0; round < 4; ++round) {
    double step[3] = {0, 0, 0}, terms = 0;
    for (int i = 0; i < 3; ++i) {
      const Row& p = *n[i];
      const Wide exact = (Wide(p[3]) << 34) - Wide(p[0]) * at[0] - Wide(p[1]) * at[1] - Wide(p[2]) * at[2];
      const double residual = static_cast<double>(exact) * inverse;
      for (int k = 0; k < 3; ++k) {
        step[k] += residual * cross[i][k];
        terms += std::fabs(residual * cross[i][k]);
      }
    }
    const double error = std::fabs(step[0]) + std::fabs(step[1]) + std::fabs(step[2]) + 0x1p-49 * terms;
    if (error < 2) {
      const auto coordinate = [&](int k) { return static_cast<double>(at[k]) / kGrid; };
      return {{coordinate(0), coordinate(1), coordinate(2)}, 0x1p-33f};
    }
    if (!(error < 0x1p53)) break;
    constexpr std::int64_t kEnd = std::int64_t{1} << 53;
    for (int k = 0; k < 3; ++k) at[k] = std::clamp<std::int64_t>(at[k] + std::llrint(step[k]), -kEnd, kEnd);
  }
  return locate_exactly(planes, f, g, h);
}

bool has_exact_normal(const Row& p) { return (normal_spread(p) >> 53) == 0; }

double norm1(const double* n) { return std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]); }

}  // namespace

HEXACT_FOR_EACH_INSTRUCTION_SET
Located locate(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h, Point3<double> x) {
  if (!planes.is_narrow(f) || !planes.is_narrow(g) || !planes.is_narrow(h)) return locate_exactly(planes, f, g, h);
  const Row* rows[3] = {&planes.narrow(f), &planes.narrow(g), &planes.narrow(h)};
  if (!has_exact_normal(*rows[0]) || !has_exact_normal(*rows[1]) || !has_exact_normal(*rows[2])) {
    return locate_exactly(planes, f, g, h);
  }
  double n[3][4], low[3];  // offsets of up to 62 bits as a sum of two doubles
  for (int i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) n[i][k] = static_cast<double>((*rows[i])[k]);
    low[i] = static_cast<double>((*rows[i])[3] - static_cast<std::int64_t>(n[i][3]));
  }
  double cross[3][3];
  for (int i = 0; i < 3; ++i) {
    const double *u = n[(i + 1) % 3], *v = n[(i + 2) % 3];
    cross[i][0] = u[1] * v[2] - u[2] * v[1];
    cross[i][1] = u[2] * v[0] - u[0] * v[2];
    cross[i][2] = u[0] * v[1] - u[1] * v[0];
  }
  const double det = n[0][0] * cross[0][0] + n[0][1] * cross[0][1] + n[0][2] * cross[0][2];
  const double inverse = 1 / det;
  double r[3];
  for (int i = 0; i < 3; ++i) r[i] = (n[i][3] - n[i][0] * x.x - n[i][1] * x.y - n[i][2] * x.z) + low[i];
  x.x += inverse * (r[0] * cross[0][0] + r[1] * cross[1][0] + r[2] * cross[2][0]);
  x.y += inverse * (r[0] * cross[0][1] + r[1] * cross[1][1] + r[2] * cross[2][1]);
  x.z += inverse * (r[0] * cross[0][2] + r[1] * cross[1][2] + r[2] * cross[2][2]);
  const double length[3] = {norm1(n[0]), norm1(n[1]), norm1(n[2])};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double tx = n[i][0] * x.x, ty = n[i][1] * x.y, tz = n[i][2] * x.z;
    const double left = std::fabs((n[i][3] - tx - ty - tz) + low[i]);
    const double rounding = 0x1.8p-51 * (std::fabs(tx) + std::fabs(ty) + std::fabs(tz) + std::fabs(n[i][3]));
    sum += (left + rounding) * (norm1(cross[i]) + 0x1p-50 * length[(i + 1) % 3] * length[(i + 2) % 3]);
  }
  // The computed determinant is off by less than 2^-49 |n₁||n₂||n₃|; where that is below 2^-9 of it, 1/det is at most
  // (1 + 2^-8) times what was computed.
  const bool det_is_known = 0x1p-40 * length[0] * length[1] * length[2] < det;
  const double bound = sum * inverse * (1 + 0x1p-7);
  if (!det_is_known || !(bound < 0x1p-18)) return locate_in_words(planes, f, g, h, x);
  return {x, upward(bound)};
}

}  // namespace hexact::detail
