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

inline double as_double(double x) { return x; }
inline double as_number(double x, const double*) { return x; }

}  // namespace hexact::detail

namespace hexact {

template <class S>
SizeKeeper<S>::SizeKeeper(const MidedgeLevel<S>& input) {
  const MidedgeMap& map = input.map;
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    if (map.twin(h) != kNoTwin) continue;
    throw InvalidInput("HasBoundary", "has a facet on one side only: an open mesh encloses no volume to be kept",
                       edge_name(map.origin(h), map.target(h)));
  }
  std::uint32_t count = 0;
  component_.of_facet = detail::component_of_facets(map, count);
  centres_.resize(count);
  std::vector<int> corners(count, 0);
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const std::uint32_t c = component(map.facet(h));
    centres_[c] = detail::plus(centres_[c], input.points[map.origin(h)]);
    ++corners[c];
  }
  for (std::uint32_t c = 0; c < count; ++c) centres_[c] = detail::times(S(1) / S(corners[c]), centres_[c]);
  volumes_ = volumes(input);
  factors_.assign(count, 1);
}

template <class S>
void SizeKeeper<S>::step(const MidedgeMap& before, const MidedgeMap& after) {
  component_ = detail::refined_names(before, after, detail::first_half_edges(before), component_);
}

/// Relative to the centre of each component, so that a distant one loses no digits.
template <class S>
std::vector<double> SizeKeeper<S>::volumes(const MidedgeLevel<S>& level) const {
  using detail::as_double;
  using Vector = Point3<double>;
  std::vector<double> sum(centres_.size(), 0);
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    const auto loop = level.map.loop(f);
    const auto corner = [&](std::size_t i) {
      const Point3<S> p = detail::minus(level.points[loop[i % loop.size()]], centres_[component(f)]);
      return Vector{as_double(p.x), as_double(p.y), as_double(p.z)};
    };
    Vector p = corner(0), centre{0, 0, 0}, area{0, 0, 0};
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector q = corner(i + 1);
      centre = detail::plus(centre, p);
      area = detail::plus(area, Vector{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x});
      p = q;
    }
    sum[component(f)] += (centre.x * area.x + centre.y * area.y + centre.z * area.z) / static_cast<double>(loop.size());
  }
  for (std::size_t c = 0; c < sum.size(); ++c) {
    sum[c] /= 6;
    if (sum[c] > 0 && std::isfinite(sum[c])) continue;
    std::uint32_t f = 0;
    while (component(f) != c) ++f;
    throw InvalidInput("NoVolume", "its component encloses no positive volume that could be kept", facet_name(f));
  }
  return sum;
}

template <class S>
void SizeKeeper<S>::fit(const MidedgeLevel<S>& level) {
  const std::vector<double> now = volumes(level);
  for (std::size_t c = 0; c < now.size(); ++c) factors_[c] = std::cbrt(volumes_[c] / now[c]);
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
