// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/spectrum.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hexact {

/// A user's rule at one valence: either weights, which take the place of the extraordinary rule of a known scheme, or
/// the blocks of a block-circulant matrix, of which nothing else is known.
struct ExtraordinaryMask {
  int valence = 0;
  /// loop: of the old centre and of each of the k neighbours. catmull-clark: of the old centre, of each neighbour along
  /// an edge, of each across a face. doo-sabin: of the corners at distance 0 … k − 1 in the new corner of the k-gon.
  std::vector<Rational> weights;
  /// D_0 … D_{k−1}, rows one after the other: weights of sector d in sector 0.
  std::vector<std::vector<Rational>> blocks;
};

/// A `masks` document.
struct MasksDocument {
  std::string name;
  std::optional<SpectrumScheme> scheme;  ///< of the rules elsewhere; none when the masks are blocks
  std::vector<ExtraordinaryMask> masks;
};

/// The matrix of one mask. Throws InvalidInput (BadMask), naming the valence, for a wrong number of weights or blocks,
/// weights of a k-gon without mirror image, blocks that are no squares of one size (at most 64).
[[nodiscard]] SpectrumSubject mask_subject(const MasksDocument& document, const ExtraordinaryMask& mask);

}  // namespace hexact
