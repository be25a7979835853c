// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"
#include "hexact/kernel/midedge.hpp"
#include "hexact/kernel/midedge_attributes.hpp"
#include "hexact/kernel/midedge_keep_size.hpp"

namespace hexact {

// Midedge steps in exact arithmetic, see hexact/kernel/midedge.hpp and midedge_attributes.hpp.
extern template PointArray<Rational> edge_points<Rational>(const MidedgeMap&, std::span<const Point3<Rational>>, MidedgeRule);
extern template PointArray<Rational> corner_points<Rational>(const MidedgeMap&, std::span<const Point3<Rational>>, MidedgeRule);
extern template MidedgeLevel<Rational> midedge_step(const MidedgeLevel<Rational>&, MidedgeRule, MidedgeBoundary);
extern template MidedgeLevel<Rational> midedge_double_step(const MidedgeLevel<Rational>&, MidedgeRule);
extern template MeshAttributes<Rational> refined_attributes(const MidedgeMap&, const MidedgeMap&, const MeshAttributes<Rational>&, MidedgeRule);
extern template CornerValues<Rational> welded(const CornerValues<Rational>&);
extern template class SizeKeeper<Rational>;

}  // namespace hexact
