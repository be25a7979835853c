// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/chamfer_surface.hpp"

#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/certify.hpp"
#include "hexact/exact/embedded.hpp"
#include "hexact/exact/sample_solids.hpp"
#include "hexact/exact/volume.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <random>

using namespace hexact;

namespace {

PlaneBody sample(const std::string& name) {
  if (name == "planar-saddle") return planar_saddle();
  return body_from_soup(std::get<PolygonSoup<Rational>>(sample_solid(name)), SoupRule::planar);
}

double largest_angle(const ChamferSurface& s) {
  const HalfEdges e = half_edges_of(s.body.loops);
  double largest = 0;
  const auto normal = [&](std::size_t f) {
    const Plane<Integer> p = s.body.planes[f];
    return std::array<double, 3>{p.a.to_double(), p.b.to_double(), p.c.to_double()};
  };
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    if (e.twin[h] == kNoTwin) continue;
    const auto p = normal(e.facet[h]), q = normal(s.right[h]);
    const double cross = std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
    largest = std::max(largest, std::atan2(cross, p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) * 180 / std::acos(-1.0));
  }
  return largest;
}

std::size_t bits(const ChamferSurface& s) {
  std::size_t most = 0;
  for (std::size_t f = 0; f < s.body.planes.size(); ++f) {
    const Plane<Integer> p = s.body.planes[f];
    most = std::max({most, p.a.bit_length(), p.b.bit_length(), p.c.bit_length(), p.d.bit_length()});
  }
  return most;
}

std::string failed_claims(const PlaneBody& body, const std::vector<std::string>& names) {
  std::vector<Claim> claims;
  for (const auto& n : names) claims.push_back({n, ""});
  std::string out;
  for (const ClaimVerdict& v : verify(make_certificate(body, claims, {}, {}))) {
    if (v.verdict != Verdict::proved) out += v.claim + ": " + v.witness + "\n";
  }
  return out;
}

std::vector<std::string> refusals(const ChamferSurface& s, const std::vector<Integer>& lifts) {
  try {
    (void)chamfer_surface_step(s, lifts);
  } catch (const InvalidInput& e) {
    std::vector<std::string> out;
    for (const Finding& f : e.findings()) out.push_back(f.code + " " + f.element);
    return out;
  }
  return {};
}

std::string first_refusal(const PlaneBody& body) {
  try {
    (void)chamfer_surface_start(body);
  } catch (const InvalidInput& e) {
    return e.findings().front().code + " " + e.findings().front().element;
  }
  return {};
}

/// Equal lifts of the signs of the edges.
std::vector<Integer> equal_lifts(const ChamferSurface& s, const Integer& t) {
  std::vector<Integer> out;
  for (const std::uint32_t h : number_surface_edges(s).half_edge) out.push_back(s.sign[h] > 0 ? t : -t);
  return out;
}

// ---- one vertex, the slow way

using Vector = std::array<long, 3>;
using Exact = std::array<Rational, 3>;

Vector cross(const Vector& p, const Vector& q) { return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}; }
long dot(const Vector& p, const Vector& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

/// Polygons with exact corners as a body; every corner lies on three planes x = …, y = …, z = ….
PlaneBody loose(const std::vector<std::pair<Vector, std::vector<Exact>>>& polygons) {
  PlaneBody body;
  std::map<Exact, std::size_t> number;
  std::vector<Exact> points;
  for (const auto& [n, polygon] : polygons) {
    for (const Exact& p : polygon) {
      const auto [at, fresh] = number.insert({p, points.size()});
      if (fresh) points.push_back(p);
      body.loops.add_corner(make_id<VertexId>(at->second));
    }
    body.loops.close_loop();
    const Rational d = Rational(n[0]) * polygon[0][0] + Rational(n[1]) * polygon[0][1] + Rational(n[2]) * polygon[0][2];
    const Integer w = d.denominator();
    body.planes.push_back(Plane<Integer>{Integer(n[0]) * w, Integer(n[1]) * w, Integer(n[2]) * w, d.numerator()});
  }
  for (const Exact& p : points) {
    std::array<FacetId, 3> triple{};
    for (std::size_t k = 0; k < 3; ++k) {
      triple[k] = make_id<FacetId>(body.planes.size());
      const Integer w = p[k].denominator();
      const auto entry = [&](std::size_t i) { return i == k ? w : Integer(0); };
      body.planes.push_back(Plane<Integer>{entry(0), entry(1), entry(2), p[k].numerator()});
      body.loops.close_loop();
    }
    body.triples.push_back(triple);
  }
  body.addresses.resize(body.planes.size());
  return body;
}

Exact moved(const Exact& p, const Vector& v, long by) {
  return {p[0] + Rational(v[0] * by), p[1] + Rational(v[1] * by), p[2] + Rational(v[2] * by)};
}

/// The part of a wedge from the direction u counter-clockwise to v that lies in a large parallelogram.
std::vector<Exact> wedge(const Exact& apex, const Vector& u, const Vector& v, bool reflex, long size) {
  const auto at = [&](long i, long j) { return moved(moved(apex, u, i * size), v, j * size); };
  if (!reflex) return {apex, at(1, 0), at(1, 1), at(0, 1)};
  return {apex, at(1, 0), at(1, -1), at(-1, -1), at(-1, 1), at(0, 1)};
}

Exact meet(const std::array<Vector, 3>& n, const std::array<long, 3>& d) {
  const long w = dot(n[0], cross(n[1], n[2]));
  const std::array<Vector, 3> c{cross(n[1], n[2]), cross(n[2], n[0]), cross(n[0], n[1])};
  Exact out;
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = Rational(Integer(d[0] * c[0][k] + d[1] * c[1][k] + d[2] * c[2][k]), Integer(1)) / Rational(w);
  }
  return out;
}

/// Three facets around the origin with normals counter-clockwise and signs of the edges 01, 12, 20.
struct Corner {
  std::array<Vector, 3> n;
  std::array<int, 3> sign;

  [[nodiscard]] long determinant() const { return dot(n[0], cross(n[1], n[2])); }
  /// From the vertex along edge i, between facets i and i + 1.
  [[nodiscard]] Vector away(std::size_t i) const {
    const Vector c = cross(n[i], n[(i + 1) % 3]);
    return {-sign[i] * c[0], -sign[i] * c[1], -sign[i] * c[2]};
  }
  [[nodiscard]] bool reflex(std::size_t f) const { return sign[f] * sign[(f + 2) % 3] * determinant() < 0; }
  /// Facet f leaves the vertex along edge f − 1 and comes back along edge f.
  [[nodiscard]] PlaneBody cone() const {
    std::vector<std::pair<Vector, std::vector<Exact>>> polygons;
    for (std::size_t f = 0; f < 3; ++f) {
      polygons.push_back({n[f], wedge({Rational(0), Rational(0), Rational(0)}, away((f + 2) % 3), away(f), reflex(f), 1)});
    }
    return loose(polygons);
  }
  /// The chamfered cone by the formulas; nothing when two new vertices coincide.
  [[nodiscard]] std::optional<PlaneBody> chamfered(const std::array<long, 3>& t) const {
    constexpr long kSize = 1000;
    const auto sum = [](const Vector& p, const Vector& q) { return Vector{p[0] + q[0], p[1] + q[1], p[2] + q[2]}; };
    std::array<Vector, 3> cut;
    std::array<long, 3> depth;
    for (std::size_t i = 0; i < 3; ++i) cut[i] = sum(n[i], n[(i + 1) % 3]), depth[i] = -sign[i] * t[i];
    const Exact m = meet(cut, depth);
    std::array<Exact, 3> q;
    for (std::size_t f = 0; f < 3; ++f) q[f] = meet({n[f], cut[(f + 2) % 3], cut[f]}, {0, depth[(f + 2) % 3], depth[f]});
    std::vector<std::pair<Vector, std::vector<Exact>>> polygons;
    for (std::size_t f = 0; f < 3; ++f) {
      if (q[f] == m) return std::nullopt;
      polygons.push_back({n[f], wedge(q[f], away((f + 2) % 3), away(f), reflex(f), kSize)});
    }
    for (std::size_t i = 0; i < 3; ++i) {
      // Along edge i outward, facet i is on the right: its corner comes before that of facet i + 1, seen counter-clockwise.
      const std::size_t g = (i + 1) % 3;
      polygons.push_back({cut[i], {m, q[i], moved(q[i], away(i), kSize), moved(q[g], away(i), kSize), q[g]}});
    }
    return loose(polygons);
  }
};

/// Area of the section z = c, c not the height of a vertex: the traces of facets, outward normals on their right.
Rational section_area(const PlaneBody& body, const std::vector<Point3<Rational>>& points, const Rational& c) {
  Rational twice(0);
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    const auto loop = body.loops[f];
    std::vector<std::array<Rational, 2>> cuts;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto &p = points[index(loop[i])], &q = points[index(loop[(i + 1) % loop.size()])];
      if ((p.z < c) == (q.z < c)) continue;
      const Rational t = (c - p.z) / (q.z - p.z);
      cuts.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
    const Plane<Integer> n = body.planes[f];
    const auto along = [&](const std::array<Rational, 2>& x) { return Rational(n.a) * x[1] - Rational(n.b) * x[0]; };
    std::sort(cuts.begin(), cuts.end(), [&](const auto& x, const auto& y) { return along(x) < along(y); });
    for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) twice += cuts[i][0] * cuts[i + 1][1] - cuts[i][1] * cuts[i + 1][0];
  }
  return twice / Rational(2);
}

/// The volume from sections: between heights of vertices the area is a polynomial of degree 2, and Milne's rule is exact.
Rational sliced_volume(const PlaneBody& body) {
  std::vector<Point3<Rational>> points;
  std::vector<Rational> heights;
  for (std::size_t v = 0; v < body.vertex_count(); ++v) {
    points.push_back(rational_vertex(body, make_id<VertexId>(v)));
    heights.push_back(points.back().z);
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  Rational volume(0);
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    const Rational h = heights[i + 1] - heights[i];
    const auto area = [&](long quarter) { return section_area(body, points, heights[i] + h * Rational(Integer(quarter), Integer(4))); };
    volume += h * (Rational(2) * area(1) - area(2) + Rational(2) * area(3)) / Rational(3);
  }
  return volume;
}

bool is_embedded(const PlaneBody& body) { return facet_findings(body).empty() && !first_facet_contact(body); }

/// Random normals and signs, determinant not 0 and edges not parallel.
Corner random_corner(std::mt19937& random) {
  for (;;) {
    Corner c;
    for (auto& n : c.n) {
      for (auto& x : n) x = static_cast<long>(random() % 11) - 5;
    }
    for (auto& s : c.sign) s = random() % 2 == 0 ? 1 : -1;
    if (c.determinant() != 0) return c;
  }
}

bool is_pure(const Corner& c) { return c.sign[0] == c.sign[1] && c.sign[1] == c.sign[2]; }

}  // namespace

TEST_CASE("a corner is embedded exactly for the signs of Lemma 1", "[chamfer-surface]") {
  std::mt19937 random(1);
  std::map<std::string, int> seen;
  for (int trial = 0; trial < 300; ++trial) {
    const Corner c = random_corner(random);
    const bool expected = (c.determinant() > 0) == is_pure(c);
    CAPTURE(trial);
    REQUIRE(is_embedded(c.cone()) == expected);
    ++seen[(c.determinant() > 0 ? "+" : "-") + std::to_string(c.sign[0] + c.sign[1] + c.sign[2])];
  }
  CHECK(seen.size() == 8);  // both signs of the determinant with 0, 1, 2, 3 convex edges
}

TEST_CASE("the lifts at a vertex are accepted exactly when the chamfered corner is embedded", "[chamfer-surface]") {
  std::mt19937 random(2);
  std::map<std::string, int> seen;
  for (int trial = 0; trial < 600; ++trial) {
    Corner c = random_corner(random);
    if ((c.determinant() > 0) != is_pure(c)) {  // turn it into one that exists
      std::swap(c.n[0], c.n[1]);
    }
    REQUIRE((c.determinant() > 0) == is_pure(c));
    std::array<long, 3> t;
    for (auto& x : t) x = 1 + static_cast<long>(random() % 5);
    // The facet between the two edges of equal sign lies between the edges `first` and `second`.
    bool expected = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const long others = t[(i + 1) % 3] + t[(i + 2) % 3];
      if (is_pure(c)) expected = expected && t[i] < others;
      else if (c.sign[i] * (c.sign[0] + c.sign[1] + c.sign[2]) > 0) expected = expected && t[i] != others;  // of the two equal ones
    }
    const auto body = c.chamfered(t);
    CAPTURE(trial, t[0], t[1], t[2], c.sign[0], c.sign[1], c.sign[2]);
    REQUIRE((body && is_embedded(*body)) == expected);
    ++seen[(is_pure(c) ? "pure " : "mixed ") + std::to_string(c.sign[0] + c.sign[1] + c.sign[2]) + (expected ? " accepted" : " refused")];
  }
  CHECK(seen.size() == 8);
}

TEST_CASE("three levels on prisms, a frame and a saddle: counts, angles, concave edges, one bit a level", "[chamfer-surface]") {
  struct Row {
    const char* name;
    std::array<std::size_t, 4> facets, concave;
    std::array<double, 4> angle;
    std::int64_t euler;
  };
  const std::vector<Row> rows{
      {"l-prism", {8, 26, 98, 386}, {1, 4, 16, 64}, {90, 60, 33.557, 17.341}, 2},
      {"u-prism", {10, 34, 130, 514}, {2, 8, 32, 128}, {90, 60, 33.557, 17.341}, 2},
      {"star-prism", {10, 34, 130, 514}, {4, 16, 64, 256}, {126.870, 78.466, 56.252, 30.450}, 2},
      {"frame", {16, 64, 256, 1024}, {4, 16, 64, 256}, {114.095, 83.154, 56.184, 30.085}, 0},
      {"planar-saddle", {19, 61, 217, 817}, {48, 140, 468, 1700}, {37.084, 19.041, 9.655, 4.827}, 1},
      {"cube", {6, 18, 66, 258}, {0, 0, 0, 0}, {90, 60, 33.557, 17.341}, 2},
  };
  for (const Row& row : rows) {
    ChamferSurface s = chamfer_surface_start(sample(row.name));
    for (std::size_t l = 0; l <= 3; ++l) {
      INFO(row.name << " level " << l);
      const MeshTopology topology = analyse_topology(s.body.loops, s.body.vertex_count());
      CHECK(topology.facets == row.facets[l]);
      CHECK(topology.euler == row.euler);
      CHECK(topology.closed == (row.euler != 1));
      CHECK(concave_edge_count(s) == row.concave[l]);
      CHECK(largest_angle(s) == Approx(row.angle[l]).margin(0.01));
      const bool closed = row.euler != 1;
      CHECK(failed_claims(s.body, closed ? std::vector<std::string>{"closed", "planar", "trivalent", "embedded"}
                                         : std::vector<std::string>{"planar", "embedded"}).empty());
      if (l == 3) break;
      const std::size_t before = bits(s), edges = number_surface_edges(s).half_edge.size();
      s = chamfer_surface_step(s);
      if (l > 0) CHECK(bits(s) <= before + 1);
      CHECK(s.body.addresses.back() == FacetAddress{static_cast<std::uint32_t>(l) + 1, make_id<VertexId>(edges - 1)});
    }
  }
}

TEST_CASE("the three cuts meet below each facet by half the triangle defect", "[chamfer-surface]") {
  for (const char* name : {"l-prism", "frame", "star-prism"}) {
    const ChamferSurface s = chamfer_surface_start(sample(name));
    const SurfaceEdges edges = number_surface_edges(s);
    const HalfEdges e = half_edges_of(s.body.loops);
    // Equal lifts but for one in seven, which is smaller: all conditions hold.
    std::vector<Integer> lifts = equal_lifts(s, Integer(64));
    std::vector<Integer> scaled;
    ChamferSurface fine = s;  // planes widened, so that these lifts are small
    fine.body.planes = {};
    for (std::size_t f = 0; f < s.body.planes.size(); ++f) {
      const Plane<Integer> p = s.body.planes[f];
      fine.body.planes.push_back(Plane<Integer>{p.a.shifted_left(12), p.b.shifted_left(12), p.c.shifted_left(12), p.d.shifted_left(12)});
    }
    for (std::size_t i = 0; i < lifts.size(); i += 7) lifts[i] = lifts[i].sign() > 0 ? Integer(41) : Integer(-41);
    const ChamferSurface next = chamfer_surface_step(fine, lifts);
    for (std::uint32_t h = 0; h < e.size(); ++h) {
      std::size_t third = 0;
      for (std::uint32_t k = 0; k < e.size(); ++k) {
        if (e.origin[k] == e.origin[h] && edges.edge[k] != edges.edge[h] && edges.edge[k] != edges.edge[e.previous[h]]) third = edges.edge[k];
      }
      const Rational sigma = Rational(lifts[edges.edge[h]] + lifts[edges.edge[e.previous[h]]] - lifts[third], Integer(2));
      const Plane<Integer> f = fine.body.planes[e.facet[h]];
      PlaneBody own = next.body;
      own.scale = 0;
      const Point3<Rational> m = rational_vertex(own, make_id<VertexId>(e.size() + e.origin[h]));
      CHECK(Rational(f.a) * m.x + Rational(f.b) * m.y + Rational(f.c) * m.z == Rational(f.d) - sigma);
    }
    // Facets survive: the same planes up to the factor 2, the same corners in number.
    for (std::size_t f = 0; f < s.body.loops.size(); ++f) {
      CHECK(next.body.planes[f].a == fine.body.planes[f].a + fine.body.planes[f].a);
      CHECK(next.body.loops[f].size() == s.body.loops[f].size());
    }
  }
}

TEST_CASE("lifts that break a condition are refused by element", "[chamfer-surface]") {
  ChamferSurface s = chamfer_surface_start(sample("l-prism"));
  const SurfaceEdges edges = number_surface_edges(s);
  const HalfEdges e = half_edges_of(s.body.loops);
  IntegerPlanes wide;
  for (std::size_t f = 0; f < s.body.planes.size(); ++f) {
    const Plane<Integer> p = s.body.planes[f];
    wide.push_back(Plane<Integer>{p.a.shifted_left(10), p.b.shifted_left(10), p.c.shifted_left(10), p.d.shifted_left(10)});
  }
  s.body.planes = wide;
  const std::vector<Integer> good = equal_lifts(s, Integer(100));
  CHECK(refusals(s, good).empty());
  CHECK(refusals(s, std::vector<Integer>(good.begin(), good.end() - 1)) == std::vector<std::string>{"BadLifts "});
  const auto edge_between = [&](std::uint32_t a, std::uint32_t b) {
    for (std::size_t i = 0; i < edges.half_edge.size(); ++i) {
      if (e.origin[edges.half_edge[i]] == a && e.target(edges.half_edge[i]) == b) return i;
    }
    throw std::logic_error("no such edge");
  };
  const auto with = [&](std::size_t edge, long value) {
    std::vector<Integer> lifts = good;
    lifts[edge] = Integer(value);
    return refusals(s, lifts);
  };
  const std::size_t concave = edge_between(3, 9), convex = edge_between(0, 6);  // vertex 3 is the inner corner of the L
  CHECK(good[concave] == Integer(-100));
  CHECK(with(concave, 100) == std::vector<std::string>{"LiftSign edge 3-9"});
  CHECK(with(convex, -100) == std::vector<std::string>{"LiftSign edge 0-6"});
  CHECK(with(convex, 0) == std::vector<std::string>{"LiftSign edge 0-6", "TriangleInequality vertex 0", "TriangleInequality vertex 6"});
  // Pure vertices: 200 is the first lift that is refused. Mixed ones: equality alone is.
  CHECK(with(convex, 199).empty());
  CHECK(with(convex, 200) == std::vector<std::string>{"TriangleInequality vertex 0", "TriangleInequality vertex 6"});
  CHECK(with(concave, -199).empty());
  CHECK(with(concave, -200).empty());
  CHECK(with(concave, -201).empty());
  const std::size_t beside = edge_between(2, 3);  // convex, from a pure vertex to the mixed one
  CHECK(with(beside, 199).empty());
  CHECK(with(beside, 200) == std::vector<std::string>{"TriangleInequality vertex 2", "SpokeCollapse vertex 3"});
  // All lifts large. In the groove of height 2 the cuts meet at 3/2 of the lift below the top and above the bottom, lengths
  // being lifts over 1024: they pass each other at 2/3 of 1024. At 1024 sides of length 2 are used up.
  CHECK(refusals(s, equal_lifts(s, Integer(682))).empty());
  CHECK(refusals(s, equal_lifts(s, Integer(683))) == std::vector<std::string>{"FacetNotSimple facet 19, the cut of edge 3-9"});
  const auto used_up = refusals(s, equal_lifts(s, Integer(1024)));
  REQUIRE_FALSE(used_up.empty());
  CHECK(used_up.front().starts_with("SideReversed edge "));
}

TEST_CASE("surfaces that cannot be cut are refused by element", "[chamfer-surface]") {
  CHECK(first_refusal(body_from_soup(std::get<PolygonSoup<Rational>>(sample_solid("octahedron")))) == "NotTrivalent vertex 0");
  CHECK(first_refusal(body_from_soup(std::get<PolygonSoup<QuadraticField>>(sample_solid("dodecahedron")))) == "FieldNotRational ");
  // Facets turned around: convex loops that run clockwise about the normals.
  PlaneBody clockwise = samples::cube();
  for (std::size_t f = 0; f < clockwise.planes.size(); ++f) {
    const Plane<Integer> p = clockwise.planes[f];
    clockwise.planes.set(f, Plane<Integer>{-p.a, -p.b, -p.c, -p.d});
  }
  CHECK(first_refusal(clockwise) == "FacetNotSimple facet 0");
  // A vertex whose planes are not those of its facets.
  PlaneBody wrong = samples::cube();
  std::swap(wrong.triples[0], wrong.triples[7]);
  CHECK(first_refusal(wrong).starts_with("NotOnPlane "));
  // The top of a cube as two coplanar rectangles: three facets at each end of their common edge, two of them in one plane.
  PlaneBody split = samples::cube();
  const std::size_t top = 5;
  REQUIRE(split.loops[top].size() == 4);
  FacetLoops loops;
  std::vector<std::vector<VertexId>> lists;
  for (std::size_t f = 0; f < split.loops.size(); ++f) lists.emplace_back(split.loops[f].begin(), split.loops[f].end());
  const auto quad = lists[top];
  split.planes.push_back(IntegerPlanes::Narrow{1, 0, 0, 0});  // x = 0, without facet
  const auto add_point = [&](std::size_t wall) {
    split.triples.push_back({make_id<FacetId>(wall), make_id<FacetId>(top), make_id<FacetId>(6)});
    return make_id<VertexId>(split.triples.size() - 1);
  };
  const auto between = [&](std::vector<VertexId>& loop, VertexId p) {  // into the edge along y = const of the top
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const VertexId a = loop[i], b = loop[(i + 1) % loop.size()];
      if (std::find(quad.begin(), quad.end(), a) == quad.end() || std::find(quad.begin(), quad.end(), b) == quad.end()) continue;
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, p);
      return;
    }
  };
  const VertexId p = add_point(2), q = add_point(3);
  between(lists[2], p);
  between(lists[3], q);
  // The corners of the top that are on wall 2 come together in the loop.
  std::vector<VertexId> first, second;
  const auto x_sign = [&](VertexId v) { return rational_vertex(split, v).x.sign(); };
  const auto y_sign = [&](VertexId v) { return rational_vertex(split, v).y.sign(); };
  const auto corner = [&](int x, int y) { return *std::find_if(quad.begin(), quad.end(), [&](VertexId v) { return x_sign(v) == x && y_sign(v) == y; }); };
  first = {corner(-1, -1), p, q, corner(-1, 1)};
  second = {p, corner(1, -1), corner(1, 1), q};
  lists[top] = first;
  lists.push_back({});
  lists.push_back(second);
  split.planes.push_back(split.planes[top]);
  for (const auto& loop : lists) loops.add(loop);
  split.loops = loops;
  split.addresses.resize(split.planes.size());
  CHECK(failed_claims(split, {"closed", "planar", "trivalent", "embedded"}).empty());
  CHECK(first_refusal(split) == "DegenerateVertex " + ("vertex " + std::to_string(index(p))));
  // A saddle whose boundary vertices know no plane beyond.
  PlaneBody bare = planar_saddle();
  for (auto& t : bare.triples) {
    if (index(t[2]) < 19 && index(t[1]) < 19) continue;
    t[2] = make_id<FacetId>(bare.planes.size() - 1);
  }
  CHECK_FALSE(first_refusal(bare).empty());
}

TEST_CASE("volumes agree with those by sections", "[chamfer-surface]") {
  CHECK(sliced_volume(sample("l-prism")) == Rational(24));
  for (const char* name : {"l-prism", "star-prism", "frame"}) {
    INFO(name);
    const ChamferSurface s = chamfer_surface_step(chamfer_surface_start(sample(name)));
    CHECK(QuadraticField(sliced_volume(s.body)) == exact_volume(s.body));
  }
}

TEST_CASE("on convex solids the rule and the step agree with the triangle and side conditions", "[chamfer-surface]") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    INFO("seed " << seed);
    ChamferSurface s = chamfer_surface_start(body_from_soup(random_solid(6 + seed, seed)));
    for (int l = 0; l < 2; ++l) s = chamfer_surface_step(s);
    CHECK(concave_edge_count(s) == 0);
    CHECK(failed_claims(s.body, {"convex", "embedded"}).empty());
  }
}
