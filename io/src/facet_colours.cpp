// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh_writers.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace hexact::io {
namespace {

using Vector = std::array<double, 3>;

/// Newell's normal, of unit length or zero. For display only.
Vector unit_normal(const MeshView& mesh, std::size_t f) {
  const auto loop = mesh.facets[f];
  Vector n{};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto& p = mesh.points[index(loop[i])];
    const auto& q = mesh.points[index(loop[(i + 1) % loop.size()])];
    n[0] += (p.y - q.y) * (p.z + q.z);
    n[1] += (p.z - q.z) * (p.x + q.x);
    n[2] += (p.x - q.x) * (p.y + q.y);
  }
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return {n[0] / length, n[1] / length, n[2] / length};
}

/// For each facet the largest 1 − cos of the angle to the normal of a facet with a common edge.
std::vector<double> bends(const MeshView& mesh) {
  struct Side {
    std::pair<VertexId, VertexId> edge;
    std::size_t facet;
  };
  std::vector<Side> sides;
  std::vector<Vector> normals;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto loop = mesh.facets[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sides.push_back({std::minmax(loop[i], loop[(i + 1) % loop.size()]), f});
    }
    normals.push_back(unit_normal(mesh, f));
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tie(a.edge, a.facet) < std::tie(b.edge, b.facet); });
  std::vector<double> result(mesh.facets.size(), 0.0);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].edge != sides[i - 1].edge) continue;
    const std::size_t f = sides[i - 1].facet, g = sides[i].facet;
    const double bend = 1 - (normals[f][0] * normals[g][0] + normals[f][1] * normals[g][1] + normals[f][2] * normals[g][2]);
    result[f] = std::max(result[f], bend);
    result[g] = std::max(result[g], bend);
  }
  return result;
}

/// Blue, teal, pale green, sand, coral for t from 0 to 1: light enough for black edges and shading to stay visible.
Colour ramp(double t) {
  constexpr std::array<Vector, 5> kStops{{{92, 137, 214}, {105, 205, 212}, {206, 236, 176}, {255, 214, 132}, {246, 140, 116}}};
  const double place = std::clamp(t, 0.0, 1.0) * (kStops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const double part = place - static_cast<double>(i);
  const auto channel = [&](std::size_t c) {
    return static_cast<std::uint8_t>(std::lround(kStops[i][c] + part * (kStops[i + 1][c] - kStops[i][c])));
  };
  return {channel(0), channel(1), channel(2)};
}

/// Where the viewer stands whose reflection lines are drawn: where examples/render puts its camera.
constexpr Vector kViewer{0.4755, -0.8236, 0.3090};
/// Bright lines that stand vertically around the body, far away.
constexpr double kLines = 12;

/// How near the facet's mirror image of the viewer is to one of the lines, 0 between two lines to 1 on one.
double reflected_light(const Vector& n) {
  const double along = n[0] * kViewer[0] + n[1] * kViewer[1] + n[2] * kViewer[2];
  const double x = 2 * along * n[0] - kViewer[0], y = 2 * along * n[1] - kViewer[1];
  return 0.5 + 0.5 * std::cos(kLines * std::atan2(y, x));
}

/// Reflection lines: of all normals that a smooth surface has, neighbours reflect nearly the same place. The lines run on
/// across an edge where the surface is smooth, and break where it has a crease.
std::vector<Colour> reflection_lines(const MeshView& mesh) {
  constexpr Vector kDark{46, 74, 120}, kBright{250, 248, 240};
  std::vector<Colour> colours;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const double light = reflected_light(unit_normal(mesh, f));
    const auto channel = [&](std::size_t c) {
      return static_cast<std::uint8_t>(std::lround(kDark[c] + light * (kBright[c] - kDark[c])));
    };
    colours.push_back({channel(0), channel(1), channel(2)});
  }
  return colours;
}

}  // namespace

std::vector<Colour> facet_colours(const MeshView& mesh, const std::string& by) {
  if (by.empty()) return {};
  if (by == "reflection") return reflection_lines(mesh);
  std::vector<double> values;
  if (by == "angle") {
    values = bends(mesh);
    for (double& value : values) value = std::acos(std::clamp(1 - value, -1.0, 1.0));
  } else if (by == "level") {
    if (mesh.addresses.empty()) {
      throw InvalidInput("NotRepresentable", "the mesh has no levels to colour its facets by", "");
    }
    for (const FacetAddress& address : mesh.addresses) values.push_back(address.level);
  } else {
    throw InvalidInput("NotRepresentable", "facets are coloured by level, angle or reflection, not by " + by, "");
  }
  const double largest = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  std::vector<Colour> colours;
  for (const double value : values) colours.push_back(ramp(largest > 0 ? value / largest : 0));
  return colours;
}

}  // namespace hexact::io
