// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "certificate_signs.hpp"
#include "facet_geometry.hpp"

#include <cmath>
#include <vector>

// Exact decisions about the vertices of a body: by their nearest doubles where these tell, else by exact points.
namespace hexact::detail {

/// What the fields have different: how planes are kept for sign tests, and how a vertex is computed.
template <class S>
struct FieldOf;
template <>
struct FieldOf<Rational> {
  using Planes = IntegerPlanes;
  static Planes planes(const PlaneBody& b) { return b.planes; }
  static Point3<Rational> vertex(const PlaneBody& b, std::size_t v) { return rational_vertex(b, make_id<VertexId>(v)); }
};
template <>
struct FieldOf<QuadraticField> {
  using Planes = RootPlanes;
  static Planes planes(const PlaneBody& b) {
    Planes out;
    out.rows.reserve(b.planes_sqrt5.size());
    for (const auto& p : b.planes_sqrt5) out.push_back(to_ring(p));
    return out;
  }
  static Point3<QuadraticField> vertex(const PlaneBody& b, std::size_t v) { return sqrt5_vertex(b, make_id<VertexId>(v)); }
};

/// Sign of (b − a) × (c − a) along `axis`, from exact points.
template <class S>
int turn_sign(const Point3<S>& a, const Point3<S>& b, const Point3<S>& c, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return sign((coordinate(b, u) - coordinate(a, u)) * (coordinate(c, v) - coordinate(a, v)) -
              (coordinate(b, v) - coordinate(a, v)) * (coordinate(c, u) - coordinate(a, u)));
}

/// The same from nearest doubles; 0: undecided. With ε = 2^-53 an operand and its rounding put at most 2ε(|p| + |q|)
/// on a difference p − q; products and their difference add less than 4ε of the products. Doubles below 2^-1022
/// are the nearest ones within 2^-1075, covered by the last term.
inline int turn_filter(const Point3<double>& a, const Point3<double>& b, const Point3<double>& c, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double au = coordinate(a, u), av = coordinate(a, v), bu = coordinate(b, u), bv = coordinate(b, v);
  const double cu = coordinate(c, u), cv = coordinate(c, v);
  const auto error = [](double p, double q) { return 0x1p-52 * (std::fabs(p) + std::fabs(q)) + 0x1p-1060; };
  const double x1 = bu - au, y1 = bv - av, x2 = cu - au, y2 = cv - av;
  const double ex1 = error(bu, au), ey1 = error(bv, av), ex2 = error(cu, au), ey2 = error(cv, av);
  const double first = x1 * y2, second = y1 * x2, value = first - second;
  const double bound = (std::fabs(x1) * ey2 + ex1 * std::fabs(y2) + ex1 * ey2 + std::fabs(y1) * ex2 + ey1 * std::fabs(x2) +
                        ey1 * ex2 + 0x1p-51 * (std::fabs(first) + std::fabs(second))) * (1 + 0x1p-40) + 0x1p-1060;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

/// The vertices of a body in its own coordinates (scale and shift left out: they change no sign).
/// Precondition: every vertex is the one point of its planes and lies on the planes of its facets (claim planar).
template <class S>
class LocatedPoints {
 public:
  /// Throws ResourceLimit where a coordinate is beyond the finite doubles.
  explicit LocatedPoints(const PlaneBody& body)
      : body_(in_own_coordinates(body)), planes_(FieldOf<S>::planes(body_)), near_(rounded_vertices(body_).points) {}

  [[nodiscard]] const PlaneBody& body() const noexcept { return body_; }
  [[nodiscard]] const typename FieldOf<S>::Planes& planes() const noexcept { return planes_; }
  /// The nearest double to each coordinate. Rounding is monotone: where doubles differ, exact numbers do so alike.
  [[nodiscard]] const Point3<double>& near(std::size_t v) const noexcept { return near_[v]; }
  [[nodiscard]] Point3<S> exact(std::size_t v) const { return FieldOf<S>::vertex(body_, v); }

  /// Sign of v − w along an axis.
  [[nodiscard]] int compare(std::size_t v, std::size_t w, int axis) const {
    const double x = coordinate(near_[v], axis), y = coordinate(near_[w], axis);
    if (x != y) return x < y ? -1 : 1;
    return v == w ? 0 : sign(coordinate(exact(v), axis) - coordinate(exact(w), axis));
  }
  [[nodiscard]] int turn(std::size_t a, std::size_t b, std::size_t c, int axis) const {
    if (const int s = turn_filter(near_[a], near_[b], near_[c], axis); s != 0) return s;
    return turn_sign(exact(a), exact(b), exact(c), axis);
  }
  /// Sign of n_f·v − d_f: positive beyond the plane.
  [[nodiscard]] int side(std::size_t v, std::size_t f) const {
    if (const int s = side_filter(v, f); s != 0) return s;
    const auto& t = body_.triples[v];
    const std::size_t a = index(t[0]), b = index(t[1]), c = index(t[2]);
    if (a == f || b == f || c == f) return 0;
    // d − n·v = det4(a, b, c, f) / det3(a, b, c).
    return -sign_det3(planes_, a, b, c) * sign_det4(planes_, a, b, c, f);
  }
  /// The axis along which the normal of facet f is largest in doubles, or one along which it is not 0.
  [[nodiscard]] int projection_axis(std::size_t f) const { return largest_axis(planes_, f); }

 private:
  static PlaneBody in_own_coordinates(PlaneBody body) {
    body.scale = 0;
    body.shift = {};
    return body;
  }
  /// Coefficients and coordinates are rounded once, products and sums add 4: below 2^-50 of the magnitudes.
  [[nodiscard]] int side_filter(std::size_t v, std::size_t f) const {
    const auto n = row_in_doubles(planes_, f);
    if (!n) return 0;
    const Point3<double>& p = near_[v];
    const auto& [a, b, c, d] = *n;
    const double x = a * p.x, y = b * p.y, z = c * p.z, value = x + y + z - d;
    const double bound = 0x1p-49 * (std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(d)) +
                         0x1p-1000 * (std::fabs(a) + std::fabs(b) + std::fabs(c) + 1);
    return value > bound ? 1 : value < -bound ? -1 : 0;
  }
  static std::optional<std::array<double, 4>> row_in_doubles(const IntegerPlanes& planes, std::size_t f) {
    if (!planes.is_narrow(f)) return std::nullopt;
    const Row& p = planes.narrow(f);
    return std::array<double, 4>{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]),
                                 static_cast<double>(p[3])};
  }
  static std::optional<std::array<double, 4>> row_in_doubles(const RootPlanes&, std::size_t) { return std::nullopt; }

  static int largest_axis(const IntegerPlanes& planes, std::size_t f) {
    const Plane<Integer> p = planes[f];
    return largest_of({std::fabs(p.a.to_double()), std::fabs(p.b.to_double()), std::fabs(p.c.to_double())},
                      {!p.a.is_zero(), !p.b.is_zero(), !p.c.is_zero()});
  }
  static int largest_axis(const RootPlanes& planes, std::size_t f) {
    const Plane<RootInteger>& p = planes[f];
    const auto size = [](const RootInteger& x) { return std::fabs(to_field(x).to_double()); };
    return largest_of({size(p.a), size(p.b), size(p.c)}, {!p.a.is_zero(), !p.b.is_zero(), !p.c.is_zero()});
  }
  static int largest_of(const std::array<double, 3>& sizes, const std::array<bool, 3>& nonzero) {
    int best = nonzero[0] ? 0 : nonzero[1] ? 1 : 2;
    for (int axis = best + 1; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if (nonzero[i] && sizes[i] > sizes[static_cast<std::size_t>(best)]) best = axis;
    }
    return best;
  }

  PlaneBody body_;
  typename FieldOf<S>::Planes planes_;
  std::vector<Point3<double>> near_;
};

}  // namespace hexact::detail
