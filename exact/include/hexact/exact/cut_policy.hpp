// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/quadratic_field.hpp"
#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/honeycomb_map.hpp"

#include <array>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

namespace hexact {

/// One parameter per edge, chosen by the size of the smaller facet beside it: the static and the constant
/// policies. λ is the share of the corner that is kept: the cut of vertex a meets edge ab at λ·a + (1 − λ)·b.
struct SizePolicy {
  std::vector<QuadraticField> by_size;  ///< by_size[n] for n-gons, n >= 3; larger sizes take the last entry

  [[nodiscard]] const QuadraticField& for_size(std::size_t n) const {
    return n < by_size.size() ? by_size[n] : by_size.back();
  }
};

/// Any λ for each half-edge a→b (the cut of a, on the edge towards b). Must be a pure function: it is called
/// from several threads.
using HalfEdgePolicy = std::function<QuadraticField(const HoneycombMap&, HalfEdgeId)>;

/// What a plane policy may look at. Facet normals point outward and have any positive length; coordinates are
/// those of the file that is refined.
struct CornerView {
  std::array<std::array<double, 3>, 3> unit_normals;  ///< of the three facets at the vertex
  std::array<double, 3> point;                        ///< the vertex
  std::uint32_t level = 0;                            ///< level of the vertex, 0 for the input
};
/// The plane that cuts a vertex, chosen freely, for instance tangent to a body. The normal is rounded to integers
/// first; `offset` then says where a plane with that normal lies, and is rounded outward. What results is decided
/// exactly. Both must be pure functions: they are called from several threads.
struct PlanePolicy {
  /// Outward normal, of any length, of the plane that cuts the vertex.
  std::function<std::array<double, 3>(const CornerView&)> normal;
  /// d of the plane n·x <= d with normal n; positively homogeneous. For a body: its support function.
  std::function<double(const std::array<double, 3>& n)> offset;
};

/// How the corners of a level are cut.
using CutPolicy = std::variant<SizePolicy, HalfEdgePolicy, PlanePolicy>;

/// The λ that a parameter policy asks for half-edge h. Precondition: not a PlanePolicy.
[[nodiscard]] QuadraticField asked_parameter(const HoneycombMap& map, const CutPolicy& policy, std::uint32_t h);

/// Decides conditions (1), (8), (10) of Han 2024 for the asked parameters exactly: ParameterOutOfRange (edge),
/// QuadCollapse (facet), TriangleOvercut (facet), at most `limit` findings. Empty for a PlanePolicy, whose step is
/// judged by its result. Cost: linear for half-edge policies, O(base facets) for size policies above level 0.
[[nodiscard]] std::vector<Finding> condition_violations(const HoneycombMap& map, const CutPolicy& policy,
                                                        std::size_t limit = 16);

/// phs (c.1): 2/5, 1/4, (11 − 3√5)/38, 0 for triangles, quadrilaterals, pentagons, all others.
[[nodiscard]] SizePolicy static_policy_sqrt5();
/// The same with the rational 11/97 for pentagons.
[[nodiscard]] SizePolicy static_policy_rational();

}  // namespace hexact
