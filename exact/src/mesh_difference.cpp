// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/mesh_difference.hpp"

#include "hexact/exact/rounding.hpp"
#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/mesh_topology.hpp"

#include <algorithm>

namespace hexact {
namespace {

/// A number of the mesh in the format; text may spell more digits than it has.
double in_format(const Rational& x, FloatFormat format) {
  return format == FloatFormat::binary32 ? static_cast<double>(nearest_float(x)) : x.to_double();
}

/// What differs between a point of the mesh and the rounded one.
std::string point_difference(const Point3<Rational>& found, const Point3<double>& expected, FloatFormat format) {
  const auto differ = [&](const Rational& x, double y) -> std::string {
    const double value = in_format(x, format);
    if (value == y) return {};
    return "coordinate " + Rational::from_double(value).str() + ", the correct rounding is " + Rational::from_double(y).str();
  };
  if (auto text = differ(found.x, expected.x); !text.empty()) return text;
  if (auto text = differ(found.y, expected.y); !text.empty()) return text;
  return differ(found.z, expected.z);
}

std::string loop_difference(const PlaneBody& body, const PolygonSoup<Rational>& mesh) {
  if (mesh.points.size() != body.vertex_count()) {
    return std::to_string(mesh.points.size()) + " vertices, expected " + std::to_string(body.vertex_count());
  }
  std::size_t facet = 0;
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    const auto expected = body.loops[f];
    if (expected.empty()) continue;
    if (facet >= mesh.facets.size()) return std::to_string(mesh.facets.size()) + " facets, more were expected";
    const auto found = mesh.facets[facet];
    if (!std::equal(expected.begin(), expected.end(), found.begin(), found.end())) return facet_name(facet) + ": another loop";
    ++facet;
  }
  if (facet != mesh.facets.size()) return std::to_string(mesh.facets.size()) + " facets, expected " + std::to_string(facet);
  return {};
}

std::string polygon_difference(const PlaneBody& body, const PolygonSoup<Rational>& mesh) {
  if (std::string text = loop_difference(body, mesh); !text.empty()) return text;
  const RoundedVertices rounded = rounded_vertices(body, mesh.storage.coordinates);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::string text = point_difference(mesh.points[v], rounded.points[v], mesh.storage.coordinates);
    if (!text.empty()) return vertex_name(v) + ": " + text;
  }
  return {};
}

/// Vertices have no numbers in the file, and distinct ones may round to the same: coordinates are compared.
std::string triangle_difference(const PlaneBody& body, const PolygonSoup<Rational>& mesh) {
  std::size_t expected = 0;
  for (std::size_t f = 0; f < body.loops.size(); ++f) expected += std::max<std::size_t>(body.loops[f].size(), 2) - 2;
  if (mesh.facets.size() != expected) {
    return std::to_string(mesh.facets.size()) + " triangles, expected " + std::to_string(expected);
  }
  const RoundedVertices rounded = rounded_vertices(body, mesh.storage.coordinates);
  std::size_t triangle = 0;
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    const auto loop = body.loops[f];
    for (std::size_t i = 2; i < loop.size(); ++i, ++triangle) {
      const auto found = mesh.facets[triangle];
      const std::array<VertexId, 3> corners{loop[0], loop[i - 1], loop[i]};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::string text =
            point_difference(mesh.points[index(found[k])], rounded.points[index(corners[k])], mesh.storage.coordinates);
        if (!text.empty()) return facet_name(triangle) + ", " + vertex_name(index(corners[k])) + ": " + text;
      }
    }
  }
  return {};
}

}  // namespace

std::string mesh_difference(const PlaneBody& body, const PolygonSoup<Rational>& mesh) {
  HEXACT_EXPECTS(body.loops.size() == body.plane_count());
  return mesh.storage.triangles_only ? triangle_difference(body, mesh) : polygon_difference(body, mesh);
}

}  // namespace hexact
