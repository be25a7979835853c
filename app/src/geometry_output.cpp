// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry_output.hpp"

#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/rounded_attributes.hpp"
#include "hexact/exact/rounding.hpp"

#include <cmath>
#include <optional>

namespace hexact::app {
namespace {

constexpr const char* kFormats = "obj, off, ply, ply-ascii, ply-float, stl, stl-ascii, planes, scad";

void refuse_certificate(const OutputChoice& output) {
  if (output.format == io::Format::certificate) {
    throw UsageError("a certificate proves claims: it is written by certify and by subdivide --certificate");
  }
}

template <class S>
WrittenGeometry write_mesh_format(const OutputChoice& output, const PolygonSoup<S>& soup, const ProgressPart& progress) {
  progress.check();
  refuse_certificate(output);
  const RoundedVertices vertices = rounded_points(soup.points, io::coordinate_format(output.format), progress);
  progress.report(0.5);
  const MeshAttributes<double>& attributes = rounded_attributes(soup.attributes);
  io::write_mesh(output.path, output.format, {vertices.points, soup.facets, soup.addresses, &attributes}, output.mesh);
  return {vertices.max_rounding == 0, vertices.max_rounding};
}

template <class S>
WrittenGeometry write_polygons(const OutputChoice& output, const PolygonSoup<S>& soup, const ProgressPart& progress) {
  if (output.format != io::Format::planes) return write_mesh_format(output, soup, progress);
  progress.check();
  io::write_planes(output.path, body_from_soup(soup, SoupRule::planar));
  return {true, 0};
}

}  // namespace

OutputChoice choose_output(const std::string& path, const std::string& to, const Common& common) {
  if (common.json && path == "-") throw UsageError("--json and -o - both want standard output");
  std::optional<io::Format> format;
  if (!to.empty()) {
    format = io::format_from_name(to);
    if (!format) throw UsageError("--to: unknown format " + to + "; expected one of " + kFormats);
  } else {
    format = io::format_from_path(path);
    if (!format) throw UsageError("the name " + path + " tells no format; say it with --to: " + kFormats);
  }
  return {path, *format, {"", common.unit}};
}

WrittenGeometry write_geometry(const OutputChoice& output, const PlaneBody& body, const ProgressPart& progress) {
  progress.check();
  refuse_certificate(output);
  if (output.format == io::Format::planes) {
    io::write_planes(output.path, body);
    return {true, 0};
  }
  const RoundedVertices vertices = rounded_vertices(body, io::coordinate_format(output.format), progress);
  progress.report(0.5);
  io::write_mesh(output.path, output.format, {vertices.points, body.loops, body.addresses}, output.mesh);
  return {vertices.max_rounding == 0, vertices.max_rounding};
}

WrittenGeometry write_geometry(const OutputChoice& output, const PolygonSoup<Rational>& soup, const ProgressPart& progress) {
  return write_polygons(output, soup, progress);
}

WrittenGeometry write_geometry(const OutputChoice& output, const PolygonSoup<QuadraticField>& soup, const ProgressPart& progress) {
  return write_polygons(output, soup, progress);
}

WrittenGeometry write_geometry(const OutputChoice& output, const PolygonSoup<double>& soup, const ProgressPart& progress) {
  if (output.format == io::Format::planes) {
    throw UsageError("doubles have no exact planes; write a mesh, or use another --arithmetic");
  }
  return write_mesh_format(output, soup, progress);
}

double finite_product(const Point3<double>& n, const Point3<double>& p) {
  const double offset = n.x * p.x + n.y * p.y + n.z * p.z;
  if (!std::isfinite(offset)) throw ResourceLimit("the offset of a plane is beyond the finite doubles");
  return offset;
}

}  // namespace hexact::app
