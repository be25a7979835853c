// SPDX-License-Identifier: GPL-3.0-or-later
// peer_catmull_clark ITERATIONS: CGAL's Catmull–Clark subdivision of the cube, double coordinates, on a Surface_mesh.
#include "measure.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  const int iterations = argc == 2 ? std::atoi(argv[1]) : 0;
  if (iterations < 1) {
    std::cerr << "usage: peer_catmull_clark ITERATIONS\n";
    return 2;
  }
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  CGAL::Surface_mesh<Point> mesh;
  CGAL::make_hexahedron(Point(-1, -1, -1), Point(1, -1, -1), Point(1, 1, -1), Point(-1, 1, -1), Point(-1, 1, 1),
                        Point(-1, -1, 1), Point(1, -1, 1), Point(1, 1, 1), mesh);
  bench::Measure measure;
  CGAL::Subdivision_method_3::CatmullClark_subdivision(mesh, CGAL::parameters::number_of_iterations(iterations));
  measure.stop();
  measure.print("CGAL Catmull-Clark, double", mesh.number_of_faces(), 1);
  return 0;
}
