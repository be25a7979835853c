// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/kernel/mesh_topology.hpp"

#include <catch2/catch.hpp>

#include <initializer_list>

using namespace hexact;

namespace {

FacetLoops loops_of(std::initializer_list<std::vector<int>> lists) {
  FacetLoops loops;
  for (const auto& list : lists) {
    for (int v : list) loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    loops.close_loop();
  }
  return loops;
}

const FacetLoops kCube = loops_of({{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}});

bool has(const MeshTopology& t, const std::string& code, const std::string& element) {
  for (const Finding& f : t.findings) {
    if (f.code == code && f.element == element) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a cube is one closed surface", "[topology]") {
  const MeshTopology t = analyse_topology(kCube, 8);
  CHECK(t.findings.empty());
  CHECK(t.is_one_closed_surface());
  CHECK(t.edges == 12);
  CHECK(t.facets == 6);
  CHECK(t.euler == 2);
  CHECK(t.boundary_loops == 0);
  CHECK(t.facet_sizes == std::map<std::size_t, std::size_t>{{4, 6}});
  CHECK(t.valences == std::map<std::size_t, std::size_t>{{3, 8}});
}

TEST_CASE("a missing facet leaves one boundary loop, two opposite ones two", "[topology]") {
  MeshTopology t = analyse_topology(
      loops_of({{4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}), 8);
  CHECK(t.manifold);
  CHECK_FALSE(t.closed);
  CHECK(t.boundary_loops == 1);
  CHECK(t.euler == 1);
  CHECK(has(t, "HasBoundary", "edge 0-1"));
  t = analyse_topology(loops_of({{0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}), 8);
  CHECK(t.manifold);
  CHECK(t.boundary_loops == 2);
  CHECK(t.euler == 0);
}

TEST_CASE("a reversed facet is a matter of order, a Moebius strip is not", "[topology]") {
  MeshTopology t = analyse_topology(
      loops_of({{2, 3, 1, 0}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}), 8);
  CHECK(t.orientable);
  CHECK_FALSE(t.oriented);
  CHECK(has(t, "InconsistentOrientation", "edge 0-1"));
  t = analyse_topology(loops_of({{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 3, 0, 5}}), 6);
  CHECK(t.manifold);
  CHECK_FALSE(t.orientable);
  CHECK(t.boundary_loops == 1);
  bool reported = false;
  for (const Finding& f : t.findings) reported = reported || f.code == "NotOrientable";
  CHECK(reported);
}

TEST_CASE("the projective plane on 6 vertices is closed and not orientable", "[topology]") {
  const MeshTopology t = analyse_topology(loops_of({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                                                    {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}}), 6);
  CHECK(t.closed);
  CHECK(t.manifold);
  CHECK(t.euler == 1);
  CHECK_FALSE(t.orientable);
}

TEST_CASE("self-touching vertex, edge with three facets, separate parts", "[topology]") {
  MeshTopology t = analyse_topology(loops_of({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                              {3, 5, 4}, {3, 4, 6}, {4, 5, 6}, {5, 3, 6}}), 7);
  CHECK(t.closed);
  CHECK_FALSE(t.manifold);
  CHECK(t.components == 1);
  CHECK(has(t, "NotManifold", "vertex 3"));
  t = analyse_topology(loops_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), 5);
  CHECK_FALSE(t.manifold);
  CHECK(has(t, "NotManifold", "edge 0-1"));
  t = analyse_topology(loops_of({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                 {4, 6, 5}, {4, 5, 7}, {5, 6, 7}, {6, 4, 7}}), 8);
  CHECK(t.manifold);
  CHECK(t.components == 2);
  CHECK(has(t, "NotConnected", "facet 4"));
}

TEST_CASE("two boundary loops that meet at a pinched vertex are two", "[topology]") {
  const MeshTopology t = analyse_topology(loops_of({{0, 1, 2}, {0, 3, 4}}), 5);
  CHECK(t.boundary_loops == 2);
  CHECK(has(t, "NotManifold", "vertex 0"));
}

TEST_CASE("bad loops are named and do no harm", "[topology]") {
  MeshTopology t = analyse_topology(loops_of({{0, 1, 0, 2}}), 3);
  CHECK(has(t, "RepeatedCorner", "facet 0"));
  CHECK_FALSE(t.manifold);
  t = analyse_topology(loops_of({{0, 1}}), 3);
  CHECK(has(t, "TooFewCorners", "facet 0"));
  CHECK(has(t, "UnusedVertex", "vertex 2"));
  t = analyse_topology(loops_of({{0, 1, 7}}), 3);
  CHECK(has(t, "WrongIndex", "facet 0"));
  t = analyse_topology(FacetLoops(), 0);
  CHECK(has(t, "Empty", ""));
  CHECK_FALSE(t.closed);
}

TEST_CASE("around walks counter-clockwise through all facets of a vertex", "[topology]") {
  const HalfEdges e = half_edges_of(kCube);
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    CHECK(e.twin[e.twin[h]] == h);
    CHECK(e.origin[e.twin[h]] == e.target(h));
    CHECK(e.around(h).size() == 3);
  }
  // Vertex 0, from facet 0 (0,1,3,2): the next facet counter-clockwise lies across edge 2→0: facet 4, then facet 2.
  const auto star = e.around(0);
  CHECK(e.facet[star[1]] == 4);
  CHECK(e.facet[star[2]] == 2);
}
