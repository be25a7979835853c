// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement.hpp"

#include "command.hpp"
#include "hexact/exact/rounding.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <utility>

namespace hexact::app {
namespace {

using Clock = std::chrono::steady_clock;

double to_double(const Rational& x) { return x.to_double(); }
double to_double(const QuadraticField& x) { return x.to_double(); }

Point3<double> unit(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

/// Directions of big integers without overflow: scaled by the common number of bits.
Point3<double> unit_normal(const IntegerPlanes& planes, std::size_t f) {
  if (planes.is_narrow(f)) {
    const auto& p = planes.narrow(f);
    return unit(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  }
  const Plane<Integer>& p = planes.wide(f);
  const long bits = static_cast<long>(std::max({p.a.bit_length(), p.b.bit_length(), p.c.bit_length()}));
  return unit(Rational(p.a).scaled(-bits).to_double(), Rational(p.b).scaled(-bits).to_double(),
              Rational(p.c).scaled(-bits).to_double());
}

template <class S>
Point3<double> unit_normal(const std::vector<Plane<S>>& planes, std::size_t f) {
  // Relative to the largest entry, so that nothing overflows.
  const Plane<S>& p = planes[f];
  const auto magnitude = [](const S& x) { return sign(x) < 0 ? -x : x; };
  S largest = magnitude(p.a);
  for (const S& x : {magnitude(p.b), magnitude(p.c)}) {
    if (largest < x) largest = x;
  }
  return unit(to_double(p.a / largest), to_double(p.b / largest), to_double(p.c / largest));
}

template <class Planes>
std::vector<Point3<double>> unit_normals(const Planes& planes) {
  std::vector<Point3<double>> normals(planes.size());
  for (std::size_t f = 0; f < normals.size(); ++f) normals[f] = unit_normal(planes, f);
  return normals;
}

DoubleLevel double_start(const PlaneBody& base) {
  const std::vector<Point3<double>> points = rounded_vertices(base).points;
  return {HoneycombMap(base.loops, base.vertex_count()), {points.begin(), points.end()}};
}

/// Parameters of the double engine; the exact policy has been checked before.
std::variant<SizeTable, DoubleParameter> in_doubles(const CutPolicy& policy) {
  if (const auto* sizes = std::get_if<SizePolicy>(&policy)) {
    SizeTable table;
    for (const QuadraticField& x : sizes->by_size) table.push_back(x.to_double());
    return table;
  }
  if (std::holds_alternative<PlanePolicy>(policy)) {
    throw InvalidInput("BadParameters", "tangent planes need an exact arithmetic", "");
  }
  return DoubleParameter([policy](const HoneycombMap& map, HalfEdgeId h) {
    return std::get<HalfEdgePolicy>(policy)(map, h).to_double();
  });
}

StepReport advance_level(SnappedLevel& level, const CutPolicy& policy, const SnappedOptions& options, const ProgressPart&) {
  SnappedStep step = snapped_step(std::move(level), policy, options);
  level = std::move(step.level);
  if (const auto bad = sign_violations(level); !bad.empty()) {
    std::vector<Finding> findings;
    for (const SignViolation& v : bad) findings.push_back(explain(v, level.map));
    throw InvalidInput(std::move(findings));
  }
  StepReport report;
  if (!std::holds_alternative<PlanePolicy>(policy)) {
    report.parameter_change = step.figures.max_parameter_change;
    report.min_parameter = step.figures.min_parameter;
    if (std::holds_alternative<SizePolicy>(policy)) report.least_delta = step.figures.delta;
  }
  return report;
}

template <class S>
StepReport advance_level(HoneycombLevel<S>& level, const CutPolicy& policy, const SnappedOptions&, const ProgressPart& progress) {
  HoneycombStep<S> step = honeycomb_step(level, policy, progress);
  level = std::move(step.level);
  StepReport report;
  report.delta = step.figures.delta.str();
  return report;
}

StepReport advance_level(DoubleLevel& level, const CutPolicy& policy, const SnappedOptions&, const ProgressPart&) {
  if (auto findings = condition_violations(level.map, policy); !findings.empty()) throw InvalidInput(std::move(findings));
  level = double_step(std::move(level), in_doubles(policy));
  return {};
}

StepReport advance_level(ChamferLevel&, const CutPolicy&, const SnappedOptions&, const ProgressPart&) {
  throw ContractViolation("a chamfer has no honeycomb steps");
}

const HoneycombMap& map_of(const ChamferLevel& level) { return level.surface.map; }
template <class Level>
const HoneycombMap& map_of(const Level& level) { return level.map; }

/// Width of the widest coefficient of the planes from `first` on.
std::size_t plane_bits(const IntegerPlanes& planes, std::size_t first) {
  std::uint64_t words = 0;
  std::size_t bits = 0;
  for (std::size_t f = first; f < planes.size(); ++f) {
    if (planes.is_narrow(f)) {
      for (const std::int64_t x : planes.narrow(f)) words |= static_cast<std::uint64_t>(x < 0 ? -x : x);
    } else {
      const Plane<Integer>& p = planes.wide(f);
      bits = std::max({bits, p.a.bit_length(), p.b.bit_length(), p.c.bit_length(), p.d.bit_length()});
    }
  }
  return std::max<std::size_t>(bits, static_cast<std::size_t>(std::bit_width(words)));
}

HoneycombStatistics statistics_of(const SnappedLevel& level) {
  HoneycombStatistics s = measure(level.map, level.points, unit_normals(level.planes));
  const double unit_length = std::ldexp(1.0, static_cast<int>(level.scale));
  for (double* x : {&s.longest_edge, &s.shortest_edge, &s.max_facet_diameter}) *x *= unit_length;
  return s;
}

}  // namespace

Arithmetic arithmetic_named(const std::string& name) {
  if (name == "rational") return Arithmetic::rational;
  if (name == "qsqrt5") return Arithmetic::qsqrt5;
  if (name == "double") return Arithmetic::floating;
  return Arithmetic::snapped;
}

Refinement::Refinement(ChamferLevel start) : level_(std::move(start)) {}

Refinement::Refinement(const PlaneBody& base, Arithmetic arithmetic, int max_bits)
    : level_(DoubleLevel{HoneycombMap(base.loops, base.vertex_count()), {}}) {
  snapped_.max_bits = max_bits;
  switch (arithmetic) {
    case Arithmetic::snapped: level_ = snapped_start(base); break;
    case Arithmetic::rational: level_ = honeycomb_start<Rational>(base); break;
    case Arithmetic::qsqrt5: level_ = honeycomb_start<QuadraticField>(base); break;
    case Arithmetic::floating: level_ = double_start(base); break;
  }
}

StepReport Refinement::advance(const PolicySchedule& schedule, const ProgressPart& progress) {
  progress.check();
  const auto start = Clock::now();
  const CutPolicy policy = schedule(map());
  StepReport report = std::visit([&](auto& level) { return advance_level(level, policy, snapped_, progress); }, level_);
  report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return report;
}

void Refinement::start_chamfer(std::span<const Rational> factors) {
  if (std::holds_alternative<ChamferLevel>(level_)) return;
  if (auto* level = std::get_if<SnappedLevel>(&level_)) {
    level_ = chamfer_start(std::move(*level), factors);
    return;
  }
  const auto* level = std::get_if<HoneycombLevel<Rational>>(&level_);
  if (level == nullptr) throw UsageError("chamfer steps need planes over Q");
  SnappedLevel surface = snapped_start(to_plane_body(*level));
  surface.map = level->map;  // the same map, which knows its levels
  level_ = chamfer_start(std::move(surface), factors);
}

StepReport Refinement::chamfer(const LiftRule& rule, const ProgressPart& progress) {
  progress.check();
  const auto start = Clock::now();
  auto& level = std::get<ChamferLevel>(level_);
  const std::size_t facets = level.surface.map.facet_count();
  level = chamfer_step(std::move(level), rule);
  StepReport report;
  report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  report.plane_bits = plane_bits(level.surface.planes, facets);
  return report;
}

const HoneycombMap& Refinement::map() const {
  return std::visit([](const auto& level) -> const HoneycombMap& { return map_of(level); }, level_);
}

PlaneBody Refinement::body() const {
  return std::visit(
      [](const auto& level) -> PlaneBody {
        if constexpr (std::is_same_v<std::decay_t<decltype(level)>, DoubleLevel>) {
          throw ContractViolation("a level in doubles has no exact body");
        } else if constexpr (std::is_same_v<std::decay_t<decltype(level)>, ChamferLevel>) {
          return to_plane_body(level.surface);
        } else {
          return to_plane_body(level);
        }
      },
      level_);
}

RoundedVertices Refinement::vertices(FloatFormat format) const {
  if (const auto* level = std::get_if<DoubleLevel>(&level_)) {
    return rounded_points(std::vector<Point3<double>>(level->points.begin(), level->points.end()), format);
  }
  return rounded_vertices(body(), format);
}

std::vector<Point3<double>> Refinement::normals() const {
  return std::visit(
      [](const auto& level) -> std::vector<Point3<double>> {
        if constexpr (std::is_same_v<std::decay_t<decltype(level)>, DoubleLevel>) {
          return newell_normals(level.map, level.points);
        } else if constexpr (std::is_same_v<std::decay_t<decltype(level)>, ChamferLevel>) {
          return unit_normals(level.surface.planes);
        } else {
          return unit_normals(level.planes);
        }
      },
      level_);
}

HoneycombStatistics Refinement::statistics() const {
  if (const auto* level = std::get_if<DoubleLevel>(&level_)) {
    return measure(level->map, level->points, normals());
  }
  if (const auto* level = std::get_if<SnappedLevel>(&level_)) return statistics_of(*level);
  if (const auto* level = std::get_if<ChamferLevel>(&level_)) return statistics_of(level->surface);
  return std::visit(
      [](const auto& level) -> HoneycombStatistics {
        if constexpr (requires { level.planes.front().a; }) {
          std::vector<Point3<double>> points;
          points.reserve(level.points.size());
          for (const auto& p : level.points) points.push_back({to_double(p.x), to_double(p.y), to_double(p.z)});
          return measure(level.map, points, unit_normals(level.planes));
        } else {
          return {};
        }
      },
      level_);
}

std::vector<FacetAddress> addresses_of(const HoneycombMap& map) {
  std::vector<FacetAddress> addresses(map.facet_count());
  for (std::uint32_t f = 0; f < addresses.size(); ++f) {
    addresses[f].level = map.facet_level(f);
    if (addresses[f].level > 0) addresses[f].parent = make_id<VertexId>(map.facet_parent(f));
  }
  return addresses;
}

}  // namespace hexact::app
