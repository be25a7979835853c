// SPDX-License-Identifier: LGPL-3.0-or-later
// pinwheel INPUT.planes OUTPUT.planes [LEVELS]: refines a solid with a cut policy of our own, exactly.
#include <hexact/exact/cut_policy.hpp>
#include <hexact/exact/honeycomb.hpp>
#include <hexact/io/mesh_file.hpp>
#include <hexact/kernel/errors.hpp>

#include <cstdlib>
#include <iostream>
#include <variant>

namespace {

using hexact::QuadraticField;
using hexact::Rational;

QuadraticField fraction(int numerator, int denominator) { return QuadraticField(Rational(numerator) / Rational(denominator)); }

/// The policy: λ for the half-edge a→b says where the cut of corner a meets the edge, at λ·a + (1 − λ)·b. Along an edge
/// between an older and a newer panel we take more in one direction than in the other, so that the new panels turn
/// around the old ones like a pinwheel. Triangles allow little freedom (their λ must stay near 2/5). Nothing has to be proved here: a step decides
/// exactly whether the parameters are admissible.
QuadraticField pinwheel(const hexact::HoneycombMap& map, hexact::HalfEdgeId half_edge) {
  const auto h = static_cast<std::uint32_t>(half_edge);
  const std::uint32_t left = map.facet(h);
  const std::uint32_t right = map.facet(map.twin(h));
  if (map.facet_size(left) == 3 || map.facet_size(right) == 3) return fraction(2, 5);
  const std::uint32_t left_level = map.facet_level(left);
  const std::uint32_t right_level = map.facet_level(right);
  if (left_level == right_level) return fraction(1, 4);
  return left_level < right_level ? fraction(3, 8) : fraction(1, 8);
}

int refine(const char* input, const char* output, int levels) {
  const hexact::io::Geometry geometry = hexact::io::read_geometry(input);
  const auto* body = std::get_if<hexact::PlaneBody>(&geometry);
  if (body == nullptr) {
    std::cerr << input << " is not a .planes file\n";
    return EXIT_FAILURE;
  }
  hexact::HoneycombLevel<Rational> level = hexact::honeycomb_start<Rational>(*body);
  const hexact::CutPolicy policy = hexact::HalfEdgePolicy(pinwheel);
  for (int k = 1; k <= levels; ++k) {
    hexact::HoneycombStep<Rational> step = hexact::honeycomb_step(level, policy);
    std::cout << "level " << k << ": " << step.level.planes.size() << " panels, smallest gap "
              << step.figures.min_gap.str() << "\n";
    level = std::move(step.level);
  }
  hexact::io::write_planes(output, hexact::to_plane_body(level));
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: pinwheel INPUT.planes OUTPUT.planes [LEVELS]\n";
    return EXIT_FAILURE;
  }
  try {
    return refine(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 3);
  } catch (const hexact::Error& error) {
    std::cerr << error.code() << ": " << error.what() << "\n";
    return EXIT_FAILURE;
  }
}
