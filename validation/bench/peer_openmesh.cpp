// SPDX-License-Identifier: GPL-3.0-or-later
// peer_openmesh ITERATIONS: OpenMesh's uniform Loop subdivision of the octahedron, double coordinates.
#include "measure.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <array>
#include <cstdlib>
#include <iostream>

namespace {

struct Doubles : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Doubles>;

void make_octahedron(Mesh& mesh) {
  std::array<Mesh::VertexHandle, 6> v;
  for (int i = 0; i < 6; ++i) {
    Mesh::Point p(0, 0, 0);
    p[i / 2] = i % 2 == 0 ? -1 : 1;
    v[static_cast<std::size_t>(i)] = mesh.add_vertex(p);
  }
  for (std::size_t i = 0; i < 8; ++i) {
    const std::size_t x = i & 1, y = (i >> 1) & 1, z = (i >> 2) & 1;
    // The octant's orientation follows the parity of its signs.
    if ((x + y + z) % 2 == 1) {
      mesh.add_face(v[x], v[2 + y], v[4 + z]);
    } else {
      mesh.add_face(v[x], v[4 + z], v[2 + y]);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int iterations = argc == 2 ? std::atoi(argv[1]) : 0;
  if (iterations < 1) {
    std::cerr << "usage: peer_openmesh ITERATIONS\n";
    return 2;
  }
  Mesh mesh;
  make_octahedron(mesh);
  bench::Measure measure;
  OpenMesh::Subdivider::Uniform::LoopT<Mesh, double> loop;
  loop.attach(mesh);
  loop(static_cast<std::size_t>(iterations));
  loop.detach();
  measure.stop();
  measure.print("OpenMesh Loop, double", mesh.n_faces(), 1);
  return 0;
}
