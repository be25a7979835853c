// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/measure_soup.hpp"

#include "facet_geometry.hpp"
#include "hexact/exact/merge_coplanar.hpp"
#include "ring_soup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexact {
namespace {

using namespace detail;

QuadraticField scaled(const QuadraticField& x, long e) {
  return {x.rational_part().scaled(e), x.sqrt5_part().scaled(e)};
}
Rational scaled(const Rational& x, long e) { return x.scaled(e); }

double finite(double x, const char* what) {
  if (!std::isfinite(x)) throw ResourceLimit(std::string(what) + " is beyond the range of double");
  return x;
}

/// √x to about 2^-52, for x >= 0 of any magnitude.
template <class S>
Rational root(const S& x) {
  if (x.is_zero()) return Rational(0);
  long e = 0;  // even: brings what would underflow back into range
  double d = x.to_double();
  for (; !std::isfinite(d); e -= 1000) d = scaled(x, e - 1000).to_double();
  for (; d < 1e-290; e += 500) d = scaled(x, e + 500).to_double();
  return Rational::from_double(std::sqrt(d)).scaled(-e / 2);
}

/// Distances in coordinates of about unit size, so that squares stay within the range of double.
template <class S>
class Measurement {
 public:
  explicit Measurement(const PolygonSoup<S>& soup) : soup_(soup) {
    box();
    double largest = 0;
    for (const auto& p : measures_.box) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    exponent_ = largest > 0 ? std::ilogb(largest) : 0;
  }

  SoupMeasures run() {
    for (std::size_t f = 0; f < soup_.facets.size(); ++f) {
      const auto loop = soup_.facets[f];
      const bool usable = loop.size() >= 3 && std::all_of(loop.begin(), loop.end(), [&](VertexId v) {
        return index(v) < soup_.points.size();
      });
      if (usable) add_facet(PolygonView<S>{soup_.points, loop});
    }
    measures_.area = finite(area_.to_double(), "the area");
    measures_.max_nonplanarity = finite(std::ldexp(measures_.max_nonplanarity, exponent_), "the nonplanarity");
    measures_.planar = bent_ == 0 && soup_.facets.size() > 0;
    if (bent_ > 0) {  // a distance may underflow, but is not 0
      measures_.max_nonplanarity = std::max(measures_.max_nonplanarity, std::numeric_limits<double>::denorm_min());
    }
    return measures_;
  }

 private:
  void box() {
    if (soup_.points.empty()) return;
    Point3<S> low = soup_.points[0], high = low;
    const auto widen = [](const S& x, S& l, S& h) {
      if (x < l) l = x;
      if (x > h) h = x;
    };
    for (const auto& p : soup_.points) {
      widen(p.x, low.x, high.x);
      widen(p.y, low.y, high.y);
      widen(p.z, low.z, high.z);
    }
    const auto rounded = [](const Point3<S>& p) {
      return Point3<double>{finite(p.x.to_double(), "a coordinate"), finite(p.y.to_double(), "a coordinate"),
                            finite(p.z.to_double(), "a coordinate")};
    };
    measures_.box = {rounded(low), rounded(high)};
  }

  void add_facet(const PolygonView<S>& polygon) {
    Point3<S> n{};  // twice the area vector
    Point3<S> sum = polygon[0];
    for (std::size_t i = 1; i < polygon.size(); ++i) {
      sum = sum + polygon[i];
      if (i + 1 < polygon.size()) n = n + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    }
    area_ += root(dot(n, n)) / Rational(2);
    const FacetShape<S> shape = facet_shape(polygon);
    if (!shape.off_plane) return;  // in one plane, or on one line
    ++bent_;
    if (is_zero(n)) n = normal(*shape.plane);  // no area vector: any plane of the facet through its mean corner
    const S count(static_cast<long long>(polygon.size()));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const S height = dot(n, count * polygon[i] - sum);
      const S squared = height * height / (count * count * dot(n, n));
      measures_.max_nonplanarity =
          std::max(measures_.max_nonplanarity, std::sqrt(scaled(squared, -2 * exponent_).to_double()));
    }
  }

  const PolygonSoup<S>& soup_;
  SoupMeasures measures_;
  Rational area_;
  int exponent_ = 0;
  std::size_t bent_ = 0;
};

template <class S>
std::optional<bool> convexity(const PolygonSoup<S>& soup, const SoupShape& shape) {
  if (!shape.topology.closed) return std::nullopt;
  if (!shape.topology.is_one_closed_surface()) return false;
  if (!shape.planar && std::any_of(shape.bent_facets.begin(), shape.bent_facets.end(), [&](std::size_t f) {
        return soup.facets[f].size() > 3;
      })) {
    return false;
  }
  try {
    return examine_soup(merge_coplanar(soup).soup).strictly_convex;
  } catch (const InvalidInput&) {  // coplanar neighbours around a hole
    return false;
  }
}

}  // namespace

SoupMeasures measure_soup(const PolygonSoup<Rational>& soup) { return Measurement<Rational>(soup).run(); }
SoupMeasures measure_soup(const PolygonSoup<QuadraticField>& soup) { return Measurement<QuadraticField>(soup).run(); }

std::optional<bool> bounds_convex_body(const PolygonSoup<Rational>& soup, const SoupShape& shape) {
  return convexity(soup, shape);
}
std::optional<bool> bounds_convex_body(const PolygonSoup<QuadraticField>& soup, const SoupShape& shape) {
  return convexity(soup, shape);
}

}  // namespace hexact
