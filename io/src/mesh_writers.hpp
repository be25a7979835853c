// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/io/mesh_file.hpp"

#include <array>
#include <string>
#include <vector>

namespace hexact::io {

// One writer for each format. Points are finite; facets without corners are left out.

[[nodiscard]] std::string obj_text(const MeshView& mesh, const MeshWriteOptions& options);
[[nodiscard]] std::string off_text(const MeshView& mesh, const MeshWriteOptions& options);
[[nodiscard]] std::string ply_text(const MeshView& mesh, const MeshWriteOptions& options);
[[nodiscard]] std::string ply_float_text(const MeshView& mesh, const MeshWriteOptions& options);
[[nodiscard]] std::string ply_ascii_text(const MeshView& mesh, const MeshWriteOptions& options);
[[nodiscard]] std::string stl_text(const MeshView& mesh);
[[nodiscard]] std::string stl_ascii_text(const MeshView& mesh);
[[nodiscard]] std::string scad_text(const MeshView& mesh, const MeshWriteOptions& options);

/// The nearest float32. Throws InvalidInput (NotRepresentable) naming the element where there is none.
[[nodiscard]] float narrowed(double value, const char* element, std::size_t number);

using Colour = std::array<std::uint8_t, 3>;
/// One colour for each facet by its level or by the largest angle to a neighbour, blue 0 to red at the maximum, or by
/// reflection lines (dark and bright stripes by the place that the normal reflects to a fixed viewer); empty
/// when no colour is asked for. Throws InvalidInput (NotRepresentable) for levels that the mesh does not have.
[[nodiscard]] std::vector<Colour> facet_colours(const MeshView& mesh, const std::string& by);

}  // namespace hexact::io
