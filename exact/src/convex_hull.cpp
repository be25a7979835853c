// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/convex_hull.hpp"

#include "facet_geometry.hpp"
#include "hexact/exact/merge_coplanar.hpp"
#include "ring_soup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace hexact {
namespace {

using namespace detail;

struct Triangle {
  std::array<std::uint32_t, 3> corner{};    ///< counter-clockwise from outside
  std::array<std::uint32_t, 3> neighbour{};  ///< across the edge corner[i] → corner[i + 1]
  std::vector<std::uint32_t> above;          ///< points strictly above it that wait for their turn
  bool alive = true;
};

/// Quickhull with exact signs. A point sees a triangle when it is strictly above its plane; triangles of one plane
/// are then seen together, so the seen part is a disk and no new triangle is flat.
template <class R>
class Hull {
 public:
  explicit Hull(const std::vector<Point3<R>>& points) : points_(points) {
    double largest = 0;
    for (const Point3<R>& p : points) {
      const Point3<R> q = p - points[0];
      approximate_.push_back({q.x.to_double(), q.y.to_double(), q.z.to_double()});
      for (const double x : approximate_.back()) largest = std::max(largest, std::fabs(x));
    }
    // Coordinates carry a relative error u = 2^-53 and differences are at most 2L, so a determinant of differences
    // is wrong by less than 700·u·L³; 2^-43 L³ covers that.
    bound_ = 0x1p-43 * largest * largest * largest;
    // Beyond these, products might underflow or overflow: exact signs only.
    if (largest < 0x1p-300 || largest > 0x1p300) bound_ = std::numeric_limits<double>::infinity();
  }

  /// The triangles of the hull. `order` are the points to use, without repetition.
  std::vector<std::array<std::uint32_t, 3>> run(const std::vector<std::uint32_t>& order) {
    start(order);
    while (!waiting_.empty()) {
      const std::uint32_t t = waiting_.back();
      waiting_.pop_back();
      if (triangles_[t].alive && !triangles_[t].above.empty()) add(t, take_farthest(t));
    }
    std::vector<std::array<std::uint32_t, 3>> result;
    for (const Triangle& t : triangles_) {
      if (t.alive) result.push_back(t.corner);
    }
    return result;
  }

 private:
  double approximate_det(const std::array<std::uint32_t, 3>& t, std::uint32_t p) const {
    const auto &a = approximate_[t[0]], &b = approximate_[t[1]], &c = approximate_[t[2]], &d = approximate_[p];
    const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
    const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
    const double dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
    return (by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy + (bx * cy - by * cx) * dz;
  }

  /// +1 strictly above, 0 on, −1 below the plane of t.
  int side(const std::array<std::uint32_t, 3>& t, std::uint32_t p) const {
    const double det = approximate_det(t, p);
    if (det > bound_) return 1;
    if (det < -bound_) return -1;
    const Point3<R>& a = points_[t[0]];
    return dot(cross(points_[t[1]] - a, points_[t[2]] - a), points_[p] - a).sign();
  }

  void start(const std::vector<std::uint32_t>& order) {
    const auto not_solid = [] { return InvalidInput("NotSolid", "all points lie in one plane", ""); };
    const auto find = [&](auto&& fits) {
      const auto found = std::find_if(order.begin(), order.end(), fits);
      if (found == order.end()) throw not_solid();
      return *found;
    };
    const std::uint32_t a = find([](std::uint32_t) { return true; });
    const std::uint32_t b = find([&](std::uint32_t p) { return !(points_[p] == points_[a]); });
    const std::uint32_t c = find([&](std::uint32_t p) {
      return !is_zero(cross(points_[b] - points_[a], points_[p] - points_[a]));
    });
    const std::uint32_t d = find([&](std::uint32_t p) { return side({a, b, c}, p) != 0; });
    const bool below = side({a, b, c}, d) < 0;
    const std::array<std::uint32_t, 4> v = below ? std::array{a, b, c, d} : std::array{a, c, b, d};
    triangles_.resize(4);
    triangles_[0] = {{v[0], v[1], v[2]}, {1, 2, 3}, {}, true};
    triangles_[1] = {{v[1], v[0], v[3]}, {0, 3, 2}, {}, true};
    triangles_[2] = {{v[2], v[1], v[3]}, {0, 1, 3}, {}, true};
    triangles_[3] = {{v[0], v[2], v[3]}, {0, 2, 1}, {}, true};
    distribute(order, {0, 1, 2, 3});
  }

  void distribute(const std::vector<std::uint32_t>& points, const std::vector<std::uint32_t>& targets) {
    for (const std::uint32_t p : points) {
      for (const std::uint32_t t : targets) {
        if (side(triangles_[t].corner, p) <= 0) continue;
        triangles_[t].above.push_back(p);
        break;
      }
    }
    for (const std::uint32_t t : targets) {
      if (!triangles_[t].above.empty()) waiting_.push_back(t);
    }
  }

  /// Far points first keep the hull small; which one is taken does not change the result.
  std::uint32_t take_farthest(std::uint32_t t) {
    auto& above = triangles_[t].above;
    std::size_t best = 0;
    double best_height = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < above.size(); ++i) {
      const double h = approximate_det(triangles_[t].corner, above[i]);
      if (h > best_height) {
        best_height = h;
        best = i;
      }
    }
    const std::uint32_t p = above[best];
    above.erase(above.begin() + static_cast<std::ptrdiff_t>(best));
    return p;
  }

  struct HorizonEdge {
    std::uint32_t to, outer;  ///< end of the edge, and the unseen triangle behind it
  };

  void add(std::uint32_t first, std::uint32_t p) {
    std::vector<std::uint32_t> seen{first}, orphans;
    std::map<std::uint32_t, HorizonEdge> horizon;  // by the start of the edge
    triangles_[first].alive = false;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Triangle& t = triangles_[seen[i]];
      orphans.insert(orphans.end(), t.above.begin(), t.above.end());
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t n = t.neighbour[k];
        if (!triangles_[n].alive) continue;
        if (side(triangles_[n].corner, p) > 0) {
          triangles_[n].alive = false;
          seen.push_back(n);
        }
      }
    }
    for (const std::uint32_t s : seen) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Triangle& t = triangles_[s];
        if (!triangles_[t.neighbour[k]].alive) continue;
        const bool inserted = horizon.insert({t.corner[k], {t.corner[(k + 1) % 3], t.neighbour[k]}}).second;
        HEXACT_INVARIANT(inserted);
      }
    }
    for (const std::uint32_t s : seen) triangles_[s].above = {};
    distribute(orphans, close(horizon, p));
  }

  /// The cone of triangles from p over the horizon.
  std::vector<std::uint32_t> close(const std::map<std::uint32_t, HorizonEdge>& horizon, std::uint32_t p) {
    std::map<std::uint32_t, std::uint32_t> triangle_at;
    std::vector<std::uint32_t> made;
    for (const auto& [from, edge] : horizon) {
      const auto t = static_cast<std::uint32_t>(triangles_.size());
      triangle_at[from] = t;
      made.push_back(t);
      triangles_.push_back({{from, edge.to, p}, {edge.outer, 0, 0}, {}, true});
      Triangle& outer = triangles_[edge.outer];
      for (std::size_t k = 0; k < 3; ++k) {
        if (outer.corner[k] == edge.to && outer.corner[(k + 1) % 3] == from) outer.neighbour[k] = t;
      }
    }
    for (const std::uint32_t t : made) {
      const std::uint32_t after = triangle_at.at(triangles_[t].corner[1]);
      triangles_[t].neighbour[1] = after;
      triangles_[after].neighbour[2] = t;
    }
    return made;
  }

  const std::vector<Point3<R>>& points_;
  std::vector<std::array<double, 3>> approximate_;
  double bound_ = 0;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> waiting_;
};

/// All points but repetitions of earlier ones, in order.
template <class R>
std::vector<std::uint32_t> distinct_points(const std::vector<Point3<R>>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const Point3<R>&p = points[a], &q = points[b];
    if (!(p.x == q.x)) return p.x < q.x;
    if (!(p.y == q.y)) return p.y < q.y;
    if (!(p.z == q.z)) return p.z < q.z;
    return a < b;
  };
  std::sort(order.begin(), order.end(), less);
  order.erase(std::unique(order.begin(), order.end(),
                          [&](std::uint32_t a, std::uint32_t b) { return points[a] == points[b]; }),
              order.end());
  std::sort(order.begin(), order.end());
  return order;
}

/// Loops from their smallest vertex on, sorted by the sets of their vertices.
FacetLoops canonical(const FacetLoops& loops) {
  std::vector<std::pair<std::vector<VertexId>, std::vector<VertexId>>> sorted;
  for (std::size_t f = 0; f < loops.size(); ++f) {
    std::vector<VertexId> loop(loops[f].begin(), loops[f].end());
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    std::vector<VertexId> key = loop;
    std::sort(key.begin(), key.end());
    sorted.emplace_back(std::move(key), std::move(loop));
  }
  std::sort(sorted.begin(), sorted.end());
  FacetLoops result;
  for (const auto& entry : sorted) result.add(entry.second);
  return result;
}

}  // namespace

template <class S>
PolygonSoup<S> convex_hull(const std::vector<Point3<S>>& points) {
  if (points.empty()) throw InvalidInput("NotSolid", "there are no points", "");
  PolygonSoup<S> triangles;
  triangles.points = points;
  on_short_ring(points, [&](const auto& ring_points) {
    using R = std::decay_t<decltype(ring_points[0].x)>;
    for (const auto& t : Hull<R>(ring_points).run(distinct_points(ring_points))) {
      for (const std::uint32_t v : t) triangles.facets.add_corner(make_id<VertexId>(v));
      triangles.facets.close_loop();
    }
  });
  PolygonSoup<S> hull = merge_coplanar(triangles).soup;
  hull.facets = canonical(hull.facets);
  return hull;
}

template PolygonSoup<Rational> convex_hull(const std::vector<Point3<Rational>>&);
template PolygonSoup<QuadraticField> convex_hull(const std::vector<Point3<QuadraticField>>&);

}  // namespace hexact
