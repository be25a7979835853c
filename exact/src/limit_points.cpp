// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/limit_points.hpp"

#include "fixed_ball.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

namespace hexact {
namespace {

using detail::enclosure;
using detail::FixedBall;
using detail::product;

using BallPoint = std::array<FixedBall, 3>;
using ExactPoint = Point3<QuadraticField>;

constexpr std::array<unsigned long, 3> kBits = {256, 1024, 4096};
constexpr int kMostSteps = 2000;

BallPoint operator-(const BallPoint& p, const BallPoint& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
/// p + t·d
BallPoint moved(const BallPoint& p, const FixedBall& t, const BallPoint& d, unsigned long bits) {
  return {p[0] + product(t, d[0], bits), p[1] + product(t, d[1], bits), p[2] + product(t, d[2], bits)};
}

/// λ of the edges of one facet: `forward[j]` cuts corner j on the edge to corner j + 1, `backward[j]` on the edge to j − 1.
struct EdgeParameters {
  std::vector<QuadraticField> forward, backward;
};

/// A facet's polygon in a frame of its own: file coordinate = 2^scale · coordinate here + origin, coordinates below 1.
struct Frame {
  ExactPoint origin;
  long scale = 0;
  std::array<std::size_t, 2> axes{0, 1};  ///< of a projection that keeps the polygon's area
};

std::array<QuadraticField, 3> difference(const ExactPoint& p, const ExactPoint& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }

Frame frame_of(const std::vector<ExactPoint>& corners) {
  Frame frame{corners[0], std::numeric_limits<long>::min(), {0, 1}};
  std::array<double, 3> area{};
  for (std::size_t j = 1; j < corners.size(); ++j) {
    const auto d = difference(corners[j], corners[0]);
    for (const QuadraticField& x : d) {
      const double size = std::fabs(x.to_double());
      if (!std::isfinite(size)) throw ResourceLimit("a facet is wider than the finite doubles");
      if (size > 0) frame.scale = std::max<long>(frame.scale, std::ilogb(size) + 2);
    }
  }
  if (frame.scale == std::numeric_limits<long>::min()) frame.scale = 0;
  // Only a choice: the axes of the largest projected area, in doubles.
  for (std::size_t j = 1; j + 1 < corners.size(); ++j) {
    const auto d = difference(corners[j], corners[0]), e = difference(corners[j + 1], corners[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](const QuadraticField& x) { return std::ldexp(x.to_double(), -static_cast<int>(frame.scale)); };
      area[k] += at(d[(k + 1) % 3]) * at(e[(k + 2) % 3]) - at(d[(k + 2) % 3]) * at(e[(k + 1) % 3]);
    }
  }
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i) k = std::fabs(area[i]) > std::fabs(area[k]) ? i : k;
  frame.axes = {(k + 1) % 3, (k + 2) % 3};
  return frame;
}

std::vector<BallPoint> in_frame(const std::vector<ExactPoint>& corners, const Frame& frame, unsigned long bits) {
  const auto scaled = [&](const QuadraticField& x) {
    return enclosure(QuadraticField(x.rational_part().scaled(-frame.scale), x.sqrt5_part().scaled(-frame.scale)), bits);
  };
  std::vector<BallPoint> polygon;
  for (const ExactPoint& p : corners) {
    const auto d = difference(p, frame.origin);
    polygon.push_back({scaled(d[0]), scaled(d[1]), scaled(d[2])});
  }
  return polygon;
}

/// One honeycomb step of a polygon: phs (4), (5), the meeting points of neighbouring cut segments. Empty where the
/// intervals are too wide.
std::vector<BallPoint> step(const std::vector<BallPoint>& q, const EdgeParameters& lambda, const Frame& frame, unsigned long bits) {
  const std::size_t n = q.size();
  const auto cut = [&](const BallPoint& corner, const BallPoint& neighbour, const QuadraticField& x) {
    return x.is_zero() ? neighbour : moved(neighbour, enclosure(x, bits), corner - neighbour, bits);
  };
  const auto cross = [&](const BallPoint& a, const BallPoint& b) {
    const auto [i, k] = frame.axes;
    return product(a[i], b[k], bits) - product(a[k], b[i], bits);
  };
  std::vector<BallPoint> start, along;
  for (std::size_t j = 0; j < n; ++j) {
    start.push_back(cut(q[j], q[(j + n - 1) % n], lambda.backward[j]));
    along.push_back(cut(q[j], q[(j + 1) % n], lambda.forward[j]) - start.back());
  }
  std::vector<BallPoint> out;
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t next = (j + 1) % n;
    const auto t = detail::quotient(cross(start[next] - start[j], along[next]), cross(along[j], along[next]), bits);
    if (!t || !(t->radius < std::ldexp(1.0L, static_cast<int>(bits)))) return {};
    out.push_back(moved(start[j], *t, along[j], bits));
  }
  return out;
}

/// The mean of the middles, and how far the points that the polygon encloses are from it at most, in frame units.
struct Disc {
  std::array<Integer, 3> middle;
  double radius = 0;
};

Disc disc_of(const std::vector<BallPoint>& polygon, unsigned long bits) {
  Disc disc;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const BallPoint& p : polygon) disc.middle[k] += p[k].middle;
    disc.middle[k] = floor_quotient(disc.middle[k], Integer(static_cast<int>(polygon.size())));
  }
  for (const BallPoint& p : polygon) {
    std::array<double, 3> d{};
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = static_cast<double>(
          std::ldexp(detail::magnitude_in_units(p[k].middle - disc.middle[k]) + p[k].radius, -static_cast<int>(bits)));
    }
    disc.radius = std::max(disc.radius, std::hypot(d[0], d[1], d[2]) * (1 + 0x1p-48) + std::numeric_limits<double>::min());
  }
  return disc;
}

/// The smallest disc that refining the polygon reaches; `first` are the parameters of the first step.
Disc smallest_disc(std::vector<BallPoint> polygon, const EdgeParameters& first, const EdgeParameters& later, const Frame& frame,
                   unsigned long bits, double goal) {
  Disc best = disc_of(polygon, bits);
  int since_better = 0;
  for (int i = 0; i < kMostSteps && best.radius > goal && since_better < 8; ++i) {
    polygon = step(polygon, i == 0 ? first : later, frame, bits);
    if (polygon.empty()) break;
    Disc disc = disc_of(polygon, bits);
    ++since_better;
    if (!(disc.radius < best.radius)) continue;
    best = std::move(disc);
    since_better = 0;
  }
  return best;
}

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

/// |p − q| for exact p, rounded up.
double distance_up(const ExactPoint& p, const Point3<double>& q) {
  const auto square = [](const QuadraticField& x, double y) {
    const QuadraticField d = x - QuadraticField(Rational::from_double(y));
    return d * d;
  };
  const QuadraticField sum = square(p.x, q.x) + square(p.y, q.y) + square(p.z, q.z);
  return sum.is_zero() ? 0 : up(std::sqrt(up(sum.to_double()))) + std::numeric_limits<double>::denorm_min();
}

/// The exact middle of a disc in file coordinates.
ExactPoint file_point(const Disc& disc, const Frame& frame, unsigned long bits) {
  const auto place = [&](std::size_t k, const QuadraticField& origin) {
    return QuadraticField(Rational(disc.middle[k]).scaled(frame.scale - static_cast<long>(bits))) + origin;
  };
  return {place(0, frame.origin.x), place(1, frame.origin.y), place(2, frame.origin.z)};
}

Point3<double> rounded(const ExactPoint& p) {
  const Point3<double> q{p.x.to_double(), p.y.to_double(), p.z.to_double()};
  if (!std::isfinite(q.x) || !std::isfinite(q.y) || !std::isfinite(q.z)) throw ResourceLimit("a coordinate is beyond the finite doubles");
  return q;
}

LimitPoint with_radius(const ExactPoint& exact, double bound, const std::vector<ExactPoint>& corners, bool known) {
  LimitPoint out;
  out.point = rounded(exact);
  for (const ExactPoint& p : corners) out.radius = std::max(out.radius, distance_up(p, out.point));
  if (known) out.bound = std::min(out.radius, up(bound + distance_up(exact, out.point)));
  return out;
}

class Locator {
 public:
  Locator(const HoneycombMap& map, const PlaneBody& body, const std::optional<SizePolicy>& policy)
      : map_(map), body_(body), policy_(policy) {
    if (policy_ && !condition_violations(map, CutPolicy(*policy_), 1).empty()) policy_.reset();
  }

  LimitPoint locate(std::uint32_t f) const {
    const std::vector<ExactPoint> corners = corners_of(f);
    const Frame frame = frame_of(corners);
    const bool known = policy_ && goes_on(corners.size());
    if (!known) return with_radius(file_point(disc_of(in_frame(corners, frame, kBits[0]), kBits[0]), frame, kBits[0]), 0, corners, false);
    const EdgeParameters first = first_parameters(f);
    const QuadraticField& x = policy_->for_size(std::min<std::size_t>(corners.size(), 6));
    const EdgeParameters later{std::vector(corners.size(), x), std::vector(corners.size(), x)};
    // As fine as doubles near the facet, or 2^-56 of its size.
    double largest = 0;
    for (const ExactPoint& p : corners) {
      for (const QuadraticField& c : {p.x, p.y, p.z}) largest = std::max(largest, std::fabs(c.to_double()));
    }
    const double goal = std::max(0x1p-56, std::ldexp(largest, -56 - static_cast<int>(frame.scale)));
    Disc disc;
    unsigned long used = 0;
    for (const unsigned long bits : kBits) {
      used = bits;
      disc = smallest_disc(in_frame(corners, frame, bits), first, later, frame, bits, goal);
      if (disc.radius <= goal) break;
    }
    const double bound = std::ldexp(disc.radius, static_cast<int>(frame.scale));
    return with_radius(file_point(disc, frame, used), bound, corners, true);
  }

 private:
  std::vector<ExactPoint> corners_of(std::uint32_t f) const {
    std::vector<ExactPoint> corners;
    const std::uint32_t start = map_.facet_start(f);
    for (std::uint32_t i = 0; i < map_.facet_size(f); ++i) {
      corners.push_back(sqrt5_vertex(body_, make_id<VertexId>(map_.origin(start + i))));
    }
    return corners;
  }

  EdgeParameters first_parameters(std::uint32_t f) const {
    EdgeParameters out;
    const std::uint32_t start = map_.facet_start(f), n = map_.facet_size(f);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t h = start + i, before = start + (i + n - 1) % n;
      out.forward.push_back(asked_parameter(map_, CutPolicy(*policy_), h));
      out.backward.push_back(asked_parameter(map_, CutPolicy(*policy_), map_.twin(before)));
    }
    return out;
  }

  /// Conditions (1), (8), (10) once all neighbours are hexagons.
  bool goes_on(std::size_t size) const {
    const QuadraticField& x = policy_->for_size(std::min<std::size_t>(size, 6));
    if (x.sign() < 0 || (QuadraticField(1) - x - x).sign() <= 0) return false;
    if (size == 3) return (x + x + x - QuadraticField(1)).sign() > 0;
    return size > 4 || x.sign() > 0;
  }

  const HoneycombMap& map_;
  const PlaneBody& body_;
  std::optional<SizePolicy> policy_;
};

}  // namespace

std::vector<LimitPoint> limit_points(const HoneycombMap& map, const PlaneBody& body, const std::optional<SizePolicy>& policy,
                                     const ProgressPart& progress) {
  HEXACT_EXPECTS(body.vertex_count() == map.vertex_count() && body.loops.size() == map.facet_count());
  const Locator locator(map, body, policy);
  std::vector<LimitPoint> out(map.facet_count());
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(out.size()), 4), [&](const auto& range) {
    for (std::uint32_t f = range.begin(); f != range.end(); ++f) out[f] = locator.locate(f);
    progress.report(static_cast<double>(done += range.size()) / static_cast<double>(out.size()));
  });
  return out;
}

}  // namespace hexact
