// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/cut_policy.hpp"
#include "hexact/exact/plane_body.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hexact {

/// Which numbers a refinement is computed with.
enum class Arithmetic { snapped, rational, qsqrt5, floating };

/// Gives the policy of each level; the map is that of the level to be cut.
using PolicySchedule = std::function<CutPolicy(const HoneycombMap&)>;

/// static: phs (c.1); β₅ exact under qsqrt5, 11/97 otherwise.
[[nodiscard]] SizePolicy static_policy(Arithmetic arithmetic);
/// equal-u: phs (c.3) with N₀ = max(6, largest facet); irrational values become the nearest multiple of 2⁻⁴⁰.
[[nodiscard]] SizePolicy equal_u_policy(std::size_t largest_facet);
/// One λ by size of the smaller facet. Sizes that are not listed take the entry of the next smaller listed size,
/// sizes below the first the first. Precondition: not empty.
[[nodiscard]] SizePolicy constant_policy(const std::map<std::size_t, QuadraticField>& by_size);

/// random=SEED: each edge draws λ = lo + (1/2 − lo)·k/256 with lo = 1/3 where a triangle is beside it and 0
/// elsewhere, k = 1 + mixed mod 255. mixed = s(s(s(seed) ^ level) ^ rank): s is the finaliser of splitmix64 (its
/// argument plus 0x9e3779b97f4a7c15, two xor-shift-multiplies, one xor-shift), level that of the map, rank the
/// position of the edge in the lexicographic order of (smaller vertex, larger vertex).
[[nodiscard]] HalfEdgePolicy random_policy(const HoneycombMap& map, std::uint64_t seed);
/// Rank of each half-edge's edge in the lexicographic order of (smaller, larger vertex). Cost: linear.
[[nodiscard]] std::vector<std::uint32_t> edge_ranks(const HoneycombMap& map);

/// An ellipsoid {centre + A·u : |u| <= 1} given by Q = A·Aᵀ, so that its support function is n·centre + √(nᵀQn).
struct Ellipsoid {
  std::array<double, 3> centre{};
  std::array<std::array<double, 3>, 3> q{};
  [[nodiscard]] double support(const std::array<double, 3>& n) const;
};
/// The plane at v has the sum of the unit normals of its three facets as normal and touches the ellipsoid.
/// The body is a choice, not a claim.
[[nodiscard]] PlanePolicy tangent_policy(const Ellipsoid& ellipsoid);
/// Least-squares sphere touching the facet planes of a body, shrunk until it lies inside all of them.
/// Throws NumericalFailure when there is none.
[[nodiscard]] Ellipsoid fitted_sphere(const PlaneBody& body);
/// Least-squares ellipsoid about the mean of the vertices, shrunk until it lies inside all facet planes.
/// Throws NumericalFailure when fewer than six facets, or no ellipsoid, determine one.
[[nodiscard]] Ellipsoid fitted_ellipsoid(const PlaneBody& body);

/// The policy that a text names: static, equal-u, constant=B, constant=3:2/5,4:1/4,6:0, random=SEED,
/// tangent=sphere, tangent=ellipsoid. Numbers are decimals or p/q (and p/q+r/s*sqrt5 under qsqrt5).
/// Throws InvalidInput (BadParameters) for any other text; files are read in io.
[[nodiscard]] PolicySchedule parse_policy(std::string_view text, Arithmetic arithmetic, const PlaneBody& base);

}  // namespace hexact
