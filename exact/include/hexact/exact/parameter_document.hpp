// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/policies.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hexact {

/// A `parameters` document: a policy, and what single levels say otherwise.
struct ParameterDocument {
  /// λ on both half-edges of an edge, vertices in the canonical numbering of the level.
  struct Edge {
    std::uint32_t a = 0, b = 0;
    QuadraticField ab, ba;  ///< λ(a→b) and λ(b→a)
  };
  struct Level {
    std::uint32_t level = 0;
    std::map<std::size_t, QuadraticField> sizes;  ///< by the smaller facet; sizes not listed keep the default
    std::vector<Edge> edges;                      ///< stand above sizes and default
  };
  std::string default_policy = "static";  ///< in the textual form of `parse_policy`
  std::vector<Level> levels;
};

/// The policies that a document says. Throws InvalidInput (BadParameters) for a malformed default or a level that is
/// named twice; and, when the policy of a level is made, for an edge that the level does not have or that is given
/// twice, and for parameters beside a tangent default. Cost per level: linear in what the document says of it.
[[nodiscard]] PolicySchedule document_policy(const ParameterDocument& document, Arithmetic arithmetic,
                                             const PlaneBody& base);

/// The plane at v has the sum of the unit normals of its three facets as normal and touches the convex hull of the
/// points. Throws InvalidInput (BadParameters) when there are none. Cost of a plane: linear in the points.
[[nodiscard]] PlanePolicy tangent_policy(std::vector<Point3<double>> points);

}  // namespace hexact
