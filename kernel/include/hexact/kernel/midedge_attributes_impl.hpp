// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

// Bodies of midedge_attributes.hpp, for the explicit instantiations in `kernel` and `exact` only.

#include "hexact/kernel/midedge_attributes.hpp"
#include "hexact/kernel/midedge_impl.hpp"

#include <algorithm>
#include <numeric>

namespace hexact::detail {

/// For each vertex and each edge the half-edge with the smallest number there.
struct FirstHalfEdges {
  std::vector<std::uint32_t> of_vertex, of_edge;
};

inline FirstHalfEdges first_half_edges(const MidedgeMap& map) {
  FirstHalfEdges first;
  first.of_vertex.assign(map.vertex_count(), kNoTwin);
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    std::uint32_t& v = first.of_vertex[map.origin(h)];
    v = std::min(v, h);
    if (map.twin(h) > h) first.of_edge.push_back(h);
  }
  return first;
}

/// The half-edge before the step whose facet a new facet follows.
inline std::uint32_t leading_half_edge(const MidedgeMap& before, const FirstHalfEdges& first, const FacetAddress& address) {
  const auto parent = static_cast<std::uint32_t>(*address.parent);
  return address.level == before.level() + 1 ? first.of_vertex[parent] : first.of_edge[parent];
}

inline FacetNames refined_names(const MidedgeMap& before, const MidedgeMap& after, const FirstHalfEdges& first, const FacetNames& names) {
  if (names.empty()) return {};
  FacetNames result = names;
  for (auto f = static_cast<std::uint32_t>(before.facet_count()); f < after.facet_count(); ++f) {
    result.of_facet.push_back(names.of_facet[before.facet(leading_half_edge(before, first, after.address(f)))]);
  }
  return result;
}

/// Texture coordinates of one step.
template <class S>
class TextureStep {
 public:
  TextureStep(const MidedgeMap& before, const MidedgeMap& after, const CornerValues<S>& old, MidedgeRule rule)
      : before_(before), after_(after), old_(old), rule_(rule), first_(first_half_edges(before)) {}

  CornerValues<S> run() {
    make_sides();
    make_pieces();
    const bool doubled = after_.level() == before_.level() + 2;
    if (doubled) make_corners();
    const std::vector<std::uint32_t>& kept = doubled ? corner_ : side_;
    result_.of_corner.resize(after_.half_edge_count(), kNothing);
    std::copy(kept.begin(), kept.end(), result_.of_corner.begin());
    for (auto f = static_cast<std::uint32_t>(before_.facet_count()); f < after_.facet_count(); ++f) {
      const FacetAddress address = after_.address(f);
      const std::uint32_t lead = leading_half_edge(before_, first_, address);
      if (old_.of_corner[lead] == kNothing) continue;
      if (!doubled) {
        place_vertex_facet(f, lead);
      } else if (address.level == before_.level() + 1) {
        place_inner_vertex_facet(f, lead);
      } else {
        place_edge_facet(f, lead);
      }
    }
    drop_unused();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::uint32_t at(std::uint32_t h) const { return old_.of_corner[h]; }
  std::uint32_t add(Point3<S> value) {
    result_.values.push_back(std::move(value));
    return static_cast<std::uint32_t>(result_.values.size() - 1);
  }
  /// Both facets have the same values along the edge of h.
  [[nodiscard]] bool smooth(std::uint32_t h) const {
    const std::uint32_t t = before_.twin(h);
    return t != kNoTwin && at(h) != kNothing && at(h) == at(before_.next(t)) && at(before_.next(h)) == at(t);
  }
  [[nodiscard]] Point3<S> middle_of(std::uint32_t h) const {
    return middle(old_.values[at(h)], old_.values[at(before_.next(h))]);
  }

  /// The value on the edge of every half-edge, as its facet has it.
  void make_sides() {
    const std::size_t count = before_.half_edge_count();
    std::vector<Point3<S>> shares(rule_ == MidedgeRule::six_point ? count : 0);
    for (std::uint32_t f = 0; f < before_.facet_count() && !shares.empty(); ++f) {
      const std::uint32_t start = before_.facet_start(f);
      if (at(start) == kNothing) continue;
      polygon_shares<S>(
          before_.facet_size(f), [&](std::uint32_t j) -> const Point3<S>& { return old_.values[at(start + j)]; },
          [&](std::uint32_t j, const Point3<S>& share) { shares[start + j] = share; });
    }
    side_.assign(count, kNothing);
    for (std::uint32_t h = 0; h < count; ++h) {
      if (at(h) == kNothing || side_[h] != kNothing) continue;
      if (!smooth(h)) {
        side_[h] = add(middle_of(h));
        continue;
      }
      const std::uint32_t t = before_.twin(h);
      side_[h] = side_[t] = add(rule_ == MidedgeRule::simple ? middle_of(h) : plus(shares[h], shares[t]));
    }
  }

  /// Which corners lie in the piece of the leading facet at their vertex: those reached over smooth edges. Equal values
  /// are not enough: maps of different pieces may lie on top of each other.
  void make_pieces() {
    in_piece_.assign(before_.half_edge_count(), 0);
    for (const std::uint32_t lead : first_.of_vertex) {
      std::uint32_t h = lead;
      in_piece_[h] = 1;
      while (smooth(before_.previous(h))) {
        h = before_.twin(before_.previous(h));
        if (h == lead) break;
        in_piece_[h] = 1;
      }
      for (h = lead; smooth(h);) {
        h = before_.next(before_.twin(h));
        if (in_piece_[h] != 0) break;
        in_piece_[h] = 1;
      }
    }
  }

  /// All facets around the inner vertex at which h begins go on smoothly.
  [[nodiscard]] bool smooth_vertex(std::uint32_t first) const {
    for (std::uint32_t h = first;;) {
      if (!smooth(h)) return false;
      h = before_.twin(before_.previous(h));
      if (h == kNoTwin || h == first) return h == first;
    }
  }

  /// The value in the corner of every half-edge after a double step.
  void make_corners() {
    corner_.assign(before_.half_edge_count(), kNothing);
    std::vector<Point3<S>> value(before_.half_edge_count());
    std::vector<char> six(before_.half_edge_count(), 0);
    if (rule_ == MidedgeRule::six_point) add_shares(value, six);
    for (std::uint32_t h = 0; h < corner_.size(); ++h) {
      if (at(h) == kNothing) continue;
      corner_[h] = add(six[h] != 0 ? value[h] : middle(result_.values[side_[before_.previous(h)]], result_.values[side_[h]]));
    }
  }

  void add_shares(std::vector<Point3<S>>& value, std::vector<char>& six) const {
    std::vector<std::uint32_t> fan;
    const auto side_value = [&](std::uint32_t h) -> const Point3<S>& { return result_.values[side_[h]]; };
    for (const std::uint32_t first : first_.of_vertex) {
      if (!smooth_vertex(first)) continue;
      collect_fan(before_, first, fan);
      polygon_shares<S>(
          static_cast<std::uint32_t>(fan.size()), [&](std::uint32_t j) -> const Point3<S>& { return side_value(fan[j]); },
          [&](std::uint32_t j, const Point3<S>& share) {
            value[fan[j]] = share;
            six[fan[j]] = 1;
          });
    }
    for (std::uint32_t f = 0; f < before_.facet_count(); ++f) {
      const std::uint32_t start = before_.facet_start(f);
      if (at(start) == kNothing) continue;
      polygon_shares<S>(
          before_.facet_size(f), [&](std::uint32_t j) -> const Point3<S>& { return side_value(start + j); },
          [&](std::uint32_t j, const Point3<S>& share) {
            const std::uint32_t h = before_.next(start + j);
            value[h] = plus(value[h], share);
          });
    }
  }

  /// Facet f of a single step cuts off the vertex at which `lead` begins.
  void place_vertex_facet(std::uint32_t f, std::uint32_t lead) {
    const std::uint32_t start = after_.facet_start(f);
    std::uint32_t vertex = kNothing, last = lead;
    for (std::uint32_t x = start; x < start + after_.facet_size(f); ++x) {
      std::uint32_t& out = result_.of_corner[x];
      if (after_.twin(x) == kNoTwin) {  // the last boundary edge, which ends at the vertex
        out = in_piece_[last] != 0 ? side_[before_.previous(last)] : kNothing;
      } else {
        const std::uint32_t h = before_.next(after_.twin(x));  // leaves the vertex along the edge
        const std::uint32_t t = before_.twin(h);
        if (in_piece_[h] != 0) {
          out = side_[h];
        } else if (t != kNoTwin && in_piece_[before_.next(t)] != 0) {
          out = side_[t];
        }
        last = h;
      }
      if (out == kNothing) out = vertex = vertex == kNothing ? add(old_.values[at(lead)]) : vertex;
    }
  }

  /// Facet f of a double step has a corner in each facet around the vertex.
  void place_inner_vertex_facet(std::uint32_t f, std::uint32_t lead) {
    const std::uint32_t start = after_.facet_start(f);
    std::uint32_t vertex = kNothing;
    for (std::uint32_t x = start; x < start + after_.facet_size(f); ++x) {
      const std::uint32_t h = after_.origin(x);
      std::uint32_t& out = result_.of_corner[x];
      if (in_piece_[h] != 0) {
        out = corner_[h];
      } else {
        out = vertex = vertex == kNothing ? add(old_.values[at(lead)]) : vertex;
      }
    }
  }

  /// Facet f of a double step lies along the edge of `lead`.
  void place_edge_facet(std::uint32_t f, std::uint32_t lead) {
    const std::uint32_t start = after_.facet_start(f);
    const bool on = smooth(lead);
    for (std::uint32_t x = start; x < start + 4; ++x) {
      const std::uint32_t h = after_.origin(x);
      if (on || before_.facet(h) == before_.facet(lead)) {
        result_.of_corner[x] = corner_[h];
      } else {
        const std::uint32_t end = before_.origin(h) == before_.origin(lead) ? lead : before_.next(lead);
        result_.of_corner[x] = add(middle(middle_of(lead), old_.values[at(end)]));
      }
    }
  }

  /// Leaves out the values of edges that a double step has used up.
  void drop_unused() {
    std::vector<std::uint32_t> number(result_.values.size(), kNothing);
    std::vector<Point3<S>> used;
    for (std::uint32_t& i : result_.of_corner) {
      if (i == kNothing) continue;
      if (number[i] == kNothing) {
        number[i] = static_cast<std::uint32_t>(used.size());
        used.push_back(std::move(result_.values[i]));
      }
      i = number[i];
    }
    result_.values = std::move(used);
  }

  const MidedgeMap &before_, &after_;
  const CornerValues<S>& old_;
  MidedgeRule rule_;
  FirstHalfEdges first_;
  std::vector<std::uint32_t> side_, corner_;
  std::vector<char> in_piece_;
  CornerValues<S> result_;
};

}  // namespace hexact::detail

namespace hexact {

template <class S>
MeshAttributes<S> refined_attributes(const MidedgeMap& before, const MidedgeMap& after, const MeshAttributes<S>& attributes,
                                     MidedgeRule rule) {
  MeshAttributes<S> result;
  result.texture_size = attributes.texture_size;
  result.material_libraries = attributes.material_libraries;
  if (attributes.empty()) return result;
  const detail::FirstHalfEdges first = detail::first_half_edges(before);
  result.groups = detail::refined_names(before, after, first, attributes.groups);
  result.materials = detail::refined_names(before, after, first, attributes.materials);
  if (!attributes.texture.empty()) result.texture = detail::TextureStep<S>(before, after, attributes.texture, rule).run();
  return result;
}

template <class S>
CornerValues<S> welded(const CornerValues<S>& corners) {
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const Point3<S> &p = corners.values[i], &q = corners.values[j];
    if (p.x != q.x) return p.x < q.x;
    return p.y != q.y ? p.y < q.y : p.z < q.z;
  };
  std::vector<std::uint32_t> order(corners.values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), less);
  CornerValues<S> result = corners;
  std::vector<std::uint32_t> same(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    same[order[i]] = i > 0 && !less(order[i - 1], order[i]) ? same[order[i - 1]] : order[i];
  }
  for (std::uint32_t& i : result.of_corner) {
    if (i != kNothing) i = same[i];
  }
  return result;
}

}  // namespace hexact
