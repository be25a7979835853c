// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/kernel/errors.hpp"
#include "hexact/validation/openscad_crosscheck.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace hexact::validation {
namespace {

using Vector = std::array<Rational, 3>;

Vector to_vector(const Point3<Rational>& p) { return {p.x, p.y, p.z}; }

Rational power_of_ten(long e) {
  Rational r(1);
  for (long i = 0; i < std::abs(e); ++i) r *= Rational(10);
  return e < 0 ? Rational(1) / r : r;
}

/// How far a written coordinate may be from the exact one, in program units: half a unit of its 6th significant
/// digit; 2^-18 for OpenSCAD's grid of 2^-20; and 2^-23 of its size, because OpenSCAD rounds to float32 before it
/// writes (-10914850.247 comes out as -1.09148e+07: a tie, after that rounding).
Rational export_bound(const Rational& written) {
  const Rational grid = Rational(1).scaled(-18);
  if (written.is_zero()) return grid;
  const Rational size = abs(written);
  long e = static_cast<long>(std::floor(std::log10(size.to_double())));
  while (power_of_ten(e) > size) --e;
  while (!(power_of_ten(e + 1) > size)) ++e;
  return Rational(5) * power_of_ten(e - 6) + size.scaled(-23) + grid;
}

/// Everything in lattice units.
struct Match {
  std::vector<Vector> exported;         ///< coordinates as written
  std::vector<Vector> bounds;           ///< how far each may be off
  std::vector<std::size_t> ours;        ///< the vertex of the model that each exported one is
};

/// Our vertices within the bounds of an exported one.
std::vector<std::size_t> candidates(const ScadModel& model, const Vector& point, const Vector& bound) {
  std::vector<std::size_t> found;
  for (std::size_t v = 0; v < model.vertices.size(); ++v) {
    const Point3<Rational>& p = model.vertices[v];
    if (abs(p.x - point[0]) > bound[0] || abs(p.y - point[1]) > bound[1] || abs(p.z - point[2]) > bound[2]) continue;
    found.push_back(v);
  }
  return found;
}

void set(RouteReport& report, Agreement verdict, std::string reason) {
  report.verdict = verdict;
  report.reason = std::move(reason);
}

/// One-to-one match of vertices; false with a verdict in the report when there is none.
bool match_vertices(const ScadModel& model, const OpenscadMesh& mesh, Match& match, RouteReport& report) {
  std::vector<std::size_t> hits(model.vertices.size(), 0);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    Vector point = to_vector(mesh.points[i]), bound;
    for (std::size_t k = 0; k < 3; ++k) {
      bound[k] = export_bound(point[k]).scaled(model.fraction_bits);
      point[k] = point[k].scaled(model.fraction_bits);
    }
    const auto found = candidates(model, point, bound);
    if (found.size() > 1) {
      set(report, Agreement::not_checked,
          "two of our vertices (" + std::to_string(found[0]) + ", " + std::to_string(found[1]) +
              ") are closer than the 6 digits that OpenSCAD writes");
      return false;
    }
    if (found.empty()) {
      set(report, Agreement::differ, "OpenSCAD's vertex " + std::to_string(i) + " is none of ours");
      return false;
    }
    ++hits[found[0]];
    match.exported.push_back(std::move(point));
    match.bounds.push_back(std::move(bound));
    match.ours.push_back(found[0]);
  }
  for (std::size_t v = 0; v < hits.size(); ++v) {
    if (hits[v] == 1) continue;
    set(report, Agreement::differ, "our vertex " + std::to_string(v) + " is " +
                                       (hits[v] == 0 ? "missing in" : "more than one vertex of") + " OpenSCAD's solid");
    return false;
  }
  return true;
}

std::vector<std::vector<std::size_t>> facets_of_vertices(const ScadModel& model) {
  std::vector<std::vector<std::size_t>> facets(model.vertices.size());
  for (std::size_t f = 0; f < model.loops.size(); ++f) {
    for (const VertexId v : model.loops[f]) facets.at(index(v)).push_back(f);
  }
  return facets;
}

/// Merges triangles that lie in one facet of ours: counts, or nullopt with a verdict in the report.
std::optional<ElementCounts> merge_triangles(const ScadModel& model, const OpenscadMesh& mesh, const Match& match,
                                             RouteReport& report) {
  const auto facets = facets_of_vertices(model);
  std::set<std::size_t> used;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> facet_of_edge;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::size_t, 3> v{};
    for (std::size_t i = 0; i < 3; ++i) v[i] = match.ours[mesh.triangles[t][i]];
    const auto at = [&](std::size_t i, std::size_t f) { return std::find(facets[v[i]].begin(), facets[v[i]].end(), f) != facets[v[i]].end(); };
    const auto f = std::find_if(facets[v[0]].begin(), facets[v[0]].end(), [&](std::size_t g) { return at(1, g) && at(2, g); });
    if (f == facets[v[0]].end()) {
      set(report, Agreement::differ, "OpenSCAD's triangle " + std::to_string(t) + " lies in no facet of ours");
      return std::nullopt;
    }
    used.insert(*f);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!facet_of_edge.emplace(std::pair{v[i], v[(i + 1) % 3]}, *f).second) {
        set(report, Agreement::differ, "OpenSCAD's surface uses an edge twice in one direction");
        return std::nullopt;
      }
    }
  }
  std::size_t edges = 0;
  for (const auto& [edge, facet] : facet_of_edge) {
    const auto twin = facet_of_edge.find({edge.second, edge.first});
    if (twin == facet_of_edge.end()) {
      set(report, Agreement::differ, "OpenSCAD's surface is open");
      return std::nullopt;
    }
    if (edge.first < edge.second && twin->second != facet) ++edges;
  }
  return ElementCounts{mesh.points.size(), edges, used.size()};
}

Rational determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The determinant with every sign positive: it bounds how far the determinant can move.
Rational permanent(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] + b[2] * c[1]) + a[1] * (b[2] * c[0] + b[0] * c[2]) + a[2] * (b[0] * c[1] + b[1] * c[0]);
}

Rational six_volumes(const ScadModel& model) {
  Rational sum;
  for (std::size_t f = 0; f < model.loops.size(); ++f) {
    const auto loop = model.loops[f];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      sum += determinant(to_vector(model.vertices[index(loop[0])]), to_vector(model.vertices[index(loop[i])]),
                         to_vector(model.vertices[index(loop[i + 1])]));
    }
  }
  return sum;
}

/// Moves of a vertex by at most e change det(a, b, c) by at most perm(|a| + e, …) − perm(|a|, …), |a| taken at the
/// exported point; the sum over the triangles bounds six times the difference of the volumes.
void compare_volumes(const ScadModel& model, const OpenscadMesh& mesh, const Match& match, RouteReport& report) {
  std::vector<Vector> size, grown;
  for (std::size_t i = 0; i < match.exported.size(); ++i) {
    Vector s, g;
    for (std::size_t k = 0; k < 3; ++k) {
      s[k] = abs(match.exported[i][k]);
      g[k] = s[k] + match.bounds[i][k];
    }
    size.push_back(std::move(s));
    grown.push_back(std::move(g));
  }
  Rational theirs, bound;
  for (const auto& [i, j, k] : mesh.triangles) {
    theirs += determinant(match.exported[i], match.exported[j], match.exported[k]);
    bound += permanent(grown[i], grown[j], grown[k]) - permanent(size[i], size[j], size[k]);
  }
  const Rational unit3 = model.unit * model.unit * model.unit / Rational(6);
  const Rational difference = abs(theirs - six_volumes(model));
  report.volume_difference = (difference * unit3).to_double();
  report.bound = (bound * unit3).to_double();
  if (difference > bound) set(report, Agreement::differ, "the volumes differ by more than the rounding explains");
}

/// Largest and smallest coordinates, theirs within the largest bound of ours.
void compare_boxes(const ScadModel& model, const Match& match, RouteReport& report) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto by = [&](const auto& a, const auto& b) { return a[k] < b[k]; };
    std::vector<Vector> exact;
    for (const auto& p : model.vertices) exact.push_back(to_vector(p));
    const auto [low, high] = std::minmax_element(exact.begin(), exact.end(), by);
    const auto [their_low, their_high] = std::minmax_element(match.exported.begin(), match.exported.end(), by);
    const Rational bound = (*std::max_element(match.bounds.begin(), match.bounds.end(), by))[k];
    if (abs((*low)[k] - (*their_low)[k]) > bound || abs((*high)[k] - (*their_high)[k]) > bound) {
      set(report, Agreement::differ, "the bounding boxes differ by more than the rounding explains");
    }
  }
}

std::string counts_text(const ElementCounts& c) {
  return std::to_string(c.vertices) + " vertices, " + std::to_string(c.edges) + " edges, " + std::to_string(c.facets) + " facets";
}

}  // namespace

RouteReport compare_export(const ScadModel& model, const OpenscadMesh& mesh, const ElementCounts& ours, RouteReport report) {
  set(report, Agreement::agree, {});
  if (report.openscad && *report.openscad != ours) {
    set(report, Agreement::differ, "OpenSCAD has " + counts_text(*report.openscad) + "; ours are " + counts_text(ours));
    return report;
  }
  if (mesh.points.empty()) {
    set(report, Agreement::differ, "OpenSCAD's solid is empty");
    return report;
  }
  Match match;
  if (!match_vertices(model, mesh, match, report)) return report;
  const auto merged = merge_triangles(model, mesh, match, report);
  if (!merged) return report;
  if (!report.openscad) report.openscad = *merged;
  if (*merged != ours) {
    set(report, Agreement::differ, "OpenSCAD's triangles merge into " + counts_text(*merged) + "; ours are " + counts_text(ours));
    return report;
  }
  compare_volumes(model, mesh, match, report);
  if (report.verdict == Agreement::agree) compare_boxes(model, match, report);
  return report;
}

}  // namespace hexact::validation
