// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/validation/scad_model.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace hexact::validation {
namespace {

// Limits of OpenSCAD 2021.01: coordinates snap to multiples of 2^-20 held in 64 bits. Ten of these digits are left
// alone, so that no two corners are ever merged.
constexpr std::size_t kCoordinateBits = 42;
constexpr int kMaxFractionBits = 10;
// Bodies are enlarged to this size, so that OpenSCAD's grid is far below the 6th digit of what it writes.
constexpr std::size_t kBodyBits = 24;

Integer dot(const LatticePoint& u, const LatticePoint& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

LatticePoint cross(const LatticePoint& u, const LatticePoint& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// p + k·u
LatticePoint along(const LatticePoint& p, const Integer& k, const LatticePoint& u) {
  return {p[0] + k * u[0], p[1] + k * u[1], p[2] + k * u[2]};
}

/// The integer nearest to a / b, b != 0.
Integer nearest_quotient(const Integer& a, const Integer& b) { return floor_quotient(a + a + b, b + b); }

struct Bezout {
  Integer g, x, y;  ///< g = a·x + b·y
};
Bezout bezout(const Integer& a, const Integer& b) {
  Bezout r;
  mpz_gcdext(r.g.raw(), r.x.raw(), r.y.raw(), a.raw(), b.raw());
  return r;
}

/// Shortest basis of a lattice of rank 2 (Gauss, Lagrange).
void reduce(LatticePoint& u, LatticePoint& w) {
  for (;;) {
    if (dot(w, w) < dot(u, u)) std::swap(u, w);
    const Integer k = nearest_quotient(dot(u, w), dot(u, u));
    if (k.is_zero()) return;
    const LatticePoint shorter = along(w, -k, u);
    if (!(dot(shorter, shorter) < dot(w, w))) return;
    w = shorter;
  }
}

/// Coordinates along u and w, times det(u, w, n), of the projection of x − p into the plane along n.
struct Oblique {
  LatticePoint to_u, to_w;
  Integer determinant;
};
Oblique oblique(const LatticePoint& u, const LatticePoint& w, const LatticePoint& n) {
  return {cross(w, n), cross(n, u), dot(cross(u, w), n)};
}

std::array<LatticePoint, 8> box_corners(const LatticePoint& low, const LatticePoint& high) {
  std::array<LatticePoint, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t k = 0; k < 3; ++k) corners[i][k] = (i >> k & 1) != 0 ? high[k] : low[k];
  }
  return corners;
}

LatticePlane primitive_plane(const PlaneBody& body, std::size_t i, Rational& offset) {
  const Plane<Integer> p = body.planes[i];
  const Integer g = gcd(gcd(p.a, p.b), p.c);
  if (g.is_zero()) throw InvalidInput("DegeneratePlane", "the normal is zero", "facet " + std::to_string(i));
  offset = Rational(p.d, g);
  return {{exact_quotient(p.a, g), exact_quotient(p.b, g), exact_quotient(p.c, g)}, Integer(0)};
}

/// Where three lattice planes meet.
Point3<Rational> meet(const LatticePlane& p, const LatticePlane& q, const LatticePlane& r, std::size_t vertex) {
  const LatticePoint qr = cross(q.n, r.n), rp = cross(r.n, p.n), pq = cross(p.n, q.n);
  const Integer w = dot(p.n, qr);
  if (w.is_zero()) {
    throw InvalidInput("DegenerateVertex", "the three planes have dependent normals", "vertex " + std::to_string(vertex));
  }
  const auto c = [&](std::size_t k) { return Rational(p.d * qr[k] + q.d * rp[k] + r.d * pq[k], w); };
  return {c(0), c(1), c(2)};
}

void place_vertices(ScadModel& model, const PlaneBody& body) {
  model.vertices.clear();
  for (std::size_t v = 0; v < body.triples.size(); ++v) {
    const auto& t = body.triples[v];
    model.vertices.push_back(meet(model.planes.at(index(t[0])), model.planes.at(index(t[1])), model.planes.at(index(t[2])), v));
  }
}

const Rational& coordinate(const Point3<Rational>& p, std::size_t k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; }

/// The smallest integer box with all vertices in its interior.
void bound_vertices(ScadModel& model) {
  for (std::size_t k = 0; k < 3; ++k) {
    Rational low = coordinate(model.vertices.front(), k), high = low;
    for (const auto& p : model.vertices) {
      low = std::min(low, coordinate(p, k));
      high = std::max(high, coordinate(p, k));
    }
    model.low[k] = ceil_quotient(low.numerator(), low.denominator()) - Integer(1);
    model.high[k] = floor_quotient(high.numerator(), high.denominator()) + Integer(1);
  }
}

/// Moves the middle of the box near the origin by an integer vector, which keeps every offset an integer.
void centre(ScadModel& model, const PlaneBody& body) {
  LatticePoint c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = nearest_quotient(model.low[k] + model.high[k], Integer(2));
  for (LatticePlane& p : model.planes) p.d -= dot(p.n, c);
  place_vertices(model, body);
  bound_vertices(model);
}

std::size_t box_bits(const ScadModel& model) {
  std::size_t bits = 0;
  for (std::size_t k = 0; k < 3; ++k) bits = std::max(bits, (model.high[k] - model.low[k]).bit_length());
  return bits;
}

/// Repeated, because the box of a body far below one unit says little about its size and place.
void enlarge(ScadModel& model, const PlaneBody& body) {
  for (std::size_t bits = box_bits(model); bits <= kBodyBits; bits = box_bits(model)) {
    const unsigned long extra = kBodyBits + 1 - bits;
    for (LatticePlane& p : model.planes) p.d = p.d.shifted_left(extra);
    model.unit = model.unit.scaled(-static_cast<long>(extra));
    place_vertices(model, body);
    bound_vertices(model);
    centre(model, body);
  }
}

void refuse_nonconvex(const ScadModel& model) {
  for (std::size_t f = 0; f < model.planes.size(); ++f) {
    const LatticePlane& p = model.planes[f];
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
      const auto& x = model.vertices[v];
      const Rational excess = Rational(p.n[0]) * x.x + Rational(p.n[1]) * x.y + Rational(p.n[2]) * x.z - Rational(p.d);
      if (excess.sign() > 0) {
        throw InvalidInput("NotConvex",
                           "the solid is not the intersection of its half-spaces: vertex " + std::to_string(v) +
                               " is beyond the plane of facet " + std::to_string(f) + " by " +
                               (excess * model.unit).str() + " / |primitive normal|",
                           "facet " + std::to_string(f));
      }
    }
  }
}

void measure_corners(ScadModel& model) {
  const auto note = [&](const LatticePoint& p) {
    for (const Integer& c : p) model.corner_bits = std::max(model.corner_bits, c.bit_length());
  };
  note(model.low), note(model.high);
  for (const LatticePlane& plane : model.planes) {
    for (const Side side : {Side::inside, Side::outside}) {
      for (const LatticePoint& p : half_space_slab(plane, side, model.low, model.high).corners) note(p);
    }
  }
  if (model.corner_bits > kCoordinateBits) {
    model.fraction_bits = static_cast<int>(std::min<std::size_t>(model.corner_bits - kCoordinateBits, kMaxFractionBits));
  }
}

/// z / 2^bits as a finite decimal: z · 5^bits / 10^bits.
std::string dyadic_text(const Integer& z, int bits) {
  if (bits == 0) return z.str();
  const Integer size = z.sign() < 0 ? -z : z;
  Integer scaled = size;
  for (int i = 0; i < bits; ++i) scaled *= Integer(5);
  std::string digits = scaled.str();
  const auto places = static_cast<std::size_t>(bits);
  if (digits.size() <= places) digits = std::string(places + 1 - digits.size(), '0') + digits;
  std::string text = z.sign() < 0 ? "-" : "";
  text.append(digits, 0, digits.size() - places).append(".").append(digits, digits.size() - places);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

void write_slab(std::string& text, const Slab& slab, int bits) {
  text += "polyhedron(points=[";
  for (std::size_t i = 0; i < 8; ++i) {
    text += i == 0 ? "[" : ",[";
    for (std::size_t k = 0; k < 3; ++k) text.append(k == 0 ? "" : ",").append(dyadic_text(slab.corners[i][k], bits));
    text += "]";
  }
  // OpenSCAD wants the corners of a face clockwise seen from outside.
  text += slab.outward ? "],faces=[[3,2,1,0],[4,5,6,7],[1,5,4,0],[2,6,5,1],[3,7,6,2],[0,4,7,3]]);\n"
                       : "],faces=[[0,1,2,3],[7,6,5,4],[0,4,5,1],[1,5,6,2],[2,6,7,3],[3,7,4,0]]);\n";
}

void write_slabs(std::string& text, const ScadModel& model, Side side) {
  for (const LatticePlane& plane : model.planes) {
    write_slab(text, half_space_slab(plane, side, model.low, model.high), model.fraction_bits);
  }
}

/// The box [low, high] is itself a slab on a plane z <= high.
Slab box_slab(const LatticePoint& low, const LatticePoint& high) {
  const auto at = [&](bool x, bool y, bool z) -> LatticePoint {
    return {x ? high[0] : low[0], y ? high[1] : low[1], z ? high[2] : low[2]};
  };
  return {{at(false, false, true), at(true, false, true), at(true, true, true), at(false, true, true),
           at(false, false, false), at(true, false, false), at(true, true, false), at(false, true, false)},
          true};
}

void write_hull(std::string& text, const ScadModel& model) {
  text += "hull() polyhedron(points=[";
  char number[40];
  for (std::size_t v = 0; v < model.vertices.size(); ++v) {
    text += v == 0 ? "\n[" : ",\n[";
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = coordinate(model.vertices[v], k).scaled(-model.fraction_bits).to_double();
      std::snprintf(number, sizeof number, "%s%.17g", k == 0 ? "" : ",", x);
      text += number;
    }
    text += "]";
  }
  text += "],faces=[";
  bool first = true;
  for (std::size_t f = 0; f < model.loops.size(); ++f) {
    if (model.loops[f].empty()) continue;
    text += first ? "\n[" : ",\n[";
    first = false;
    const auto loop = model.loops[f];
    for (std::size_t i = loop.size(); i-- > 0;) text += std::to_string(index(loop[i])) + (i == 0 ? "]" : ",");
  }
  text += "]);\n";
}

}  // namespace

LatticeFrame lattice_frame(const LatticePlane& plane) {
  const auto& [a, b, c] = plane.n;
  LatticeFrame frame;
  const Bezout ab = bezout(a, b);
  if (ab.g.is_zero()) {
    frame = {{Integer(0), Integer(0), plane.d * c}, {1, 0, 0}, {0, 1, 0}};  // c = ±1
  } else {
    const Bezout one = bezout(ab.g, c);
    HEXACT_EXPECTS(one.g == Integer(1));
    frame.p = {plane.d * one.x * ab.x, plane.d * one.x * ab.y, plane.d * one.y};
    frame.u = {exact_quotient(b, ab.g), -exact_quotient(a, ab.g), Integer(0)};
    frame.w = {-(c * ab.x), -(c * ab.y), ab.g};
    reduce(frame.u, frame.w);
  }
  // The origin's coordinates in the frame, rounded, lead to a lattice point near the foot of the origin.
  const Oblique o = oblique(frame.u, frame.w, plane.n);
  const Integer i = nearest_quotient(-dot(frame.p, o.to_u), o.determinant);
  const Integer j = nearest_quotient(-dot(frame.p, o.to_w), o.determinant);
  frame.p = along(along(frame.p, i, frame.u), j, frame.w);
  HEXACT_ENSURES(dot(plane.n, frame.p) == plane.d && dot(plane.n, frame.u).is_zero() && dot(plane.n, frame.w).is_zero());
  return frame;
}

Slab half_space_slab(const LatticePlane& plane, Side side, const LatticePoint& low, const LatticePoint& high) {
  const LatticeFrame frame = lattice_frame(plane);
  const Oblique o = oblique(frame.u, frame.w, plane.n);
  const Integer nn = dot(plane.n, plane.n);
  Integer u0(-1), u1(1), w0(-1), w1(1), depth(1);
  for (const LatticePoint& x : box_corners(low, high)) {
    const LatticePoint r = along(x, Integer(-1), frame.p);
    const Integer s = dot(r, o.to_u), t = dot(r, o.to_w), h = dot(plane.n, r);
    u0 = std::min(u0, floor_quotient(s, o.determinant) - Integer(1));
    u1 = std::max(u1, ceil_quotient(s, o.determinant) + Integer(1));
    w0 = std::min(w0, floor_quotient(t, o.determinant) - Integer(1));
    w1 = std::max(w1, ceil_quotient(t, o.determinant) + Integer(1));
    depth = std::max(depth, ceil_quotient(side == Side::inside ? -h : h, nn) + Integer(1));
  }
  Slab slab;
  const std::array<std::pair<Integer, Integer>, 4> around{{{u0, w0}, {u1, w0}, {u1, w1}, {u0, w1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    slab.corners[i] = along(along(frame.p, around[i].first, frame.u), around[i].second, frame.w);
    slab.corners[i + 4] = along(slab.corners[i], side == Side::inside ? -depth : depth, plane.n);
  }
  slab.outward = (o.determinant.sign() > 0) == (side == Side::inside);
  return slab;
}

bool ScadModel::representable() const noexcept {
  return corner_bits <= kCoordinateBits + static_cast<std::size_t>(kMaxFractionBits);
}

ScadModel scad_model(const PlaneBody& body) {
  if (body.field != Field::rational) {
    throw InvalidInput("FieldNotRational", "OpenSCAD works over the rational numbers; this body needs sqrt5", "");
  }
  if (body.planes.size() < 4 || body.triples.size() < 4) {
    throw InvalidInput("NotASolid", "a solid needs at least 4 planes and 4 vertices", "");
  }
  ScadModel model;
  model.loops = body.loops;
  std::vector<Rational> offsets(body.planes.size());
  Integer denominators(1), numerators(0);
  for (std::size_t i = 0; i < body.planes.size(); ++i) {
    model.planes.push_back(primitive_plane(body, i, offsets[i]));
    denominators = lcm(denominators, offsets[i].denominator());
  }
  for (const Rational& d : offsets) numerators = gcd(numerators, (d * Rational(denominators)).numerator());
  if (numerators.is_zero()) numerators = Integer(1);
  const Rational factor(denominators, numerators);
  for (std::size_t i = 0; i < offsets.size(); ++i) model.planes[i].d = (offsets[i] * factor).numerator();
  model.unit = (Rational(1) / factor).scaled(body.scale);
  place_vertices(model, body);
  bound_vertices(model);
  centre(model, body);
  const auto apart = [&](const Point3<Rational>& p) { return !(p == model.vertices.front()); };
  if (std::none_of(model.vertices.begin(), model.vertices.end(), apart)) {
    throw InvalidInput("NotASolid", "all vertices are one point", "vertex 0");
  }
  enlarge(model, body);
  refuse_nonconvex(model);
  measure_corners(model);
  return model;
}

const char* name_of(Route route) noexcept {
  return route == Route::intersection ? "intersection" : route == Route::hull ? "hull" : "difference";
}

std::string scad_program(const ScadModel& model, Route route) {
  std::string text = "// Written by hexact: " + std::string(name_of(route)) + " of " +
                     std::to_string(model.planes.size()) + " half-spaces, " + std::to_string(model.vertices.size()) +
                     " vertices.\n// One unit here is " + model.unit.scaled(model.fraction_bits).str() +
                     " units of the file it was made from; the centre is moved.\n";
  if (route == Route::hull) {
    write_hull(text, model);
    return text;
  }
  text += route == Route::intersection ? "intersection() {\n" : "difference() {\n";
  if (route == Route::difference) write_slab(text, box_slab(model.low, model.high), model.fraction_bits);
  write_slabs(text, model, route == Route::intersection ? Side::inside : Side::outside);
  return text + "}\n";
}

std::string corner_cutting_program(const PlaneBody& body) {
  const ScadModel model = scad_model(body);
  if (!model.representable()) {
    throw ResourceLimit("a corner of a half-space needs " + std::to_string(model.corner_bits) +
                        " bits; OpenSCAD can hold 52");
  }
  return scad_program(model, Route::intersection);
}

}  // namespace hexact::validation
