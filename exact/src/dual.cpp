// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/dual.hpp"

#include "facet_geometry.hpp"
#include "open_mesh.hpp"

namespace hexact {

using namespace detail;

template <class S>
PolygonSoup<S> dual_mesh(const PolygonSoup<S>& soup) {
  require_oriented_manifold(soup.facets, soup.points.size());
  const HalfEdges edges = half_edges_of(soup.facets);
  PolygonSoup<S> dual;
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    Point3<S> sum{};
    for (const VertexId v : soup.facets[f]) sum = sum + soup.points[index(v)];
    const auto n = static_cast<long long>(std::max<std::size_t>(1, soup.facets[f].size()));
    dual.points.push_back(S(Rational(Integer(1), Integer(n))) * sum);
  }
  for (const std::uint32_t start : interior_starts(edges, soup.points.size())) {
    if (start == kNoTwin) continue;
    for (const std::uint32_t h : edges.around(start)) dual.facets.add_corner(make_id<VertexId>(edges.facet[h]));
    dual.facets.close_loop();
  }
  dual = without_unused_points(dual);
  // A vertex of valence 2 in the given mesh, or a single triangle at a narrow place, leaves no proper mesh.
  require_oriented_manifold(dual.facets, dual.points.size());
  return dual;
}

template PolygonSoup<Rational> dual_mesh(const PolygonSoup<Rational>&);
template PolygonSoup<QuadraticField> dual_mesh(const PolygonSoup<QuadraticField>&);

}  // namespace hexact
