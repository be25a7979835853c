// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/honeycomb.hpp"
#include "hexact/exact/plane_body.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

// Fixtures of the honeycomb tests: bodies from points and facets, and residues modulo p = 2^61 − 1.
namespace hexact::test {

inline nlohmann::json golden() {
  std::ifstream file(HEXACT_TEST_DATA "/phs_golden.json");
  return nlohmann::json::parse(file);
}

inline QuadraticField number(const std::string& text) {
  QuadraticField x;
  if (!QuadraticField::parse(text, x)) throw std::runtime_error("not a number: " + text);
  return x;
}

struct Solid {
  std::vector<Point3<QuadraticField>> points;
  FacetLoops loops;
};

inline Solid solid(const nlohmann::json& initial) {
  Solid s;
  for (const auto& v : initial.at("vertices")) {
    s.points.push_back({number(v[0]), number(v[1]), number(v[2])});
  }
  for (const auto& f : initial.at("faces")) {
    for (const auto& v : f) s.loops.add_corner(make_id<VertexId>(v.get<std::size_t>()));
    s.loops.close_loop();
  }
  return s;
}

inline Solid tetrahedron() {
  return solid(nlohmann::json::parse(R"({"vertices":[["1","1","1"],["1","-1","-1"],["-1","1","-1"],["-1","-1","1"]],
    "faces":[[3,2,1],[2,3,0],[3,1,0],[1,2,0]]})"));
}

inline Solid cube() {
  return solid(nlohmann::json::parse(R"({"vertices":[["-1","-1","-1"],["-1","-1","1"],["-1","1","-1"],["-1","1","1"],
    ["1","-1","-1"],["1","-1","1"],["1","1","-1"],["1","1","1"]],
    "faces":[[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]]})"));
}

inline Plane<QuadraticField> plane_of(const Solid& s, std::size_t f) {
  const auto loop = s.loops[f];
  const auto &p = s.points[index(loop[0])], &q = s.points[index(loop[1])], &r = s.points[index(loop[2])];
  const QuadraticField ux = q.x - p.x, uy = q.y - p.y, uz = q.z - p.z, vx = r.x - q.x, vy = r.y - q.y, vz = r.z - q.z;
  const QuadraticField a = uy * vz - uz * vy, b = uz * vx - ux * vz, c = ux * vy - uy * vx;
  return {a, b, c, a * p.x + b * p.y + c * p.z};
}

/// The exact body of a solid, over Q where its planes are rational.
inline PlaneBody body_of(const Solid& s) {
  PlaneBody body;
  body.loops = s.loops;
  bool rational = true;
  for (std::size_t f = 0; f < s.loops.size(); ++f) {
    body.planes_sqrt5.push_back(plane_of(s, f));
    body.addresses.push_back({0, std::nullopt});
    const auto& p = body.planes_sqrt5.back();
    rational = rational && p.a.is_rational() && p.b.is_rational() && p.c.is_rational() && p.d.is_rational();
  }
  const HoneycombMap map(s.loops, s.points.size());
  for (std::uint32_t v = 0; v < s.points.size(); ++v) {
    const auto f = map.facets_at(v);
    body.triples.push_back({make_id<FacetId>(f[0]), make_id<FacetId>(f[1]), make_id<FacetId>(f[2])});
  }
  body.field = rational ? Field::rational : Field::sqrt5;
  if (!rational) return body;
  for (const auto& p : body.planes_sqrt5) {
    const Integer l = lcm(lcm(p.a.rational_part().denominator(), p.b.rational_part().denominator()),
                          lcm(p.c.rational_part().denominator(), p.d.rational_part().denominator()));
    const auto scaled = [&](const QuadraticField& x) { return (x.rational_part() * Rational(l)).numerator(); };
    body.planes.push_back(Plane<Integer>{scaled(p.a), scaled(p.b), scaled(p.c), scaled(p.d)});
  }
  body.planes_sqrt5.clear();
  return body;
}

inline CutPolicy constant(const char* beta) { return SizePolicy{{number(beta)}}; }

/// The policies that the golden file names in words.
inline CutPolicy golden_policy(const std::string& name) {
  if (name == "static") return static_policy_sqrt5();
  if (name == "static_rational") return static_policy_rational();
  if (name == "uniform 1/4") return constant("1/4");
  if (name == "beta4=2/5, beta6=1/10") {
    return SizePolicy{{number("0"), number("0"), number("0"), number("2/5"), number("2/5"), number("2/5"), number("1/10")}};
  }
  if (name != "lambda(a->b) = (1+(3a+5b) mod 7)/16 at level 0") throw std::runtime_error("unknown policy " + name);
  return HalfEdgePolicy([](const HoneycombMap& map, HalfEdgeId h) {
    const auto i = static_cast<std::uint32_t>(h);
    return QuadraticField(Rational(Integer(1 + static_cast<int>((3 * map.origin(i) + 5 * map.target(i)) % 7)), Integer(16)));
  });
}

/// Does the case need √5 in its coordinates or in its parameters?
inline bool needs_root(const nlohmann::json& closed, const PlaneBody& body) {
  return body.field == Field::sqrt5 ||
         (closed.at("parameters") == "static" && closed.at("levels")[0].at("face_sizes").contains("5"));
}

constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;
constexpr std::uint64_t kSqrt5 = 659791110852991619;
static_assert(static_cast<unsigned __int128>(kSqrt5) * kSqrt5 % kPrime == 5);

inline std::uint64_t times_mod(std::uint64_t x, std::uint64_t y) {
  return static_cast<std::uint64_t>(static_cast<unsigned __int128>(x) * y % kPrime);
}

inline std::uint64_t power_mod(std::uint64_t x, std::uint64_t n) {
  std::uint64_t r = 1;
  for (; n > 0; n >>= 1, x = times_mod(x, x)) {
    if (n & 1) r = times_mod(r, x);
  }
  return r;
}

inline std::uint64_t residue(const Rational& x) {
  const Integer numerator = x.numerator(), denominator = x.denominator();
  return times_mod(mpz_fdiv_ui(numerator.raw(), kPrime), power_mod(mpz_fdiv_ui(denominator.raw(), kPrime), kPrime - 2));
}
inline std::uint64_t residue(const QuadraticField& x) {
  return (residue(x.rational_part()) + times_mod(residue(x.sqrt5_part()), kSqrt5)) % kPrime;
}

/// Σ x[i][c]·B^(3i+c+1) mod p with B = 1000003: checks all coordinates at once.
template <class S>
std::uint64_t fingerprint(const std::vector<Point3<S>>& points) {
  std::uint64_t sum = 0, weight = 1;
  for (const auto& p : points) {
    for (const S* x : {&p.x, &p.y, &p.z}) {
      weight = times_mod(weight, 1000003);
      sum = (sum + times_mod(residue(*x), weight)) % kPrime;
    }
  }
  return sum;
}

}  // namespace hexact::test
