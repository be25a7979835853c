// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/certify.hpp"

#include "cut_levels.hpp"
#include "hexact/exact/embedded.hpp"
#include "hexact/exact/smooth_limit.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace hexact {
namespace {

using detail::Fault;
using detail::RootInteger;
using detail::RootPlanes;

Rational scaled(const Rational& x, long e) { return x.scaled(e); }
QuadraticField scaled(const QuadraticField& x, long e) {
  return {x.rational_part().scaled(e), x.sqrt5_part().scaled(e)};
}

/// Planes of a body over the field S as the certificate sees them.
template <class S>
struct Traits;
template <>
struct Traits<Rational> {
  using Planes = IntegerPlanes;
  static Plane<Rational> plane(const PlaneBody& b, std::size_t i) {
    const Plane<Integer> p = b.planes[i];
    return {p.a, p.b, p.c, p.d};
  }
  static Planes all(const PlaneBody& b) { return b.planes; }
};
template <>
struct Traits<QuadraticField> {
  using Planes = RootPlanes;
  static Plane<QuadraticField> plane(const PlaneBody& b, std::size_t i) { return b.planes_sqrt5[i]; }
  static Planes all(const PlaneBody& b) {
    Planes out;
    out.rows.reserve(b.planes_sqrt5.size());
    for (const auto& p : b.planes_sqrt5) out.push_back(detail::to_ring(p));
    return out;
  }
};

/// The half-space i of `of` in the coordinates of `frame`: n·y <= (d·2^s' − n·(t − t'))·2^−s with file coordinate
/// 2^s·y + t in `frame` and 2^s'·z + t' in `of`.
template <class S>
Plane<S> in_frame(const PlaneBody& of, std::size_t i, const PlaneBody& frame) {
  Plane<S> p = Traits<S>::plane(of, i);
  if (of.scale == frame.scale && of.shift == frame.shift) return p;
  p.d = scaled(p.d, of.scale) - p.a * S(frame.shift[0] - of.shift[0]) - p.b * S(frame.shift[1] - of.shift[1]) -
        p.c * S(frame.shift[2] - of.shift[2]);
  p.d = scaled(p.d, -frame.scale);
  return p;
}

template <class S>
std::string key(const Plane<S>& p) {
  if (p.a.is_zero() && p.b.is_zero() && p.c.is_zero()) return {};
  const Plane<S> c = detail::canonical(detail::to_ring(p));
  return c.a.str() + ' ' + c.b.str() + ' ' + c.c.str() + ' ' + c.d.str();
}

/// A reference next to the body: its half-spaces in the body's frame stand behind the body's planes.
template <class S>
struct Pair {
  typename Traits<S>::Planes planes;
  std::size_t own = 0;            ///< planes of the body
  std::vector<bool> is_facet;     ///< half-space of the reference is a facet half-space of the body

  Pair(const PlaneBody& body, const PlaneBody& reference)
      : planes(Traits<S>::all(body)), own(body.plane_count()), is_facet(reference.plane_count(), false) {
    std::unordered_multimap<std::string, std::size_t> wanted;
    for (std::size_t i = 0; i < reference.plane_count(); ++i) {
      const Plane<S> p = in_frame<S>(reference, i, body);
      planes.push_back(detail::to_ring(p));
      std::string k = key(p);
      if (k.empty()) continue;
      // A corner cut keeps the reference's planes in their places; the rest is looked for below.
      is_facet[i] = i < own && !body.loops[i].empty() && key(Traits<S>::plane(body, i)) == k;
      if (!is_facet[i]) wanted.emplace(std::move(k), i);
    }
    for (std::size_t f = 0; f < own && !wanted.empty(); ++f) {
      if (body.loops[f].empty()) continue;
      const auto [first, last] = wanted.equal_range(key(Traits<S>::plane(body, f)));
      for (auto it = first; it != last; ++it) is_facet[it->second] = true;
      wanted.erase(first, last);
    }
  }
};

/// The claims of one certificate over the field S; surfaces are examined once.
template <class S>
class Verifier {
 public:
  using Planes = typename Traits<S>::Planes;
  explicit Verifier(const Certificate& certificate)
      : certificate_(certificate), body_(certificate.body), planes_(Traits<S>::all(body_)),
        topology_(analyse_topology(body_.loops, body_.vertex_count())) {}

  Fault decide(const Claim& claim, const ProgressPart& progress) {
    if (claim.name == "closed") return detail::closed_fault(topology_);
    if (claim.name == "planar") return detail::planar_fault(planes_, body_.loops, body_.triples);
    if (claim.name == "trivalent") return detail::trivalent_fault(body_.loops, body_.vertex_count());
    if (claim.name == "convex") return convex();
    if (claim.name == "embedded") return embedded_fault(body_);
    const auto named = std::find_if(certificate_.bodies.begin(), certificate_.bodies.end(),
                                    [&](const NamedBody& b) { return b.name == claim.reference; });
    if (named == certificate_.bodies.end()) return "the certificate has no body " + claim.reference;
    if (named->body.field != body_.field) return "body " + claim.reference + " is over another field";
    if (claim.name == "inside") return inside(*named, false);
    if (claim.name == "tangent") return inside(*named, true);
    return corner_cut(*named, progress);
  }

 private:
  const Fault& convex() {
    if (!convex_) convex_ = detail::convex_fault(planes_, body_.loops, body_.triples, topology_);
    return *convex_;
  }

  Fault reference_fault(const NamedBody& reference) const {
    const PlaneBody& b = reference.body;
    const Fault fault = detail::convex_fault(Traits<S>::all(b), b.loops, b.triples,
                                             analyse_topology(b.loops, b.vertex_count()));
    return fault.empty() ? Fault{} : "body " + reference.name + " is not convex: " + fault;
  }

  /// `tangent` asks in addition that every facet half-space of the reference is one of the body.
  Fault inside(const NamedBody& reference, const bool tangent) {
    if (!convex().empty()) return convex();
    if (Fault fault = reference_fault(reference); !fault.empty()) return fault;
    const Pair<S> pair(body_, reference.body);
    std::map<std::size_t, VertexId> support;
    for (const Support& s : certificate_.supports) {
      if (s.reference == reference.name) support.emplace(s.plane, s.vertex);
    }
    if (std::all_of(pair.is_facet.begin(), pair.is_facet.end(), [](bool b) { return b; })) return {};
    const detail::ConvexSigns<Planes> signs(planes_, body_.loops, body_.triples);
    std::vector<std::uint32_t> leaving(body_.vertex_count(), kNoTwin);
    for (std::size_t h = signs.edges().size(); h-- > 0;) leaving[signs.edges().origin[h]] = static_cast<std::uint32_t>(h);
    for (std::size_t i = 0; i < pair.is_facet.size(); ++i) {
      if (pair.is_facet[i]) continue;
      const std::string name = "half-space " + std::to_string(i) + " of " + reference.name;
      if (tangent && !reference.body.loops[i].empty()) return name + ": is no facet half-space of the body";
      const auto evidence = support.find(i);
      if (evidence == support.end()) return name + ": no support is given and it is no facet half-space";
      if (Fault f = support_fault(pair, i, index(evidence->second), signs.edges(), leaving); !f.empty()) return name + ": " + f;
    }
    return {};
  }

  Fault support_fault(const Pair<S>& pair, std::size_t i, std::size_t v, const HalfEdges& edges,
                      const std::vector<std::uint32_t>& leaving) const {
    if (v >= leaving.size()) return "support " + vertex_name(v) + " does not exist";
    const std::size_t n = pair.own + i;
    const auto& t = body_.triples[v];
    const std::size_t a = index(t[0]), b = index(t[1]), c = index(t[2]);
    // d − n·v = det4(a, b, c, n) / det3(a, b, c).
    if (detail::sign_det4(pair.planes, a, b, c, n) * detail::sign_det3(pair.planes, a, b, c) < 0) {
      return vertex_name(v) + " is beyond it, det4 = " + detail::det4_text(pair.planes, a, b, c, n);
    }
    for (const std::uint32_t h : edges.around(leaving[v])) {
      const std::size_t f = edges.facet[h], g = edges.facet[edges.twin[h]];
      if (detail::sign_det3(pair.planes, n, f, g) > 0) {
        return vertex_name(v) + " does not support it: " + edge_name(v, edges.target(h)) + " runs outward, det3 = " +
               detail::det3_text(pair.planes, n, f, g);
      }
    }
    return {};
  }

  Fault corner_cut(const NamedBody& reference, const ProgressPart& progress) {
    if (!convex().empty()) return convex();
    const PlaneBody& base = reference.body;
    if (Fault fault = reference_fault(reference); !fault.empty()) return fault;
    if (Fault fault = detail::trivalent_fault(base.loops, base.vertex_count()); !fault.empty()) {
      return "body " + reference.name + ": " + fault;
    }
    if (base.plane_count() > body_.plane_count()) return "fewer planes than body " + reference.name;
    for (std::size_t i = 0; i < base.plane_count(); ++i) {
      if (base.loops[i].empty()) return facet_name(i) + " of " + reference.name + ": has no loop";
      if (key(in_frame<S>(base, i, body_)) != key(Traits<S>::plane(body_, i))) {
        return facet_name(i) + ": is not the plane of body " + reference.name;
      }
    }
    return detail::replay_fault(planes_, body_, base, 1, [](const HoneycombMap&, detail::CutKind) {}, progress);
  }

  const Certificate& certificate_;
  const PlaneBody& body_;
  Planes planes_;
  MeshTopology topology_;
  std::optional<Fault> convex_;
};

bool is_convex(const PlaneBody& b) {
  const MeshTopology topology = analyse_topology(b.loops, b.vertex_count());
  if (b.field == Field::rational) return detail::convex_fault(b.planes, b.loops, b.triples, topology).empty();
  return detail::convex_fault(Traits<QuadraticField>::all(b), b.loops, b.triples, topology).empty();
}

/// Evidence for the half-spaces of the reference that are no facet half-spaces of the body; none when the body is not
/// convex, `verify` then names the reason.
/// Walks uphill along n: an edge along n_f × n_g rises where det(n, f, g) > 0. Ends at a supporting vertex.
template <class S>
void add_supports(Certificate& out, const NamedBody& reference, const ProgressPart& progress) {
  const PlaneBody& body = out.body;
  const Pair<S> pair(body, reference.body);
  const auto is_set = [](bool b) { return b; };
  if (std::all_of(pair.is_facet.begin(), pair.is_facet.end(), is_set) || !is_convex(body)) return;
  const HalfEdges edges = half_edges_of(body.loops);
  std::vector<std::uint32_t> leaving(body.vertex_count(), 0);
  for (std::size_t h = edges.size(); h-- > 0;) leaving[edges.origin[h]] = static_cast<std::uint32_t>(h);
  std::uint32_t v = edges.origin[0];
  for (std::size_t i = 0; i < pair.is_facet.size(); ++i) {
    if (pair.is_facet[i]) continue;
    progress.check();
    for (bool risen = true; risen;) {
      risen = false;
      for (const std::uint32_t h : edges.around(leaving[v])) {
        if (detail::sign_det3(pair.planes, pair.own + i, edges.facet[h], edges.facet[edges.twin[h]]) <= 0) continue;
        v = edges.target(h);
        risen = true;
        break;
      }
    }
    out.supports.push_back({reference.name, i, make_id<VertexId>(v)});
  }
}

template <class S>
std::vector<ClaimVerdict> verify_over(const Certificate& certificate, const ProgressPart& progress) {
  progress.check();
  Verifier<S> verifier(certificate);
  std::vector<ClaimVerdict> out;
  const double claims = static_cast<double>(certificate.claims.size());
  for (const Claim& claim : certificate.claims) {
    const double before = static_cast<double>(out.size());
    progress.report(before / claims);
    const ProgressPart part = progress.part(before / claims, (before + 1) / claims);
    if (claim.name == "smooth-limit") {
      const SmoothLimit limit = smooth_limit(certificate.body, part);
      out.push_back({claim_text(claim), limit.verdict, limit.reason});
      continue;
    }
    const Fault fault = verifier.decide(claim, part);
    out.push_back({claim_text(claim), fault.empty() ? Verdict::proved : Verdict::refuted, fault});
  }
  return out;
}

void expect_consistent(const PlaneBody& b) {
  const auto fail = [](const std::string& what) { throw InvalidInput("WrongIndex", what, ""); };
  if (b.loops.size() != b.plane_count()) fail("a body needs one loop for each plane");
  if (!b.addresses.empty() && b.addresses.size() != b.plane_count()) fail("a body needs one address for each plane");
  for (const VertexId v : b.loops.corners()) {
    if (index(v) >= b.vertex_count()) fail("a loop names " + vertex_name(index(v)) + ", which does not exist");
  }
  for (const auto& t : b.triples) {
    for (const FacetId f : t) {
      if (index(f) >= b.plane_count()) fail("a vertex names plane " + std::to_string(index(f)) + ", which does not exist");
    }
  }
}

}  // namespace

std::string claim_text(const Claim& claim) {
  return claim.reference.empty() ? claim.name : claim.name + "=" + claim.reference;
}

Verdict overall(const std::vector<ClaimVerdict>& verdicts) noexcept {
  Verdict worst = verdicts.empty() ? Verdict::undecided : Verdict::proved;
  for (const ClaimVerdict& v : verdicts) {
    if (v.verdict == Verdict::refuted) return Verdict::refuted;
    if (v.verdict == Verdict::undecided) worst = Verdict::undecided;
  }
  return worst;
}

Certificate make_certificate(PlaneBody body, std::vector<Claim> claims, std::vector<NamedBody> references,
                             std::vector<std::string> provenance, const ProgressPart& progress) {
  Certificate out{std::move(body), std::move(claims), std::move(references), {}, std::move(provenance)};
  expect_consistent(out.body);
  for (const NamedBody& b : out.bodies) expect_consistent(b.body);
  std::vector<std::string> done;
  for (const Claim& claim : out.claims) {
    const bool alone = claim.name == "closed" || claim.name == "planar" || claim.name == "trivalent" || claim.name == "convex" ||
                       claim.name == "embedded" || claim.name == "smooth-limit";
    const bool about = claim.name == "inside" || claim.name == "tangent" || claim.name == "corner-cut-of";
    if (!alone && !about) throw InvalidInput("UnknownClaim", "there is no claim " + claim.name, claim_text(claim));
    if (alone != claim.reference.empty()) throw InvalidInput("MissingBody", alone ? "needs no body" : "needs a body", claim_text(claim));
    if (alone) continue;
    const auto named = std::find_if(out.bodies.begin(), out.bodies.end(), [&](const auto& b) { return b.name == claim.reference; });
    if (named == out.bodies.end()) throw InvalidInput("MissingBody", "names a body that is not given", claim_text(claim));
    if (claim.name == "corner-cut-of" || std::find(done.begin(), done.end(), named->name) != done.end()) continue;
    done.push_back(named->name);
    if (named->body.field != out.body.field) continue;  // `verify` names the reason
    if (out.body.field == Field::rational) add_supports<Rational>(out, *named, progress);
    if (out.body.field == Field::sqrt5) add_supports<QuadraticField>(out, *named, progress);
  }
  return out;
}

std::vector<ClaimVerdict> verify(const Certificate& certificate, const ProgressPart& progress) {
  expect_consistent(certificate.body);
  for (const NamedBody& b : certificate.bodies) expect_consistent(b.body);
  return certificate.body.field == Field::rational ? verify_over<Rational>(certificate, progress)
                                                   : verify_over<QuadraticField>(certificate, progress);
}

}  // namespace hexact
