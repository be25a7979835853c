// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/prepare.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hexact {

/// A sample without parameters.
struct SampleName {
  std::string name;
  std::string description;
};
/// All names that `sample_solid` knows.
[[nodiscard]] const std::vector<SampleName>& sample_names();

/// A sample by name. Regular solids are centred at the origin; those of the reference data have its vertex and facet
/// order. `torus` and `saddle` are meshes of hexagons that are not planar, phs (g), Figures 34 and 35.
/// Throws InvalidInput (UnknownSample).
[[nodiscard]] ExactSoup sample_solid(const std::string& name);

/// The prism over a convex n-gon inscribed in the unit circle, of height 2. Its corners are points of the circle with
/// rational coordinates beside those of the regular n-gon, which they are for n = 4; symmetric to both axes for even n.
/// Precondition: 3 <= n <= 100000.
[[nodiscard]] PolygonSoup<Rational> prism(std::size_t n);

/// m × n quadrilaterals over the squares of the integer grid, at heights from 0 to 3/2 that repeat with period 4; open.
/// Precondition: m, n >= 1, m · n <= 1000000.
[[nodiscard]] PolygonSoup<Rational> grid(std::size_t m, std::size_t n);

/// Part of a saddle with exactly planar facets: 19 hexagons, each with two reflex corners, on tangent planes of
/// z = (x² − y²)/16 at the points of a lattice; three planes meet at every vertex. It has a boundary, whose vertices lie
/// on planes without facets: the tangent planes at the 18 points around.
[[nodiscard]] PlaneBody planar_saddle();

/// A convex polyhedron with exactly n facets and three at every vertex: the intersection of n half-spaces with small
/// integers, about tangent to the sphere of radius 100 around the origin, drawn with splitmix64 from `seed`. The same
/// everywhere: only integers decide. Facets are ordered as drawn.
/// Precondition: 4 <= n <= 100000. Cost: O(n log n) expected.
[[nodiscard]] PolygonSoup<Rational> random_solid(std::size_t n, std::uint64_t seed);

}  // namespace hexact
