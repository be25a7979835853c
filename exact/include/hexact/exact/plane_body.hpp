// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/integer.hpp"
#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/facet_loops.hpp"
#include "hexact/kernel/ids.hpp"
#include "hexact/kernel/polygon_soup.hpp"
#include "hexact/kernel/raw_vector.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace hexact {

class ProgressPart;

/// The half-space a·x + b·y + c·z <= d; (a, b, c) points outward and need not have unit length.
template <class S>
struct Plane {
  S a{}, b{}, c{}, d{};
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// Half-spaces with integer coefficients: 32 bytes each while all four fit 63 bits, and big integers for the rest.
class IntegerPlanes {
 public:
  using Narrow = std::array<std::int64_t, 4>;

  void reserve(std::size_t n) { narrow_.reserve(n); }
  void push_back(const Narrow& plane) { narrow_.push_back(plane); }
  /// Stored narrow when the coefficients fit, wide otherwise.
  void push_back(const Plane<Integer>& plane);
  [[nodiscard]] std::size_t size() const noexcept { return narrow_.size(); }
  [[nodiscard]] bool is_narrow(std::size_t i) const noexcept { return narrow_[i][3] != kWide; }
  /// Precondition: is_narrow(i).
  [[nodiscard]] const Narrow& narrow(std::size_t i) const noexcept { return narrow_[i]; }
  /// The words behind plane i; those of a wide plane mean nothing, and the last one is the least of all integers.
  [[nodiscard]] const Narrow& row(std::size_t i) const noexcept { return narrow_[i]; }
  /// Precondition: !is_narrow(i).
  [[nodiscard]] const Plane<Integer>& wide(std::size_t i) const noexcept {
    return wide_[static_cast<std::size_t>(narrow_[i][0])];
  }
  [[nodiscard]] Plane<Integer> operator[](std::size_t i) const;
  /// Number of planes kept as big integers.
  [[nodiscard]] std::size_t wide_count() const noexcept { return wide_.size(); }
  /// Makes room for n planes, each of which has to be written with `set` before it is read.
  void resize(std::size_t n) { narrow_.resize(n); }
  void set(std::size_t i, const Narrow& plane) noexcept { narrow_[i] = plane; }
  void set(std::size_t i, const Plane<Integer>& plane);

 private:
  static constexpr std::int64_t kWide = std::numeric_limits<std::int64_t>::min();
  RawVector<Narrow> narrow_;
  std::vector<Plane<Integer>> wide_;
};

/// Which numbers the planes of a body are made of.
enum class Field { rational, sqrt5 };

/// An exact polyhedron as a `.planes` file holds it: facet planes, loops and, by them, vertices.
/// file coordinate = 2^scale · coordinate here + shift.
struct PlaneBody {
  Field field = Field::rational;
  long scale = 0;
  std::array<Rational, 3> shift{};                   ///< dyadic, in file units
  IntegerPlanes planes;                              ///< of a body over Q
  std::vector<Plane<QuadraticField>> planes_sqrt5;   ///< of a body over Q(√5); `planes` is then empty
  std::vector<FacetAddress> addresses;               ///< one per plane
  FacetLoops loops;                                  ///< one per plane; empty: auxiliary plane without a facet
  std::vector<std::array<FacetId, 3>> triples;       ///< the defining planes of each vertex

  [[nodiscard]] std::size_t plane_count() const noexcept {
    return field == Field::rational ? planes.size() : planes_sqrt5.size();
  }
  [[nodiscard]] std::size_t vertex_count() const noexcept { return triples.size(); }
};

/// A claim that a certificate proves: `name` alone, or `name` about the body `reference`.
struct Claim {
  std::string name;       ///< e.g. "convex", "corner-cut-of"
  std::string reference;  ///< name of a body block; empty when the claim needs none
  friend bool operator==(const Claim&, const Claim&) = default;
};

/// A further body that claims refer to, with its name in the file.
struct NamedBody {
  std::string name;
  PlaneBody body;
};

/// Evidence that half-space `plane` of body `reference` holds on all of the solid: vertex `vertex` of the solid
/// satisfies it, and its normal is a non-negative combination of the normals of the facets there.
struct Support {
  std::string reference;
  std::size_t plane = 0;
  VertexId vertex{};
};

/// What a certificate file says.
struct Certificate {
  PlaneBody body;
  std::vector<Claim> claims;
  std::vector<NamedBody> bodies;
  std::vector<Support> supports;
  std::vector<std::string> provenance;  ///< comment lines, for information only
};

/// The exact vertex where the three defining planes meet, in file coordinates (scale and shift applied).
/// Throws InvalidInput (DegenerateVertex) when their normals are dependent.
[[nodiscard]] Point3<Rational> rational_vertex(const PlaneBody& body, VertexId v);
[[nodiscard]] Point3<QuadraticField> sqrt5_vertex(const PlaneBody& body, VertexId v);

/// Every vertex rounded to the nearest double or float32 (ties to even), in file coordinates.
struct RoundedVertices {
  std::vector<Point3<double>> points;
  double max_rounding = 0;  ///< upper bound, rounded up, of the Euclidean distance between exact and rounded
};
/// Throws ResourceLimit where a coordinate is beyond the finite numbers of the format, InvalidInput (DegenerateVertex).
/// Cost: linear; about 10 µs for each vertex that a floating-point filter cannot decide. In parallel; the
/// result does not depend on the number of threads.
[[nodiscard]] RoundedVertices rounded_vertices(const PlaneBody& body, FloatFormat format = FloatFormat::binary64);
[[nodiscard]] RoundedVertices rounded_vertices(const PlaneBody& body, FloatFormat format, const ProgressPart& progress);

}  // namespace hexact
