// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry_output.hpp"

#include "hexact/exact/body_from_soup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hexact::app {
namespace {

constexpr const char* kFormats = "obj, off, ply, ply-ascii, stl, stl-ascii, planes, scad";

void refuse_certificate(const OutputChoice& output) {
  if (output.format == io::Format::certificate) {
    throw UsageError("a certificate proves claims: it is written by certify and by subdivide --certificate");
  }
}

/// An upper bound, rounded up, of the distance that rounding to float adds for binary STL.
double float_rounding(const std::vector<Point3<double>>& points) {
  double largest = 0;
  for (const auto& p : points) {
    const auto difference = [](double x) { return std::abs(x - static_cast<double>(static_cast<float>(x))); };
    const double dx = difference(p.x), dy = difference(p.y), dz = difference(p.z);
    largest = std::max(largest, std::sqrt(dx * dx + dy * dy + dz * dz));
  }
  // Six roundings of relative size 2^-53 and gradual underflow stay below this factor and this term.
  return largest == 0 ? 0 : largest * (1 + 0x1p-48) + 1e-150;
}

double rounding_of_output(const OutputChoice& output, const std::vector<Point3<double>>& points, double rounding) {
  if (output.format != io::Format::stl) return rounding;
  const double further = float_rounding(points);
  return further == 0 ? rounding : std::nextafter(rounding + further, std::numeric_limits<double>::infinity());
}

/// An upper bound of the distance between a point and its rounding to doubles; 0 only when they are equal.
double rounding_error(const Point3<Rational>& exact, const Point3<double>& rounded) {
  const auto square = [](const Rational& x, double y) {
    const Rational difference = x - Rational::from_double(y);
    return difference * difference;
  };
  const Rational sum = square(exact.x, rounded.x) + square(exact.y, rounded.y) + square(exact.z, rounded.z);
  if (sum.is_zero()) return 0;
  const double up = std::nextafter(sum.to_double(), std::numeric_limits<double>::infinity());
  return std::nextafter(std::sqrt(up), std::numeric_limits<double>::infinity());
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

WrittenGeometry write_geometry(const OutputChoice& output, const PlaneBody& body) {
  refuse_certificate(output);
  if (output.format == io::Format::planes) {
    io::write_planes(output.path, body);
    return {true, 0};
  }
  const RoundedVertices vertices = rounded_vertices(body);
  io::write_mesh(output.path, output.format, {vertices.points, body.loops, body.addresses}, output.mesh);
  const double rounding = rounding_of_output(output, vertices.points, vertices.max_rounding);
  return {rounding == 0, rounding};
}

WrittenGeometry write_geometry(const OutputChoice& output, const PolygonSoup<Rational>& soup) {
  refuse_certificate(output);
  if (output.format == io::Format::planes) {
    io::write_planes(output.path, body_from_soup(soup, SoupRule::planar));
    return {true, 0};
  }
  std::vector<Point3<double>> points;
  points.reserve(soup.points.size());
  double rounding = 0;
  for (const auto& p : soup.points) {
    points.push_back({p.x.to_double(), p.y.to_double(), p.z.to_double()});
    rounding = std::max(rounding, rounding_error(p, points.back()));
  }
  io::write_mesh(output.path, output.format, {points, soup.facets, soup.addresses}, output.mesh);
  rounding = rounding_of_output(output, points, rounding);
  return {rounding == 0, rounding};
}

WrittenGeometry write_geometry(const OutputChoice& output, const PolygonSoup<double>& soup) {
  refuse_certificate(output);
  if (output.format == io::Format::planes) {
    throw UsageError("doubles have no exact planes; write a mesh, or use another --arithmetic");
  }
  for (const auto& p : soup.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw ResourceLimit("a coordinate is beyond the range of double; --arithmetic rational has none");
    }
  }
  io::write_mesh(output.path, output.format, {soup.points, soup.facets, soup.addresses}, output.mesh);
  const double rounding = rounding_of_output(output, soup.points, 0);
  return {rounding == 0, rounding};
}

}  // namespace hexact::app
