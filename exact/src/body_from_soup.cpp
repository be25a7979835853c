// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/body_from_soup.hpp"

#include "facet_geometry.hpp"
#include "primitive_plane.hpp"
#include "ring_soup.hpp"

#include <algorithm>
#include <numeric>

namespace hexact {
namespace {

using namespace detail;

template <class R>
bool lexicographically_less(const Point3<R>& p, const Point3<R>& q) {
  if (!(p.x == q.x)) return p.x < q.x;
  if (!(p.y == q.y)) return p.y < q.y;
  return p.z < q.z;
}

/// Collects the geometric findings of a soup whose points lie in the ring R.
template <class R>
class Examination {
 public:
  Examination(const std::vector<Point3<R>>& points, const FacetLoops& loops, SoupRule rule, SoupShape& shape)
      : points_(points), loops_(loops), rule_(rule), shape_(shape) {}

  void run() {
    shape_.findings = shape_.topology.findings;
    examine_duplicates();
    examine_facets();
    const bool surface = shape_.topology.is_one_closed_surface();
    if (surface && rule_ == SoupRule::convex && shape_.topology.euler != 2) {
      report("BadEuler", "vertices - edges + facets is " + std::to_string(shape_.topology.euler) + ", expected 2", "");
    }
    if (surface && volume_sign() < 0) {
      report("InsideOut", "the volume is negative: the corners run clockwise seen from outside", "");
    } else if (surface && rule_ == SoupRule::convex && shape_.planar) {
      examine_edges();
    }
    shape_.strictly_convex = rule_ == SoupRule::convex && shape_.findings.empty();
  }

 private:
  void report(const char* code, std::string message, std::string element) {
    shape_.findings.push_back({code, std::move(message), std::move(element), std::nullopt});
  }

  void examine_duplicates() {
    std::vector<std::uint32_t> order(points_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (lexicographically_less(points_[a], points_[b])) return true;
      return points_[a] == points_[b] && a < b;
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (points_[order[i]] == points_[order[i - 1]]) {
        report("DuplicateVertices", "has the same coordinates as " + vertex_name(order[i - 1]), vertex_name(order[i]));
      }
    }
  }

  void examine_facets() {
    shape_.planar = true;
    facets_.resize(loops_.size());
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      const auto loop = loops_[f];
      if (loop.empty()) continue;
      const bool usable = loop.size() >= 3 && std::all_of(loop.begin(), loop.end(), [&](VertexId v) {
        return index(v) < points_.size();
      });
      if (usable) facets_[f] = detail::facet_shape(PolygonView<R>{points_, loop});
      const FacetShape<R>& facet = facets_[f];
      if (!facet.planar()) {
        shape_.planar = false;
        shape_.bent_facets.push_back(f);
      }
      if (usable) report_facet(f, facet);
    }
    shape_.planar = shape_.planar && shape_.topology.facets > 0;
  }

  void report_facet(std::size_t f, const FacetShape<R>& facet) {
    const auto corner = [&](std::size_t j) { return vertex_name(index(loops_[f][j])); };
    if (!facet.plane) {
      report("FaceNotPlanar", "has no area", facet_name(f));
    } else if (facet.off_plane) {
      report("FaceNotPlanar", corner(*facet.off_plane) + " is not on the plane of the others", facet_name(f));
    } else if (rule_ == SoupRule::convex && facet.reflex_corner) {
      report("FaceNotStrictlyConvex", "its corner at " + corner(*facet.reflex_corner) + " is straight or reflex",
             facet_name(f));
    } else if (rule_ == SoupRule::convex && !facet.turns_once) {
      report("FaceNotStrictlyConvex", "its corners go round more than once", facet_name(f));
    }
  }

  /// Sign of Σ det(p0, pi, pi+1) over fans of all facets: exact also where facets are bent.
  int volume_sign() const {
    R six_volumes{};
    std::vector<R> terms;
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      const PolygonView<R> polygon{points_, loops_[f]};
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        terms.push_back(dot(polygon[0], cross(polygon[i], polygon[i + 1])));
      }
    }
    // Pairwise, so that the denominators of rational terms grow late.
    for (std::size_t step = 1; step < terms.size(); step *= 2) {
      for (std::size_t i = 0; i + step < terms.size(); i += 2 * step) terms[i] += terms[i + step];
    }
    return terms.empty() ? 0 : terms[0].sign();
  }

  void examine_edges() {
    const HalfEdges e = half_edges_of(loops_);
    bool edges_convex = true;
    for (std::uint32_t h = 0; h < e.size(); ++h) {
      const std::uint32_t t = e.twin[h];
      if (h > t) continue;
      const Point3<R>& beyond = points_[e.target(e.next[t])];
      const int side = detail::height(*facets_[e.facet[h]].plane, beyond).sign();
      if (side < 0) continue;
      edges_convex = false;
      report("EdgeNotStrictlyConvex", facet_name(e.facet[h]) + " and " + facet_name(e.facet[t]) +
             (side == 0 ? " are coplanar" : " form a reflex angle"), edge_name(e.origin[h], e.origin[t]));
    }
    if (edges_convex) examine_vertices(e);
  }

  void examine_vertices(const HalfEdges& e) {
    std::vector<char> seen(points_.size(), 0);
    for (std::uint32_t h = 0; h < e.size(); ++h) {
      const std::uint32_t v = e.origin[h];
      if (seen[v] != 0) continue;
      seen[v] = 1;
      const auto star = e.around(h);
      if (star.size() <= 3) continue;  // three convex edges always bound a convex cone
      std::vector<Point3<R>> directions, normals;
      for (const std::uint32_t g : star) {
        directions.push_back(points_[e.target(g)] - points_[v]);
        normals.push_back(detail::normal(*facets_[e.facet[g]].plane));
      }
      if (!detail::vertex_cone_turns_once(directions, normals)) {
        report("VertexNotStrictlyConvex", "its facets go round more than once", vertex_name(v));
      }
    }
  }

  const std::vector<Point3<R>>& points_;
  const FacetLoops& loops_;
  SoupRule rule_;
  SoupShape& shape_;
  std::vector<FacetShape<R>> facets_;
};

template <class S>
SoupShape examine(const PolygonSoup<S>& soup, SoupRule rule) {
  SoupShape shape;
  shape.topology = analyse_topology(soup.facets, soup.points.size());
  detail::on_short_ring(soup.points, [&](const auto& points) {
    using R = std::decay_t<decltype(points[0].x)>;
    Examination<R>(points, soup.facets, rule, shape).run();
  });
  return shape;
}

/// Three of the planes around a vertex with independent normals: the first two and the first that fits.
template <class S>
std::array<FacetId, 3> defining_triple(const std::vector<Plane<S>>& planes, const std::vector<std::uint32_t>& facets,
                                       std::size_t vertex) {
  for (std::size_t i = 1; i < facets.size(); ++i) {
    const Point3<S> line = detail::cross(detail::normal(planes[facets[0]]), detail::normal(planes[facets[i]]));
    if (detail::is_zero(line)) continue;
    for (std::size_t j = i + 1; j < facets.size(); ++j) {
      if (detail::dot(line, detail::normal(planes[facets[j]])).is_zero()) continue;
      return {make_id<FacetId>(facets[0]), make_id<FacetId>(facets[i]), make_id<FacetId>(facets[j])};
    }
  }
  throw InvalidInput("DegenerateVertex", "the planes of its facets share a line", vertex_name(vertex));
}

template <class S>
std::vector<std::array<FacetId, 3>> defining_triples(const std::vector<Plane<S>>& planes, const FacetLoops& loops,
                                                     std::size_t vertex_count) {
  std::vector<std::array<FacetId, 3>> triples(vertex_count);
  std::vector<char> seen(vertex_count, 0);
  const HalfEdges e = half_edges_of(loops);
  for (std::uint32_t h = 0; h < e.size(); ++h) {  // the first half-edge at a vertex lies in its smallest facet
    const std::uint32_t v = e.origin[h];
    if (seen[v] != 0) continue;
    seen[v] = 1;
    std::vector<std::uint32_t> facets;
    for (const std::uint32_t g : e.around(h)) facets.push_back(e.facet[g]);
    triples[v] = defining_triple(planes, facets, v);
  }
  return triples;
}

template <class S>
std::vector<Plane<S>> facet_planes(const std::vector<Point3<S>>& points, const FacetLoops& loops) {
  std::vector<Plane<S>> planes;
  planes.reserve(loops.size());
  for (std::size_t f = 0; f < loops.size(); ++f) {
    planes.push_back(*detail::facet_shape(PolygonView<S>{points, loops[f]}).plane);
  }
  return planes;
}

void store_planes(PlaneBody& body, const std::vector<Point3<Rational>>& points, const FacetLoops& loops) {
  std::vector<Plane<Integer>> planes;
  if (const auto grid = detail::integer_points(points)) {
    planes = facet_planes(grid->points, loops);
    for (Plane<Integer>& p : planes) {
      p = detail::primitive(Plane<Integer>{p.a * grid->denominator, p.b * grid->denominator, p.c * grid->denominator, p.d});
    }
  } else {
    for (const Plane<Rational>& p : facet_planes(points, loops)) planes.push_back(detail::primitive(p));
  }
  body.field = Field::rational;
  body.scale = detail::shortening_scale(planes);
  body.planes.reserve(planes.size());
  for (Plane<Integer>& p : planes) {
    p = detail::scaled_plane(p, body.scale);
    body.planes.push_back(p);
  }
  body.triples = defining_triples(planes, loops, points.size());
}

void store_planes(PlaneBody& body, const std::vector<Point3<QuadraticField>>& points, const FacetLoops& loops) {
  body.field = Field::sqrt5;
  for (const Plane<QuadraticField>& p : facet_planes(points, loops)) body.planes_sqrt5.push_back(detail::primitive(p));
  body.triples = defining_triples(body.planes_sqrt5, loops, points.size());
}

template <class S>
PlaneBody make_body(const PolygonSoup<S>& soup, SoupRule rule) {
  SoupShape shape = examine(soup, rule);
  if (!shape.findings.empty()) throw InvalidInput(std::move(shape.findings));
  PlaneBody body;
  body.loops = soup.facets;
  body.addresses = soup.addresses;
  if (body.addresses.empty()) body.addresses.resize(soup.facets.size());
  store_planes(body, soup.points, soup.facets);
  return body;
}

template <class S, class PointOf>
PolygonSoup<S> soup_of(const PlaneBody& body, PointOf&& point_of) {
  PolygonSoup<S> soup;
  soup.points.reserve(body.vertex_count());
  for (std::size_t v = 0; v < body.vertex_count(); ++v) soup.points.push_back(point_of(make_id<VertexId>(v)));
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    if (body.loops[f].empty()) continue;
    soup.facets.add(body.loops[f]);
    if (!body.addresses.empty()) soup.addresses.push_back(body.addresses[f]);
  }
  return soup;
}

template <class S>
void check_planes(const PlaneBody& body, const std::vector<Plane<S>>& planes, const std::vector<Point3<S>>& points,
                  std::vector<Finding>& findings) {
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    const auto loop = body.loops[f];
    if (loop.empty()) continue;
    for (const VertexId v : loop) {
      if (detail::height(planes[f], points[index(v)]).is_zero()) continue;
      findings.push_back({"NotOnPlane", "is not on the plane of " + facet_name(f), vertex_name(index(v)), {}});
    }
    const auto own = detail::facet_shape(PolygonView<S>{points, loop}).plane;
    if (own && detail::dot(detail::normal(*own), detail::normal(planes[f])).sign() <= 0) {
      findings.push_back({"PlaneFacesInward", "its corners run clockwise seen along its outward normal", facet_name(f), {}});
    }
  }
}

std::vector<Plane<Rational>> planes_in_file_coordinates(const PlaneBody& body) {
  std::vector<Plane<Rational>> planes;
  for (std::size_t f = 0; f < body.planes.size(); ++f) planes.push_back(detail::file_plane(body, f));
  return planes;
}

void append_valences(const PlaneBody& body, std::vector<Finding>& findings) {
  std::vector<std::size_t> valence(body.vertex_count(), 0);
  for (const VertexId v : body.loops.corners()) ++valence[index(v)];
  for (std::size_t v = 0; v < valence.size(); ++v) {
    if (valence[v] == 3) continue;
    findings.push_back({"NotTrivalent", "has valence " + std::to_string(valence[v]) + ", expected 3", vertex_name(v), {}});
  }
}

}  // namespace

SoupShape examine_soup(const PolygonSoup<Rational>& soup, SoupRule rule) { return examine(soup, rule); }
SoupShape examine_soup(const PolygonSoup<QuadraticField>& soup, SoupRule rule) { return examine(soup, rule); }
PlaneBody body_from_soup(const PolygonSoup<Rational>& soup, SoupRule rule) { return make_body(soup, rule); }
PlaneBody body_from_soup(const PolygonSoup<QuadraticField>& soup, SoupRule rule) { return make_body(soup, rule); }

PolygonSoup<Rational> rational_soup(const PlaneBody& body) {
  HEXACT_EXPECTS(body.field == Field::rational);
  return soup_of<Rational>(body, [&](VertexId v) { return detail::meet_in_file_coordinates(body, v); });
}

PolygonSoup<QuadraticField> sqrt5_soup(const PlaneBody& body) {
  HEXACT_EXPECTS(body.field == Field::sqrt5);
  return soup_of<QuadraticField>(body, [&](VertexId v) { return detail::meet_in_file_coordinates_sqrt5(body, v); });
}

std::vector<Finding> convex_trivalent_findings(const PlaneBody& body) {
  std::vector<Finding> findings = analyse_topology(body.loops, body.vertex_count()).findings;
  if (!findings.empty()) return findings;
  if (body.field == Field::rational) {
    PolygonSoup<Rational> soup = rational_soup(body);
    soup.facets = body.loops;  // with the planes that have no facet, so that facets keep their numbers
    findings = examine_soup(soup).findings;
    check_planes(body, planes_in_file_coordinates(body), soup.points, findings);
  } else {
    PolygonSoup<QuadraticField> soup = sqrt5_soup(body);
    soup.facets = body.loops;
    findings = examine_soup(soup).findings;
    std::vector<Plane<QuadraticField>> planes;
    for (std::size_t f = 0; f < body.planes_sqrt5.size(); ++f) planes.push_back(detail::file_plane_sqrt5(body, f));
    check_planes(body, planes, soup.points, findings);
  }
  append_valences(body, findings);
  return findings;
}

}  // namespace hexact
