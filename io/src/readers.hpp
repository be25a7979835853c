// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <string>
#include <string_view>

namespace hexact::io {

// One reader for each format, in a source file of its name. `bytes` is not empty. All throw ParseError.

[[nodiscard]] PolygonSoup<Rational> parse_obj(std::string_view bytes, const std::string& name);
[[nodiscard]] PolygonSoup<Rational> parse_off(std::string_view bytes, const std::string& name);
[[nodiscard]] PolygonSoup<Rational> parse_ply(std::string_view bytes, const std::string& name);
[[nodiscard]] PolygonSoup<Rational> parse_stl(std::string_view bytes, const std::string& name);
[[nodiscard]] PlaneBody parse_planes(std::string_view bytes, const std::string& name);
[[nodiscard]] Certificate parse_certificate(std::string_view bytes, const std::string& name);

/// True when the size is that of a binary STL file with the announced number of triangles.
[[nodiscard]] bool is_binary_stl(std::string_view bytes);

}  // namespace hexact::io
