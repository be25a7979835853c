// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/midedge_attributes.hpp"

#include "hexact/kernel/midedge_attributes_impl.hpp"

namespace hexact {

template MeshAttributes<double> refined_attributes(const MidedgeMap&, const MidedgeMap&, const MeshAttributes<double>&, MidedgeRule);
template CornerValues<double> welded(const CornerValues<double>&);

}  // namespace hexact
