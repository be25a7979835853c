// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

// Half-spaces for OpenSCAD without rounding. OpenSCAD computes exactly on what it is given, but is given doubles,
// so a plane must pass through points that doubles can hold. Each half-space becomes a parallelepiped with eight
// lattice corners and one face exactly in the plane.
namespace hexact::validation {

using LatticePoint = std::array<Integer, 3>;

/// n·x <= d with n primitive (coprime coefficients).
struct LatticePlane {
  LatticePoint n;
  Integer d;
};

/// A basis of the lattice {x ∈ Z³ : n·x = 0} with u the shortest vector, and a point with n·p = d near the origin.
struct LatticeFrame {
  LatticePoint p, u, w;
};
/// Extended Euclid, then Gauss reduction. Precondition: n primitive.
[[nodiscard]] LatticeFrame lattice_frame(const LatticePlane& plane);

/// Which side of a plane a piece fills.
enum class Side { inside, outside };

/// Corners: 0-3 in the plane, around; 4-7 the same moved off the plane.
struct Slab {
  std::array<LatticePoint, 8> corners;
  bool outward = true;  ///< corners 0, 1, 2, 3 turn counter-clockwise seen from outside the slab
};
/// The parallelepiped on one side of the plane that covers that part of the box [low, high].
[[nodiscard]] Slab half_space_slab(const LatticePlane& plane, Side side, const LatticePoint& low, const LatticePoint& high);

/// A body in coordinates where every half-space is a LatticePlane: file coordinate = unit · lattice + a translation.
struct ScadModel {
  std::vector<LatticePlane> planes;         ///< in the order of the body
  std::vector<Point3<Rational>> vertices;   ///< exact, in lattice coordinates
  FacetLoops loops;
  Rational unit;                            ///< file units per lattice unit
  LatticePoint low, high;                   ///< integer box with all vertices in its interior
  int fraction_bits = 0;                    ///< coordinate in the program = lattice / 2^fraction_bits
  std::size_t corner_bits = 0;              ///< bits of the largest lattice coordinate of any corner

  /// Can OpenSCAD 2021.01 hold all corners? It returns an empty object, silently, for coordinates beyond 2^42 and
  /// keeps 20 binary digits after the point; doubles have 53 bits.
  [[nodiscard]] bool representable() const noexcept;
};

/// Scales the body by the smallest factor that makes every offset an integer, moves its centre near the origin and
/// enlarges small bodies so that 6 written digits are finer than OpenSCAD's grid.
/// Throws InvalidInput: FieldNotRational, DegeneratePlane, DegenerateVertex, NotConvex (vertex, plane, exact excess).
[[nodiscard]] ScadModel scad_model(const PlaneBody& body);

/// Which Boolean operations OpenSCAD builds the solid with.
enum class Route {
  intersection,  ///< of all half-spaces
  hull,          ///< of the vertices, rounded to doubles
  difference,    ///< a box minus the outer side of every plane
};
[[nodiscard]] const char* name_of(Route route) noexcept;

/// The program, complete, with a comment that says how to undo the scale.
/// Precondition for intersection and difference to be exact: model.representable().
[[nodiscard]] std::string scad_program(const ScadModel& model, Route route);

/// The CSG corner-cutting program of a body: scad_program(scad_model(body), Route::intersection).
/// Throws as scad_model, and ResourceLimit when a corner is beyond what OpenSCAD can hold.
[[nodiscard]] std::string corner_cutting_program(const PlaneBody& body);

}  // namespace hexact::validation
