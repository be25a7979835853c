// SPDX-License-Identifier: LGPL-3.0-or-later
#include "nonconvex_solids.hpp"

#include "hexact/exact/sample_solids.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <vector>

namespace hexact {
namespace detail {
namespace {

using Corner = std::array<int, 2>;
using Corner3 = std::array<int, 3>;

void add_loop(PolygonSoup<Rational>& soup, const std::vector<std::size_t>& loop) {
  for (const std::size_t v : loop) soup.facets.add_corner(make_id<VertexId>(v));
  soup.facets.close_loop();
}

/// Bottom, top and one wall for each side of a counter-clockwise polygon.
PolygonSoup<Rational> prism_over(const std::vector<Corner>& polygon) {
  PolygonSoup<Rational> soup;
  const std::size_t n = polygon.size();
  for (const int z : {0, 2}) {
    for (const Corner& c : polygon) soup.points.push_back({c[0], c[1], z});
  }
  std::vector<std::size_t> bottom, top;
  for (std::size_t i = 0; i < n; ++i) {
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
  }
  add_loop(soup, bottom);
  add_loop(soup, top);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    add_loop(soup, {i, j, n + j, n + i});
  }
  return soup;
}

/// The polygons as a soup, equal corners once.
PolygonSoup<Rational> soup_of(const std::vector<std::vector<Corner3>>& polygons) {
  PolygonSoup<Rational> soup;
  std::map<Corner3, std::size_t> number;
  for (const auto& polygon : polygons) {
    std::vector<std::size_t> loop;
    for (const Corner3& c : polygon) {
      const auto [place, fresh] = number.insert({c, soup.points.size()});
      if (fresh) soup.points.push_back({c[0], c[1], c[2]});
      loop.push_back(place->second);
    }
    add_loop(soup, loop);
  }
  return soup;
}

/// Height of the roof of the frame; the bottom is its mirror image.
int roof(int x, int y) { return 6 - (std::abs(x) + std::abs(y)) / 2; }

}  // namespace

PolygonSoup<Rational> l_prism() { return prism_over({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}); }
PolygonSoup<Rational> u_prism() { return prism_over({{0, 0}, {6, 0}, {6, 5}, {4, 5}, {4, 2}, {2, 2}, {2, 5}, {0, 5}}); }
PolygonSoup<Rational> star_prism() { return prism_over({{0, 0}, {3, 1}, {6, 0}, {5, 3}, {6, 6}, {3, 5}, {0, 6}, {1, 3}}); }

PolygonSoup<Rational> frame() {
  constexpr int kOuter = 4, kInner = 2;
  std::vector<std::vector<Corner3>> polygons;
  const auto quarter = [](int turns, int x, int y) {
    for (int i = 0; i < turns; ++i) std::swap(x, y), x = -x;
    return Corner{x, y};
  };
  const auto over = [](const Corner& c) { return Corner3{c[0], c[1], roof(c[0], c[1])}; };
  const auto under = [](const Corner& c) { return Corner3{c[0], c[1], -roof(c[0], c[1])}; };
  for (int k = 0; k < 4; ++k) {
    // The ring between x = 0 and y = 0, counter-clockwise from above.
    std::vector<Corner3> top, bottom;
    for (const Corner& c : {Corner{kOuter, 0}, {kOuter, kOuter}, {0, kOuter}, {0, kInner}, {kInner, kInner}, {kInner, 0}}) {
      const Corner t = quarter(k, c[0], c[1]);
      top.push_back(over(t));
      bottom.push_back(under(t));
    }
    std::reverse(bottom.begin(), bottom.end());
    polygons.push_back(top);
    polygons.push_back(bottom);
    // The walls x = 4, seen from +x, and x = 2, seen from the hole.
    const auto wall = [&](int x) {
      const Corner a = quarter(k, x, -x), b = quarter(k, x, 0), c = quarter(k, x, x);
      return std::vector<Corner3>{under(a), under(b), under(c), over(c), over(b), over(a)};
    };
    polygons.push_back(wall(kOuter));
    std::vector<Corner3> hole = wall(kInner);
    std::reverse(hole.begin(), hole.end());
    polygons.push_back(hole);
  }
  return soup_of(polygons);
}

}  // namespace detail

PlaneBody planar_saddle() {
  // Points i·(4, −3) + j·(4, 3) of the plane; six neighbours of each differ by ±(1, 0), ±(0, 1), ±(1, −1) in (i, j).
  using Place = std::array<int, 2>;
  constexpr int kRings = 2;
  constexpr std::array<Place, 6> around{{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
  const auto ring = [](const Place& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[0] + p[1])}); };
  std::vector<Place> places;
  std::map<Place, std::size_t> number;
  for (const bool facets : {true, false}) {  // the planes of the last ring carry no facet
    for (int i = -kRings - 1; i <= kRings + 1; ++i) {
      for (int j = -kRings - 1; j <= kRings + 1; ++j) {
        const Place p{i, j};
        if (ring(p) > kRings + 1 || (ring(p) <= kRings) != facets) continue;
        number[p] = places.size();
        places.push_back(p);
      }
    }
  }
  PlaneBody body;
  std::map<std::array<std::size_t, 3>, std::size_t> vertex;
  for (const Place& p : places) {
    // Tangent to z = (x² − y²)/16 at (px, py): 16 z <= 2 px x − 2 py y − px² + py².
    const int x = 4 * (p[0] + p[1]), y = 3 * (p[1] - p[0]);
    body.planes.push_back(Plane<Integer>{Integer(-2 * x), Integer(2 * y), Integer(16), Integer(y * y - x * x)});
    body.addresses.push_back({});
    if (ring(p) <= kRings) {
      for (std::size_t k = 0; k < around.size(); ++k) {
        const auto neighbour = [&](std::size_t m) { return number.at({p[0] + around[m % 6][0], p[1] + around[m % 6][1]}); };
        std::array<std::size_t, 3> planes{number.at(p), neighbour(k), neighbour(k + 1)};
        std::rotate(planes.begin(), std::min_element(planes.begin(), planes.end()), planes.end());
        const auto [at, fresh] = vertex.insert({planes, body.triples.size()});
        if (fresh) body.triples.push_back({make_id<FacetId>(planes[0]), make_id<FacetId>(planes[1]), make_id<FacetId>(planes[2])});
        body.loops.add_corner(make_id<VertexId>(at->second));
      }
    }
    body.loops.close_loop();
  }
  return body;
}

}  // namespace hexact
