// SPDX-License-Identifier: GPL-3.0-or-later
// peer_halfspaces FILE.planes: CGAL's halfspace_intersection_3 over the exact-constructions kernel.
#include "measure.hpp"
#include "read_planes.hpp"

#include <CGAL/Convex_hull_3/dual/halfspace_intersection_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <random>

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Short numbers as doubles, which they equal and which CGAL filters best; longer ones exactly.
Kernel::FT number(const std::string& text) {
  if (text.size() <= 15) return Kernel::FT(std::stod(text));
  return Kernel::FT(CGAL::Exact_rational(text));
}

int run(const std::string& path) {
  std::vector<bench::PlaneLine> lines = bench::read_planes(path);
  // The incremental hull behind the intersection wants its input in random order.
  std::shuffle(lines.begin(), lines.end(), std::mt19937_64(5));
  std::vector<Kernel::Plane_3> planes;
  planes.reserve(lines.size());
  bool origin_inside = true;
  for (const bench::PlaneLine& line : lines) {
    const auto& [a, b, c, d] = line.abcd;
    origin_inside = origin_inside && d[0] != '-' && d != "0";
    planes.emplace_back(number(a), number(b), number(c), -number(d));
  }
  // Where the origin is no interior point CGAL has to find one, which is part of its work.
  boost::optional<Kernel::Point_3> inside;
  if (origin_inside) inside = Kernel::Point_3(0, 0, 0);
  constexpr std::size_t kBytesPerPlane = 13000;  // its own: measured
  bench::Measure measure(kBytesPerPlane * planes.size());
  Mesh mesh;
  CGAL::halfspace_intersection_3(planes.begin(), planes.end(), mesh, inside);
  measure.stop();
  measure.print("CGAL halfspace_intersection_3, Epeck", mesh.number_of_faces(), 1);
  return mesh.number_of_faces() == planes.size() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: peer_halfspaces FILE.planes\n";
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "peer_halfspaces: " << error.what() << "\n";
    return 3;
  }
}
