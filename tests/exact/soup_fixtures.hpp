// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/mesh_topology.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <array>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

// Small solids with derived figures, for the tests of preparation.
namespace hexact::fixtures {

inline Rational fraction(long p, long q) { return Rational(Integer(p), Integer(q)); }

inline PolygonSoup<Rational> soup_of(std::initializer_list<std::array<Rational, 3>> points,
                                     std::initializer_list<std::vector<int>> facets) {
  PolygonSoup<Rational> soup;
  for (const auto& p : points) soup.points.push_back({p[0], p[1], p[2]});
  for (const auto& list : facets) {
    for (int v : list) soup.facets.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    soup.facets.close_loop();
  }
  return soup;
}

inline PolygonSoup<Rational> cube() {
  return soup_of({{-1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {-1, 1, 1}, {1, -1, -1}, {1, -1, 1}, {1, 1, -1}, {1, 1, 1}},
                 {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}});
}

inline PolygonSoup<Rational> triangulated_cube() {
  PolygonSoup<Rational> soup = cube();
  FacetLoops triangles;
  for (std::size_t f = 0; f < 6; ++f) {
    const auto q = soup.facets[f];
    triangles.add(std::array{q[0], q[1], q[2]});
    triangles.add(std::array{q[0], q[2], q[3]});
  }
  soup.facets = triangles;
  return soup;
}

inline PolygonSoup<Rational> pyramid() {
  return soup_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}},
                 {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
}

inline PolygonSoup<Rational> octahedron() {
  return soup_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                 {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

template <class S>
std::array<std::size_t, 3> counts(const PolygonSoup<S>& soup) {
  const MeshTopology t = analyse_topology(soup.facets, soup.points.size());
  return {t.vertices, t.edges, t.facets};
}

using Counts = std::array<std::size_t, 3>;
using Sizes = std::map<std::size_t, std::size_t>;

template <class S>
Sizes facet_sizes(const PolygonSoup<S>& soup) {
  return analyse_topology(soup.facets, soup.points.size()).facet_sizes;
}

/// The codes of the findings that `action` throws; empty when it throws none.
template <class Action>
std::set<std::string> codes_thrown_by(Action&& action) {
  std::set<std::string> codes;
  try {
    action();
  } catch (const InvalidInput& e) {
    for (const Finding& f : e.findings()) codes.insert(f.code);
  }
  return codes;
}
using Codes = std::set<std::string>;

/// Steele, Lea and Flood's generator: the same numbers everywhere.
struct SplitMix64 {
  std::uint64_t state;
  std::uint64_t operator()() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  long between(long low, long high) { return low + static_cast<long>((*this)() % static_cast<std::uint64_t>(high - low + 1)); }
};

}  // namespace hexact::fixtures
