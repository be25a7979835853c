// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <array>
#include <cstdint>
#include <optional>

// Points of three planes in 128-bit fixed point: what doubles cannot tell apart near collapsing edges, without big integers.
namespace hexact::detail {

/// Coordinates here are multiples of 2^-60; bodies lie in [−2^19, 2^19]³, so that they need 80 bits.
constexpr int kFineBits = 60;

/// The half-space n·x <= d·2^-60 with |n| < 2^40 in each entry and |d| < 2^123.
struct WordPlane {
  std::array<std::int64_t, 3> n;
  __int128 d;
};
/// Plane f in this form, common powers of two of its normal taken out; nullopt where it does not fit.
[[nodiscard]] std::optional<WordPlane> word_plane(const IntegerPlanes& planes, std::size_t f);

/// A point in multiples of 2^-60, within two units (sum over the coordinates) of the exact one.
struct FinePoint {
  std::array<__int128, 3> at;
};
/// The point of three planes by iterative refinement of a guess: residuals, cross products and the determinant are
/// exact in 128 bits, so that a correction is known to 2^-49 of its terms. A result also says that the determinant of
/// the normals is positive. nullopt where the guess is out of range, the determinant is not positive, or the corner
/// is too flat to come within two units.
[[nodiscard]] std::optional<FinePoint> meet_in_words(const std::array<WordPlane, 3>& planes, const Point3<double>& guess);

/// The double nearest to each coordinate, off by at most 2^-34 while coordinates are below 2^19.
[[nodiscard]] Point3<double> to_double(const FinePoint& p);

}  // namespace hexact::detail
