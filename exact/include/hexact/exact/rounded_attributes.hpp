// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/mesh_attributes.hpp"

namespace hexact {

/// The same attributes with every number rounded to the nearest double. Throws ResourceLimit beyond the finite doubles.
[[nodiscard]] MeshAttributes<double> rounded_attributes(const MeshAttributes<Rational>& attributes);
[[nodiscard]] MeshAttributes<double> rounded_attributes(const MeshAttributes<QuadraticField>& attributes);
[[nodiscard]] inline const MeshAttributes<double>& rounded_attributes(const MeshAttributes<double>& attributes) noexcept { return attributes; }

}  // namespace hexact
