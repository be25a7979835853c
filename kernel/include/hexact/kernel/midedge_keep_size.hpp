// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/mesh_attributes.hpp"
#include "hexact/kernel/midedge.hpp"

#include <span>
#include <vector>

namespace hexact {

/// Scales levels so that they keep the volume that the input encloses, component by component.
///
/// Midedge meshes shrink: the mean of the vertices, each counted as often as it has edges, stays where it is for ever,
/// and the surface draws together around it. Level n is scaled about that mean, for each component by one factor
/// ∛(volume of the input / volume of level n). Steps commute with it, as with every affine map: a scaled level is the
/// same level of the scaled input, so nothing else changes. Volumes are those of facets fanned from their mean corner,
/// in floating point; the factor is a double, and over exact numbers it is applied exactly.
template <class S>
class SizeKeeper {
 public:
  /// Throws InvalidInput: HasBoundary (edge), NoVolume (first facet of a component that does not enclose a positive volume).
  explicit SizeKeeper(const MidedgeLevel<S>& input);

  /// Follows one step from level `before` to level `after`.
  void step(const MidedgeMap& before, const MidedgeMap& after);
  /// Takes the factors of the level that was reached. Throws InvalidInput (NoVolume).
  void fit(const MidedgeLevel<S>& level);
  /// The factor of each component.
  [[nodiscard]] std::span<const double> factors() const noexcept { return factors_; }
  /// Component of facet f of the level that was reached.
  [[nodiscard]] std::uint32_t component(std::uint32_t f) const { return component_.of_facet[f]; }
  /// Where a point of a component goes.
  [[nodiscard]] Point3<S> scaled(const Point3<S>& p, std::uint32_t component) const;
  /// The points of the level that was reached, scaled.
  [[nodiscard]] PointArray<S> scaled(const MidedgeLevel<S>& level) const;

 private:
  [[nodiscard]] std::vector<double> volumes(const MidedgeLevel<S>& level) const;

  FacetNames component_;
  std::vector<Point3<S>> centres_;
  std::vector<double> volumes_, factors_;
};

extern template class SizeKeeper<double>;

}  // namespace hexact
