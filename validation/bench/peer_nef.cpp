// SPDX-License-Identifier: GPL-3.0-or-later
// peer_nef FILE.planes: the same solid cut by cut from its level 0, as CGAL Nef polyhedra.
#include "measure.hpp"
#include "read_planes.hpp"

#include <CGAL/Exact_integer.h>
#include <CGAL/Homogeneous.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/generators.h>

#include <exception>
#include <iostream>

namespace {

// The fastest of CGAL's exact kernels here (measured beside Epeck, Homogeneous<Gmpz> and Cartesian<Gmpq>).
using Number = CGAL::Exact_integer;
using Kernel = CGAL::Homogeneous<Number>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

/// A cube that holds every body of the benchmarks: half side 2^40 in the coordinates of the planes.
Nef big_box() {
  const Number s("1099511627776");
  const auto p = [&](int x, int y, int z) { return Kernel::Point_3(Number(x * s), Number(y * s), Number(z * s), Number(1)); };
  CGAL::Polyhedron_3<Kernel> box;
  CGAL::make_hexahedron(p(-1, -1, -1), p(1, -1, -1), p(1, 1, -1), p(-1, 1, -1), p(-1, 1, 1), p(-1, -1, 1), p(1, -1, 1),
                        p(1, 1, 1), box);
  for (auto f = box.facets_begin(); f != box.facets_end(); ++f) {
    const auto h = f->halfedge();
    f->plane() = Kernel::Plane_3(h->vertex()->point(), h->next()->vertex()->point(), h->next()->next()->vertex()->point());
  }
  return Nef(box);
}

void cut(Nef& solid, const bench::PlaneLine& line) {
  const auto& [a, b, c, d] = line.abcd;
  const Number offset = -Number(d);
  const Kernel::Plane_3 plane(Number(a), Number(b), Number(c), offset);
  solid = solid.intersection(plane, Nef::CLOSED_HALFSPACE);
}

int run(const std::string& path) {
  const std::vector<bench::PlaneLine> lines = bench::read_planes(path);
  Nef solid = big_box();
  for (const bench::PlaneLine& line : lines) {
    if (line.level == 0) cut(solid, line);
  }
  bench::Measure measure;
  for (const bench::PlaneLine& line : lines) {
    if (line.level != 0) cut(solid, line);
  }
  measure.stop();
  measure.print("CGAL Nef polyhedra, cut by cut", solid.number_of_facets(), 1);
  return solid.is_simple() && solid.number_of_facets() == lines.size() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: peer_nef FILE.planes\n";
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "peer_nef: " << error.what() << "\n";
    return 3;
  }
}
