// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

// Bodies of midedge_keep_size.hpp, for the explicit instantiations in `kernel` and `exact` only.

#include "hexact/kernel/midedge_attributes_impl.hpp"
#include "hexact/kernel/midedge_keep_size.hpp"

#include <cmath>

namespace hexact::detail {

/// For each facet the number of its component, counted in the order of their first facets.
inline std::vector<std::uint32_t> component_of_facets(const MidedgeMap& map, std::uint32_t& count) {
  std::vector<std::uint32_t> label(map.facet_count(), kNothing), stack;
  count = 0;
  for (std::uint32_t first = 0; first < label.size(); ++first) {
    if (label[first] != kNothing) continue;
    label[first] = count;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t f = stack.back(), start = map.facet_start(f);
      stack.pop_back();
      for (std::uint32_t h = start; h < start + map.facet_size(f); ++h) {
        const std::uint32_t t = map.twin(h);
        if (t == kNoTwin || label[map.facet(t)] != kNothing) continue;
        label[map.facet(t)] = count;
        stack.push_back(map.facet(t));
      }
    }
    ++count;
  }
  return label;
}

using FacetPolygon = std::vector<Point3<double>>;

inline Point3<double> cross(const Point3<double>& p, const Point3<double>& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

inline Point3<double> sum_of(const FacetPolygon& polygon) {
  Point3<double> sum{0, 0, 0};
  for (const auto& p : polygon) sum = plus(sum, p);
  return sum;
}

/// Volume between the origin and the polygon, fanned from its mean corner.
inline double fanned_volume(const FacetPolygon& polygon) {
  const Point3<double> sum = sum_of(polygon);
  Point3<double> area{0, 0, 0};
  for (std::size_t i = 0; i < polygon.size(); ++i) area = plus(area, cross(polygon[i], polygon[(i + 1) % polygon.size()]));
  return (sum.x * area.x + sum.y * area.y + sum.z * area.z) / (6 * static_cast<double>(polygon.size()));
}

/// Area of the same fan.
inline double fanned_area(const FacetPolygon& polygon) {
  const Point3<double> mean = times(1 / static_cast<double>(polygon.size()), sum_of(polygon));
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3<double> n = cross(minus(polygon[i], mean), minus(polygon[(i + 1) % polygon.size()], mean));
    area += std::hypot(n.x, n.y, n.z);
  }
  return area / 2;
}

inline double as_double(double x) { return x; }
inline double as_number(double x, const double*) { return x; }

}  // namespace hexact::detail

namespace hexact {

template <class S>
SizeKeeper<S>::SizeKeeper(const MidedgeLevel<S>& input) {
  const MidedgeMap& map = input.map;
  std::uint32_t count = 0;
  component_.of_facet = detail::component_of_facets(map, count);
  measures_.assign(count, SizeMeasure::volume);
  centres_.resize(count);
  std::vector<int> corners(count, 0);
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const std::uint32_t c = component(map.facet(h));
    if (map.twin(h) == kNoTwin) measures_[c] = SizeMeasure::area;
    centres_[c] = detail::plus(centres_[c], input.points[map.origin(h)]);
    ++corners[c];
  }
  for (std::uint32_t c = 0; c < count; ++c) centres_[c] = detail::times(S(1) / S(corners[c]), centres_[c]);
  centre_open_components(input);
  sizes_ = sizes(input);
  factors_.assign(count, 1);
}

/// Each vertex once: by the first of its half-edges.
template <class S>
void SizeKeeper<S>::centre_open_components(const MidedgeLevel<S>& level) {
  const std::vector<std::uint32_t> first = detail::first_half_edges(level.map).of_vertex;
  std::vector<int> count(centres_.size(), 0);
  for (std::size_t c = 0; c < centres_.size(); ++c) {
    if (measures_[c] == SizeMeasure::area) centres_[c] = {};
  }
  for (std::size_t v = 0; v < first.size(); ++v) {
    const std::uint32_t c = component(level.map.facet(first[v]));
    if (measures_[c] != SizeMeasure::area) continue;
    centres_[c] = detail::plus(centres_[c], level.points[v]);
    ++count[c];
  }
  for (std::size_t c = 0; c < centres_.size(); ++c) {
    if (measures_[c] == SizeMeasure::area) centres_[c] = detail::times(S(1) / S(count[c]), centres_[c]);
  }
}

template <class S>
void SizeKeeper<S>::step(const MidedgeMap& before, const MidedgeMap& after) {
  component_ = detail::refined_names(before, after, detail::first_half_edges(before), component_);
}

/// Relative to the centre of each component, so that a distant one loses no digits.
template <class S>
std::vector<double> SizeKeeper<S>::sizes(const MidedgeLevel<S>& level) const {
  std::vector<double> sum(centres_.size(), 0);
  std::vector<Point3<double>> polygon;
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    const std::uint32_t c = component(f);
    polygon.clear();
    for (const std::uint32_t v : level.map.loop(f)) {
      const Point3<S> p = detail::minus(level.points[v], centres_[c]);
      polygon.push_back({detail::as_double(p.x), detail::as_double(p.y), detail::as_double(p.z)});
    }
    sum[c] += measures_[c] == SizeMeasure::volume ? detail::fanned_volume(polygon) : detail::fanned_area(polygon);
  }
  for (std::size_t c = 0; c < sum.size(); ++c) {
    if (sum[c] > 0 && std::isfinite(sum[c])) continue;
    std::uint32_t f = 0;
    while (component(f) != c) ++f;
    if (measures_[c] == SizeMeasure::area) throw InvalidInput("NoArea", "its component has no area that could be kept", facet_name(f));
    throw InvalidInput("NoVolume", "its component encloses no positive volume that could be kept", facet_name(f));
  }
  return sum;
}

template <class S>
void SizeKeeper<S>::fit(const MidedgeLevel<S>& level) {
  centre_open_components(level);
  const std::vector<double> now = sizes(level);
  for (std::size_t c = 0; c < now.size(); ++c) {
    const double ratio = sizes_[c] / now[c];
    factors_[c] = measures_[c] == SizeMeasure::volume ? std::cbrt(ratio) : std::sqrt(ratio);
  }
}

template <class S>
Point3<S> SizeKeeper<S>::scaled(const Point3<S>& p, std::uint32_t component) const {
  const Point3<S>& centre = centres_[component];
  return detail::plus(centre, detail::times(detail::as_number(factors_[component], static_cast<const S*>(nullptr)), detail::minus(p, centre)));
}

template <class S>
PointArray<S> SizeKeeper<S>::scaled(const MidedgeLevel<S>& level) const {
  PointArray<S> points(level.points.size());
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    for (const std::uint32_t v : level.map.loop(f)) points[v] = scaled(level.points[v], component(f));
  }
  return points;
}

}  // namespace hexact
