// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/midedge.hpp"

#include "hexact/kernel/midedge_impl.hpp"

namespace hexact {

template PointArray<double> edge_points<double>(const MidedgeMap&, std::span<const Point3<double>>, MidedgeRule);
template PointArray<double> corner_points<double>(const MidedgeMap&, std::span<const Point3<double>>, MidedgeRule);
template MidedgeLevel<double> midedge_step(const MidedgeLevel<double>&, MidedgeRule, MidedgeBoundary);
template MidedgeLevel<double> midedge_double_step(const MidedgeLevel<double>&, MidedgeRule);

}  // namespace hexact
