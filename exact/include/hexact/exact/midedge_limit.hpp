// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/midedge.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hexact {

/// A direction that is proven to be near the exact one.
struct NormalEnclosure {
  Point3<double> unit;                     ///< of about unit length, outward for facets counter-clockwise from outside
  double bound = 0;                        ///< upper bound, rounded up, of the distance to the exact unit normal
  std::optional<Point3<Rational>> exact;   ///< a multiple of the exact normal, where it is rational (facets of 4 corners)
};

/// Where the centre of a facet goes.
struct MidedgeLimit {
  Point3<Rational> point;
  std::optional<NormalEnclosure> normal;  ///< none where the tangent plane is degenerate or not known
};

/// The vertices around facet f that a limit needs, in sectors of 3 × 3: entry 9s + 3i + j is the vertex i steps along
/// axis s and j along axis s + 1 from corner s. Empty unless two rings of quadrilaterals surround the facet whose vertices,
/// but for the outermost, have valence 4.
[[nodiscard]] std::vector<std::uint32_t> midedge_net(const MidedgeMap& map, std::uint32_t f);

/// Weight of the vertices (s, i, j) of all sectors together in the limit of the centre, over 243712: the left eigenvector
/// of the two-step operator for the eigenvalue 1. It does not depend on the size of the facet.
[[nodiscard]] const std::array<std::array<int, 3>, 3>& midedge_centre_weights();

/// Limit points and normals of facet centres.
///
/// Six-point rule: with two rings of quadrilaterals around a k-gon the limit of its centre is Σ w_ij · mean over
/// sectors of P(s, i, j). The tangent plane is spanned by the real and imaginary part of Σ_s ω^-s Σ_ij l_ij P(s, i, j),
/// ω = e^(2πi/k), where l is the left eigenvector of the mode ω of the two-step operator for the eigenvalue λ, the
/// largest of that mode. The operator is taken from the steps themselves; λ and l are enclosed in intervals of 320 bits:
/// λ between two numbers at which the determinant has opposite signs, l by elimination over intervals. For k = 4, λ = 1/2
/// and all is rational. That λ is the subdominant eigenvalue of the whole operator is what `spectrum` proves.
///
/// Simple rule: the mean of the corners stays for ever and is the limit; the tangent plane is that of Σ_s ω^-s P(s).
/// For k = 3 its eigenvalue 1/4 is shared with other modes and there is no normal, nor is there one for facets with a
/// boundary vertex.
///
/// Facets of more than 512 corners get no normal.
class MidedgeLimits {
 public:
  explicit MidedgeLimits(MidedgeRule rule);
  MidedgeLimits(MidedgeLimits&&) noexcept;
  ~MidedgeLimits();

  /// Prepares facets of k corners; needed once for each size; 0.1 s for small ones. Precondition: k >= 3.
  void prepare(std::uint32_t k);
  /// The limit of the centre of facet f, or nothing where the rule needs two rings of quadrilaterals and there are none.
  /// Precondition: the size of f has been prepared. May be called from several threads.
  [[nodiscard]] std::optional<MidedgeLimit> operator()(const MidedgeLevel<Rational>& level, std::uint32_t f) const;
  /// An enclosure of λ for k-gons: a number and the distance within which λ is. Precondition: prepared.
  [[nodiscard]] std::pair<Rational, Rational> eigenvalue(std::uint32_t k) const;

 private:
  struct Tangent;
  MidedgeRule rule_;
  std::map<std::uint32_t, std::unique_ptr<const Tangent>> tangents_;
};

}  // namespace hexact
