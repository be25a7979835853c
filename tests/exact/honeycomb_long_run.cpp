// SPDX-License-Identifier: GPL-3.0-or-later
// The golden runs over many levels, their doubles derived from exact numbers, in every arithmetic that reaches them; and
// the closed golden cases, which Q and Q(sqrt5) meet exactly elsewhere, with snapped planes and in doubles.
#include "exact/honeycomb_golden.hpp"
#include "hexact/exact/honeycomb.hpp"
#include "hexact/exact/snapped_honeycomb.hpp"
#include "hexact/kernel/honeycomb_double.hpp"
#include "hexact/kernel/honeycomb_statistics.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace hexact {
namespace {

constexpr double kDegree = 180 / 3.14159265358979323846;

struct Figures {
  double volume = 0, area = 0, mean_width = 0, smallest_angle = 180, upper_median = 0;
  HoneycombStatistics statistics;
};

template <class T>
using Points = std::span<const Point3<T>>;

Point3<double> minus(const Point3<double>& p, const Point3<double>& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Point3<double> cross(const Point3<double>& p, const Point3<double>& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
double dot(const Point3<double>& p, const Point3<double>& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
double length(const Point3<double>& p) { return std::sqrt(dot(p, p)); }

/// Sums in double over fans about each facet's first corner; normals from the planes where angles are small.
Figures figures_of(const HoneycombMap& map, Points<double> points, const std::vector<Point3<double>>& normals) {
  Figures out;
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
    const std::uint32_t start = map.facet_start(f);
    const auto& p = points[map.origin(start)];
    for (std::uint32_t h = start + 1; h + 1 < start + map.facet_size(f); ++h) {
      const auto n = cross(minus(points[map.origin(h)], p), minus(points[map.origin(h + 1)], p));
      out.volume += dot(p, n) / 6;
      out.area += dot(n, normals[f]) / 2;
    }
  }
  std::vector<double> angles;
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    if (map.twin(h) < h) continue;
    const auto &m = normals[map.facet(h)], &n = normals[map.facet(map.twin(h))];
    const double angle = std::atan2(length(cross(m, n)), dot(m, n));
    out.mean_width += angle * length(minus(points[map.origin(h)], points[map.target(h)])) / 2;
    out.smallest_angle = std::min(out.smallest_angle, angle * kDegree);
    angles.push_back(angle * kDegree);
  }
  std::sort(angles.begin(), angles.end());
  out.upper_median = angles[angles.size() / 2];  // the golden file takes the upper median, `measure` the lower one
  out.statistics = measure(map, points, normals);
  return out;
}

void check_counts(const HoneycombMap& map, const nlohmann::json& expected) {
  CHECK(map.vertex_count() == expected.at("V"));
  CHECK(map.edge_count() == expected.at("E"));
  CHECK(map.facet_count() == expected.at("F"));
}

/// `relative` covers what the arithmetic may change; 0 stands for an exact one, whose figures are off by double sums only.
void check_figures(const Figures& found, const nlohmann::json& expected, double relative, double angle) {
  const auto near = [&](const char* key) { return Approx(expected.at(key).get<double>()).epsilon(relative + 1e-11); };
  CHECK(found.volume == near("volume"));
  CHECK(found.area == near("area"));
  CHECK(found.mean_width == near("mean_width_integral"));
  CHECK(found.statistics.longest_edge == near("edge_max"));
  CHECK(found.statistics.max_normal_angle_deg == Approx(expected.at("angle_max_deg").get<double>()).margin(angle));
  CHECK(found.upper_median == Approx(expected.at("angle_median_deg").get<double>()).margin(angle));
}

PlaneBody initial(const std::string& name) {
  if (name == "cube") return test::body_of(test::cube());
  const nlohmann::json data = test::golden();
  for (const auto& closed : data.at("closed")) {
    if (closed.at("name") == name && closed.contains("initial")) return test::body_of(test::solid(closed.at("initial")));
  }
  throw std::runtime_error("no initial " + name);
}

std::vector<Point3<double>> unit_normals(const IntegerPlanes& planes) {
  std::vector<Point3<double>> out;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const Plane<Integer> p = planes[f];
    const Point3<double> n{Rational(p.a).to_double(), Rational(p.b).to_double(), Rational(p.c).to_double()};
    out.push_back({n.x / length(n), n.y / length(n), n.z / length(n)});
  }
  return out;
}

std::vector<Point3<double>> unit_normals(const std::vector<Plane<Rational>>& planes) {
  std::vector<Point3<double>> out;
  for (const auto& p : planes) {
    Rational largest = abs(p.a);
    for (const Rational* x : {&p.b, &p.c}) largest = std::max(largest, abs(*x));
    const Point3<double> n{(p.a / largest).to_double(), (p.b / largest).to_double(), (p.c / largest).to_double()};
    out.push_back({n.x / length(n), n.y / length(n), n.z / length(n)});
  }
  return out;
}

/// How deep exact rationals go within a second.
std::uint32_t exact_levels(const std::string& name) {
  return name == "random12" ? 3 : name == "pyritohedron" ? 4 : 6;
}

}  // namespace

TEST_CASE("golden long runs in rational arithmetic", "[honeycomb][golden]") {
  const nlohmann::json data = test::golden();
  std::size_t levels = 0;
  for (const auto& run : data.at("exact_long_run")) {
    const std::string name = run.at("name");
    REQUIRE(run.at("parameters") == "static_rational");
    auto level = honeycomb_start<Rational>(initial(name));
    for (const auto& expected : run.at("levels")) {
      const auto l = expected.at("level").get<std::uint32_t>();
      if (l > exact_levels(name)) break;
      CAPTURE(name, l);
      if (l > 0) level = honeycomb_step(level, static_policy_rational()).level;
      std::vector<Point3<double>> points;
      for (const auto& p : level.points) points.push_back({p.x.to_double(), p.y.to_double(), p.z.to_double()});
      check_counts(level.map, expected);
      const Figures found = figures_of(level.map, points, unit_normals(level.planes));
      check_figures(found, expected, 0, 1e-6);
      CHECK(found.smallest_angle == Approx(expected.at("angle_min_deg").get<double>()).epsilon(1e-6));
      CHECK(found.statistics.shortest_edge == Approx(expected.at("edge_min").get<double>()).epsilon(1e-6));
      ++levels;
    }
  }
  CHECK(levels == 23);
}

TEST_CASE("golden long runs with snapped planes, within the proven change of the parameters", "[snapped][golden]") {
  const nlohmann::json data = test::golden();
  std::size_t levels = 0;
  for (const auto& run : data.at("exact_long_run")) {
    const std::string name = run.at("name");
    SnappedLevel level = snapped_start(initial(name));
    double change = 0;
    for (const auto& expected : run.at("levels")) {
      const auto l = expected.at("level").get<std::uint32_t>();
      CAPTURE(name, l, change);
      if (l > 0) {
        SnappedStep step = snapped_step(std::move(level), static_policy_rational(), {});
        level = std::move(step.level);
        change += step.figures.max_parameter_change;
      }
      check_counts(level.map, expected);
      REQUIRE(sign_violations(level).empty());
      Figures found = figures_of(level.map, level.points, unit_normals(level.planes));
      // Sums of cubes, squares and lengths in the scaled and shifted frame; the shift changes neither edges nor angles.
      const double unit = std::ldexp(1.0, static_cast<int>(level.scale));
      found.volume *= unit * unit * unit;
      found.area *= unit * unit;
      found.mean_width *= unit;
      found.statistics.longest_edge *= unit;
      // By (17) a triangle shrinks by 3λ − 1, whose logarithm changes by 15 times the change of λ at 2/5, and a volume by
      // three times that; other polygons and later steps change less.
      check_figures(found, expected, 45 * change, 180 * 45 * change + 1e-6);
      ++levels;
    }
  }
  CHECK(levels == 32);
}

TEST_CASE("golden long runs in doubles", "[double][golden]") {
  const nlohmann::json data = test::golden();
  SizeTable table;
  for (const QuadraticField& beta : static_policy_rational().by_size) table.push_back(beta.to_double());
  std::size_t levels = 0;
  for (const auto& run : data.at("exact_long_run")) {
    const std::string name = run.at("name");
    const PlaneBody body = initial(name);
    const auto points = rounded_vertices(body).points;
    DoubleLevel level{HoneycombMap(body.loops, body.vertex_count()), {points.begin(), points.end()}};
    for (const auto& expected : run.at("levels")) {
      const auto l = expected.at("level").get<std::uint32_t>();
      CAPTURE(name, l);
      if (l > 0) level = double_step(std::move(level), table);
      check_counts(level.map, expected);
      const Figures found = figures_of(level.map, level.points, newell_normals(level.map, level.points));
      // Directions are lost where edges come near the last place of the coordinates.
      const double lost = 4e-15 / expected.at("edge_min").get<double>();
      check_figures(found, expected, lost, 180 * lost + 1e-6);
      ++levels;
    }
  }
  CHECK(levels == 32);
}

/// Smallest and largest product of unit normals across an edge.
std::pair<double, double> normal_products(const HoneycombMap& map, const std::vector<Point3<double>>& normals) {
  double least = 1, most = -1;
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const double product = dot(normals[map.facet(h)], normals[map.facet(map.twin(h))]);
    least = std::min(least, product);
    most = std::max(most, product);
  }
  return {least, most};
}

/// A closed golden level; `relative` as above.
void check_closed(const HoneycombMap& map, const Figures& found, const std::vector<Point3<double>>& normals,
                  const nlohmann::json& expected, double relative) {
  check_counts(map, expected);
  const auto& volume = expected.at("volume");
  CHECK(found.volume == Approx(volume.at("double").get<double>()).epsilon(relative + 1e-11));
  CHECK(found.area == Approx(expected.at("area").get<double>()).epsilon(relative + 1e-11));
  const auto [least, most] = normal_products(map, normals);
  CHECK(least == Approx(expected.at("normal_dot_min").get<double>()).margin(3.2 * relative + 1e-9));
  CHECK(most == Approx(expected.at("normal_dot_max").get<double>()).margin(3.2 * relative + 1e-9));
}

PlaneBody body_of_case(const nlohmann::json& closed) {
  return test::body_of(closed.contains("initial") ? test::solid(closed.at("initial")) : test::cube());
}

TEST_CASE("closed golden cases with snapped planes, within the proven change of the parameters", "[snapped][golden]") {
  const nlohmann::json data = test::golden();
  std::size_t cases = 0;
  for (const auto& closed : data.at("closed")) {
    if (!closed.contains("levels")) continue;
    const PlaneBody body = body_of_case(closed);
    if (test::needs_root(closed, body)) continue;
    ++cases;
    const CutPolicy policy = test::golden_policy(closed.at("parameters"));
    SnappedLevel level = snapped_start(body);
    double change = 0;
    for (const auto& expected : closed.at("levels")) {
      CAPTURE(closed.at("name").get<std::string>(), closed.at("parameters").get<std::string>(), expected.at("level").get<int>());
      while (level.map.level() < expected.at("level").get<std::uint32_t>()) {
        SnappedStep step = snapped_step(std::move(level), policy, {});
        level = std::move(step.level);
        change += step.figures.max_parameter_change;
      }
      CHECK(sign_violations(level).empty());
      const auto normals = unit_normals(level.planes);
      Figures found = figures_of(level.map, level.points, normals);
      const double unit = std::ldexp(1.0, static_cast<int>(level.scale));
      found.volume *= unit * unit * unit;
      found.area *= unit * unit;
      check_closed(level.map, found, normals, expected, 45 * change);
    }
  }
  CHECK(cases == 8);
}

TEST_CASE("closed golden cases in doubles", "[double][golden]") {
  const nlohmann::json data = test::golden();
  std::size_t cases = 0;
  for (const auto& closed : data.at("closed")) {
    if (!closed.contains("levels")) continue;
    ++cases;
    const PlaneBody body = body_of_case(closed);
    const CutPolicy policy = test::golden_policy(closed.at("parameters"));
    const DoubleParameter parameter = [&](const HoneycombMap& map, HalfEdgeId h) {
      return asked_parameter(map, policy, static_cast<std::uint32_t>(h)).to_double();
    };
    const auto points = rounded_vertices(body).points;
    DoubleLevel level{HoneycombMap(body.loops, body.vertex_count()), {points.begin(), points.end()}};
    for (const auto& expected : closed.at("levels")) {
      CAPTURE(closed.at("name").get<std::string>(), closed.at("parameters").get<std::string>(), expected.at("level").get<int>());
      while (level.map.level() < expected.at("level").get<std::uint32_t>()) level = double_step(std::move(level), parameter);
      const auto normals = newell_normals(level.map, level.points);
      check_closed(level.map, figures_of(level.map, level.points, normals), normals, expected, 0);
    }
  }
  CHECK(cases == 12);
}

}  // namespace hexact
