// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/snapped_honeycomb.hpp"
#include "homogeneous.hpp"
#include "word_points.hpp"

#include <array>
#include <optional>

// How one cut plane is chosen: in floating point, in 128-bit words, or in fixed point of growing precision, with proven error bounds.
namespace hexact::detail {

/// Half-width of the working range is 2^18; with 22-bit normals all certificate signs fit 128-bit sums.
constexpr int kRangeBits = 18;
constexpr int kShortNormal = 22;
/// Widest normal that 128-bit words deal with.
constexpr int kWordNormal = 40;
/// Fewest bits by which rounding has to stay below the depth of the cut before a plane is widened.
constexpr int kLeastGuard = 6;
/// A realised parameter that differs by more from the asked one is not accepted.
constexpr double kLargestChange = 1.0 / 64;

/// What is known in floating point about a vertex v, its neighbours and the asked parameters (rounded up).
struct CornerInDoubles {
  Point3<double> v;
  std::array<Point3<double>, 3> w;
  std::array<double, 3> lambda;
  double error;  ///< bound of |approximate − exact| for all four points
};

/// What a cut plane realises.
struct CutFigures {
  double change;         ///< upper bound of λ realised − λ asked
  double min_parameter;  ///< lower bound of the realised parameters
};

struct CutChoice {
  IntegerPlanes::Narrow plane;
  CutFigures figures;
};

/// The cut plane, proved in floating point: v is strictly beyond it, no neighbour is cut off further than asked.
/// nullopt where doubles cannot tell, or the plane would be too wide for 62 bits.
[[nodiscard]] std::optional<CutChoice> cut_in_doubles(const CornerInDoubles& corner, int guard_bits);

struct WideChoice {
  Plane<Integer> plane;
  CutFigures figures;
  int normal_bits;
};

/// The corner in 128-bit fixed point; asked parameters in floating point, rounded up.
struct FineCorner {
  FinePoint v;
  std::array<FinePoint, 3> w;
  std::array<double, 3> lambda;
};
/// The same proof with coordinates about v, for cuts that doubles cannot tell from none. nullopt where that does not
/// suffice either.
[[nodiscard]] std::optional<WideChoice> cut_in_words(const FineCorner& corner, int guard_bits);

/// The exact corner: points in homogeneous integers, asked parameters as rationals.
struct ExactCorner {
  HomogeneousPoint v;
  std::array<HomogeneousPoint, 3> w;
  std::array<Rational, 3> lambda;
};
/// The same in fixed point of as many bits as it takes; ends because v is strictly beyond the asked plane.
/// Widths follow the local feature size (distance over depth) with `guard_bits` to spare.
/// Precondition: the asked parameters satisfy condition (1), v is not coplanar with its neighbours.
[[nodiscard]] WideChoice cut_in_fixed_point(const ExactCorner& corner, int guard_bits);

}  // namespace hexact::detail
