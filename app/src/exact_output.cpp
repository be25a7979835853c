// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_output.hpp"

#include "hexact/exact/body_from_soup.hpp"

#include <fmt/format.h>


namespace hexact::app {
namespace {

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

WrittenGeometry write_exact(const OutputChoice& output, const ExactSoup& soup, const std::optional<PlaneBody>& body,
                            const ProgressPart& progress) {
  if (body && output.format == io::Format::planes) return write_geometry(output, *body, progress);
  return std::visit([&](const auto& polygons) { return write_geometry(output, polygons, progress); }, soup);
}

void remark_rounding(const char* subcommand, const WrittenGeometry& written, const Common& common) {
  if (written.exact) return;
  common.remark(fmt::format("{}: vertices were rounded by at most {:.3g}; only .planes keeps the exact result", subcommand,
                            written.max_rounding));
}

}  // namespace hexact::app
