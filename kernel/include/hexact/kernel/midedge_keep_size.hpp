// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/mesh_attributes.hpp"
#include "hexact/kernel/midedge.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hexact {

/// What a component keeps.
enum class SizeMeasure : std::uint8_t {
  volume,  ///< of a closed component
  area,    ///< of one with a boundary
};

/// A volume or an area: value · 2^(3 · exponent) or value · 2^(2 · exponent). Lengths are measured in units of 2^exponent,
/// about the extent of the component, so that no product of them overflows or vanishes.
struct ComponentSize {
  double value = 0;
  int exponent = 0;
};

/// Scales levels so that they keep the size of the input, component by component.
///
/// Midedge meshes shrink. A component of level n is scaled by one factor about one point:
/// - closed: ∛(volume of the input / volume of level n), about the mean of the vertices, each counted as often as it has
///   edges, which stays where it is for ever while the surface draws together around it;
/// - open: √(area of the input / area of level n), about the mean of the points of level n, which thus stays where level n
///   has it (open meshes have no mean that all levels share).
/// Steps commute with it, as with every affine map: a scaled level is the same level of the scaled input, so nothing else
/// changes. Volumes and areas are those of facets fanned from their mean corner, one surface for both measures, in floating
/// point; the factor is a double, and over exact numbers it is applied exactly.
template <class S>
class SizeKeeper {
 public:
  /// Throws InvalidInput: NoVolume, NoArea (first facet of a closed component that does not enclose a positive volume, of an
  /// open one without area); NumericalFailure where coordinates are not finite.
  explicit SizeKeeper(const MidedgeLevel<S>& input);

  /// Follows one step from level `before` to level `after`.
  void step(const MidedgeMap& before, const MidedgeMap& after);
  /// Takes the factors of the level that was reached. Throws InvalidInput (NoVolume, NoArea), NumericalFailure (also
  /// where a factor is too large or too small for a double).
  void fit(const MidedgeLevel<S>& level);
  /// The factor of each component.
  [[nodiscard]] std::span<const double> factors() const noexcept { return factors_; }
  /// What each component keeps.
  [[nodiscard]] std::span<const SizeMeasure> measures() const noexcept { return measures_; }
  /// Component of facet f of the level that was reached.
  [[nodiscard]] std::uint32_t component(std::uint32_t f) const { return component_.of_facet[f]; }
  /// Where a point of a component goes.
  [[nodiscard]] Point3<S> scaled(const Point3<S>& p, std::uint32_t component) const;
  /// The points of the level that was reached, scaled.
  [[nodiscard]] PointArray<S> scaled(const MidedgeLevel<S>& level) const;

 private:
  void centre_open_components(const MidedgeLevel<S>& level);
  template <class Visit>
  void centre(SizeMeasure measure, const Visit& visit);
  [[nodiscard]] std::vector<int> exponents(const MidedgeLevel<S>& level) const;
  [[nodiscard]] std::vector<ComponentSize> sizes(const MidedgeLevel<S>& level) const;

  FacetNames component_;
  std::vector<SizeMeasure> measures_;
  std::vector<Point3<S>> centres_;
  std::vector<ComponentSize> sizes_;
  std::vector<double> factors_;
};

extern template class SizeKeeper<double>;

}  // namespace hexact
