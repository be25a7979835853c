// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/rounded_attributes.hpp"

#include "hexact/kernel/errors.hpp"

#include <cmath>

namespace hexact {
namespace {

template <class S>
MeshAttributes<double> rounded(const MeshAttributes<S>& attributes) {
  const auto nearest = [](const S& x) {
    const double value = x.to_double();
    if (!std::isfinite(value)) throw ResourceLimit("a texture coordinate is beyond the range of double");
    return value;
  };
  MeshAttributes<double> result;
  result.texture_size = attributes.texture_size;
  result.groups = attributes.groups;
  result.materials = attributes.materials;
  result.material_libraries = attributes.material_libraries;
  result.texture.of_corner = attributes.texture.of_corner;
  result.texture.values.reserve(attributes.texture.values.size());
  for (const auto& p : attributes.texture.values) result.texture.values.push_back({nearest(p.x), nearest(p.y), nearest(p.z)});
  return result;
}

}  // namespace

MeshAttributes<double> rounded_attributes(const MeshAttributes<Rational>& attributes) { return rounded(attributes); }
MeshAttributes<double> rounded_attributes(const MeshAttributes<QuadraticField>& attributes) { return rounded(attributes); }

}  // namespace hexact
