// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/embedded.hpp"

#include "box_tree.hpp"
#include "convex_surface.hpp"
#include "facet_contact.hpp"
#include "hexact/exact/volume.hpp"
#include "simple_polygon.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>


namespace hexact {
namespace {

using namespace detail;

template <class S>
std::vector<Finding> findings_of_facets(const LocatedPoints<S>& points) {
  const FacetLoops& loops = points.body().loops;
  std::vector<std::string> faults(loops.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, loops.size(), 64), [&](const auto& range) {
    for (std::size_t f = range.begin(); f != range.end(); ++f) {
      if (!loops[f].empty()) faults[f] = SimplePolygon<S>(points, f).fault();
    }
  });
  std::vector<Finding> findings;
  for (std::size_t f = 0; f < faults.size(); ++f) {
    if (!faults[f].empty()) findings.push_back({"FacetNotSimple", faults[f], facet_name(f), {}});
  }
  return findings;
}

template <class S>
BoxTree tree_of_facets(const LocatedPoints<S>& points) {
  const FacetLoops& loops = points.body().loops;
  std::vector<Box> boxes(loops.size());
  for (std::size_t f = 0; f < loops.size(); ++f) {
    for (const VertexId v : loops[f]) boxes[f].include(points.near(index(v)));
  }
  return BoxTree(std::move(boxes));
}

std::string place(const Rational& x, const PlaneBody& body, std::size_t axis) { return (x.scaled(body.scale) + body.shift[axis]).str(); }
std::string place(const QuadraticField& x, const PlaneBody& body, std::size_t axis) {
  return QuadraticField(x.rational_part().scaled(body.scale) + body.shift[axis], x.sqrt5_part().scaled(body.scale)).str();
}

/// The smallest facet number above f that f touches where it must not.
template <class S>
std::optional<FacetContact> contact_of(const LocatedPoints<S>& points, const BoxTree& tree, std::size_t f, const PlaneBody& body) {
  std::vector<std::uint32_t> candidates;
  tree.for_each_meeting(tree.box(f), [&](std::uint32_t g) {
    if (g > f) candidates.push_back(g);
  });
  std::sort(candidates.begin(), candidates.end());
  for (const std::uint32_t g : candidates) {
    const auto x = FacetPair<S>(points, f, g).contact();
    if (!x) continue;
    return FacetContact{f, g, "(" + place(x->x, body, 0) + ", " + place(x->y, body, 1) + ", " + place(x->z, body, 2) + ")"};
  }
  return std::nullopt;
}

template <class S>
std::optional<FacetContact> first_contact(const LocatedPoints<S>& points, const PlaneBody& body) {
  const BoxTree tree = tree_of_facets(points);
  const FacetLoops& loops = points.body().loops;
  const std::size_t n = loops.size();
  const std::size_t first = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, n, 64), n,
      [&](const tbb::blocked_range<std::size_t>& range, std::size_t best) {
        for (std::size_t f = range.begin(); f < range.end() && f < best; ++f) {
          if (!loops[f].empty() && contact_of(points, tree, f, body)) return f;
        }
        return best;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  return first == n ? std::nullopt : contact_of(points, tree, first, body);
}

/// Sign of the volume that a closed surface encloses by its orientation: from doubles with a bound, else exactly.
/// Six terms per product of three coordinates with relative errors of 2^-53 each and n sums.
template <class Near>
int volume_sign(const PlaneBody& body, const Near& near) {
  double sum = 0, magnitude = 0;
  std::size_t terms = 0;
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    const auto loop = body.loops[f];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i, ++terms) {
      const auto &p = near(index(loop[0])), &q = near(index(loop[i])), &r = near(index(loop[i + 1]));
      sum += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) + p.z * (q.x * r.y - q.y * r.x);
      magnitude += std::fabs(p.x) * (std::fabs(q.y * r.z) + std::fabs(q.z * r.y)) + std::fabs(p.y) * (std::fabs(q.z * r.x) + std::fabs(q.x * r.z)) +
                   std::fabs(p.z) * (std::fabs(q.x * r.y) + std::fabs(q.y * r.x));
    }
  }
  const double bound = (static_cast<double>(terms) + 16) * 0x1p-52 * magnitude + 0x1p-900;
  if (sum > bound) return 1;
  if (sum < -bound) return -1;
  return exact_volume(body).sign();
}

template <class S>
std::string fault_over(const PlaneBody& body, const MeshTopology& topology) {
  const auto planes = FieldOf<S>::planes(body);
  if (Fault fault = planar_fault(planes, body.loops, body.triples); !fault.empty()) return fault;
  const LocatedPoints<S> points(body);
  if (const auto bad = findings_of_facets(points); !bad.empty()) return bad.front().element + ": " + bad.front().message;
  if (const auto contact = first_contact(points, body)) {
    return facet_name(contact->first) + " and " + facet_name(contact->second) + ": both contain " + contact->point +
           ", which is on no common vertex or edge";
  }
  if (!topology.closed) return {};
  const auto near = [&](std::size_t v) -> const Point3<double>& { return points.near(v); };
  return volume_sign(points.body(), near) > 0 ? "" : "the normals point inward: the volume is negative";
}

}  // namespace

std::vector<Finding> facet_findings(const PlaneBody& body) {
  if (body.field == Field::rational) return findings_of_facets(LocatedPoints<Rational>(body));
  return findings_of_facets(LocatedPoints<QuadraticField>(body));
}

std::optional<FacetContact> first_facet_contact(const PlaneBody& body) {
  if (body.field == Field::rational) return first_contact(LocatedPoints<Rational>(body), body);
  return first_contact(LocatedPoints<QuadraticField>(body), body);
}

std::string embedded_fault(const PlaneBody& body) {
  const MeshTopology topology = analyse_topology(body.loops, body.vertex_count());
  for (const Finding& f : topology.findings) {
    if (f.code == "HasBoundary") continue;
    return f.element + (f.element.empty() ? "" : ": ") + f.message;
  }
  return body.field == Field::rational ? fault_over<Rational>(body, topology) : fault_over<QuadraticField>(body, topology);
}

}  // namespace hexact
