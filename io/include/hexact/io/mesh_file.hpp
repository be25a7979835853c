// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace hexact::io {

enum class Format { obj, off, ply, ply_ascii, ply_float, stl, stl_ascii, planes, certificate, scad };

/// "obj", "off", "ply", "stl", "planes", "cert", "scad" and the variants "ply-ascii", "ply-float", "stl-ascii"; nullopt
/// for other names.
[[nodiscard]] std::optional<Format> format_from_name(std::string_view name);
/// What coordinates are rounded to when a mesh is written: float32 in binary STL and `ply_float`, else double.
[[nodiscard]] FloatFormat coordinate_format(Format format) noexcept;
/// By the file name's ending (.obj .off .ply .stl .planes .cert .hxc .scad); nullopt when it tells nothing.
[[nodiscard]] std::optional<Format> format_from_path(std::string_view path);

/// What a geometry file holds: polygons as read, an exact body, or a certificate.
using Geometry = std::variant<PolygonSoup<Rational>, PlaneBody, Certificate>;

/// Reads a file, "-" being standard input. The format is `format`, or what the first bytes and the ending tell.
/// Text numbers are read as the exact decimal they spell, binary ones as the exact float.
/// Throws FileError (cannot be opened, a directory), ParseError (file, line, element), ResourceLimit.
[[nodiscard]] Geometry read_geometry(const std::string& path, std::optional<Format> format = std::nullopt);
/// The same from bytes in memory; `name` stands in messages.
[[nodiscard]] Geometry parse_geometry(std::string_view bytes, Format format, const std::string& name);

/// The digest of a file's bytes as 64 hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

struct MeshWriteOptions {
  std::string color;  ///< "", "level", "angle" or "reflection": colours of facets, where the format has them (PLY, OFF)
  std::string unit;   ///< "", "mm", "m", "in": noted in a comment where the format has one
};

/// A mesh that is ready to be written, its points rounded to the format's numbers (see `coordinate_format`): whoever
/// has exact points rounds them once, to nearest.
struct MeshView {
  const std::vector<Point3<double>>& points;
  const FacetLoops& facets;
  const std::vector<FacetAddress>& addresses;  ///< may be empty
  const MeshAttributes<double>* attributes = nullptr;  ///< what of it the format has is written
};

/// Writes a mesh whole or not at all (see output_file.hpp), "-" being standard output. Doubles are written so that
/// they read back bit for bit. STL triangulates facets (fan from the first corner). Points that are no float32 are rounded
/// where the format holds float32. Throws FileError; InvalidInput (NotRepresentable) where the format cannot hold the mesh.
void write_mesh(const std::string& path, Format format, const MeshView& mesh, const MeshWriteOptions& options = {});
/// Writes `.planes` text, exactly.
void write_planes(const std::string& path, const PlaneBody& body);
/// Writes a certificate with its digest.
void write_certificate(const std::string& path, const Certificate& certificate);

/// The text of the above, for tests and streams.
[[nodiscard]] std::string mesh_text(Format format, const MeshView& mesh, const MeshWriteOptions& options = {});
[[nodiscard]] std::string planes_text(const PlaneBody& body);
[[nodiscard]] std::string certificate_text(const Certificate& certificate);

}  // namespace hexact::io
