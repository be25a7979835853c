// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <vector>

// One representative for each half-space (coprime integers), and half-spaces moved between the coordinates of a
// body and those of its file.
namespace hexact::detail {

/// The same half-space with coprime integers.
[[nodiscard]] Plane<Integer> primitive(const Plane<Integer>& plane);
[[nodiscard]] Plane<Integer> primitive(const Plane<Rational>& plane);
/// The same half-space with coefficients p + q√5 whose eight integers p, q are coprime.
[[nodiscard]] Plane<QuadraticField> primitive(const Plane<QuadraticField>& plane);

/// The exponent E (file = 2^E · here) that makes planes with coprime integers shortest: negative where offsets have
/// dyadic fractions, positive only where offsets share a power of two and some are long, otherwise 0.
[[nodiscard]] long shortening_scale(const std::vector<Plane<Integer>>& file_planes);
/// The half-space of file coordinates in coordinates where file = 2^scale · here, with coprime integers.
[[nodiscard]] Plane<Integer> scaled_plane(const Plane<Integer>& file_plane, long scale);

/// Plane f of a body over Q in file coordinates (scale and shift applied).
[[nodiscard]] Plane<Rational> file_plane(const PlaneBody& body, std::size_t f);
/// Plane f of a body over Q(√5) in file coordinates.
[[nodiscard]] Plane<QuadraticField> file_plane_sqrt5(const PlaneBody& body, std::size_t f);

/// The point of three planes. Throws InvalidInput (DegenerateVertex) naming `vertex` when normals are dependent.
[[nodiscard]] Point3<Rational> meet_planes(const Plane<Rational>& p, const Plane<Rational>& q, const Plane<Rational>& r,
                                           std::size_t vertex);
[[nodiscard]] Point3<QuadraticField> meet_planes(const Plane<QuadraticField>& p, const Plane<QuadraticField>& q,
                                                 const Plane<QuadraticField>& r, std::size_t vertex);
/// Vertex v of a body in file coordinates.
[[nodiscard]] Point3<Rational> meet_in_file_coordinates(const PlaneBody& body, VertexId v);
[[nodiscard]] Point3<QuadraticField> meet_in_file_coordinates_sqrt5(const PlaneBody& body, VertexId v);

}  // namespace hexact::detail
