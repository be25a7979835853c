// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/nef/nef_solid.hpp"

#include "hexact/kernel/errors.hpp"

#include <CGAL/Homogeneous.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/gmpxx.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace hexact {
namespace {

// Homogeneous coordinates over integers: the fastest of the exact kernels for half-space cuts of this kind.
using Number = mpz_class;
using Kernel = CGAL::Homogeneous<Number>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

struct Vertex {
  Integer x, y, z, w;  ///< w > 0
};

/// A body in file coordinates: primitive integer half-spaces and homogeneous vertices.
struct Solid {
  std::vector<Plane<Integer>> planes;
  std::vector<Vertex> vertices;
  const FacetLoops* loops = nullptr;
};

/// Ends the work when the progress callback asks for it.
struct Cancelled {};

void report(const NefOptions& options, double fraction) {
  if (options.progress && !options.progress(fraction)) throw Cancelled{};
}

Number to_cgal(const Integer& z) { return Number(z.raw()); }

/// a·X + b·Y + c·Z <= d in file coordinates X = 2^scale·x + shift, with coprime coefficients.
Plane<Integer> file_plane(const PlaneBody& body, std::size_t i) {
  const Plane<Integer> p = body.planes[i];
  const Rational d = Rational(p.d).scaled(body.scale) + Rational(p.a) * body.shift[0] + Rational(p.b) * body.shift[1] +
                     Rational(p.c) * body.shift[2];
  const Integer m = d.denominator();
  const Plane<Integer> q{p.a * m, p.b * m, p.c * m, d.numerator()};
  const Integer g = gcd(gcd(q.a, q.b), gcd(q.c, q.d));
  if (g.is_zero()) throw InvalidInput("DegeneratePlane", "all coefficients are zero", "facet " + std::to_string(i));
  return {exact_quotient(q.a, g), exact_quotient(q.b, g), exact_quotient(q.c, g), exact_quotient(q.d, g)};
}

std::array<Integer, 3> cross(const Plane<Integer>& u, const Plane<Integer>& v) {
  return {u.b * v.c - u.c * v.b, u.c * v.a - u.a * v.c, u.a * v.b - u.b * v.a};
}

/// Cramer's rule for the point of three planes.
Vertex meet(const Plane<Integer>& p, const Plane<Integer>& q, const Plane<Integer>& r, std::size_t name) {
  const auto qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  Vertex v{p.d * qr[0] + q.d * rp[0] + r.d * pq[0], p.d * qr[1] + q.d * rp[1] + r.d * pq[1],
           p.d * qr[2] + q.d * rp[2] + r.d * pq[2], p.a * qr[0] + p.b * qr[1] + p.c * qr[2]};
  if (v.w.is_zero()) {
    throw InvalidInput("DegenerateVertex", "the three planes have dependent normals", "vertex " + std::to_string(name));
  }
  const Integer common = gcd(gcd(v.x, v.y), gcd(v.z, v.w));
  const Integer g = v.w.sign() < 0 ? -common : common;
  return {exact_quotient(v.x, g), exact_quotient(v.y, g), exact_quotient(v.z, g), exact_quotient(v.w, g)};
}

Solid solid_of(const PlaneBody& body) {
  Solid solid;
  solid.loops = &body.loops;
  for (std::size_t i = 0; i < body.planes.size(); ++i) solid.planes.push_back(file_plane(body, i));
  for (std::size_t v = 0; v < body.triples.size(); ++v) {
    const auto& t = body.triples[v];
    solid.vertices.push_back(meet(solid.planes.at(index(t[0])), solid.planes.at(index(t[1])), solid.planes.at(index(t[2])), v));
  }
  return solid;
}

/// (n·x − d)·w at a vertex: positive outside.
Integer excess(const Plane<Integer>& p, const Vertex& v) { return p.a * v.x + p.b * v.y + p.c * v.z - p.d * v.w; }

std::string excess_text(std::size_t vertex, std::size_t facet, const Integer& numerator, const Integer& w) {
  return "vertex " + std::to_string(vertex) + ", plane of facet " + std::to_string(facet) +
         ": a*x + b*y + c*z - d = " + Rational(numerator, w).str();
}

/// A facet corner that does not lie in its facet's plane, if there is one.
std::optional<std::string> nonplanar_corner(const Solid& solid) {
  for (std::size_t f = 0; f < solid.loops->size(); ++f) {
    for (const VertexId v : (*solid.loops)[f]) {
      const Integer e = excess(solid.planes[f], solid.vertices.at(index(v)));
      if (!e.is_zero()) return "facet is not planar; " + excess_text(index(v), f, e, solid.vertices[index(v)].w);
    }
  }
  return std::nullopt;
}

/// A loop that does not turn counter-clockwise about its plane's outward normal, if there is one.
std::optional<std::string> reversed_loop(const Solid& solid) {
  for (std::size_t f = 0; f < solid.loops->size(); ++f) {
    const auto loop = (*solid.loops)[f];
    const Plane<Integer>& p = solid.planes[f];
    Rational area;  // n·(sum of u × v over the loop's edges uv), twice the area along n
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vertex& u = solid.vertices[index(loop[i])];
      const Vertex& v = solid.vertices[index(loop[(i + 1) % loop.size()])];
      area += Rational(p.a * (u.y * v.z - u.z * v.y) + p.b * (u.z * v.x - u.x * v.z) + p.c * (u.x * v.y - u.y * v.x),
                       u.w * v.w);
    }
    if (!loop.empty() && area.sign() <= 0) {
      return "the loop of facet " + std::to_string(f) + " is not counter-clockwise: area along its normal " + area.str();
    }
  }
  return std::nullopt;
}

/// A vertex strictly outside a half-space, if there is one.
std::optional<std::string> vertex_beyond(const std::vector<Vertex>& vertices, const std::vector<Plane<Integer>>& planes) {
  for (std::size_t f = 0; f < planes.size(); ++f) {
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const Integer e = excess(planes[f], vertices[v]);
      if (e.sign() > 0) return excess_text(v, f, e, vertices[v].w);
    }
  }
  return std::nullopt;
}

Kernel::Point_3 to_point(const Vertex& v) {
  return Kernel::Point_3(to_cgal(v.x), to_cgal(v.y), to_cgal(v.z), to_cgal(v.w));
}
/// CGAL's negative side is where a·x + b·y + c·z + d < 0, our inside.
Kernel::Plane_3 to_plane(const Plane<Integer>& p) {
  return Kernel::Plane_3(to_cgal(p.a), to_cgal(p.b), to_cgal(p.c), to_cgal(-p.d));
}

class SurfaceBuilder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
 public:
  explicit SurfaceBuilder(const Solid& solid) : solid_(solid) {}
  [[nodiscard]] bool failed() const noexcept { return failed_; }

  void operator()(Polyhedron::HalfedgeDS& surface) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(surface, false);
    builder.begin_surface(solid_.vertices.size(), solid_.loops->size());
    for (const Vertex& v : solid_.vertices) builder.add_vertex(to_point(v));
    for (std::size_t f = 0; f < solid_.loops->size() && !failed_; ++f) {
      if ((*solid_.loops)[f].empty()) continue;
      std::vector<std::size_t> loop;
      for (const VertexId v : (*solid_.loops)[f]) loop.push_back(index(v));
      failed_ = !builder.test_facet(loop.begin(), loop.end());
      if (!failed_) builder.add_facet(loop.begin(), loop.end())->facet()->plane() = to_plane(solid_.planes[f]);
    }
    failed_ = failed_ || builder.error();
    if (failed_) {
      builder.rollback();
      return;
    }
    builder.end_surface();
    failed_ = builder.error() || builder.check_unconnected_vertices();
  }

 private:
  const Solid& solid_;
  bool failed_ = false;
};

/// The solid bounded by the facets; a text that refutes every claim when they bound none.
std::variant<Nef, std::string> nef_of(const Solid& solid) {
  if (const auto bad = nonplanar_corner(solid)) return *bad;
  if (const auto bad = reversed_loop(solid)) return *bad;
  Polyhedron surface;
  SurfaceBuilder builder(solid);
  surface.delegate(builder);
  if (builder.failed() || surface.empty() || !surface.is_closed()) {
    return std::string("the facets do not form a closed oriented surface");
  }
  return Nef(surface);
}

/// A box of integer corners that contains all vertices in its interior.
Nef enclosing_box(const std::vector<Vertex>& vertices) {
  Integer reach(1);
  for (const Vertex& v : vertices) {
    for (const Integer& c : {v.x, v.y, v.z}) {
      const Integer size = ceil_quotient(c.sign() < 0 ? -c : c, v.w) + Integer(1);
      if (reach < size) reach = size;
    }
  }
  FacetLoops loops;
  for (const auto& f : {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    for (const int v : f) loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    loops.close_loop();
  }
  Solid box;
  box.loops = &loops;
  for (int i = 0; i < 8; ++i) {
    const auto side = [&](int bit) { return (i >> bit & 1) != 0 ? reach : -reach; };
    box.vertices.push_back({side(0), side(1), side(2), Integer(1)});
  }
  box.planes = {{-1, 0, 0, reach}, {1, 0, 0, reach}, {0, -1, 0, reach}, {0, 1, 0, reach}, {0, 0, -1, reach}, {0, 0, 1, reach}};
  return std::get<Nef>(nef_of(box));
}

/// `start` cut by all half-spaces, one after another.
Nef cut_by_all(Nef start, const std::vector<Plane<Integer>>& planes, const NefOptions& options) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    // The k-th cut costs about k^1.2, hence the fraction.
    report(options, 0.9 * std::pow(static_cast<double>(i) / static_cast<double>(planes.size()), 2.2));
    start = start.intersection(to_plane(planes[i]), Nef::CLOSED_HALFSPACE);
  }
  report(options, 0.9);
  return start;
}

std::string coordinate(const Number& h, const Number& w) {
  return Rational(Integer(h.get_mpz_t()), Integer(w.get_mpz_t())).str();
}

/// A vertex of a non-empty set, one that belongs to it where there is any.
std::string point_of(const Nef& set) {
  const Nef::SNC_structure::Point_3* found = nullptr;
  for (auto v = set.vertices_begin(); v != set.vertices_end(); ++v) {
    if (found == nullptr || v->mark()) found = &v->point();
    if (v->mark()) break;
  }
  if (found == nullptr) return "(unbounded)";
  return "(" + coordinate(found->hx(), found->hw()) + ", " + coordinate(found->hy(), found->hw()) + ", " +
         coordinate(found->hz(), found->hw()) + ")";
}

void set_equality(ClaimVerdict& verdict, const Nef& built, const Nef& cut) {
  if (built == cut) {
    verdict.verdict = Verdict::proved;
    return;
  }
  verdict.verdict = Verdict::refuted;
  const Nef extra = built - cut;
  verdict.witness = extra.is_empty()
                        ? "point " + point_of(cut - built) + " satisfies all half-spaces and is not in the solid"
                        : "point " + point_of(extra) + " is in the solid and beyond a half-space";
}

void bound_facets(std::size_t facets, const NefOptions& options) {
  if (facets > options.max_facets) {
    throw ResourceLimit("the Nef witness is bounded to " + std::to_string(options.max_facets) + " facets and would take " +
                        nef_cost_estimate(facets) + " for " + std::to_string(facets));
  }
}

void silent(const char*, const char*, const char*, int, const char*) {}

/// While it lives, CGAL throws on failed assertions and prints nothing.
class ThrowingCgal {
 public:
  ThrowingCgal()
      : errors_(CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION)),
        warnings_(CGAL::set_warning_behaviour(CGAL::CONTINUE)),
        error_handler_(CGAL::set_error_handler(silent)),
        warning_handler_(CGAL::set_warning_handler(silent)) {}
  ThrowingCgal(const ThrowingCgal&) = delete;
  ThrowingCgal& operator=(const ThrowingCgal&) = delete;
  ~ThrowingCgal() {
    CGAL::set_error_behaviour(errors_);
    CGAL::set_warning_behaviour(warnings_);
    CGAL::set_error_handler(error_handler_);
    CGAL::set_warning_handler(warning_handler_);
  }

 private:
  CGAL::Failure_behaviour errors_, warnings_;
  CGAL::Failure_function error_handler_, warning_handler_;
};

/// Runs `decide` on a fresh verdict; what CGAL throws leaves the claim undecided.
template <class Decide>
ClaimVerdict decided(const std::string& claim, std::initializer_list<const PlaneBody*> bodies, const Decide& decide) {
  ClaimVerdict verdict{claim, Verdict::undecided, {}};
  for (const PlaneBody* body : bodies) {
    if (body->field != Field::rational) {
      verdict.witness = "the Nef witness works over the rational numbers only; this body needs sqrt5";
      return verdict;
    }
  }
  const ThrowingCgal guard;
  try {
    decide(verdict);
  } catch (const Cancelled&) {
    verdict = {claim, Verdict::undecided, "cancelled"};
  } catch (const CGAL::Failure_exception& e) {
    verdict = {claim, Verdict::undecided, std::string("CGAL failed: ") + e.what()};
  }
  return verdict;
}

bool refute(ClaimVerdict& verdict, const std::string& what, const std::variant<Nef, std::string>& built) {
  if (const auto* reason = std::get_if<std::string>(&built)) {
    verdict.verdict = Verdict::refuted;
    verdict.witness = what + *reason;
    return true;
  }
  return false;
}

}  // namespace

double nef_cost_seconds(std::size_t facets) { return 3.3 * std::pow(static_cast<double>(facets) / 326.0, 2.2); }

std::string nef_cost_estimate(std::size_t facets) {
  const double s = nef_cost_seconds(facets);
  char text[64];
  if (s < 120) {
    std::snprintf(text, sizeof text, "about %.2g s cut by cut", s);
  } else if (s < 7200) {
    std::snprintf(text, sizeof text, "about %.0f minutes cut by cut", s / 60);
  } else {
    std::snprintf(text, sizeof text, "about %.0f hours cut by cut", s / 3600);
  }
  return text;
}

ClaimVerdict nef_convex(const PlaneBody& body, const NefOptions& options) {
  bound_facets(body.plane_count(), options);
  return decided("convex", {&body}, [&](ClaimVerdict& verdict) {
    const Solid solid = solid_of(body);
    const auto built = nef_of(solid);
    if (refute(verdict, "", built)) return;
    set_equality(verdict, std::get<Nef>(built), cut_by_all(enclosing_box(solid.vertices), solid.planes, options));
    if (verdict.verdict == Verdict::refuted) {
      if (const auto beyond = vertex_beyond(solid.vertices, solid.planes)) verdict.witness = *beyond;
    }
    report(options, 1);
  });
}

ClaimVerdict nef_corner_cut(const PlaneBody& base, const PlaneBody& cut, const NefOptions& options) {
  bound_facets(std::max(base.plane_count(), cut.plane_count()), options);
  return decided("corner-cut-of", {&base, &cut}, [&](ClaimVerdict& verdict) {
    const Solid p0 = solid_of(base), p1 = solid_of(cut);
    const auto n0 = nef_of(p0), n1 = nef_of(p1);
    if (refute(verdict, "body that is cut: ", n0) || refute(verdict, "", n1)) return;
    set_equality(verdict, std::get<Nef>(n1), cut_by_all(std::get<Nef>(n0), p1.planes, options));
    report(options, 1);
  });
}

ClaimVerdict nef_inside(const PlaneBody& inner, const PlaneBody& outer, const NefOptions& options) {
  bound_facets(std::max(inner.plane_count(), outer.plane_count()), options);
  return decided("inside", {&inner, &outer}, [&](ClaimVerdict& verdict) {
    const Solid p = solid_of(inner), q = solid_of(outer);
    const auto np = nef_of(p), nq = nef_of(q);
    if (refute(verdict, "", np) || refute(verdict, "outer body: ", nq)) return;
    report(options, 0.1);
    const Nef difference = std::get<Nef>(np) - std::get<Nef>(nq);
    const bool empty = difference.is_empty();
    verdict.verdict = empty ? Verdict::proved : Verdict::refuted;
    if (!empty) verdict.witness = "point " + point_of(difference) + " is in the inner solid and not in the outer one";
    report(options, 1);
  });
}

}  // namespace hexact
