// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/chamfer.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace hexact {

/// A `lifts` document: the lifts of some levels, exactly. Lifts are in the scale of ExactLifts.
struct LiftDocument {
  struct Edge {
    std::uint32_t a = 0, b = 0;  ///< in the canonical numbering of the level, in either order
    Rational lift;
  };
  /// Has either `edges`, one entry for every edge, or `lifts` in the order of the edges' numbers.
  struct Level {
    std::uint32_t level = 0;  ///< of the edges that are cut
    std::optional<std::vector<Edge>> edges;
    std::vector<Rational> lifts;
  };
  std::vector<Rational> factors;     ///< κ of every facet of the start; empty: by the rule of `chamfer_start`
  bool automatic_otherwise = false;  ///< levels that are not listed follow another rule; otherwise they are an error
  std::vector<Level> levels;
};

/// The lifts that a document says; `otherwise` gives those of levels that are not listed where the document allows it.
/// Throws InvalidInput (BadLifts) for a level that is named twice; and, when lifts of a level are asked for, for a level that is
/// missing, a wrong number of lifts, an edge that does not exist, is given twice or is missing.
[[nodiscard]] LiftRule document_lifts(const LiftDocument& document, LiftRule otherwise);

}  // namespace hexact
