// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_input.hpp"
#include "command.hpp"
#include "exact_output.hpp"
#include "hexact/exact/certify.hpp"
#include "hexact/exact/measure_soup.hpp"
#include "hexact/exact/volume.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace hexact::app {
namespace {

// Exact vertices of deep levels have thousands of bits: beyond this many the signs of a certificate decide instead, and
// figures are those of the correctly rounded vertices.
constexpr std::size_t kManyVertices = 20000;
constexpr std::size_t kShownFindings = 100;

struct InfoOptions {
  std::string input, from;
  bool exact = false;
};

/// Everything that is reported about a mesh.
struct Description {
  SoupShape shape;
  SoupMeasures measures;
  bool planar = false;
  std::optional<bool> convex;
  std::optional<QuadraticField> volume;   ///< exact, or of rounded vertices
  std::optional<std::string> volume_exact;
};

bool has_volume(const MeshTopology& t) { return t.closed && t.manifold && t.oriented; }

template <class S>
Description describe(const PolygonSoup<S>& soup) {
  Description d;
  d.shape = examine_soup(soup);
  d.measures = measure_soup(soup);
  d.planar = d.measures.planar;
  d.convex = bounds_convex_body(soup, d.shape);
  if (has_volume(d.shape.topology)) {
    d.volume = QuadraticField(exact_volume(std::span(soup.points), soup.facets));
    d.volume_exact = d.volume->str();
  }
  return d;
}

bool proved(const PlaneBody& body, const char* claim) {
  return overall(verify(make_certificate(body, {{claim, ""}}, {}, {}))) == Verdict::proved;
}

/// A body of many planes: planarity and convexity by the signs of a certificate.
Description describe_large(const PlaneBody& body, bool exact) {
  PolygonSoup<Rational> near;
  for (const auto& p : rounded_vertices(body).points) {
    near.points.push_back({Rational::from_double(p.x), Rational::from_double(p.y), Rational::from_double(p.z)});
  }
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    if (!body.loops[f].empty()) near.facets.add(body.loops[f]);
  }
  Description d;
  d.shape.topology = analyse_topology(near.facets, near.points.size());
  d.shape.findings = d.shape.topology.findings;
  d.measures = measure_soup(near);
  d.planar = proved(body, "planar");
  if (d.planar) d.measures.max_nonplanarity = 0;
  if (d.shape.topology.closed) d.convex = proved(body, "convex");
  d.shape.strictly_convex = d.convex.value_or(false);
  if (has_volume(d.shape.topology)) {
    d.volume = QuadraticField(exact_volume(std::span<const Point3<Rational>>(near.points), near.facets));
    if (exact) d.volume_exact = exact_volume(body).str();
  }
  return d;
}

Description describe_geometry(io::Geometry&& geometry, bool exact) {
  const PlaneBody* body = std::get_if<PlaneBody>(&geometry);
  if (const auto* certificate = std::get_if<Certificate>(&geometry)) body = &certificate->body;
  if (body != nullptr && body->field == Field::rational && body->vertex_count() > kManyVertices) {
    return describe_large(*body, exact);
  }
  return std::visit([](const auto& soup) { return describe(soup); }, exact_soup(std::move(geometry)));
}

nlohmann::ordered_json histogram(const std::map<std::size_t, std::size_t>& counts) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [key, count] : counts) object[std::to_string(key)] = count;
  return object;
}

nlohmann::ordered_json coordinates(const Point3<double>& p) { return {p.x, p.y, p.z}; }

double finite_volume(const QuadraticField& volume) {
  const double v = volume.to_double();
  if (!std::isfinite(v)) throw ResourceLimit("the volume is beyond the range of double; scale the mesh");
  return v;
}

nlohmann::ordered_json report_of(const Description& d, bool exact) {
  const MeshTopology& t = d.shape.topology;
  nlohmann::ordered_json r;
  r["vertices"] = t.vertices;
  r["edges"] = t.edges;
  r["faces"] = t.facets;
  r["boundary_loops"] = t.boundary_loops;
  r["euler"] = t.euler;
  r["face_sizes"] = histogram(t.facet_sizes);
  r["valences"] = histogram(t.valences);
  r["components"] = t.components;
  r["closed"] = t.closed;
  r["manifold"] = t.manifold;
  r["orientable"] = t.orientable;
  r["planar"] = d.planar;
  r["max_nonplanarity"] = d.measures.max_nonplanarity;
  r["convex"] = d.convex ? nlohmann::ordered_json(*d.convex) : nlohmann::ordered_json();
  r["strictly_convex"] = d.shape.strictly_convex;
  r["volume"] = d.volume ? nlohmann::ordered_json(finite_volume(*d.volume)) : nlohmann::ordered_json();
  if (exact) {
    r["volume_exact"] = d.volume_exact ? nlohmann::ordered_json(*d.volume_exact) : nlohmann::ordered_json();
  }
  r["area"] = d.measures.area;
  r["bbox"] = {coordinates(d.measures.box[0]), coordinates(d.measures.box[1])};
  r["finding_count"] = d.shape.findings.size();
  r["findings"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < std::min(kShownFindings, d.shape.findings.size()); ++i) {
    const Finding& f = d.shape.findings[i];
    r["findings"].push_back({{"code", f.code}, {"element", f.element}, {"message", f.message}});
  }
  return r;
}

std::string list(const std::map<std::size_t, std::size_t>& counts) {
  std::string text;
  for (const auto& [key, count] : counts) text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", count, key);
  return text;
}

std::string text_of(const Description& d, const InfoOptions& options, const std::string& unit) {
  const MeshTopology& t = d.shape.topology;
  const auto yes = [](bool b) { return b ? "yes" : "no"; };
  std::string text = fmt::format(
      "{}: {} vertices, {} edges, {} facets\n"
      "facet sizes       {}\nvalences          {}\nparts             {}\nboundary loops    {}\nEuler             {}\n"
      "closed            {}\nmanifold          {}\norientable        {}\nplanar            {}\nnonplanarity      {:.6g}{}\n"
      "convex            {}\n",
      options.input, t.vertices, t.edges, t.facets, list(t.facet_sizes), list(t.valences), t.components,
      t.boundary_loops, t.euler, yes(t.closed), yes(t.manifold), yes(t.orientable), yes(d.planar),
      d.measures.max_nonplanarity, unit, d.convex ? yes(*d.convex) : "bounds nothing");
  if (d.volume) text += fmt::format("volume            {:.17g}{}\n", finite_volume(*d.volume), unit.empty() ? "" : unit + "^3");
  if (options.exact && d.volume_exact) text += fmt::format("volume exactly    {}\n", *d.volume_exact);
  const auto &low = d.measures.box[0], &high = d.measures.box[1];
  text += fmt::format("area              {:.17g}{}\nbox               ({}, {}, {}) to ({}, {}, {}){}\n", d.measures.area,
                      unit.empty() ? "" : unit + "^2", low.x, low.y, low.z, high.x, high.y, high.z, unit);
  for (std::size_t i = 0; i < std::min<std::size_t>(10, d.shape.findings.size()); ++i) {
    const Finding& f = d.shape.findings[i];
    text += fmt::format("{}{}{}: {}\n", f.element, f.element.empty() ? "" : ": ", f.code, f.message);
  }
  if (d.shape.findings.size() > 10) text += fmt::format("and {} more findings\n", d.shape.findings.size() - 10);
  return text;
}

Outcome info(const InfoOptions& options, const Common& common) {
  const Description d = describe_geometry(io::read_geometry(options.input, named_format(options.from)), options.exact);
  Outcome outcome;
  outcome.report = report_of(d, options.exact);
  outcome.text = text_of(d, options, common.unit.empty() ? "" : " " + common.unit);
  return outcome;
}

}  // namespace

void add_info(const Registry& registry) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command = registry.add("info", "Counts, shape and exact figures of a mesh, .planes file or certificate");
  command->add_option("MESH", options->input, "File to describe; - is standard input")->required();
  command->add_option("--from", options->from, "Format of the input: obj, off, ply, stl, planes, cert");
  command->add_flag("--exact", options->exact, "Also the exact volume, p/q or p/q+r/s*sqrt5");
  command->callback([options, registry] {
    registry.selected = [options, &common = registry.common] { return info(*options, common); };
  });
}

}  // namespace hexact::app
