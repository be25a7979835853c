// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

// Bodies of midedge_keep_size.hpp, for the explicit instantiations in `kernel` and `exact` only.

#include "hexact/kernel/midedge_attributes_impl.hpp"
#include "hexact/kernel/midedge_keep_size.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <string>

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

constexpr int kLeastExponent = INT_MIN;

/// The least e with |x| < 2^e, or nearly so; kLeastExponent for 0.
inline int binary_exponent(double x) { return x == 0 ? kLeastExponent : std::isfinite(x) ? std::ilogb(x) + 1 : 0; }
/// x / 2^exponent.
inline double as_double(double x, int exponent) { return std::ldexp(x, -exponent); }
inline double times_power_of_two(double x, int exponent) { return std::ldexp(x, exponent); }
inline bool is_finite(double x) { return std::isfinite(x); }
inline double as_number(double x, const double*) { return x; }

template <class S>
Point3<S> times_power_of_two(const Point3<S>& p, int exponent) {
  return {times_power_of_two(p.x, exponent), times_power_of_two(p.y, exponent), times_power_of_two(p.z, exponent)};
}

}  // namespace hexact::detail

namespace hexact {

template <class S>
SizeKeeper<S>::SizeKeeper(const MidedgeLevel<S>& input) {
  const MidedgeMap& map = input.map;
  std::uint32_t count = 0;
  component_.of_facet = detail::component_of_facets(map, count);
  measures_.assign(count, SizeMeasure::volume);
  centres_.resize(count);
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    if (map.twin(h) == kNoTwin) measures_[component(map.facet(h))] = SizeMeasure::area;
  }
  centre(SizeMeasure::volume, [&](const auto& add) {
    for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) add(component(map.facet(h)), input.points[map.origin(h)]);
  });
  centre_open_components(input);
  sizes_ = sizes(input);
  factors_.assign(count, 1);
}

/// Sets the centres of the components with this measure to the means of the points that `visit` adds. Sums that overflow
/// are taken again 2^32 times smaller.
template <class S>
template <class Visit>
void SizeKeeper<S>::centre(SizeMeasure measure, const Visit& visit) {
  for (const int shift : {0, 32}) {
    std::vector<Point3<S>> sum(centres_.size());
    std::vector<int> count(centres_.size(), 0);
    visit([&](std::uint32_t c, const Point3<S>& p) {
      if (measures_[c] != measure) return;
      sum[c] = detail::plus(sum[c], shift == 0 ? p : detail::times_power_of_two(p, -shift));
      ++count[c];
    });
    bool finite = true;
    for (std::size_t c = 0; c < centres_.size(); ++c) {
      if (measures_[c] != measure) continue;
      centres_[c] = detail::times(S(1) / S(count[c]), sum[c]);
      if (shift != 0) centres_[c] = detail::times_power_of_two(centres_[c], shift);
      finite = finite && detail::is_finite(centres_[c].x) && detail::is_finite(centres_[c].y) && detail::is_finite(centres_[c].z);
    }
    if (finite) return;
  }
}

/// Each vertex once: by the first of its half-edges.
template <class S>
void SizeKeeper<S>::centre_open_components(const MidedgeLevel<S>& level) {
  const std::vector<std::uint32_t> first = detail::first_half_edges(level.map).of_vertex;
  centre(SizeMeasure::area, [&](const auto& add) {
    for (std::size_t v = 0; v < first.size(); ++v) add(component(level.map.facet(first[v])), level.points[v]);
  });
}

template <class S>
void SizeKeeper<S>::step(const MidedgeMap& before, const MidedgeMap& after) {
  component_ = detail::refined_names(before, after, detail::first_half_edges(before), component_);
}

/// For each component the power of two that its coordinates relative to its centre stay below.
template <class S>
std::vector<int> SizeKeeper<S>::exponents(const MidedgeLevel<S>& level) const {
  const std::vector<std::uint32_t> first = detail::first_half_edges(level.map).of_vertex;
  std::vector<int> result(centres_.size(), detail::kLeastExponent);
  for (std::size_t v = 0; v < first.size(); ++v) {
    const std::uint32_t c = component(level.map.facet(first[v]));
    const Point3<S> p = detail::minus(level.points[v], centres_[c]);
    result[c] = std::max({result[c], detail::binary_exponent(p.x), detail::binary_exponent(p.y), detail::binary_exponent(p.z)});
  }
  std::replace(result.begin(), result.end(), detail::kLeastExponent, 0);
  return result;
}

/// Relative to the centre of each component, so that a distant one loses no digits.
template <class S>
std::vector<ComponentSize> SizeKeeper<S>::sizes(const MidedgeLevel<S>& level) const {
  const std::vector<int> exponent = exponents(level);
  std::vector<ComponentSize> result(centres_.size());
  for (std::size_t c = 0; c < result.size(); ++c) result[c].exponent = exponent[c];
  std::vector<Point3<double>> polygon;
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    const std::uint32_t c = component(f);
    polygon.clear();
    for (const std::uint32_t v : level.map.loop(f)) {
      const Point3<S> p = detail::minus(level.points[v], centres_[c]);
      polygon.push_back({detail::as_double(p.x, exponent[c]), detail::as_double(p.y, exponent[c]), detail::as_double(p.z, exponent[c])});
    }
    result[c].value += measures_[c] == SizeMeasure::volume ? detail::fanned_volume(polygon) : detail::fanned_area(polygon);
  }
  for (std::size_t c = 0; c < result.size(); ++c) {
    if (result[c].value > 0 && std::isfinite(result[c].value)) continue;
    std::uint32_t f = 0;
    while (component(f) != c) ++f;
    if (!std::isfinite(result[c].value)) {
      throw NumericalFailure("the size of the component of " + facet_name(f) + " cannot be kept: its coordinates are too large for doubles");
    }
    if (measures_[c] == SizeMeasure::area) throw InvalidInput("NoArea", "its component has no area that could be kept", facet_name(f));
    throw InvalidInput("NoVolume", "its component encloses no positive volume that could be kept", facet_name(f));
  }
  return result;
}

template <class S>
void SizeKeeper<S>::fit(const MidedgeLevel<S>& level) {
  centre_open_components(level);
  const std::vector<ComponentSize> now = sizes(level);
  for (std::size_t c = 0; c < now.size(); ++c) {
    const double ratio = sizes_[c].value / now[c].value;
    const double root = measures_[c] == SizeMeasure::volume ? std::cbrt(ratio) : std::sqrt(ratio);
    factors_[c] = std::ldexp(root, sizes_[c].exponent - now[c].exponent);
    if (std::isnormal(factors_[c])) continue;
    throw NumericalFailure("the factor that keeps the size of component " + std::to_string(c) + " is too large or too small for a double");
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
