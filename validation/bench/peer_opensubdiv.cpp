// SPDX-License-Identifier: GPL-3.0-or-later
// peer_opensubdiv LEVEL [loop]: OpenSubdiv's uniform refinement, topology and double coordinates of all levels:
// Catmull–Clark of the cube, or Loop of the octahedron.
#include "measure.hpp"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// A point as OpenSubdiv's primvar interface wants it.
struct Vertex {
  double x = 0, y = 0, z = 0;
  void Clear(void* = nullptr) { x = y = z = 0; }
  void AddWithWeight(const Vertex& source, double weight) {
    x += weight * source.x;
    y += weight * source.y;
    z += weight * source.z;
  }
};

/// A start mesh and the scheme that refines it.
struct Task {
  const char* name;
  Sdc::SchemeType scheme;
  std::vector<Vertex> points;
  std::vector<int> sizes, corners;
};

Task catmull_clark_of_cube() {
  Task task{"OpenSubdiv uniform Catmull-Clark, double", Sdc::SCHEME_CATMARK, {}, std::vector<int>(6, 4),
            {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5}};
  for (int i = 0; i < 8; ++i) {
    task.points.push_back({(i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0});
  }
  return task;
}

Task loop_of_octahedron() {
  return {"OpenSubdiv uniform Loop, double", Sdc::SCHEME_LOOP,
          {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, std::vector<int>(8, 3),
          {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};
}

std::unique_ptr<Far::TopologyRefiner> refiner_of(const Task& task) {
  Far::TopologyDescriptor mesh;
  mesh.numVertices = static_cast<int>(task.points.size());
  mesh.numFaces = static_cast<int>(task.sizes.size());
  mesh.numVertsPerFace = task.sizes.data();
  mesh.vertIndicesPerFace = task.corners.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(mesh, Factory::Options(task.scheme, Sdc::Options())));
}

}  // namespace

int main(int argc, char** argv) {
  const int level = argc >= 2 ? std::atoi(argv[1]) : 0;
  const bool loop = argc == 3 && std::string(argv[2]) == "loop";
  if (level < 1 || argc > (loop ? 3 : 2)) {
    std::cerr << "usage: peer_opensubdiv LEVEL [loop]\n";
    return 2;
  }
  const Task task = loop ? loop_of_octahedron() : catmull_clark_of_cube();
  bench::Measure measure;
  const std::unique_ptr<Far::TopologyRefiner> refiner = refiner_of(task);
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(level));
  std::vector<Vertex> points(static_cast<std::size_t>(refiner->GetNumVerticesTotal()));
  std::copy(task.points.begin(), task.points.end(), points.begin());
  const Far::PrimvarRefinerReal<double> interpolation(*refiner);
  Vertex* source = points.data();
  for (int l = 1; l <= level; ++l) {
    Vertex* target = source + refiner->GetLevel(l - 1).GetNumVertices();
    interpolation.Interpolate(l, source, target);
    source = target;
  }
  measure.stop();
  measure.print(task.name, static_cast<std::size_t>(refiner->GetLevel(level).GetNumFaces()), 1);
  return 0;
}
