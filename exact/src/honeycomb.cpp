// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/honeycomb.hpp"

#include "free_planes.hpp"
#include "honeycomb_impl.hpp"

namespace hexact {

template <class S>
HoneycombLevel<S> honeycomb_start(const PlaneBody& body) {
  HoneycombMap map(body.loops, body.vertex_count());
  std::vector<Plane<S>> planes = detail::file_planes(body, static_cast<const S*>(nullptr));
  const auto ring = detail::ring_planes(planes);
  std::vector<Point3<S>> points(map.vertex_count());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const auto f = map.facets_at(v);
    points[v] = detail::meet_in<S>(ring[f[0]], ring[f[1]], ring[f[2]], "DegenerateVertex", "vertex " + std::to_string(v));
  }
  return {std::move(map), std::move(planes), std::move(points)};
}

template <class S>
HoneycombStep<S> honeycomb_step(const HoneycombLevel<S>& level, const CutPolicy& policy, const ProgressPart& progress) {
  progress.check();
  if (const auto* free = std::get_if<PlanePolicy>(&policy)) return detail::step_by_planes(level, *free);
  return detail::step_by_parameters(level, policy, progress);
}

template <class S>
PlaneBody to_plane_body(const HoneycombLevel<S>& level) {
  PlaneBody body;
  detail::store_planes(level.planes, body);
  body.loops = level.map.loops();
  const auto facets = static_cast<std::uint32_t>(level.map.facet_count());
  body.addresses.reserve(facets);
  for (std::uint32_t f = 0; f < facets; ++f) {
    const std::uint32_t l = level.map.facet_level(f);
    body.addresses.push_back({l, l == 0 ? std::nullopt : std::optional(make_id<VertexId>(level.map.facet_parent(f)))});
  }
  body.triples.resize(level.map.vertex_count());
  for (std::uint32_t v = 0; v < body.triples.size(); ++v) {
    const auto f = level.map.facets_at(v);
    body.triples[v] = {make_id<FacetId>(f[0]), make_id<FacetId>(f[1]), make_id<FacetId>(f[2])};
  }
  return body;
}

template HoneycombLevel<Rational> honeycomb_start(const PlaneBody&);
template HoneycombLevel<QuadraticField> honeycomb_start(const PlaneBody&);
template HoneycombStep<Rational> honeycomb_step(const HoneycombLevel<Rational>&, const CutPolicy&, const ProgressPart&);
template HoneycombStep<QuadraticField> honeycomb_step(const HoneycombLevel<QuadraticField>&, const CutPolicy&,
                                                      const ProgressPart&);
template PlaneBody to_plane_body(const HoneycombLevel<Rational>&);
template PlaneBody to_plane_body(const HoneycombLevel<QuadraticField>&);

}  // namespace hexact
