// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_output.hpp"

#include "hexact/exact/body_from_soup.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <limits>

namespace hexact::app {
namespace {

struct RoundedSoup {
  PolygonSoup<Rational> soup;
  double max_rounding = 0;
};

double distance_bound(const QuadraticField& squared) {
  if (squared.is_zero()) return 0;
  const double infinity = std::numeric_limits<double>::infinity();
  return std::nextafter(std::sqrt(std::nextafter(squared.to_double(), infinity)), infinity);
}

RoundedSoup rounded(const PolygonSoup<QuadraticField>& soup) {
  RoundedSoup result;
  result.soup.facets = soup.facets;
  result.soup.addresses = soup.addresses;
  for (const auto& p : soup.points) {
    QuadraticField squared;
    const auto nearest = [&](const QuadraticField& x) {
      const double y = x.to_double();
      if (!std::isfinite(y)) throw ResourceLimit("a coordinate is beyond the range of double");
      const QuadraticField difference = x - QuadraticField(Rational::from_double(y));
      squared += difference * difference;
      return Rational::from_double(y);
    };
    result.soup.points.push_back({nearest(p.x), nearest(p.y), nearest(p.z)});
    result.max_rounding = std::max(result.max_rounding, distance_bound(squared));
  }
  return result;
}

WrittenGeometry write(const OutputChoice& output, const PolygonSoup<Rational>& soup) {
  return write_geometry(output, soup);
}

WrittenGeometry write(const OutputChoice& output, const PolygonSoup<QuadraticField>& soup) {
  if (output.format == io::Format::planes) return write_geometry(output, body_from_soup(soup, SoupRule::planar));
  const RoundedSoup near = rounded(soup);
  WrittenGeometry written = write_geometry(output, near.soup);
  if (near.max_rounding > 0) {
    written.exact = false;
    written.max_rounding = written.max_rounding == 0
                               ? near.max_rounding
                               : std::nextafter(written.max_rounding + near.max_rounding,
                                                std::numeric_limits<double>::infinity());
  }
  return written;
}

ExactSoup soup_of(const PlaneBody& body) {
  if (body.field == Field::rational) return rational_soup(body);
  return sqrt5_soup(body);
}

}  // namespace

ExactSoup exact_soup(io::Geometry&& geometry) {
  if (auto* soup = std::get_if<PolygonSoup<Rational>>(&geometry)) return std::move(*soup);
  if (const auto* body = std::get_if<PlaneBody>(&geometry)) return soup_of(*body);
  return soup_of(std::get<Certificate>(geometry).body);
}

WrittenGeometry write_exact(const OutputChoice& output, const ExactSoup& soup, const std::optional<PlaneBody>& body) {
  if (body && output.format == io::Format::planes) return write_geometry(output, *body);
  return std::visit([&](const auto& polygons) { return write(output, polygons); }, soup);
}

void remark_rounding(const char* subcommand, const WrittenGeometry& written, const Common& common) {
  if (written.exact || common.quiet) return;
  std::cerr << fmt::format("hexact {}: vertices were rounded by at most {:.3g}; only .planes keeps the exact result\n",
                           subcommand, written.max_rounding);
}

}  // namespace hexact::app
