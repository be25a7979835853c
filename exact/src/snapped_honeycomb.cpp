// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/snapped_honeycomb.hpp"

#include "homogeneous.hpp"
#include "plane_determinants.hpp"
#include "snapped_cut.hpp"
#include "snapped_vertices.hpp"
#include "word_points.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hexact {
namespace {

using detail::kRangeBits;
using Range = tbb::blocked_range<std::uint32_t>;
constexpr std::size_t kGrain = 1 << 12;

// ---------------------------------------------------------------------------------------------- level 0

/// Here = (there − centre)·2^exponent brings the body into [−2^18, 2^18]³.
struct Frame {
  std::array<Rational, 3> centre;
  long exponent = 0;
};

Frame working_frame(const std::vector<Point3<Rational>>& points) {
  Frame frame;
  Rational extent(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto coordinate = [k](const Point3<Rational>& p) -> const Rational& { return k == 0 ? p.x : k == 1 ? p.y : p.z; };
    Rational low = coordinate(points[0]), high = low;
    for (const auto& p : points) {
      low = std::min(low, coordinate(p));
      high = std::max(high, coordinate(p));
    }
    // Keep the origin where the body is not far from it: planes stay as short as they were.
    const Rational half = (high - low) / Rational(2);
    if (half.is_zero()) throw InvalidInput("NotConvex", "the body is flat", "");
    const Rational middle = (low + high) / Rational(2);
    if (abs(middle) > Rational(4) * half) {
      const long unit = detail::floor_log2(half);
      const Rational scaled = middle.scaled(-unit);
      frame.centre[k] = Rational(floor_quotient(scaled.numerator(), scaled.denominator())).scaled(unit);
    }
    extent = std::max({extent, abs(low - frame.centre[k]), abs(high - frame.centre[k])});
  }
  frame.exponent = kRangeBits - 2 - detail::floor_log2(extent);
  return frame;
}

Plane<Integer> in_frame(const Plane<Integer>& p, const Frame& frame) {
  const Rational offset = (Rational(p.d) - Rational(p.a) * frame.centre[0] - Rational(p.b) * frame.centre[1] -
                           Rational(p.c) * frame.centre[2])
                              .scaled(frame.exponent);
  const Integer factor = offset.denominator();
  return {p.a * factor, p.b * factor, p.c * factor, offset.numerator()};
}

// ---------------------------------------------------------------------------------------------- vertices

/// The vertex of half-edge a→b is where its facet meets the planes that cut a and b.
void locate_vertices(const HoneycombMap& old_map, const RawVector<Point3<double>>& old_points,
                     const IntegerPlanes& planes, RawVector<Point3<double>>& points, RawVector<float>& errors) {
  const auto old_facets = static_cast<std::uint32_t>(old_map.facet_count());
  const auto count = static_cast<std::uint32_t>(old_map.half_edge_count());
  points.resize(count);
  errors.resize(count);
  const auto corner_of = [&](std::uint32_t h) {
    const std::uint32_t a = old_map.origin(h), b = old_map.target(h);
    const Point3<double>&p = old_points[a], &q = old_points[b];
    return detail::Corner{{old_map.facet(h), old_facets + a, old_facets + b},
                          {(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2}};
  };
  tbb::parallel_for(Range(0, count, kGrain), [&](const Range& range) {
    detail::locate_range(planes, range.begin(), range.end(), corner_of, points, errors);
  });
}

// ---------------------------------------------------------------------------------------------- cuts

double rounded_up(const QuadraticField& x) {
  const double d = x.to_double();
  return QuadraticField(Rational::from_double(d)) < x ? std::nextafter(d, 2.0) : d;
}

/// The asked parameters in floating point, rounded up; those of a size policy come from a table.
class AskedParameters {
 public:
  AskedParameters(const HoneycombMap& map, const CutPolicy& policy) : map_(map), policy_(policy) {
    if (const auto* sizes = std::get_if<SizePolicy>(&policy)) {
      for (const QuadraticField& x : sizes->by_size) table_.push_back(rounded_up(x));
    }
  }
  /// λ(v→wᵢ) in the order of `star`: edge i lies between facets i and i − 1.
  [[nodiscard]] std::array<double, 3> at(const std::array<std::uint32_t, 3>& star) const {
    std::array<double, 3> lambda;
    if (table_.empty()) {
      for (std::size_t i = 0; i < 3; ++i) lambda[i] = rounded_up(asked_parameter(map_, policy_, star[i]));
      return lambda;
    }
    std::array<std::size_t, 3> size;
    for (std::size_t i = 0; i < 3; ++i) size[i] = map_.facet_size(map_.facet(star[i]));
    for (std::size_t i = 0; i < 3; ++i) {
      lambda[i] = table_[std::min(std::min(size[i], size[(i + 2) % 3]), table_.size() - 1)];
    }
    return lambda;
  }

 private:
  const HoneycombMap& map_;
  const CutPolicy& policy_;
  std::vector<double> table_;
};

/// What a range of vertices contributes; merged in order, so that results do not depend on threads.
struct Progress {
  double change = 0;
  double least = 1;
  std::vector<std::uint32_t> undecided;

  void add(const detail::CutFigures& figures) {
    change = std::max(change, figures.change);
    least = std::min(least, figures.min_parameter);
  }
};

Progress merged(Progress a, const Progress& b) {
  a.change = std::max(a.change, b.change);
  a.least = std::min(a.least, b.least);
  a.undecided.insert(a.undecided.end(), b.undecided.begin(), b.undecided.end());
  return a;
}

template <class Cut>
Progress for_each_vertex(const HoneycombMap& map, const Cut& cut) {
  return tbb::parallel_deterministic_reduce(
      Range(0, static_cast<std::uint32_t>(map.vertex_count()), kGrain), Progress{},
      [&](const Range& range, Progress progress) {
        for (std::uint32_t v = range.begin(); v != range.end(); ++v) cut(v, progress);
        return progress;
      },
      merged);
}

detail::HomogeneousPoint exact_vertex(const HoneycombMap& map, const IntegerPlanes& planes, std::uint32_t v) {
  const auto f = map.facets_at(v);
  detail::HomogeneousPoint m = detail::meet(planes[f[0]], planes[f[1]], planes[f[2]]);
  HEXACT_EXPECTS(!m.w.is_zero());
  return m;
}

std::optional<detail::FinePoint> fine_vertex(const SnappedLevel& level, const IntegerPlanes& planes, std::uint32_t v) {
  const auto f = level.map.facets_at(v);
  const auto p = detail::word_plane(planes, f[0]), q = detail::word_plane(planes, f[1]), r = detail::word_plane(planes, f[2]);
  if (!p || !q || !r) return std::nullopt;
  return detail::meet_in_words({*p, *q, *r}, level.points[v]);
}

/// The plane that cuts vertex v, proved in 128-bit words; nullopt where these do not suffice.
std::optional<detail::WideChoice> cut_in_words(const SnappedLevel& level, const AskedParameters& asked,
                                               const IntegerPlanes& planes, std::uint32_t v, int guard_bits) {
  const auto star = level.map.star(v);
  detail::FineCorner corner;
  corner.lambda = asked.at(star);
  const auto at_v = fine_vertex(level, planes, v);
  if (!at_v) return std::nullopt;
  corner.v = *at_v;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at_w = fine_vertex(level, planes, level.map.target(star[k]));
    if (!at_w) return std::nullopt;
    corner.w[k] = *at_w;
  }
  return detail::cut_in_words(corner, guard_bits);
}

detail::WideChoice cut_exactly(const SnappedLevel& level, const CutPolicy& policy, const IntegerPlanes& planes,
                               std::uint32_t v, int guard_bits) {
  const auto star = level.map.star(v);
  detail::ExactCorner corner;
  corner.v = exact_vertex(level.map, planes, v);
  for (std::size_t k = 0; k < 3; ++k) {
    corner.w[k] = exact_vertex(level.map, planes, level.map.target(star[k]));
    const QuadraticField lambda = asked_parameter(level.map, policy, star[k]);
    corner.lambda[k] = lambda.is_rational() ? lambda.rational_part() : Rational::from_double(rounded_up(lambda));
  }
  return detail::cut_in_fixed_point(corner, guard_bits);
}

/// Chooses the planes that doubles could not, and stores them in order.
void cut_rest(const SnappedLevel& level, const CutPolicy& policy, const SnappedOptions& options,
                      IntegerPlanes& planes, Progress& progress) {
  const std::size_t facets = level.map.facet_count();
  const AskedParameters asked(level.map, policy);
  std::vector<detail::WideChoice> choices(progress.undecided.size());
  tbb::parallel_for(std::size_t{0}, choices.size(), [&](std::size_t i) {
    const std::uint32_t v = progress.undecided[i];
    auto choice = cut_in_words(level, asked, planes, v, options.guard_bits);
    choices[i] = choice ? std::move(*choice) : cut_exactly(level, policy, planes, v, options.guard_bits);
  });
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (options.max_bits > 0 && choices[i].normal_bits > options.max_bits) {
      throw ResourceLimit("level " + std::to_string(level.map.level() + 1) + ": the plane that cuts vertex " +
                          std::to_string(progress.undecided[i]) + " needs " + std::to_string(choices[i].normal_bits) +
                          " bits, the bound is " + std::to_string(options.max_bits));
    }
    planes.set(facets + progress.undecided[i], choices[i].plane);
    progress.add(choices[i].figures);
  }
}

Progress cut_by_parameters(const SnappedLevel& level, const CutPolicy& policy, const SnappedOptions& options,
                           IntegerPlanes& planes) {
  const AskedParameters asked(level.map, policy);
  const std::size_t facets = level.map.facet_count();
  return for_each_vertex(level.map, [&](std::uint32_t v, Progress& progress) {
    const auto star = level.map.star(v);
    detail::CornerInDoubles corner;
    corner.v = level.points[v];
    corner.error = level.errors[v];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t w = level.map.target(star[i]);
      corner.w[i] = level.points[w];
      corner.error = std::max(corner.error, static_cast<double>(level.errors[w]));
    }
    corner.lambda = asked.at(star);
    const auto choice = detail::cut_in_doubles(corner, options.guard_bits);
    if (!choice || (options.max_bits > 0 && detail::kShortNormal > options.max_bits)) {
      progress.undecided.push_back(v);
      return;
    }
    planes.set(facets + v, choice->plane);
    progress.add(choice->figures);
  });
}

std::array<double, 3> unit_normal(const IntegerPlanes& planes, std::uint32_t f) {
  if (planes.is_narrow(f)) {
    const auto& q = planes.narrow(f);
    const std::array<double, 3> n = {static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2])};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return {n[0] / length, n[1] / length, n[2] / length};
  }
  const Plane<Integer> p = planes[f];
  const long bits = static_cast<long>(std::max({p.a.bit_length(), p.b.bit_length(), p.c.bit_length()}));
  const std::array<double, 3> n = {Rational(p.a).scaled(-bits).to_double(), Rational(p.b).scaled(-bits).to_double(),
                                   Rational(p.c).scaled(-bits).to_double()};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  return {n[0] / length, n[1] / length, n[2] / length};
}

/// A plane of a free policy: normal of 22 bits, or 31 with 12 fraction bits where the cut is shallow.
IntegerPlanes::Narrow free_plane(const SnappedLevel& level, const PlanePolicy& policy, const CornerView& view,
                                 const std::array<double, 3>& shift, double unit, double shallow) {
  const std::array<double, 3> wanted = policy.normal(view);
  const double length = std::sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1] + wanted[2] * wanted[2]);
  if (!(length > 0) || !std::isfinite(length)) throw NumericalFailure("a cut policy proposed a plane without a normal");
  for (const int bits : {22, 31}) {
    const double scale = std::ldexp(1.0, bits - 1) / length;
    std::array<double, 3> n;
    for (std::size_t k = 0; k < 3; ++k) n[k] = std::nearbyint(wanted[k] * scale);
    const double in_file = policy.offset(n);
    const double moved = in_file - (n[0] * shift[0] + n[1] * shift[1] + n[2] * shift[2]);
    const int fraction = bits == 22 ? 0 : 12;
    const double d = std::ldexp(moved / unit, fraction);
    const double margin = 0x1p-50 * std::fabs(d);
    const double offset = std::ceil(d + margin);
    const double at_v = n[0] * view.point[0] + n[1] * view.point[1] + n[2] * view.point[2] - in_file;
    if (bits == 22 && at_v / unit < shallow) continue;
    if (!(std::fabs(offset) < 0x1p61)) throw NumericalFailure("a cut policy proposed a plane that is too far away");
    const auto f = static_cast<std::int64_t>(1) << fraction;
    return {static_cast<std::int64_t>(n[0]) * f, static_cast<std::int64_t>(n[1]) * f, static_cast<std::int64_t>(n[2]) * f,
            static_cast<std::int64_t>(offset)};
  }
  HEXACT_INVARIANT(level.map.vertex_count() == 0);  // the loop returns for 31 bits
  return {};
}

Progress cut_freely(const SnappedLevel& level, const PlanePolicy& policy, IntegerPlanes& planes) {
  const std::size_t facets = level.map.facet_count();
  const double unit = std::ldexp(1.0, static_cast<int>(level.scale));
  const std::array<double, 3> shift = {level.shift[0].to_double(), level.shift[1].to_double(), level.shift[2].to_double()};
  const Progress progress = for_each_vertex(level.map, [&](std::uint32_t v, Progress& out) {
    const auto f = level.map.facets_at(v);
    CornerView view;
    for (std::size_t k = 0; k < 3; ++k) view.unit_normals[k] = unit_normal(planes, f[k]);
    const Point3<double>& p = level.points[v];
    view.point = {p.x * unit + shift[0], p.y * unit + shift[1], p.z * unit + shift[2]};
    view.level = level.map.level();
    // Depth of the cut against the rounding of a 22-bit plane: 16 guard bits, as heights times 2^21.
    planes.set(facets + v, free_plane(level, policy, view, shift, unit, 0x1p16));
    if (detail::sign_det4(planes, f[0], f[1], f[2], facets + v) >= 0) out.undecided.push_back(v);
  });
  if (!progress.undecided.empty()) {
    throw InvalidInput("LatticeLost",
                       "is not strictly beyond the plane chosen for it at level " + std::to_string(level.map.level() + 1),
                       "vertex " + std::to_string(progress.undecided.front()));
  }
  return progress;
}

/// Lower bound of δ over all edges for a size policy: both parameters of an edge grow by at most `change`.
double least_delta(const HoneycombMap& map, const CutPolicy& policy, double change) {
  const auto* sizes = std::get_if<SizePolicy>(&policy);
  if (sizes == nullptr) return 0;
  double largest = rounded_up(sizes->for_size(6));
  for (std::uint32_t f = 0; f < map.base_facet_count(); ++f) {
    largest = std::max(largest, rounded_up(sizes->for_size(std::min<std::size_t>(map.facet_size(f), 6))));
  }
  return std::nextafter(1 - 2 * largest - 2 * change, -1.0);
}

}  // namespace

SnappedLevel snapped_start(const PlaneBody& body) {
  if (body.field != Field::rational) {
    throw InvalidInput("FieldNotRational", "snapped arithmetic needs a body over Q", "");
  }
  SnappedLevel level{HoneycombMap(body.loops, body.vertex_count()), {}, {}, {}, 0, {}};
  std::vector<Point3<Rational>> points;
  points.reserve(body.vertex_count());
  for (std::uint32_t v = 0; v < body.vertex_count(); ++v) {
    const auto f = level.map.facets_at(v);
    const auto m = detail::meet(body.planes[f[0]], body.planes[f[1]], body.planes[f[2]]);
    if (m.w.is_zero()) {
      throw InvalidInput("DegenerateVertex", "its facet normals are dependent", "vertex " + std::to_string(v));
    }
    points.push_back(detail::to_point(m));
  }
  const Frame frame = working_frame(points);
  level.scale = body.scale - frame.exponent;
  for (std::size_t k = 0; k < 3; ++k) level.shift[k] = body.shift[k] + frame.centre[k].scaled(body.scale);
  level.planes.reserve(body.planes.size());
  for (std::size_t f = 0; f < body.planes.size(); ++f) level.planes.push_back(in_frame(body.planes[f], frame));
  for (const auto& p : points) {
    const auto move = [&](const Rational& x, std::size_t k) {
      return (x - frame.centre[k]).scaled(frame.exponent).to_double();
    };
    level.points.push_back({move(p.x, 0), move(p.y, 1), move(p.z, 2)});
  }
  for (std::uint32_t v = 0; v < body.vertex_count(); ++v) {
    const auto f = level.map.facets_at(v);
    const bool proper = detail::sign_det3(level.planes, f[0], f[1], f[2]) > 0;
    level.errors.push_back(proper ? 0x1p-33f : std::numeric_limits<float>::infinity());
  }
  return level;
}

SnappedStep snapped_step(SnappedLevel level, const CutPolicy& policy, const SnappedOptions& options) {
  if (auto findings = condition_violations(level.map, policy); !findings.empty()) throw InvalidInput(std::move(findings));
  IntegerPlanes planes = std::move(level.planes);
  planes.resize(level.map.facet_count() + level.map.vertex_count());
  Progress progress;
  if (const auto* free = std::get_if<PlanePolicy>(&policy)) {
    progress = cut_freely(level, *free, planes);
    progress.least = std::numeric_limits<double>::quiet_NaN();  // parameters may be negative and are not computed
  } else {
    progress = cut_by_parameters(level, policy, options, planes);
    cut_rest(level, policy, options, planes, progress);
  }
  SnappedFigures figures{progress.change, progress.least, least_delta(level.map, policy, progress.change),
                         progress.undecided.size()};
  RawVector<Point3<double>> points;
  RawVector<float> errors;
  locate_vertices(level.map, level.points, planes, points, errors);
  level.points = {};
  level.errors = {};
  HoneycombMap refined = level.map.refined();
  return {{std::move(refined), std::move(planes), std::move(points), std::move(errors), level.scale, level.shift}, figures};
}

PlaneBody to_plane_body(const SnappedLevel& level) {
  PlaneBody body;
  body.scale = level.scale;
  body.shift = level.shift;
  body.planes = level.planes;
  body.loops = level.map.loops();
  const auto facets = static_cast<std::uint32_t>(level.map.facet_count());
  body.addresses.reserve(facets);
  for (std::uint32_t f = 0; f < facets; ++f) {
    const std::uint32_t l = level.map.facet_level(f);
    body.addresses.push_back({l, l == 0 ? std::nullopt : std::optional(make_id<VertexId>(level.map.facet_parent(f)))});
  }
  body.triples.resize(level.map.vertex_count());
  tbb::parallel_for(Range(0, static_cast<std::uint32_t>(level.map.vertex_count()), kGrain), [&](const Range& range) {
    for (std::uint32_t v = range.begin(); v != range.end(); ++v) {
      const auto f = level.map.facets_at(v);
      body.triples[v] = {make_id<FacetId>(f[0]), make_id<FacetId>(f[1]), make_id<FacetId>(f[2])};
    }
  });
  return body;
}

}  // namespace hexact
