// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "fixed_interval.hpp"
#include "hexact/exact/midedge_boundary_limit.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace hexact::detail {

inline constexpr std::size_t kNet = 9;  ///< vertices of a sector

template <class T>
using NetVector = std::array<Complex<T>, kNet>;
template <class T>
using NetMatrix = std::array<NetVector<T>, kNet>;

/// A facet with a surrounding of quadrilaterals, two deep wherever the pattern has inner sides and corners: as much as
/// fixes the same surrounding one double step later. The facet is number 0.
[[nodiscard]] MidedgeMap midedge_patch(const MidedgeBoundaryPattern& pattern);

/// Blocks of the two-step operator around a k-gon: [d][r][c] is the weight of coarse vertex c of sector d in fine vertex
/// r of sector 0. Taken from a double step of the six-point rule on unit data.
[[nodiscard]] std::vector<std::array<std::array<Rational, kNet>, kNet>> two_step_blocks(std::uint32_t k);

/// Left eigenvector of Σ_d ω^d D_d, ω = e^(2πi/k), with first entry 1, and its eigenvalue, the largest of the mode.
template <class T>
struct LeftEigenvector {
  T eigenvalue;
  NetVector<T> entries;
};
/// Over intervals, for any k. Throws NumericalFailure where the intervals are too wide to prove what is needed.
[[nodiscard]] LeftEigenvector<FixedInterval> enclosed_left_eigenvector(std::uint32_t k);
/// Exactly, for k = 4.
[[nodiscard]] LeftEigenvector<Rational> exact_left_eigenvector();

/// cos and sin of 2πm/k.
[[nodiscard]] Complex<FixedInterval> root_of_unity(std::uint32_t m, std::uint32_t k);

}  // namespace hexact::detail
