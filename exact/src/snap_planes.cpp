// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/snap_planes.hpp"

#include "displacement.hpp"
#include "dyadic_frame.hpp"
#include "hexact/exact/body_from_soup.hpp"
#include "primitive_plane.hpp"

namespace hexact {
namespace {

using namespace detail;

std::vector<Plane<Rational>> planes_in_frame(const PlaneBody& body, const DyadicFrame& frame) {
  std::vector<Plane<Rational>> planes;
  for (std::size_t f = 0; f < body.planes.size(); ++f) {
    Plane<Rational> p = file_plane(body, f);
    p.d -= p.a * frame.shift[0] + p.b * frame.shift[1] + p.c * frame.shift[2];
    p.d = p.d.scaled(-frame.scale);
    planes.push_back(p);
  }
  return planes;
}

/// A rational number with 64 more bits than asked: near enough to round from.
Rational nearby(const QuadraticField& x, long bits) {
  if (x.is_rational()) return x.rational_part();
  Integer root;
  mpz_sqrt(root.raw(), Integer(5).shifted_left(2 * static_cast<unsigned long>(bits)).raw());
  return x.rational_part() + x.sqrt5_part() * Rational(root).scaled(-bits);
}

std::vector<Plane<Rational>> planes_near_sqrt5(const PlaneBody& body, const DyadicFrame& frame, unsigned bits) {
  std::vector<Plane<Rational>> planes;
  for (std::size_t f = 0; f < body.planes_sqrt5.size(); ++f) {
    const Plane<QuadraticField> p = file_plane_sqrt5(body, f);
    long extra = static_cast<long>(bits) + 64;  // and the size of the numbers themselves
    for (const QuadraticField* x : {&p.a, &p.b, &p.c, &p.d}) {
      extra += std::max(0L, ceil_log2(x->rational_part())) + std::max(0L, ceil_log2(x->sqrt5_part()));
    }
    Plane<Rational> q{nearby(p.a, extra), nearby(p.b, extra), nearby(p.c, extra), nearby(p.d, extra)};
    q.d -= q.a * frame.shift[0] + q.b * frame.shift[1] + q.c * frame.shift[2];
    q.d = q.d.scaled(-frame.scale);
    planes.push_back(q);
  }
  return planes;
}

/// The nearest plane with coefficients below 2^bits: |n|∞ = 2^(bits − 2), and in [−1, 1]³ |d| <= |n|₁ <= 3 |n|∞.
/// Among planes with that normal the offset is the one nearest to the given plane's at the mean of its corners.
Plane<Integer> snapped(const Plane<Rational>& plane, const Point3<Rational>& anchor, unsigned bits) {
  const Point3<Integer> n = rounded_direction(normal(plane), bits - 2);
  const Rational d = Rational(n.x) * anchor.x + Rational(n.y) * anchor.y + Rational(n.z) * anchor.z;
  return primitive(Plane<Integer>{n.x, n.y, n.z, nearest_integer(d)});
}

Point3<Rational> mean_of_corners(const std::vector<Point3<Rational>>& points, std::span<const VertexId> loop) {
  Point3<Rational> sum{};
  for (const VertexId v : loop) sum = sum + points[index(v)];
  return Rational(Integer(1), Integer(static_cast<long long>(loop.size()))) * sum;
}

PlaneBody snapped_body(PlaneBody body, const std::vector<Plane<Rational>>& planes, const DyadicFrame& frame,
                       const std::vector<Point3<Rational>>& points_here, unsigned bits) {
  PlaneBody result;
  result.scale = frame.scale;
  result.shift = frame.shift;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const Point3<Rational> anchor = mean_of_corners(points_here, body.loops[f]);
    result.planes.push_back(snapped(planes[f], anchor, bits));
  }
  result.addresses = std::move(body.addresses);
  result.loops = std::move(body.loops);
  result.triples = std::move(body.triples);
  return result;
}

void require_convex(const PlaneBody& body, unsigned bits) {
  std::vector<Finding> findings;
  try {
    findings = convex_trivalent_findings(body);
  } catch (const InvalidInput& e) {  // three planes that no longer meet
    findings = e.findings();
  }
  if (findings.empty()) return;
  for (Finding& f : findings) {
    f.message = "planes of " + std::to_string(bits) + " bits are too coarse: " + f.code + ": " + f.message;
    f.code = "SnappedTooCoarse";
  }
  throw InvalidInput(std::move(findings));
}

template <class S>
PlaneBody trivalent_body(const PolygonSoup<S>& soup) {
  PlaneBody body = body_from_soup(soup);
  std::vector<Finding> findings = convex_trivalent_findings(body);
  if (!findings.empty()) throw InvalidInput(std::move(findings));
  return body;
}

}  // namespace

SnappedBody snap_planes(const PolygonSoup<Rational>& soup, unsigned bits) {
  HEXACT_EXPECTS(bits >= 2 && bits <= 4096);
  PlaneBody exact = trivalent_body(soup);
  const DyadicFrame frame = frame_of(soup.points);
  std::vector<Point3<Rational>> here;
  for (const auto& p : soup.points) here.push_back(frame.here(p));
  SnappedBody result;
  const std::vector<Plane<Rational>> planes = planes_in_frame(exact, frame);
  result.body = snapped_body(std::move(exact), planes, frame, here, bits);
  require_convex(result.body, bits);
  result.max_displacement = largest_distance(soup.points, rational_soup(result.body).points);
  return result;
}

SnappedBody snap_planes(const PolygonSoup<QuadraticField>& soup, unsigned bits) {
  HEXACT_EXPECTS(bits >= 2 && bits <= 4096);
  PlaneBody exact = trivalent_body(soup);
  std::vector<Point3<Rational>> near;
  for (const auto& p : soup.points) {
    const long precision = static_cast<long>(bits) + 128;
    near.push_back({nearby(p.x, precision), nearby(p.y, precision), nearby(p.z, precision)});
  }
  const DyadicFrame frame = frame_of(near);
  for (auto& p : near) p = frame.here(p);
  SnappedBody result;
  const std::vector<Plane<Rational>> planes = planes_near_sqrt5(exact, frame, bits);
  result.body = snapped_body(std::move(exact), planes, frame, near, bits);
  require_convex(result.body, bits);
  std::vector<Point3<QuadraticField>> moved;
  for (const auto& p : rational_soup(result.body).points) moved.push_back({p.x, p.y, p.z});
  result.max_displacement = largest_distance(soup.points, moved);
  return result;
}

}  // namespace hexact
