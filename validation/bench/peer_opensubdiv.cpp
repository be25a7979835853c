// SPDX-License-Identifier: GPL-3.0-or-later
// peer_opensubdiv LEVEL: OpenSubdiv's uniform Catmull–Clark refinement of the cube, topology and double coordinates.
#include "measure.hpp"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <memory>
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

constexpr std::array<int, 6> kSizes = {4, 4, 4, 4, 4, 4};
constexpr std::array<int, 24> kCorners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};

std::unique_ptr<Far::TopologyRefiner> cube_refiner() {
  Far::TopologyDescriptor cube;
  cube.numVertices = 8;
  cube.numFaces = static_cast<int>(kSizes.size());
  cube.numVertsPerFace = kSizes.data();
  cube.vertIndicesPerFace = kCorners.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  return std::unique_ptr<Far::TopologyRefiner>(
      Factory::Create(cube, Factory::Options(Sdc::SCHEME_CATMARK, Sdc::Options())));
}

}  // namespace

int main(int argc, char** argv) {
  const int level = argc == 2 ? std::atoi(argv[1]) : 0;
  if (level < 1) {
    std::cerr << "usage: peer_opensubdiv LEVEL\n";
    return 2;
  }
  bench::Measure measure;
  const std::unique_ptr<Far::TopologyRefiner> refiner = cube_refiner();
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(level));
  std::vector<Vertex> points(static_cast<std::size_t>(refiner->GetNumVerticesTotal()));
  for (int i = 0; i < 8; ++i) {
    points[static_cast<std::size_t>(i)] = {(i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0};
  }
  const Far::PrimvarRefinerReal<double> interpolation(*refiner);
  Vertex* source = points.data();
  for (int l = 1; l <= level; ++l) {
    Vertex* target = source + refiner->GetLevel(l - 1).GetNumVertices();
    interpolation.Interpolate(l, source, target);
    source = target;
  }
  measure.stop();
  measure.print("OpenSubdiv uniform Catmull-Clark, double", static_cast<std::size_t>(refiner->GetLevel(level).GetNumFaces()), 1);
  return 0;
}
