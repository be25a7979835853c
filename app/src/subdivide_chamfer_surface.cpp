// SPDX-License-Identifier: GPL-3.0-or-later
#include "subdivide_chamfer_surface.hpp"

#include "geometry_output.hpp"
#include "hexact/exact/certify.hpp"
#include "hexact/exact/chamfer_surface.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/mesh_topology.hpp"
#include "level_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace hexact::app {
namespace {

std::vector<Point3<double>> unit_normals(const IntegerPlanes& planes) {
  std::vector<Point3<double>> out;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const Plane<Integer> p = planes[f];
    const long bits = static_cast<long>(std::max({p.a.bit_length(), p.b.bit_length(), p.c.bit_length()}));
    const auto entry = [&](const Integer& x) { return Rational(x).scaled(-bits).to_double(); };
    const double x = entry(p.a), y = entry(p.b), z = entry(p.c), l = std::sqrt(x * x + y * y + z * z);
    out.push_back({x / l, y / l, z / l});
  }
  return out;
}

double distance(const Point3<double>& p, const Point3<double>& q) { return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z); }

HoneycombStatistics measure(const ChamferSurface& surface) {
  const auto normals = unit_normals(surface.body.planes);
  const auto points = rounded_vertices(surface.body).points;
  const HalfEdges e = half_edges_of(surface.body.loops);
  HoneycombStatistics out;
  out.shortest_edge = std::numeric_limits<double>::infinity();
  std::vector<double> angles;
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    if (e.twin[h] != kNoTwin && e.twin[h] < h) continue;
    const double l = distance(points[e.origin[h]], points[e.target(h)]);
    out.longest_edge = std::max(out.longest_edge, l);
    out.shortest_edge = std::min(out.shortest_edge, l);
    if (e.twin[h] == kNoTwin) continue;
    const auto &p = normals[e.facet[h]], &q = normals[surface.right[h]];
    const double sine = std::hypot(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
    angles.push_back(std::atan2(sine, p.x * q.x + p.y * q.y + p.z * q.z) * 180 / std::numbers::pi);
  }
  for (std::size_t f = 0; f < surface.body.loops.size(); ++f) {
    const auto loop = surface.body.loops[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        out.max_facet_diameter = std::max(out.max_facet_diameter, distance(points[index(loop[i])], points[index(loop[j])]));
      }
    }
  }
  if (angles.empty()) return out;
  std::sort(angles.begin(), angles.end());
  out.max_normal_angle_deg = angles.back();
  out.median_normal_angle_deg = angles[(angles.size() - 1) / 2];
  return out;
}

nlohmann::ordered_json level_row(const ChamferSurface& surface, const HoneycombStatistics& statistics, double seconds) {
  const MeshTopology topology = analyse_topology(surface.body.loops, surface.body.vertex_count());
  std::size_t bits = 0;
  for (std::size_t f = 0; f < surface.body.planes.size(); ++f) {
    const Plane<Integer> p = surface.body.planes[f];
    bits = std::max({bits, p.a.bit_length(), p.b.bit_length(), p.c.bit_length(), p.d.bit_length()});
  }
  nlohmann::ordered_json row = level_row(LevelCounts{surface.level, topology.vertices, topology.edges, topology.facets}, seconds, statistics);
  row["plane_bits"] = bits;
  row["concave_edges"] = concave_edge_count(surface);
  return row;
}

std::string text_row(const nlohmann::ordered_json& row) {
  return fmt::format("{:>5} {:>10} {:>10} {:>9} {:>10.4f} {:>10.4f} {:>12.5g} {:>12.5g} {:>8.3f}\n", row["level"].get<unsigned>(),
                     row["vertices"].get<std::size_t>(), row["faces"].get<std::size_t>(), row["concave_edges"].get<std::size_t>(),
                     row["max_normal_angle_deg"].get<double>(), row["median_normal_angle_deg"].get<double>(),
                     row["longest_edge"].get<double>(), row["shortest_edge"].get<double>(), row["seconds"].get<double>());
}

/// V' <= 4V and F' = F + E with E <= 3V/2.
void check_bounds(const PlaneBody& body, unsigned levels, const Common& common) {
  double vertices = static_cast<double>(body.vertex_count()), facets = static_cast<double>(body.loops.size());
  for (unsigned l = 0; l < levels; ++l) {
    facets += 1.5 * vertices;
    vertices *= 4;
  }
  if (3 * vertices >= 4294967295.0) throw ResourceLimit(fmt::format("level {} would have {:.0f} half-edges; at most 4294967294 are possible", levels, 3 * vertices));
  if (common.max_facets > 0 && facets > static_cast<double>(common.max_facets)) {
    throw ResourceLimit(fmt::format("level {} would have {:.0f} facets, --max-facets allows {}", levels, facets, common.max_facets));
  }
  // Two levels with their points, the map and signs of one.
  constexpr double kBytesPerFacet = 1500;
  if (common.max_memory > 0 && facets * kBytesPerFacet > static_cast<double>(common.max_memory)) {
    throw ResourceLimit(fmt::format("level {} would need about {:.0f} bytes, --max-memory allows {}", levels, facets * kBytesPerFacet, common.max_memory));
  }
}

OutputChoice output_of(const SubdivideOptions& options, const std::string& path, io::Format format, const Common& common) {
  return {path, format, {options.color, common.unit}};
}

struct Stop {
  bool keep_new = true;
  std::string reason;
};
Stop stopping(const SubdivideOptions& options, const HoneycombStatistics& statistics, unsigned level) {
  if (options.stop_min_edge > 0 && statistics.shortest_edge < options.stop_min_edge) {
    return {false, fmt::format("level {} would have an edge of {:.6g}, below --stop-min-edge", level, statistics.shortest_edge)};
  }
  if (options.stop_max_panel > 0 && statistics.max_facet_diameter <= options.stop_max_panel) {
    return {true, fmt::format("level {} is the first with all panels within --stop-max-panel", level)};
  }
  return {};
}

/// The claims of the result, decided; the certificate is written when all hold.
std::vector<ClaimVerdict> certify_result(const PlaneBody& body, const SubdivideOptions& options) {
  std::vector<Claim> claims;
  if (analyse_topology(body.loops, body.vertex_count()).closed) claims = {{"closed", ""}, {"trivalent", ""}};
  claims.push_back({"planar", ""});
  claims.push_back({"embedded", ""});
  const Certificate certificate = make_certificate(
      body, claims, {}, {fmt::format("hexact {}", HEXACT_VERSION), fmt::format("subdivide --scheme {} --levels {}", options.scheme, options.levels)});
  std::vector<ClaimVerdict> verdicts = verify(certificate);
  if (overall(verdicts) == Verdict::proved) io::write_certificate(options.certificate, certificate);
  return verdicts;
}

}  // namespace

Outcome subdivide_chamfer_surface(const BodyInput& input, const SubdivideOptions& options, const Common& common) {
  if (!options.limit_points.empty()) throw UsageError("--limit-points needs a convex solid");
  if (!options.keep.empty()) throw UsageError("--keep needs a convex solid");
  if (!options.lifts.empty() && options.lifts != "auto") throw UsageError("--lifts file and fair need a convex solid");
  check_bounds(input.body, options.levels, common);
  ChamferSurface surface = chamfer_surface_start(input.body);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  rows.push_back(level_row(surface, measure(surface), 0));
  std::string stopped;
  for (unsigned l = 1; l <= options.levels && stopped.empty(); ++l) {
    const auto start = std::chrono::steady_clock::now();
    ChamferSurface next = chamfer_surface_step(surface);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const HoneycombStatistics statistics = measure(next);
    const Stop stop = stopping(options, statistics, l);
    stopped = stop.reason;
    if (!stop.keep_new) break;
    surface = std::move(next);
    rows.push_back(level_row(surface, statistics, seconds));
    if (options.all_levels.empty()) continue;
    const std::string path = level_path(options.all_levels, l);
    write_geometry(output_of(options, path, level_format(path, options.to), common), surface.body);
  }
  Outcome outcome;
  auto& report = outcome.report;
  report["scheme"] = options.scheme;
  report["arithmetic"] = options.arithmetic;
  report["levels"] = rows;
  report["output"] = options.output;
  report["certificate"] = nullptr;
  if (!options.certificate.empty()) {
    const auto verdicts = certify_result(surface.body, options);
    if (overall(verdicts) == Verdict::proved) {
      report["certificate"] = options.certificate;
    } else {
      outcome.exit_code = kClaimFails;
      for (const ClaimVerdict& v : verdicts) {
        if (v.verdict != Verdict::proved) report["witness"] = v.claim + ": " + v.witness;
      }
    }
  }
  report["max_rounding"] = write_geometry(output_of(options, options.output, output_format(options.output, options.to), common), surface.body).max_rounding;
  report["max_parameter_change"] = nullptr;
  report["min_parameter"] = nullptr;
  if (!stopped.empty()) report["stopped"] = stopped;
  if (options.output == "-") return outcome;
  outcome.text = "level   vertices     facets   concave  max angle     median      longest     shortest  seconds\n";
  for (const auto& row : rows) outcome.text += text_row(row);
  for (const char* key : {"stopped", "witness"}) {
    if (report.contains(key)) outcome.text += report[key].get<std::string>() + "\n";
  }
  outcome.text += fmt::format("written to {}\n", options.output);
  return outcome;
}

}  // namespace hexact::app
