// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/corner_cut.hpp"

#include "facet_geometry.hpp"
#include "open_mesh.hpp"

namespace hexact {

using namespace detail;

template <class S>
PolygonSoup<S> corner_cut_mesh(const PolygonSoup<S>& soup, const Rational& t) {
  HEXACT_EXPECTS(t.sign() > 0 && t < Rational(Integer(1), Integer(2)));
  require_oriented_manifold(soup.facets, soup.points.size());
  const HalfEdges edges = half_edges_of(soup.facets);
  const S fraction(t);
  const auto near_origin = [&](std::uint32_t a, std::uint32_t b) {
    return soup.points[a] + fraction * (soup.points[b] - soup.points[a]);
  };
  PolygonSoup<S> cut;
  std::vector<std::uint32_t> near_target(edges.size());  // point number of the far point of a half-edge
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    cut.points.push_back(near_origin(edges.origin[h], edges.target(h)));
    near_target[h] = edges.twin[h];
  }
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    if (edges.twin[h] != kNoTwin) continue;
    near_target[h] = static_cast<std::uint32_t>(cut.points.size());
    cut.points.push_back(near_origin(edges.target(h), edges.origin[h]));
  }
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    const auto start = static_cast<std::uint32_t>(soup.facets.start(f));
    for (std::uint32_t h = start; h < start + soup.facets[f].size(); ++h) {
      cut.facets.add_corner(make_id<VertexId>(h));
      cut.facets.add_corner(make_id<VertexId>(near_target[h]));
    }
    cut.facets.close_loop();
  }
  for (const std::uint32_t start : interior_starts(edges, soup.points.size())) {
    if (start == kNoTwin) continue;
    for (const std::uint32_t h : edges.around(start)) cut.facets.add_corner(make_id<VertexId>(h));
    cut.facets.close_loop();
  }
  return cut;
}

template PolygonSoup<Rational> corner_cut_mesh(const PolygonSoup<Rational>&, const Rational&);
template PolygonSoup<QuadraticField> corner_cut_mesh(const PolygonSoup<QuadraticField>&, const Rational&);

}  // namespace hexact
