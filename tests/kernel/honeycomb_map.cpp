// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/kernel/honeycomb_map.hpp"

#include "hexact/kernel/edge_numbering.hpp"
#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <vector>

namespace hexact {
namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;

FacetLoops to_loops(const Faces& faces) {
  FacetLoops loops;
  for (const auto& f : faces) {
    for (const std::uint32_t v : f) loops.add_corner(make_id<VertexId>(v));
    loops.close_loop();
  }
  return loops;
}

const Faces kTetrahedron = {{3, 2, 1}, {2, 3, 0}, {3, 1, 0}, {1, 2, 0}};
const Faces kCube = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
/// A pentagonal prism whose vertices are numbered without any order.
const Faces kPrism = {{7, 2, 9, 0, 4}, {1, 8, 3, 5, 6}, {2, 7, 6, 5}, {9, 2, 5, 3}, {0, 9, 3, 8}, {4, 0, 8, 1}, {7, 4, 1, 6}};

/// phs (b.2), canonical numbering, word by word and with search: new vertices by face and position; face-faces
/// start with q_1; vertex-faces by old vertex, from the smallest face at v, counter-clockwise, q_j then q_{j−1}.
Faces canonical_step(const Faces& faces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>> corner;  // (v, next) → face, j
  std::vector<std::uint32_t> first;
  std::uint32_t count = 0, vertices = 0;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    first.push_back(count);
    for (std::uint32_t j = 0; j < faces[f].size(); ++j) {
      corner[{faces[f][j], faces[f][(j + 1) % faces[f].size()]}] = {f, j};
      vertices = std::max(vertices, faces[f][j] + 1);
    }
    count += static_cast<std::uint32_t>(faces[f].size());
  }
  Faces out;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    out.emplace_back();
    for (std::uint32_t j = 0; j < faces[f].size(); ++j) out.back().push_back(first[f] + j);
  }
  for (std::uint32_t v = 0; v < vertices; ++v) {
    std::uint32_t f = 0;
    while (std::find(faces[f].begin(), faces[f].end(), v) == faces[f].end()) ++f;
    out.emplace_back();
    for (int turn = 0; turn < 3; ++turn) {
      const auto n = static_cast<std::uint32_t>(faces[f].size());
      const auto j = static_cast<std::uint32_t>(std::find(faces[f].begin(), faces[f].end(), v) - faces[f].begin());
      const std::uint32_t before = (j + n - 1) % n;
      out.back().push_back(first[f] + j);
      out.back().push_back(first[f] + before);
      // The edge that enters v in f leaves v in the next face counter-clockwise.
      f = corner.at({v, faces[f][before]}).first;
    }
  }
  return out;
}

/// A chamfer step word by word and with search: corner j of face f becomes the vertex of its half-edge, old vertex v
/// the vertex H + v; edges in the order of half-edges a→b with a < b, each with the hexagon
/// m_a, q_Ga, q_Gb, m_b, q_Fb, q_Fa, where a→b runs in F and b→a in G.
Faces chamfer_step(const Faces& faces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> face_left;  // (a, b) → face
  std::map<std::pair<std::size_t, std::uint32_t>, std::uint32_t> corner;     // (face, v) → new vertex
  std::uint32_t count = 0;
  Faces out;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    out.emplace_back();
    for (std::size_t j = 0; j < faces[f].size(); ++j) {
      face_left[{faces[f][j], faces[f][(j + 1) % faces[f].size()]}] = f;
      corner[{f, faces[f][j]}] = count;
      out.back().push_back(count++);
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t j = 0; j < faces[f].size(); ++j) {
      const std::uint32_t a = faces[f][j], b = faces[f][(j + 1) % faces[f].size()];
      if (a > b) continue;
      const std::size_t g = face_left.at({b, a});
      out.push_back({count + a, corner.at({g, a}), corner.at({g, b}), count + b, corner.at({f, b}), corner.at({f, a})});
    }
  }
  return out;
}

Faces faces_of(const HoneycombMap& map) {
  Faces out;
  const FacetLoops loops = map.loops();
  for (std::size_t f = 0; f < loops.size(); ++f) {
    out.emplace_back();
    for (const VertexId v : loops[f]) out.back().push_back(static_cast<std::uint32_t>(v));
  }
  return out;
}

std::size_t vertices_in(const Faces& faces) {
  std::uint32_t n = 0;
  for (const auto& f : faces) n = std::max(n, *std::max_element(f.begin(), f.end()) + 1);
  return n;
}

TEST_CASE("refined loops are the canonical ones", "[map]") {
  for (const Faces& start : {kTetrahedron, kCube, kPrism}) {
    HoneycombMap map(to_loops(start), vertices_in(start));
    Faces faces = start;
    for (int l = 0; l < 4; ++l) {
      map = map.refined();
      faces = canonical_step(faces);
      REQUIRE(faces_of(map) == faces);
    }
  }
}

TEST_CASE("counts follow (b.2)", "[map]") {
  for (const Faces& start : {kTetrahedron, kCube, kPrism}) {
    HoneycombMap map(to_loops(start), vertices_in(start));
    const std::size_t v0 = map.vertex_count(), e0 = map.edge_count();
    std::size_t power = 1;
    for (std::uint32_t l = 0; l <= 6; ++l, power *= 3) {
      CHECK(map.level() == l);
      CHECK(map.vertex_count() == power * v0);
      CHECK(map.edge_count() == power * e0);
      CHECK(map.facet_count() == 2 + power * (e0 - v0));
      CHECK(map.facet_count_at(l) == map.facet_count());
      if (l < 6) map = map.refined();
    }
  }
}

HoneycombMap refined_by(const HoneycombMap& map, Cut cut) {
  return cut == Cut::vertices ? map.refined() : map.refined_at_edges(number_edges(map));
}

TEST_CASE("chamfer steps and honeycomb steps have their canonical loops in any order", "[map][chamfer]") {
  for (const Faces& start : {kTetrahedron, kCube, kPrism}) {
    for (unsigned order = 0; order < 16; ++order) {
      HoneycombMap map(to_loops(start), vertices_in(start));
      Faces faces = start;
      for (std::uint32_t l = 0; l < 4; ++l) {
        const Cut cut = (order >> l & 1) != 0 ? Cut::edges : Cut::vertices;
        map = refined_by(map, cut);
        faces = cut == Cut::edges ? chamfer_step(faces) : canonical_step(faces);
        REQUIRE(map.cut_at(l + 1) == cut);
        REQUIRE(faces_of(map) == faces);
      }
    }
  }
}

TEST_CASE("a chamfer step makes V' = 4V, E' = 4E, F' = F + E", "[map][chamfer]") {
  for (const Faces& start : {kTetrahedron, kCube, kPrism}) {
    HoneycombMap map(to_loops(start), vertices_in(start));
    for (std::uint32_t l = 1; l <= 6; ++l) {
      const std::size_t v = map.vertex_count(), e = map.edge_count(), f = map.facet_count();
      map = refined_by(map, Cut::edges);
      CHECK(map.vertex_count() == 4 * v);
      CHECK(map.edge_count() == 4 * e);
      CHECK(map.facet_count() == f + e);
      CHECK(map.vertex_count() + map.facet_count() == map.edge_count() + 2);
    }
  }
}

TEST_CASE("edges are numbered by their half-edges from the smaller vertex", "[map][chamfer]") {
  HoneycombMap map(to_loops(kPrism), 10);
  for (int l = 0; l < 5; ++l, map = refined_by(map, Cut::edges)) {
    const EdgeNumbering numbers = number_edges(map);
    std::uint32_t e = 0;
    for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
      REQUIRE(numbers.edge[h] == numbers.edge[map.twin(h)]);
      REQUIRE(numbers.is_first(h) == (map.origin(h) < map.target(h)));
      if (numbers.is_first(h)) REQUIRE(numbers.half_edge[e++] == h);
    }
    REQUIRE(e == map.edge_count());
  }
}

TEST_CASE("half-edge relations hold at every level", "[map]") {
  const unsigned order = GENERATE(0U, 15U, 5U, 10U, 3U);
  HoneycombMap map(to_loops(kPrism), 10);
  for (unsigned l = 0; l < 4; ++l, map = refined_by(map, (order >> l & 1) != 0 ? Cut::edges : Cut::vertices)) {
    for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
      REQUIRE(map.twin(map.twin(h)) == h);
      REQUIRE(map.next(map.previous(h)) == h);
      REQUIRE(map.facet(map.next(h)) == map.facet(h));
      REQUIRE(map.origin(map.twin(h)) == map.target(h));
      REQUIRE(map.star(map.origin(h))[map.slot(h)] == h);
    }
    for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
      const auto f = map.facets_at(v);
      REQUIRE(f[0] < f[1]);
      REQUIRE(f[0] < f[2]);
    }
    for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
      const std::uint32_t level = map.facet_level(f);
      REQUIRE(f < map.facet_count_at(level));
      if (level > 0) REQUIRE(map.facet_count_at(level - 1) + map.facet_parent(f) == f);
    }
  }
}

std::string refusal(const Faces& faces, std::size_t vertices) {
  try {
    (void)HoneycombMap(to_loops(faces), vertices);
  } catch (const InvalidInput& e) {
    return e.code();
  }
  return "none";
}

TEST_CASE("what is no closed trivalent map is refused by name", "[map]") {
  CHECK(refusal(kCube, 8) == "none");
  Faces open = kCube;
  open.pop_back();
  CHECK(refusal(open, 8) == "HasBoundary");
  Faces turned = kCube;
  std::reverse(turned[0].begin(), turned[0].end());
  CHECK(refusal(turned, 8) == "NotManifold");
  CHECK(refusal(kCube, 9) == "NotTrivalent");
  CHECK(refusal({{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}, 6) == "NotTrivalent");
  Faces twice = kTetrahedron;
  for (const auto& f : kTetrahedron) twice.push_back({f[0] + 4, f[1] + 4, f[2] + 4});
  CHECK(refusal(twice, 8) == "NotConnected");
  CHECK(refusal({{0, 1}, {1, 0}}, 2) == "NotManifold");
  CHECK(refusal({{0, 1, 9}}, 3) == "WrongIndex");
  CHECK(refusal({{0, 1, 0, 2}}, 3) == "NotManifold");
  CHECK(refusal({}, 0) == "NotManifold");
}

}  // namespace
}  // namespace hexact
