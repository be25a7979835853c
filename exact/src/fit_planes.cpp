// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/fit_planes.hpp"

#include "displacement.hpp"
#include "dyadic_frame.hpp"
#include "hexact/exact/body_from_soup.hpp"

#include <algorithm>
#include <deque>

namespace hexact {
namespace {

using namespace detail;

// Largest entry 2^56 of a rounded normal: with offsets below 2^58 such planes fit machine words.
constexpr unsigned kNormalBits = 56;
constexpr std::size_t kLargestNumberBits = 100000;

/// A vertex or a facet in the order of placement.
struct Node {
  bool is_facet;
  std::uint32_t number;
};

/// Vertices and facets in an order in which each has at most three neighbours before it: nodes of degree at most 3
/// are taken away round by round, vertices first, and the order is read backwards.
std::vector<Node> placement_order(const FacetLoops& loops, const std::vector<std::vector<std::uint32_t>>& facets_at) {
  std::vector<std::size_t> facet_degree(loops.size()), vertex_degree(facets_at.size());
  for (std::size_t f = 0; f < loops.size(); ++f) facet_degree[f] = loops[f].size();
  for (std::size_t v = 0; v < facets_at.size(); ++v) vertex_degree[v] = facets_at[v].size();
  std::vector<char> facet_gone(loops.size(), 0), vertex_gone(facets_at.size(), 0);
  std::vector<Node> order;
  const std::size_t total = loops.size() + facets_at.size();
  order.reserve(total);
  const auto take = [&](Node node) {
    order.push_back(node);
    if (node.is_facet) {
      facet_gone[node.number] = 1;
      for (const VertexId v : loops[node.number]) --vertex_degree[index(v)];
    } else {
      vertex_gone[node.number] = 1;
      for (const std::uint32_t f : facets_at[node.number]) --facet_degree[f];
    }
  };
  while (order.size() < total) {
    const std::size_t before = order.size();
    // The degrees of the beginning of a round decide, so that chains of dependence stay short.
    std::vector<std::uint32_t> round;
    for (std::uint32_t v = 0; v < facets_at.size(); ++v) {
      if (vertex_gone[v] == 0 && vertex_degree[v] <= 3) round.push_back(v);
    }
    for (const std::uint32_t v : round) take({false, v});
    round.clear();
    for (std::uint32_t f = 0; f < loops.size(); ++f) {
      if (facet_gone[f] == 0 && facet_degree[f] <= 3) round.push_back(f);
    }
    for (const std::uint32_t f : round) take({true, f});
    HEXACT_INVARIANT(order.size() > before);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

class Fit {
 public:
  Fit(const PolygonSoup<Rational>& soup, std::vector<Point3<Rational>> target)
      : loops_(soup.facets), target_(std::move(target)), facets_at_(soup.points.size()), point_(soup.points.size()),
        plane_(soup.facets.size()) {
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      for (const VertexId v : loops_[f]) facets_at_[index(v)].push_back(static_cast<std::uint32_t>(f));
    }
  }

  std::vector<Point3<Rational>> run() {
    for (const Node& node : placement_order(loops_, facets_at_)) {
      if (node.is_facet) {
        place_facet(node.number);
      } else {
        place_vertex(node.number);
      }
    }
    std::vector<Point3<Rational>> points;
    for (auto& p : point_) points.push_back(std::move(*p));
    return points;
  }

 private:
  /// Twice the area vector of the corners as given.
  Point3<Rational> area_vector(std::uint32_t f) const {
    const PolygonView<Rational> polygon{target_, loops_[f]};
    Point3<Rational> n{};
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      n = n + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    }
    if (detail::is_zero(n)) throw InvalidInput("FaceNotPlanar", "has no area", facet_name(f));
    return n;
  }

  static Point3<Rational> rational(const Point3<Integer>& n) { return {n.x, n.y, n.z}; }

  void place_facet(std::uint32_t f) {
    std::vector<Point3<Rational>> fixed;
    for (const VertexId v : loops_[f]) {
      if (point_[index(v)]) fixed.push_back(*point_[index(v)]);
    }
    if (fixed.size() >= 2) {
      plane_[f] = plane_with(fixed, f);
    } else {
      const Point3<Integer> n = rounded_direction(area_vector(f), kNormalBits);
      plane_[f] = fixed.empty() ? plane_at_mean(n, f) : plane_through(rational(n), fixed[0]);
    }
    bound(plane_[f]->d, facet_name(f));
  }

  Plane<Rational> plane_at_mean(const Point3<Integer>& n, std::uint32_t f) const {
    Point3<Rational> sum{};
    for (const VertexId v : loops_[f]) sum = sum + target_[index(v)];
    const Rational d = dot(rational(n), sum) / Rational(static_cast<long long>(loops_[f].size()));
    return {n.x, n.y, n.z, Rational(nearest_integer(d))};
  }

  /// Through two or three placed corners; with two, also through the given corner that is farthest from their line.
  Plane<Rational> plane_with(std::vector<Point3<Rational>> fixed, std::uint32_t f) const {
    if (fixed.size() == 2) {
      const Point3<Rational> line = fixed[1] - fixed[0];
      Rational best(0);
      Point3<Rational> third = fixed[0];
      for (const VertexId v : loops_[f]) {
        const Point3<Rational> c = cross(line, target_[index(v)] - fixed[0]);
        if (dot(c, c) > best) {
          best = dot(c, c);
          third = target_[index(v)];
        }
      }
      fixed.push_back(third);
    }
    Point3<Rational> n = cross(fixed[1] - fixed[0], fixed[2] - fixed[0]);
    if (detail::is_zero(n)) throw InvalidInput("FaceNotStrictlyConvex", "three of its corners are collinear", facet_name(f));
    if (dot(n, area_vector(f)).sign() < 0) n = {-n.x, -n.y, -n.z};
    return plane_through(n, fixed[0]);
  }

  void place_vertex(std::uint32_t v) {
    std::vector<Plane<Rational>> planes;
    for (const std::uint32_t f : facets_at_[v]) {
      if (plane_[f]) planes.push_back(*plane_[f]);
    }
    // Coordinates of the given position complete what the planes leave open.
    const auto keep = [&](int axis) {
      const Rational zero(0), one(1);
      planes.push_back({axis == 0 ? one : zero, axis == 1 ? one : zero, axis == 2 ? one : zero,
                        coordinate(target_[v], axis)});
    };
    if (planes.empty()) {
      point_[v] = target_[v];
      return;
    }
    if (planes.size() == 1) {
      const int solved = largest_axis(normal(planes[0]));
      keep((solved + 1) % 3);
      keep((solved + 2) % 3);
    } else if (planes.size() == 2) {
      keep(largest_axis(cross(normal(planes[0]), normal(planes[1]))));
    }
    point_[v] = meet(planes, v);
    bound(point_[v]->x, vertex_name(v));
  }

  static int largest_axis(const Point3<Rational>& n) {
    const Rational x = abs(n.x), y = abs(n.y), z = abs(n.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  }

  static Point3<Rational> meet(const std::vector<Plane<Rational>>& p, std::uint32_t v) {
    const Point3<Rational> u = cross(normal(p[1]), normal(p[2]));
    const Rational w = dot(normal(p[0]), u);
    if (w.is_zero()) throw InvalidInput("DegenerateVertex", "the planes fitted to its facets share a line", vertex_name(v));
    const Point3<Rational> m = p[0].d * u + p[1].d * cross(normal(p[2]), normal(p[0])) +
                               p[2].d * cross(normal(p[0]), normal(p[1]));
    return {m.x / w, m.y / w, m.z / w};
  }

  static void bound(const Rational& x, const std::string& element) {
    if (x.denominator().bit_length() > kLargestNumberBits || x.numerator().bit_length() > kLargestNumberBits) {
      throw ResourceLimit(element + ": fitting exact planes needs numbers of more than " +
                          std::to_string(kLargestNumberBits) + " bits; --truncate or --triangulate the mesh first");
    }
  }

  const FacetLoops& loops_;
  std::vector<Point3<Rational>> target_;
  std::vector<std::vector<std::uint32_t>> facets_at_;
  std::vector<std::optional<Point3<Rational>>> point_;
  std::vector<std::optional<Plane<Rational>>> plane_;
};

}  // namespace

FittedSoup fit_planes(const PolygonSoup<Rational>& soup) {
  SoupShape given = examine_soup(soup, SoupRule::planar);
  if (given.planar && given.findings.empty()) {  // already exact: only convexity is left to decide
    SoupShape shape = examine_soup(soup, SoupRule::convex);
    if (!shape.findings.empty()) throw InvalidInput(std::move(shape.findings));
    return {soup, 0};
  }
  std::erase_if(given.findings, [](const Finding& f) { return f.code == "FaceNotPlanar"; });
  if (given.findings.empty() && given.topology.euler != 2) {
    given.findings.push_back({"BadEuler", "vertices - edges + facets is " + std::to_string(given.topology.euler) +
                              ", expected 2", "", std::nullopt});
  }
  if (!given.findings.empty()) throw InvalidInput(std::move(given.findings));
  const DyadicFrame frame = frame_of(soup.points);
  std::vector<Point3<Rational>> here;
  for (const auto& p : soup.points) here.push_back(frame.here(p));
  FittedSoup result;
  result.soup.facets = soup.facets;
  result.soup.addresses = soup.addresses;
  for (const auto& p : Fit(soup, std::move(here)).run()) result.soup.points.push_back(frame.file(p));
  SoupShape fitted = examine_soup(result.soup, SoupRule::convex);
  if (!fitted.findings.empty()) throw InvalidInput(std::move(fitted.findings));
  result.max_displacement = largest_distance(soup.points, result.soup.points);
  return result;
}

}  // namespace hexact
