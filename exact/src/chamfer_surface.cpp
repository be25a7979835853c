// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/chamfer_surface.hpp"

#include "convex_surface.hpp"
#include "hexact/exact/embedded.hpp"
#include "surface_step.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hexact {
namespace {

using namespace detail;

std::vector<Finding> topology_findings(const PlaneBody& body) {
  std::vector<Finding> findings = analyse_topology(body.loops, body.vertex_count()).findings;
  std::erase_if(findings, [](const Finding& f) { return f.code == "HasBoundary"; });
  return findings;
}

/// The one plane, beside that of the facet, that the ends of a boundary edge share.
std::optional<std::uint32_t> plane_beyond(const PlaneBody& body, std::size_t a, std::size_t b, std::uint32_t facet) {
  std::optional<std::uint32_t> found;
  for (const FacetId p : body.triples[a]) {
    if (index(p) == facet || std::find(body.triples[b].begin(), body.triples[b].end(), p) == body.triples[b].end()) continue;
    if (found) return std::nullopt;
    found = static_cast<std::uint32_t>(index(p));
  }
  return found;
}

/// Fills `right`. Interior vertices get the triple of their facets, counter-clockwise.
void find_right_planes(ChamferSurface& surface, const HalfEdges& e, std::vector<Finding>& findings) {
  surface.right.assign(e.size(), kNoTwin);
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    if (e.twin[h] != kNoTwin) {
      surface.right[h] = e.facet[e.twin[h]];
    } else if (const auto p = plane_beyond(surface.body, e.origin[h], e.target(h), e.facet[h])) {
      surface.right[h] = *p;
    } else {
      findings.push_back({"BoundaryPlane", "its ends do not share exactly one plane beside that of " + facet_name(e.facet[h]),
                          edge_name(e.origin[h], e.target(h)), {}});
    }
  }
}

/// Interior vertices have three facets; those on a boundary one, or two and one plane beyond.
void check_valences(const ChamferSurface& surface, const HalfEdges& e, std::vector<Finding>& findings) {
  struct Star {
    std::size_t facets = 0, boundary = 0;
    std::vector<std::uint32_t> beyond;
  };
  std::vector<Star> stars(surface.body.vertex_count());
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    ++stars[e.origin[h]].facets;
    if (e.twin[h] != kNoTwin) continue;
    for (const std::uint32_t v : {e.origin[h], e.target(h)}) {
      ++stars[v].boundary;
      stars[v].beyond.push_back(surface.right[h]);
    }
  }
  for (std::size_t v = 0; v < stars.size(); ++v) {
    const Star& s = stars[v];
    if (s.boundary == 0 ? s.facets != 3 : s.facets > 2) {
      findings.push_back({"NotTrivalent", "has " + std::to_string(s.facets) + " facets, expected " + (s.boundary == 0 ? "3" : "at most 2 on a boundary"),
                          vertex_name(v), {}});
    } else if (s.boundary == 2 && s.facets == 2 && s.beyond[0] != s.beyond[1]) {
      findings.push_back({"BoundaryPlane", "its boundary edges lie on different planes", vertex_name(v), {}});
    }
  }
}

/// The three planes of each vertex from its facets and the planes beyond.
void set_triples(ChamferSurface& surface, const HalfEdges& e, std::vector<Finding>& findings) {
  std::vector<char> seen(surface.body.vertex_count(), 0);
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    const std::uint32_t v = e.origin[h];
    if (seen[v] != 0) continue;
    seen[v] = 1;
    std::array<std::uint32_t, 3> p{e.facet[h], surface.right[e.previous[h]], surface.right[h]};
    std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
    surface.body.triples[v] = {make_id<FacetId>(p[0]), make_id<FacetId>(p[1]), make_id<FacetId>(p[2])};
    if (sign_det3(surface.body.planes, p[0], p[1], p[2]) == 0) {
      findings.push_back({"DegenerateVertex", "the normals of its three planes are dependent", vertex_name(v), {}});
    }
  }
}

/// x·2^shift is a double of ordinary size; only for proposals.
double scaled_double(const Integer& x, long bits) { return Rational(x).scaled(-bits).to_double(); }

/// Integers that make all normals equally long to 2^-12.
void equalise(IntegerPlanes& planes) {
  std::vector<double> length(planes.size());
  long bits = 0;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const Plane<Integer> p = planes[f];
    bits = std::max(bits, static_cast<long>(std::max({p.a.bit_length(), p.b.bit_length(), p.c.bit_length()})));
  }
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const Plane<Integer> p = planes[f];
    length[f] = std::hypot(scaled_double(p.a, bits), scaled_double(p.b, bits), scaled_double(p.c, bits));
    if (!(length[f] > 0x1p-1000)) throw ResourceLimit("normals of planes differ in length by more than 2^1000");
  }
  const double longest = *std::max_element(length.begin(), length.end());
  std::vector<Integer> factors(planes.size());
  for (int extra = 0;; ++extra) {
    bool equal = true;
    for (std::size_t f = 0; f < planes.size(); ++f) {
      const double wanted = std::ldexp(longest / length[f], extra);
      const Rational nearest = wanted < 0x1p52 ? Rational::from_double(std::nearbyint(wanted)) : Rational::from_double(wanted);
      factors[f] = nearest.numerator();
      equal = equal && std::fabs(nearest.to_double() / wanted - 1) <= 0x1p-12;
    }
    if (equal) break;
  }
  IntegerPlanes out;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const Plane<Integer> p = planes[f];
    out.push_back(Plane<Integer>{p.a * factors[f], p.b * factors[f], p.c * factors[f], p.d * factors[f]});
  }
  planes = std::move(out);
}

/// Signs of edges; then whether the facets at interior vertices form an embedded cone: docs/chamfer-nonconvex.md.
void find_signs(ChamferSurface& surface, const HalfEdges& e, std::vector<Finding>& findings) {
  const LocatedPoints<Rational> points(surface.body);
  surface.sign.assign(e.size(), 0);
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    if (e.twin[h] != kNoTwin && e.twin[h] < h) {
      surface.sign[h] = surface.sign[e.twin[h]];
      continue;
    }
    surface.sign[h] = static_cast<std::int8_t>(run_of_edge(points, e.origin[h], e.target(h), e.facet[h], surface.right[h]));
    if (surface.sign[h] == 0) findings.push_back({"EdgeFlat", "its planes meet in no line, or it has no length", edge_name(e.origin[h], e.target(h)), {}});
  }
  if (!findings.empty()) return;
  std::vector<char> seen(surface.body.vertex_count(), 0);
  const SurfaceMap map(surface);
  for (std::uint32_t h = 0; h < e.size(); ++h) {
    const std::uint32_t v = e.origin[h];
    const auto star = e.around(h);
    if (seen[v] != 0 || star.size() != 3 || e.twin[e.previous[h]] == kNoTwin) continue;
    seen[v] = 1;
    if ((map.corner_sign[v] > 0) == map.is_pure(surface, v)) continue;
    findings.push_back({"VertexNotEmbedded", "its facets pass through each other", vertex_name(v), {}});
  }
}

void require(std::vector<Finding>& findings) {
  if (!findings.empty()) throw InvalidInput(std::move(findings));
}

}  // namespace

ChamferSurface chamfer_surface_start(const PlaneBody& body) {
  if (body.field != Field::rational) {
    throw InvalidInput("FieldNotRational", "a chamfer needs planes over Q; snap them first (prepare --snap)", "");
  }
  std::vector<Finding> findings = topology_findings(body);
  require(findings);
  ChamferSurface surface;
  surface.body = body;
  surface.body.addresses.assign(body.planes.size(), {});
  const HalfEdges e = half_edges_of(body.loops);
  find_right_planes(surface, e, findings);
  check_valences(surface, e, findings);
  require(findings);
  set_triples(surface, e, findings);
  require(findings);
  if (const Fault fault = planar_fault(body.planes, body.loops, body.triples); !fault.empty()) {
    const std::size_t colon = fault.find(": ");
    throw InvalidInput("NotOnPlane", fault.substr(colon + 2), fault.substr(0, colon));
  }
  findings = facet_findings(surface.body);
  require(findings);
  find_signs(surface, e, findings);
  require(findings);
  equalise(surface.body.planes);
  return surface;
}

ChamferSurface chamfer_surface_step(const ChamferSurface& surface, const std::vector<Integer>& lifts) {
  const SurfaceMap map(surface);
  const auto refuse = [](const std::vector<SurfaceFault>& faults) {
    std::vector<Finding> findings;
    for (const SurfaceFault& f : faults) findings.push_back(f.finding);
    require(findings);
  };
  refuse(lift_faults(surface, map, lifts));
  ChamferSurface next = cut_edges(surface, map, lifts);
  refuse(cut_faults(surface, map, next));
  return next;
}

}  // namespace hexact
