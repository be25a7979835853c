// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/sample_solids.hpp"

#include "facet_geometry.hpp"
#include "hexact/exact/convex_hull.hpp"
#include "hexact/exact/dual.hpp"
#include "nonconvex_solids.hpp"
#include "primitive_plane.hpp"
#include "stored_solids.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace hexact {
namespace {

using namespace detail;
using Golden = QuadraticField;

template <class S>
bool lexicographically_less(const Point3<S>& p, const Point3<S>& q) {
  if (!(p.x == q.x)) return p.x < q.x;
  if (!(p.y == q.y)) return p.y < q.y;
  return p.z < q.z;
}

/// The hull of all points that cyclic shifts and changes of sign make from some, numbered lexicographically.
template <class S>
PolygonSoup<S> pyritohedral(const std::vector<Point3<S>>& seeds) {
  std::vector<Point3<S>> points;
  for (const Point3<S>& s : seeds) {
    for (const Point3<S>& p : {s, Point3<S>{s.y, s.z, s.x}, Point3<S>{s.z, s.x, s.y}}) {
      for (int signs = 0; signs < 8; ++signs) {
        points.push_back({signs & 1 ? -p.x : p.x, signs & 2 ? -p.y : p.y, signs & 4 ? -p.z : p.z});
      }
    }
  }
  std::sort(points.begin(), points.end(), lexicographically_less<S>);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return convex_hull(points);
}

PolygonSoup<Rational> mesh(const std::vector<Point3<Rational>>& points, const std::vector<std::vector<std::uint32_t>>& loops) {
  PolygonSoup<Rational> soup;
  soup.points = points;
  for (const auto& loop : loops) {
    for (const std::uint32_t v : loop) soup.facets.add_corner(make_id<VertexId>(v));
    soup.facets.close_loop();
  }
  return soup;
}

Rational half(long long x) { return Rational(Integer(x), Integer(2)); }
Golden phi() { return {half(1), half(1)}; }
Golden inverse_phi() { return {half(-1), half(1)}; }

PolygonSoup<Rational> tetrahedron() {
  return mesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{3, 2, 1}, {2, 3, 0}, {3, 1, 0}, {1, 2, 0}});
}

PolygonSoup<Rational> cube() {
  return mesh({{-1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {-1, 1, 1}, {1, -1, -1}, {1, -1, 1}, {1, 1, -1}, {1, 1, 1}},
              {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}});
}

PolygonSoup<Rational> pyramid() {
  return mesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}},
              {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
}

ExactSoup truncated_icosahedron() {
  const Golden g = phi(), two(2), one(1), zero(0);
  return pyritohedral<Golden>({{zero, one, Golden(3) * g}, {one, two + g, two * g}, {g, two, two * g + one}});
}

PolygonSoup<Rational> stored(const std::vector<PlaneAndLoop>& rows) {
  std::vector<std::vector<Plane<Rational>>> planes_at;
  std::vector<std::vector<std::uint32_t>> loops;
  for (const PlaneAndLoop& row : rows) {
    const auto number = [&](std::size_t i) { return Rational(static_cast<long long>(row.plane[i])); };
    for (const std::uint32_t v : row.loop) {
      if (v >= planes_at.size()) planes_at.resize(v + 1);
      planes_at[v].push_back({number(0), number(1), number(2), number(3)});
    }
    loops.push_back(row.loop);
  }
  std::vector<Point3<Rational>> points;
  for (std::size_t v = 0; v < planes_at.size(); ++v) {
    points.push_back(meet_planes(planes_at[v][0], planes_at[v][1], planes_at[v][2], v));
  }
  return mesh(points, loops);
}

/// The dual of a torus of 10 × 6 × 2 triangles with vertices rounded to integers: 60 hexagons, phs (g) Figure 34.
PolygonSoup<Rational> torus() {
  constexpr std::uint32_t nu = 10, nv = 6;
  std::vector<Point3<Rational>> points;
  std::vector<std::vector<std::uint32_t>> triangles;
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      const double a = 2 * std::numbers::pi * i / nu, b = 2 * std::numbers::pi * j / nv;
      const double r = 3 + std::cos(b);
      const auto thousandths = [](double x) { return Rational(static_cast<long long>(std::llround(1000 * x))); };
      points.push_back({thousandths(r * std::cos(a)), thousandths(r * std::sin(a)), thousandths(std::sin(b))});
      const std::uint32_t p = i * nv + j, q = (i + 1) % nu * nv + j;
      const std::uint32_t s = (i + 1) % nu * nv + (j + 1) % nv, t = i * nv + (j + 1) % nv;
      triangles.push_back({p, q, s});
      triangles.push_back({p, s, t});
    }
  }
  return dual_mesh(mesh(points, triangles));
}

/// Rows of 5, 6, 5, 6, 5 hexagons lifted to z = xy/8: 27 hexagons with a boundary, phs (g) Figure 35.
PolygonSoup<Rational> saddle() {
  const std::array<int, 5> rows{5, 6, 5, 6, 5};
  constexpr std::array<std::array<int, 2>, 6> corners{{{1, -1}, {1, 1}, {0, 2}, {-1, 1}, {-1, -1}, {0, -2}}};
  std::map<std::array<int, 2>, std::uint32_t> number;
  std::vector<Point3<Rational>> points;
  std::vector<std::vector<std::uint32_t>> loops;
  for (int r = 0; r < 5; ++r) {
    for (int i = 0; i < rows[static_cast<std::size_t>(r)]; ++i) {
      loops.emplace_back();
      for (const auto& c : corners) {
        const std::array<int, 2> key{2 * i - rows[static_cast<std::size_t>(r)] + c[0], 3 * r + c[1]};
        const auto [place, fresh] = number.insert({key, static_cast<std::uint32_t>(points.size())});
        if (fresh) {
          const Rational x(key[0]), y(key[1] - 6);
          points.push_back({x, y, x * y / Rational(8)});
        }
        loops.back().push_back(place->second);
      }
    }
  }
  return mesh(points, loops);
}

/// The surface of a union of unit cubes, named by their smallest corners in lexicographic order.
PolygonSoup<Rational> voxels(const std::vector<std::array<int, 3>>& cubes) {
  struct Side {
    std::array<int, 3> towards;
    std::array<std::array<int, 3>, 4> corners;
  };
  constexpr std::array<Side, 6> sides{{{{1, 0, 0}, {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}}},
                                       {{-1, 0, 0}, {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}}},
                                       {{0, 1, 0}, {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}}},
                                       {{0, -1, 0}, {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}}},
                                       {{0, 0, 1}, {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}},
                                       {{0, 0, -1}, {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}}}}};
  const auto sum = [](const std::array<int, 3>& a, const std::array<int, 3>& b) {
    return std::array<int, 3>{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  };
  std::map<std::array<int, 3>, std::uint32_t> number;
  std::vector<Point3<Rational>> points;
  std::vector<std::vector<std::uint32_t>> loops;
  for (const auto& cube : cubes) {
    for (const Side& side : sides) {
      if (std::find(cubes.begin(), cubes.end(), sum(cube, side.towards)) != cubes.end()) continue;
      loops.emplace_back();
      for (const auto& corner : side.corners) {
        const auto p = sum(cube, corner);
        const auto [place, fresh] = number.insert({p, static_cast<std::uint32_t>(points.size())});
        if (fresh) points.push_back({p[0], p[1], p[2]});
        loops.back().push_back(place->second);
      }
    }
  }
  return mesh(points, loops);
}

PolygonSoup<Rational> seven_cubes() {
  return voxels({{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
}

PolygonSoup<Rational> seven_cubes_corner() {
  return voxels({{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}, {1, 0, 0}, {1, 0, 1}, {1, 1, 0}});
}

struct Sample {
  SampleName name;
  ExactSoup (*make)();
};

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all{
      {{"tetrahedron", "regular, vertices among those of the cube"}, [] { return ExactSoup(tetrahedron()); }},
      {{"cube", "side 2"}, [] { return ExactSoup(cube()); }},
      {{"octahedron", "vertices at distance 1; four facets at each"},
       [] { return ExactSoup(pyritohedral<Rational>({{0, 0, 1}})); }},
      {{"dodecahedron", "regular, over Q(sqrt5)"},
       [] { return ExactSoup(pyritohedral<Golden>({{1, 1, 1}, {0, inverse_phi(), phi()}})); }},
      {{"icosahedron", "regular, over Q(sqrt5); five facets at each vertex"},
       [] { return ExactSoup(pyritohedral<Golden>({{0, 1, phi()}})); }},
      {{"truncated-icosahedron", "12 pentagons and 20 hexagons, over Q(sqrt5)"}, truncated_icosahedron},
      {{"pyritohedron", "12 equal pentagons with rational corners"},
       [] { return ExactSoup(pyritohedral<Rational>({{1, 1, 1}, {0, half(3), Rational(Integer(3), Integer(4))}})); }},
      {{"cuboctahedron", "8 triangles and 6 squares, four at each vertex"},
       [] { return ExactSoup(pyritohedral<Rational>({{0, 1, 1}})); }},
      {{"pyramid", "over a square"}, [] { return ExactSoup(pyramid()); }},
      {{"random12", "a stored generic solid with 12 facets"}, [] { return ExactSoup(stored(kRandom12)); }},
      {{"random29", "a stored generic solid with 29 facets"}, [] { return ExactSoup(stored(kRandom29)); }},
      {{"seven-cubes", "a cube with one more on each side: 32 vertices, 30 squares, not convex"},
       [] { return ExactSoup(seven_cubes()); }},
      {{"seven-cubes-corner", "2 x 2 x 2 cubes without one: 26 vertices, 24 squares, not convex"},
       [] { return ExactSoup(seven_cubes_corner()); }},
      {{"l-prism", "not convex: one concave edge"}, [] { return ExactSoup(l_prism()); }},
      {{"u-prism", "not convex: two concave edges"}, [] { return ExactSoup(u_prism()); }},
      {{"star-prism", "not convex: four concave edges"}, [] { return ExactSoup(star_prism()); }},
      {{"frame", "a square block with a square hole: genus 1, 16 planar hexagons"}, [] { return ExactSoup(frame()); }},
      {{"torus", "60 hexagons that are not planar"}, [] { return ExactSoup(torus()); }},
      {{"saddle", "27 hexagons that are not planar, with a boundary"}, [] { return ExactSoup(saddle()); }},
  };
  return all;
}

/// Steele, Lea and Flood 2014: the same numbers everywhere.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(next() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::uint64_t state_;
};

Plane<Integer> random_plane(SplitMix64& random, std::size_t n) {
  constexpr std::int64_t kSize = 1000, kRadius = 100;
  for (;;) {
    const std::int64_t a = random.between(-kSize, kSize), b = random.between(-kSize, kSize), c = random.between(-kSize, kSize);
    const std::int64_t squared = a * a + b * b + c * c;
    if (squared > kSize * kSize || 4 * squared < kSize * kSize) continue;  // directions evenly spread
    Integer tangent;
    mpz_sqrt(tangent.raw(), Integer(kRadius * kRadius * squared).raw());
    // A little outside the sphere, by less than the height of a cap that one of n facets covers.
    const std::int64_t room = tangent.to_int64() / static_cast<std::int64_t>(4 * n);
    return {a, b, c, tangent + Integer(random.between(1, room + 1))};
  }
}

/// The polar point of a half-space that holds the origin inside.
Point3<Rational> polar(const Plane<Integer>& p) { return {Rational(p.a, p.d), Rational(p.b, p.d), Rational(p.c, p.d)}; }

/// Planes that are corners of the hull of the polar points, as many of their facets are triangles; empty when the
/// half-spaces leave the solid unbounded.
std::vector<char> contributing(const std::vector<Point3<Rational>>& points, const PolygonSoup<Rational>& hull) {
  std::vector<char> keep(points.size(), 0);
  std::map<std::array<Rational, 3>, std::size_t> number;
  for (std::size_t i = points.size(); i-- > 0;) number[{points[i].x, points[i].y, points[i].z}] = i;
  for (const auto& p : hull.points) keep[number.at({p.x, p.y, p.z})] = 1;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const Plane<Rational> plane = *facet_shape(PolygonView<Rational>{hull.points, hull.facets[f]}).plane;
    if (plane.d.sign() <= 0) return {};
    if (hull.facets[f].size() == 3) continue;
    const auto& p = hull.points[index(hull.facets[f][0])];
    keep[number.at({p.x, p.y, p.z})] = 0;  // four planes in one point: without one of them
  }
  return keep;
}

/// The polar body of a hull of triangles around the origin: a vertex for each triangle, a facet for each point.
PolygonSoup<Rational> polar_body(const PolygonSoup<Rational>& hull) {
  PolygonSoup<Rational> body;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const Plane<Rational> p = *facet_shape(PolygonView<Rational>{hull.points, hull.facets[f]}).plane;
    body.points.push_back({p.a / p.d, p.b / p.d, p.c / p.d});
  }
  body.facets = dual_mesh(hull).facets;
  return body;
}

}  // namespace

const std::vector<SampleName>& sample_names() {
  static const std::vector<SampleName> names = [] {
    std::vector<SampleName> all;
    for (const Sample& s : samples()) all.push_back(s.name);
    return all;
  }();
  return names;
}

ExactSoup sample_solid(const std::string& name) {
  for (const Sample& s : samples()) {
    if (s.name.name == name) return s.make();
  }
  throw InvalidInput("UnknownSample", "there is no sample " + name, "");
}

PolygonSoup<Rational> prism(std::size_t n) {
  HEXACT_EXPECTS(n >= 3 && n <= 100000);
  // Corner k has the angle 2πk/n + π/n·(n even). With u = tan(angle/2) it is ((1 − u²)/(1 + u²), 2u/(1 + u²));
  // u is rounded so finely that neighbours stay apart, in the first quadrant, and reflected into the others.
  const double grid = std::ldexp(1.0, 16 + static_cast<int>(std::ceil(std::log2(static_cast<double>(n)))));
  const auto corner = [&](std::size_t twice) {  // angle = twice · π/n, 0 <= twice < 2n
    const bool lower = twice > n;
    const std::size_t up = lower ? 2 * n - twice : twice;
    const bool left = 2 * up > n;
    const std::size_t first = left ? n - up : up;
    const double t = std::tan(std::numbers::pi * static_cast<double>(first) / (2 * static_cast<double>(n)));
    const Rational u = Rational::from_double(std::nearbyint(t * grid) / grid);
    const Rational w = Rational(1) + u * u;
    const Rational x = (Rational(1) - u * u) / w, y = Rational(2) * u / w;
    return std::array<Rational, 2>{left ? -x : x, lower ? -y : y};
  };
  PolygonSoup<Rational> soup;
  for (int z : {-1, 1}) {
    for (std::size_t k = 0; k < n; ++k) {
      const auto c = corner(2 * k);
      soup.points.push_back({c[0], c[1], z});
    }
  }
  const auto add = [&](std::size_t v) { soup.facets.add_corner(make_id<VertexId>(v)); };
  for (std::size_t k = n; k-- > 0;) add(k);
  soup.facets.close_loop();
  for (std::size_t k = 0; k < n; ++k) add(n + k);
  soup.facets.close_loop();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t l = (k + 1) % n;
    for (const std::size_t v : {k, l, n + l, n + k}) add(v);
    soup.facets.close_loop();
  }
  return soup;
}

PolygonSoup<Rational> grid(std::size_t m, std::size_t n) {
  HEXACT_EXPECTS(m >= 1 && n >= 1 && m * n <= 1000000);
  PolygonSoup<Rational> soup;
  for (std::size_t j = 0; j <= n; ++j) {
    for (std::size_t i = 0; i <= m; ++i) {
      const auto height = static_cast<long>((i * i + 2 * i * j + 3 * j) % 4);
      soup.points.push_back({static_cast<long>(i), static_cast<long>(j), Rational(height) / Rational(2)});
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t v = j * (m + 1) + i;
      for (const std::size_t corner : {v, v + 1, v + m + 2, v + m + 1}) soup.facets.add_corner(make_id<VertexId>(corner));
      soup.facets.close_loop();
    }
  }
  return soup;
}

PolygonSoup<Rational> random_solid(std::size_t n, std::uint64_t seed) {
  HEXACT_EXPECTS(n >= 4 && n <= 100000);
  SplitMix64 random(seed);
  std::vector<Plane<Integer>> planes;
  for (;;) {
    while (planes.size() < n) planes.push_back(random_plane(random, n));
    std::vector<Point3<Rational>> points;
    for (const auto& p : planes) points.push_back(polar(p));
    PolygonSoup<Rational> hull;
    try {
      hull = convex_hull(points);
    } catch (const InvalidInput&) {  // all polar points in one plane: draw anew
      planes.clear();
      continue;
    }
    const std::vector<char> keep = contributing(points, hull);
    if (keep.empty()) {
      planes.clear();
      continue;
    }
    if (std::all_of(keep.begin(), keep.end(), [](char k) { return k != 0; })) return polar_body(hull);
    std::vector<Plane<Integer>> rest;
    for (std::size_t i = 0; i < n; ++i) {
      if (keep[i] != 0) rest.push_back(planes[i]);
    }
    planes = std::move(rest);
  }
}

}  // namespace hexact
