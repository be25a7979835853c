// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/triangulate.hpp"

#include "facet_geometry.hpp"
#include "ring_soup.hpp"

#include <algorithm>

namespace hexact {
namespace {

using namespace detail;
using Corner = std::array<VertexId, 3>;

/// Cuts ears off a planar polygon, seen along a coordinate axis that its normal has a part in.
template <class R>
class EarCutter {
 public:
  EarCutter(const PolygonView<R>& polygon, const Plane<R>& plane) : points_(polygon.points) {
    const int axis = !plane.a.is_zero() ? 0 : !plane.b.is_zero() ? 1 : 2;
    u_ = (axis + 1) % 3;
    v_ = (axis + 2) % 3;
    facing_ = coordinate(normal(plane), axis).sign();
    rest_.assign(polygon.loop.begin(), polygon.loop.end());
  }

  /// Empty when no ear is left or the last triangle is reversed: only where the outline crosses or touches itself.
  std::vector<Corner> run() {
    std::vector<Corner> triangles;
    while (rest_.size() > 3) {
      const auto ear = find_ear();
      if (!ear) return {};
      const std::size_t n = rest_.size();
      triangles.push_back({rest_[(*ear + n - 1) % n], rest_[*ear], rest_[(*ear + 1) % n]});
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(*ear));
    }
    if (turn(rest_[0], rest_[1], rest_[2]) <= 0) return {};
    triangles.push_back({rest_[0], rest_[1], rest_[2]});
    return triangles;
  }

 private:
  int turn(VertexId a, VertexId b, VertexId c) const {
    const Point3<R> p = points_[index(b)] - points_[index(a)], q = points_[index(c)] - points_[index(a)];
    return facing_ * (coordinate(p, u_) * coordinate(q, v_) - coordinate(p, v_) * coordinate(q, u_)).sign();
  }

  bool is_ear(std::size_t j) const {
    const std::size_t n = rest_.size();
    const VertexId a = rest_[(j + n - 1) % n], b = rest_[j], c = rest_[(j + 1) % n];
    if (turn(a, b, c) <= 0) return false;
    return std::none_of(rest_.begin(), rest_.end(), [&](VertexId p) {
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  std::optional<std::size_t> find_ear() const {
    for (std::size_t j = 1; j < rest_.size() + 1; ++j) {
      if (is_ear(j % rest_.size())) return j % rest_.size();
    }
    return std::nullopt;
  }

  const std::vector<Point3<R>>& points_;
  std::vector<VertexId> rest_;
  int u_ = 0, v_ = 1, facing_ = 1;
};

template <class R>
std::vector<Corner> triangles_of(const PolygonView<R>& polygon, std::size_t facet) {
  const FacetShape<R> shape = facet_shape(polygon);
  if (polygon.size() == 3 || shape.strictly_convex() || !shape.planar()) {
    std::vector<Corner> fan;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) fan.push_back({polygon.loop[0], polygon.loop[i], polygon.loop[i + 1]});
    return fan;
  }
  std::vector<Corner> ears = EarCutter<R>(polygon, *shape.plane).run();
  if (ears.empty()) throw InvalidInput("NotSimple", "its outline crosses itself", facet_name(facet));
  return ears;
}

}  // namespace

template <class S>
PolygonSoup<S> triangulate(const PolygonSoup<S>& soup) {
  std::vector<Finding> findings = analyse_topology(soup.facets, soup.points.size()).findings;
  std::erase_if(findings, [](const Finding& f) {
    return f.code != "TooFewCorners" && f.code != "WrongIndex" && f.code != "RepeatedCorner";
  });
  if (!findings.empty()) throw InvalidInput(std::move(findings));
  PolygonSoup<S> result;
  result.points = soup.points;
  on_short_ring(soup.points, [&](const auto& points) {
    using R = std::decay_t<decltype(points[0].x)>;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
      if (soup.facets[f].empty()) continue;
      for (const Corner& t : triangles_of(PolygonView<R>{points, soup.facets[f]}, f)) {
        result.facets.add(t);
        if (!soup.addresses.empty()) result.addresses.push_back(soup.addresses[f]);
      }
    }
  });
  return result;
}

template PolygonSoup<Rational> triangulate(const PolygonSoup<Rational>&);
template PolygonSoup<QuadraticField> triangulate(const PolygonSoup<QuadraticField>&);

}  // namespace hexact
