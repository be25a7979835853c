// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/midedge.hpp"

#include "hexact/kernel/midedge_attributes_impl.hpp"
#include "hexact/kernel/midedge_impl.hpp"

namespace hexact {

template PointArray<Rational> edge_points<Rational>(const MidedgeMap&, std::span<const Point3<Rational>>, MidedgeRule);
template PointArray<Rational> corner_points<Rational>(const MidedgeMap&, std::span<const Point3<Rational>>, MidedgeRule);
template MidedgeLevel<Rational> midedge_step(const MidedgeLevel<Rational>&, MidedgeRule, MidedgeBoundary);
template MidedgeLevel<Rational> midedge_double_step(const MidedgeLevel<Rational>&, MidedgeRule);
template MeshAttributes<Rational> refined_attributes(const MidedgeMap&, const MidedgeMap&, const MeshAttributes<Rational>&, MidedgeRule);
template CornerValues<Rational> welded(const CornerValues<Rational>&);

}  // namespace hexact
