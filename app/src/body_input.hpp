// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/io/mesh_file.hpp"

#include <optional>
#include <string>

namespace hexact::app {

/// An exact body read from a file, with what certificates say about its origin.
struct BodyInput {
  PlaneBody body;
  std::string path;
};

/// Reads a body: `.planes` and certificates as they are, polygons by their exact facet planes.
/// Throws what io::read_geometry throws; InvalidInput with all findings where the polygons bound no exact convex
/// polyhedron.
[[nodiscard]] BodyInput read_body(const std::string& path, const std::string& format_name);

/// The format that `--from` or `--to` names. Throws UsageError for an unknown name; nullopt for an empty one.
[[nodiscard]] std::optional<io::Format> named_format(const std::string& name);

}  // namespace hexact::app
