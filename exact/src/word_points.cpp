// SPDX-License-Identifier: LGPL-3.0-or-later
#include "word_points.hpp"

#include "plane_determinants.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hexact::detail {
namespace {

using Wide = __int128;
constexpr int kNormalBits = 40;
constexpr std::size_t kOffsetBits = 123;
constexpr double kUnit = 0x1p-60;

std::optional<WordPlane> from_row(const Row& p) {
  const int zeros = (normal_spread(p) >> kNormalBits) == 0
                        ? 0
                        : std::countr_zero(static_cast<std::uint64_t>(p[0]) | static_cast<std::uint64_t>(p[1]) |
                                           static_cast<std::uint64_t>(p[2]));
  if (zeros > kFineBits) return std::nullopt;
  const WordPlane plane{{p[0] >> zeros, p[1] >> zeros, p[2] >> zeros}, Wide(p[3]) << (kFineBits - zeros)};
  if (((spread(plane.n[0]) | spread(plane.n[1]) | spread(plane.n[2])) >> kNormalBits) != 0) return std::nullopt;
  return plane;
}

/// Precondition: at most 127 bits.
Wide to_wide(const Integer& x) {
  const auto magnitude = (static_cast<unsigned __int128>(mpz_getlimbn(x.raw(), 1)) << 64) | mpz_getlimbn(x.raw(), 0);
  return x.sign() < 0 ? -static_cast<Wide>(magnitude) : static_cast<Wide>(magnitude);
}

std::optional<WordPlane> from_integers(const Plane<Integer>& p) {
  mp_bitcnt_t zeros = kFineBits;
  std::size_t bits = 0;
  for (const Integer* x : {&p.a, &p.b, &p.c}) {
    if (x->is_zero()) continue;
    zeros = std::min(zeros, mpz_scan1(x->raw(), 0));
    bits = std::max(bits, x->bit_length());
  }
  const std::size_t shift = kFineBits - zeros;
  if (bits - zeros > kNormalBits || p.d.bit_length() + shift > kOffsetBits) return std::nullopt;
  const auto entry = [&](const Integer& x) {
    Integer quotient;
    mpz_tdiv_q_2exp(quotient.raw(), x.raw(), zeros);
    return quotient.to_int64();
  };
  return WordPlane{{entry(p.a), entry(p.b), entry(p.c)}, to_wide(p.d) << shift};
}

}  // namespace

std::optional<WordPlane> word_plane(const IntegerPlanes& planes, std::size_t f) {
  return planes.is_narrow(f) ? from_row(planes.narrow(f)) : from_integers(planes.wide(f));
}

std::optional<FinePoint> meet_in_words(const std::array<WordPlane, 3>& planes, const Point3<double>& guess) {
  if (!(std::fabs(guess.x) < 0x1p19 && std::fabs(guess.y) < 0x1p19 && std::fabs(guess.z) < 0x1p19)) return std::nullopt;
  double cross[3][3];
  Wide det = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &u = planes[(i + 1) % 3].n, &v = planes[(i + 2) % 3].n, &n = planes[i].n;
    const Wide exact[3] = {Wide(u[1]) * v[2] - Wide(u[2]) * v[1], Wide(u[2]) * v[0] - Wide(u[0]) * v[2],
                           Wide(u[0]) * v[1] - Wide(u[1]) * v[0]};
    for (int k = 0; k < 3; ++k) cross[i][k] = static_cast<double>(exact[k]);
    if (i == 0) det = exact[0] * n[0] + exact[1] * n[1] + exact[2] * n[2];
  }
  if (det <= 0) return std::nullopt;
  const double inverse = 1 / static_cast<double>(det);
  const auto to_fine = [](double x) { return static_cast<Wide>(x / kUnit); };
  FinePoint p{{to_fine(guess.x), to_fine(guess.y), to_fine(guess.z)}};
  for (int round = 0; round < 6; ++round) {
    double step[3] = {0, 0, 0}, terms = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& n = planes[i].n;
      const Wide exact = planes[i].d - p.at[0] * n[0] - p.at[1] * n[1] - p.at[2] * n[2];
      const double residual = static_cast<double>(exact) * inverse;
      for (int k = 0; k < 3; ++k) {
        step[k] += residual * cross[i][k];
        terms += std::fabs(residual * cross[i][k]);
      }
    }
    const double error = std::fabs(step[0]) + std::fabs(step[1]) + std::fabs(step[2]) + 0x1p-49 * terms;
    if (error < 2) return p;
    if (!(error < 0x1p79)) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) {
      // Where doubles have no fractions any more, a step is rounded toward zero as it is.
      p.at[k] += std::fabs(step[k]) < 0x1p52 ? static_cast<Wide>(std::llrint(step[k])) : static_cast<Wide>(step[k]);
      if (p.at[k] < -(Wide(1) << 79) || p.at[k] > (Wide(1) << 79)) return std::nullopt;
    }
  }
  return std::nullopt;
}

Point3<double> to_double(const FinePoint& p) {
  return {static_cast<double>(p.at[0]) * kUnit, static_cast<double>(p.at[1]) * kUnit, static_cast<double>(p.at[2]) * kUnit};
}

}  // namespace hexact::detail
