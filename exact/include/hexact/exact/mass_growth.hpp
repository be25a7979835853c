// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/eigenvalues.hpp"
#include "hexact/exact/integer.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace hexact {

/// Weights q(−L) … q(L), all positive, of sum 1: the law of a step D. They define the random number
/// Y = D_1/2 + D_2/4 + …, |Y| <= L, of independent steps, whose law ν is the limit of repeated smoothing.
using StepLaw = std::vector<Rational>;

/// A square matrix, rows one after the other.
using RationalMatrix = std::vector<Rational>;

/// T_0 and T_1 with T_e[i, l] = q(2i + e − l), i and l from −L to L − 1. The vector of the masses ν(l + J) of a dyadic
/// interval J in [0, 1) becomes by T_e that of the interval (e + J)/2.
[[nodiscard]] std::array<RationalMatrix, 2> digit_matrices(const StepLaw& law);

/// Evidence for low < ρ <= high, ρ being the joint spectral radius of T_0 and T_1: masses of dyadic intervals of length
/// 2^−n are at most C high^n, and those of some are more than c low^n.
struct MassGrowth {
  /// A vertex of the polytope, whose scale does not matter: T_digit of an earlier vertex, divided by `high` and rounded
  /// up to integers. The first vertex comes from none; it is positive.
  struct Vertex {
    std::size_t parent = 0;
    int digit = 0;
    std::vector<Integer> entries;
  };
  /// T_digit v <= high · Σ weight · vertex, weights positive and of sum 1.
  struct Image {
    std::size_t vertex = 0;
    int digit = 0;
    std::vector<std::pair<std::size_t, Rational>> combination;
  };
  RationalInterval bounds;      ///< low, high
  std::vector<int> word;        ///< the product T_word[0] T_word[1] … has an eigenvalue greater than low^length
  std::vector<Vertex> vertices;
  std::vector<Image> images;    ///< of each vertex and digit that no later vertex comes from, in order
};

/// Finds evidence with high/low − 1 < 2^−90. The product is the best of all words of up to four digits; the polytope
/// grows from its leading eigenvector until all images are inside (Guglielmi and Protasov 2013). Inside is decided by a
/// linear program in exact numbers. Throws NumericalFailure if it has not closed at 64 vertices (then the product
/// is not the one that grows most), or if that eigenvector is not positive. Cost: milliseconds for L = 2.
[[nodiscard]] MassGrowth find_mass_growth(const StepLaw& law);

/// What is wrong with the evidence; empty if nothing is. Exact throughout. In addition to what the proof needs, the
/// bounds must agree to 2^−64 and the vertices must be rounded as said above, so that there is no number in it that
/// does not matter.
[[nodiscard]] std::string mass_growth_fault(const StepLaw& law, const MassGrowth& growth);

}  // namespace hexact
