// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/facet_loops.hpp"
#include "hexact/kernel/ids.hpp"
#include "hexact/kernel/mesh_attributes.hpp"
#include "hexact/kernel/point3.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hexact {

/// Where a facet comes from: the level that made it and the vertex of the level before that was cut.
/// Facets of level 0 have no parent. The address never changes in later levels.
struct FacetAddress {
  std::uint32_t level = 0;
  std::optional<VertexId> parent;
  friend bool operator==(const FacetAddress&, const FacetAddress&) = default;
};

/// The binary formats that coordinates are rounded to.
enum class FloatFormat { binary64, binary32 };

/// What a file can hold, so that one can ask whether it is the correct rounding of something exact.
struct SoupStorage {
  FloatFormat coordinates = FloatFormat::binary64;
  bool triangles_only = false;  ///< polygons have to be cut into triangles, and vertices have no numbers
};

/// Polygons as they were read: nothing about their shape or connectivity is promised.
template <class S>
struct PolygonSoup {
  std::vector<Point3<S>> points;
  FacetLoops facets;
  std::vector<FacetAddress> addresses;  ///< empty, or one for each facet
  SoupStorage storage;                  ///< of the file they were read from
  MeshAttributes<S> attributes;
};

}  // namespace hexact
