// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/midedge.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

// Meshes of rational points for the tests of Midedge subdivision, and the reference data.
namespace hexact::midedge_samples {

using Level = MidedgeLevel<Rational>;
using Point = Point3<Rational>;

inline Rational number(const nlohmann::json& x) {
  Rational value;
  const std::string text = x.is_string() ? x.get<std::string>() : x.dump();
  if (Rational::parse(text, value) != Rational::ParseResult::ok) throw std::runtime_error("bad number " + text);
  return value;
}

inline Level level_of(const std::vector<Point>& points, const std::vector<std::vector<int>>& facets) {
  FacetLoops loops;
  for (const auto& facet : facets) {
    for (const int v : facet) loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    loops.close_loop();
  }
  return {MidedgeMap(loops, points.size()), points};
}

inline Level level_of(const nlohmann::json& mesh) {
  std::vector<Point> points;
  for (const auto& p : mesh.at("V")) points.push_back({number(p[0]), number(p[1]), number(p[2])});
  return level_of(points, mesh.at("F").get<std::vector<std::vector<int>>>());
}

inline const nlohmann::json& golden() {
  static const nlohmann::json data = [] {
    std::ifstream in(HEXACT_TEST_DATA "/midedge_golden.json");
    return nlohmann::json::parse(in);
  }();
  return data;
}

inline Level golden_mesh(const std::string& name) { return level_of(golden().at("meshes").at(name).at("input")); }

/// m × n quadrilaterals over the integer grid.
inline Level grid(int m, int n, const std::function<Point(int, int)>& point) {
  std::vector<Point> points;
  std::vector<std::vector<int>> facets;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= m; ++i) points.push_back(point(i, j));
  }
  const auto number_of = [&](int i, int j) { return j * (m + 1) + i; };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      facets.push_back({number_of(i, j), number_of(i + 1, j), number_of(i + 1, j + 1), number_of(i, j + 1)});
    }
  }
  return level_of(points, facets);
}

/// m × n quadrilaterals that close in both directions: every vertex has valence 4.
inline Level torus(int m, int n, const std::function<Point(int, int)>& point) {
  std::vector<Point> points;
  std::vector<std::vector<int>> facets;
  const auto number_of = [&](int i, int j) { return (j % n) * m + i % m; };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      points.push_back(point(i, j));
      facets.push_back({number_of(i, j), number_of(i + 1, j), number_of(i + 1, j + 1), number_of(i, j + 1)});
    }
  }
  return level_of(points, facets);
}

/// A prism over an n-gon with a pyramid on top: faces of 3, 4 and n corners, vertices of valence 3, 4 and n.
inline Level tower(int n) {
  std::vector<Point> points;
  std::vector<std::vector<int>> facets;
  for (int z = 0; z < 2; ++z) {
    for (int k = 0; k < n; ++k) points.push_back({k * k - 2 * k, (k * (n - k) * 3) % 7 + 10 * (2 * k < n), z * (5 + k % 3)});
  }
  points.push_back({1, 2, 9});
  facets.emplace_back();
  for (int k = n; k-- > 0;) facets.back().push_back(k);
  for (int k = 0; k < n; ++k) {
    const int l = (k + 1) % n;
    facets.push_back({k, l, n + l, n + k});
    facets.push_back({n + k, n + l, 2 * n});
  }
  return level_of(points, facets);
}

/// A polynomial surface without symmetry over the integer grid.
inline Point wave(int i, int j) { return {3 * i + j, 2 * j - i * j, (i * i * 3 + j * 7 + i * j * j) % 11}; }

/// Open meshes with all that a boundary can have: rows and corners of quadrilaterals, a hole with inward corners, a
/// pentagon and a triangle at the boundary, boundary vertices with 4 to 6 edges, inner vertices of valence 3, 5 and 6,
/// facets that reach the boundary with single corners, a facet alone.
inline std::map<std::string, Level> open_samples() {
  std::map<std::string, Level> samples;
  samples.emplace("grid", grid(5, 4, wave));
  const Level base = grid(5, 5, wave);
  std::vector<std::vector<int>> around;
  for (const std::uint32_t f : {0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24}) {
    const auto loop = base.map.loop(f);
    around.emplace_back(loop.begin(), loop.end());
  }
  samples.emplace("hole", level_of({base.points.begin(), base.points.end()}, around));
  samples.emplace("pentagon", level_of({{0, 0, 0}, {4, 0, 1}, {5, 3, 0}, {2, 5, 2}, {-1, 3, 0}, {8, 0, 1}, {9, 4, 3}, {6, 7, 0}, {1, 8, 1}},
                                       {{0, 1, 2, 3, 4}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}}));
  for (const int n : {5, 6}) {
    std::vector<Point> points{{0, 0, 5}};
    std::vector<std::vector<int>> disc, half;
    for (int i = 0; i < n; ++i) {
      points.push_back({(i * i * 5 + 3 * i) % 13, (7 * i) % 11, i * (n - i)});
      disc.push_back({0, 1 + i, 1 + (i + 1) % n});
      if (i + 1 < n) half.push_back({0, 1 + i, 2 + i});
    }
    samples.emplace("disc of " + std::to_string(n), level_of(points, disc));
    samples.emplace("fan of " + std::to_string(n - 1), level_of(points, half));
  }
  // A corner of a cube: three quadrilaterals around an inner vertex.
  samples.emplace("corner", level_of({{0, 0, 0}, {2, 0, 0}, {3, 3, 1}, {0, 2, 0}, {1, 3, 4}, {0, 0, 2}, {4, 0, 3}},
                                     {{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 1}}));
  samples.emplace("alone", level_of({{0, 0, 0}, {4, 0, 1}, {5, 3, 0}, {2, 5, 2}, {-1, 3, 0}}, {{0, 1, 2, 3, 4}}));
  return samples;
}

/// Two meshes as components of one; facets and vertices of the first come first.
inline Level beside(const Level& a, const Level& b) {
  std::vector<Point> points(a.points.begin(), a.points.end());
  points.insert(points.end(), b.points.begin(), b.points.end());
  std::vector<std::vector<int>> facets;
  for (const Level* level : {&a, &b}) {
    for (std::uint32_t f = 0; f < level->map.facet_count(); ++f) {
      facets.emplace_back();
      for (const std::uint32_t v : level->map.loop(f)) {
        facets.back().push_back(static_cast<int>(v + (level == &b ? a.points.size() : 0)));
      }
    }
  }
  return level_of(points, facets);
}

inline Level refined(Level level, unsigned steps, MidedgeRule rule, MidedgeBoundary boundary = MidedgeBoundary::close) {
  for (unsigned i = 0; i < steps; ++i) level = midedge_step(level, rule, boundary);
  return level;
}

inline MidedgeLevel<double> in_doubles(const Level& level) {
  MidedgeLevel<double> result{level.map, {}};
  for (const Point& p : level.points) result.points.push_back({p.x.to_double(), p.y.to_double(), p.z.to_double()});
  return result;
}

/// The loops of all facets, each from its smallest vertex.
inline std::vector<std::vector<std::uint32_t>> rotated_loops(const MidedgeMap& map) {
  std::vector<std::vector<std::uint32_t>> loops;
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
    const auto loop = map.loop(f);
    loops.emplace_back(loop.begin(), loop.end());
    std::rotate(loops.back().begin(), std::min_element(loops.back().begin(), loops.back().end()), loops.back().end());
  }
  return loops;
}

inline std::vector<std::size_t> counts(const MidedgeMap& map) { return {map.vertex_count(), map.edge_count(), map.facet_count()}; }

inline std::map<std::size_t, std::size_t> facet_sizes(const MidedgeMap& map) {
  std::map<std::size_t, std::size_t> sizes;
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) ++sizes[map.facet_size(f)];
  return sizes;
}

}  // namespace hexact::midedge_samples
