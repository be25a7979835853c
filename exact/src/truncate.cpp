// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/truncate.hpp"

#include "facet_geometry.hpp"
#include "hexact/exact/body_from_soup.hpp"

namespace hexact {
namespace {

using namespace detail;

constexpr std::uint32_t kNone = UINT32_MAX;

/// The cut points on the edges that leave v, one for each half-edge of its star: phs (a.1).
template <class S>
std::vector<Point3<S>> cut_points(const std::vector<Point3<S>>& points, const HalfEdges& edges,
                                  const std::vector<std::uint32_t>& star, const std::vector<Point3<S>>& normals,
                                  const S& theta) {
  const Point3<S>& v = points[edges.origin[star[0]]];
  Point3<S> n{};
  for (const std::uint32_t h : star) n = n + normals[edges.facet[h]];
  std::vector<S> gap;  // g_i = n·(v − w_i) > 0
  for (const std::uint32_t h : star) gap.push_back(dot(n, v - points[edges.target(h)]));
  S smallest = gap[0];
  for (const S& g : gap) smallest = g < smallest ? g : smallest;
  std::vector<Point3<S>> cuts;
  for (std::size_t i = 0; i < star.size(); ++i) {
    const S fraction = theta * smallest / gap[i];
    cuts.push_back(v + fraction * (points[edges.target(star[i])] - v));
  }
  return cuts;
}

}  // namespace

template <class S>
TruncatedSoup<S> truncate_vertices(const PolygonSoup<S>& soup, const Rational& theta) {
  HEXACT_EXPECTS(theta.sign() > 0 && theta < Rational(Integer(1), Integer(2)));
  SoupShape shape = examine_soup(soup);
  if (!shape.findings.empty()) throw InvalidInput(std::move(shape.findings));
  const HalfEdges edges = half_edges_of(soup.facets);
  std::vector<Point3<S>> normals;
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    normals.push_back(normal(*facet_shape(PolygonView<S>{soup.points, soup.facets[f]}).plane));
  }
  std::vector<std::uint32_t> first(soup.points.size(), kNone);
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    if (first[edges.origin[h]] == kNone) first[edges.origin[h]] = h;
  }

  TruncatedSoup<S> result;
  std::vector<std::uint32_t> number(soup.points.size(), kNone);
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (edges.around(first[v]).size() != 3) continue;
    number[v] = static_cast<std::uint32_t>(result.soup.points.size());
    result.soup.points.push_back(soup.points[v]);
  }
  std::vector<std::uint32_t> cut_number(edges.size(), kNone);  // of the point on the half-edge, near its origin
  FacetLoops caps;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (number[v] != kNone) continue;
    ++result.truncated_vertices;
    const auto star = edges.around(first[v]);
    const auto cuts = cut_points(soup.points, edges, star, normals, S(theta));
    for (std::size_t i = 0; i < star.size(); ++i) {
      cut_number[star[i]] = static_cast<std::uint32_t>(result.soup.points.size());
      caps.add_corner(make_id<VertexId>(result.soup.points.size()));
      result.soup.points.push_back(cuts[i]);
    }
    caps.close_loop();
  }
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    const auto start = static_cast<std::uint32_t>(soup.facets.start(f));
    for (std::uint32_t h = start; h < start + soup.facets[f].size(); ++h) {
      if (number[edges.origin[h]] != kNone) {
        result.soup.facets.add_corner(make_id<VertexId>(number[edges.origin[h]]));
        continue;
      }
      // The corner becomes two: on the edge that arrives and on the edge that leaves.
      result.soup.facets.add_corner(make_id<VertexId>(cut_number[edges.twin[edges.previous[h]]]));
      result.soup.facets.add_corner(make_id<VertexId>(cut_number[h]));
    }
    result.soup.facets.close_loop();
  }
  for (std::size_t f = 0; f < caps.size(); ++f) result.soup.facets.add(caps[f]);
  return result;
}

template TruncatedSoup<Rational> truncate_vertices(const PolygonSoup<Rational>&, const Rational&);
template TruncatedSoup<QuadraticField> truncate_vertices(const PolygonSoup<QuadraticField>&, const Rational&);

}  // namespace hexact
