// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/point3.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hexact {

/// In place of a position: there is no value, or no name.
inline constexpr std::uint32_t kNothing = UINT32_MAX;

/// Names that facets carry, for instance their groups.
struct FacetNames {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_facet;  ///< empty, or for each facet the position of its name, or kNothing

  [[nodiscard]] bool empty() const noexcept { return of_facet.empty(); }
  friend bool operator==(const FacetNames&, const FacetNames&) = default;
};

/// Values in the corners of facets: texture coordinates, of which z is the third where there is one. Two facets go on
/// smoothly across an edge where they have the same positions at both its ends; elsewhere there is a seam.
template <class S>
struct CornerValues {
  std::vector<Point3<S>> values;
  std::vector<std::uint32_t> of_corner;  ///< empty, or for each corner, facet by facet, the position of its value, or kNothing

  [[nodiscard]] bool empty() const noexcept { return of_corner.empty(); }
  friend bool operator==(const CornerValues&, const CornerValues&) = default;
};

/// What a mesh carries beside points and facets.
template <class S>
struct MeshAttributes {
  CornerValues<S> texture;
  unsigned texture_size = 2;  ///< numbers of a texture coordinate: 1, 2 or 3
  FacetNames groups, materials;
  std::vector<std::string> material_libraries;  ///< names of files that say what the materials are

  [[nodiscard]] bool empty() const noexcept {
    return texture.empty() && groups.empty() && materials.empty() && material_libraries.empty();
  }
  friend bool operator==(const MeshAttributes&, const MeshAttributes&) = default;
};

}  // namespace hexact
