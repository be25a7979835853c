// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

// Sample solids that are not convex, with planar facets and three facets at every vertex.
namespace hexact::detail {

/// Prisms of height 2 over an L, a U and a star with four points; one, two and four concave edges.
[[nodiscard]] PolygonSoup<Rational> l_prism();
[[nodiscard]] PolygonSoup<Rational> u_prism();
[[nodiscard]] PolygonSoup<Rational> star_prism();
/// A square block with a square hole, genus 1: 16 hexagons. Its top and bottom are roofs over |x| + |y|, so that the
/// ring is made of four L-shaped hexagons that meet in the planes x = 0 and y = 0, and every vertex has three facets.
[[nodiscard]] PolygonSoup<Rational> frame();

}  // namespace hexact::detail
