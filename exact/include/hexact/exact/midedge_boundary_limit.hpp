// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/midedge.hpp"
#include "hexact/kernel/progress.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace hexact {

/// A corner of a facet together with the side that leaves it.
enum class MidedgeCorner : std::uint8_t {
  inner,  ///< an inner vertex; so the side has a facet on either side
  gap,    ///< a boundary vertex, and the side is an inner edge
  rim,    ///< a boundary vertex, and the side is a boundary edge
};

/// How a facet touches the boundary, from corner to corner. Double steps never change it.
using MidedgeBoundaryPattern = std::vector<MidedgeCorner>;

/// The pattern of facet f, from its first corner. Cost: O(edges at its corners).
[[nodiscard]] MidedgeBoundaryPattern midedge_boundary_pattern(const MidedgeMap& map, std::uint32_t f);
[[nodiscard]] bool touches_boundary(const MidedgeBoundaryPattern& pattern);
/// True where the facet is a component of its own.
[[nodiscard]] bool stands_alone(const MidedgeBoundaryPattern& pattern);

/// The vertices that decide where a facet goes under double steps.
struct MidedgeBoundaryNet {
  MidedgeBoundaryPattern pattern;  ///< turned so that it comes first in the alphabet
  /// For each corner s of the pattern: itself; the vertices (i, j) of its sector (0,1), (0,2), (1,0), (1,1), (1,2), (2,0),
  /// (2,1) if it is inner; else (0,1), (0,2) if the side behind it is inner and (1,0), (2,0) if the side before it is.
  std::vector<std::uint32_t> vertices;
};

/// The net of facet f, or nothing where its surroundings are not yet those that all later double steps have: two
/// quadrilaterals in a row across each inner side, ending at the boundary beside boundary corners, and 2 × 2 around inner
/// corners, with vertices of valence 4.
[[nodiscard]] std::optional<MidedgeBoundaryNet> midedge_boundary_net(const MidedgeMap& map, std::uint32_t f);

/// The double step of the six-point rule on such a net: row r has the weights of the net's vertices in vertex r of the
/// net one double step later. Taken from `corner_points` on unit data. Rows are non-negative and add up to 1.
/// Cost: O(n²) rational operations for n vertices.
[[nodiscard]] std::vector<std::vector<Rational>> midedge_boundary_operator(const MidedgeBoundaryPattern& pattern,
                                                                           const ProgressPart& progress = {});

/// The left eigenvector w of that operator M for the eigenvalue 1, with sum 1: under further double steps all points of
/// the net tend to w · P.
///
/// Proof. Some power of M has a positive column, which is checked on the places of its non-zero entries. A row-stochastic
/// matrix M with M^p ≥ ε in one column contracts the range of every coordinate by 1 − ε in p steps, so M^n tends to a
/// matrix of equal rows w; w M = w, and w is the only such row of sum 1. The linear equations are solved over Q and the
/// solution is inserted. Cost: elimination in a band along the facet's corners; numbers of O(n) digits for n vertices.
/// Precondition: the facet touches the boundary and does not stand alone. Throws Cancelled between rows.
[[nodiscard]] std::vector<Rational> midedge_boundary_weights(const MidedgeBoundaryPattern& pattern, const ProgressPart& progress = {});

/// Limits of facets at the boundary under double steps of the six-point rule, one row of weights for each pattern.
class MidedgeBoundaryLimits {
 public:
  /// Nets of more vertices get no limit: exact elimination over 1014 takes 24 s.
  static constexpr std::size_t kLargestNet = 1024;

  /// `progress` is asked whether to go on, nothing is reported to it.
  explicit MidedgeBoundaryLimits(const ProgressPart& progress = {}) : progress_(progress) {}

  /// Computes the weights of a pattern, turned or not, unless they are known or the net is too large. Throws Cancelled.
  void prepare(MidedgeBoundaryPattern pattern);
  /// Where facet f goes, or nothing where it has no net or too large a one. Precondition: its pattern has been prepared.
  /// May be called from several threads.
  [[nodiscard]] std::optional<Point3<Rational>> operator()(const MidedgeLevel<Rational>& level, std::uint32_t f) const;

 private:
  ProgressPart progress_;
  std::map<MidedgeBoundaryPattern, std::vector<Rational>> weights_;
};

}  // namespace hexact
