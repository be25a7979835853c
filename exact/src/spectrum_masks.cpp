// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/spectrum_masks.hpp"

#include "hexact/kernel/errors.hpp"

namespace hexact {
namespace {

constexpr std::size_t kLargestBlock = 64;

[[noreturn]] void refuse(const std::string& message, int valence) {
  throw InvalidInput("BadMask", message, "valence " + std::to_string(valence));
}

void require_count(const ExtraordinaryMask& mask, std::size_t n) {
  if (mask.weights.size() == n) return;
  refuse(std::to_string(n) + " weights are expected, " + std::to_string(mask.weights.size()) + " are given", mask.valence);
}

SubdivisionMatrix with_centre(SubdivisionMatrix m, const ExtraordinaryMask& mask, bool faces) {
  require_count(mask, faces ? 3 : 2);
  m.centre = {mask.weights[0]};
  m.centre_from[m.index(1, 0)] = {mask.weights[1]};
  if (faces) m.centre_from[m.index(1, 1)] = {mask.weights[2]};
  return m;
}

SubdivisionMatrix with_face(SubdivisionMatrix m, const ExtraordinaryMask& mask) {
  const auto k = static_cast<std::size_t>(mask.valence);
  require_count(mask, k);
  for (std::size_t d = 1; d < k; ++d) {
    if (mask.weights[d] != mask.weights[k - d]) refuse("the weights at distances " + std::to_string(d) + " and " + std::to_string(k - d) + " differ", mask.valence);
  }
  std::erase_if(m.local, [](const SectorWeight& w) { return w.row == 0; });
  m.uniform.clear();
  m.harmonic.clear();
  for (std::size_t d = 0; d < k; ++d) {
    if (!mask.weights[d].is_zero()) m.local.push_back({0, 0, static_cast<int>(d), mask.weights[d]});
  }
  return m;
}

SubdivisionMatrix of_blocks(const ExtraordinaryMask& mask) {
  if (mask.blocks.size() != static_cast<std::size_t>(mask.valence)) {
    refuse(std::to_string(mask.valence) + " blocks are expected, " + std::to_string(mask.blocks.size()) + " are given", mask.valence);
  }
  std::size_t n = 1;
  while (n * n < mask.blocks[0].size()) ++n;
  if (n > kLargestBlock) refuse("a block has at most 64 rows", mask.valence);
  SubdivisionMatrix m;
  m.valence = mask.valence;
  for (std::size_t i = 0; i < n; ++i) m.vertices.push_back({static_cast<int>(i), 0});
  m.centre_to.resize(n);
  for (std::size_t d = 0; d < mask.blocks.size(); ++d) {
    if (mask.blocks[d].size() != n * n) refuse("block " + std::to_string(d) + " is no square of the size of the first", mask.valence);
    for (std::size_t i = 0; i < n * n; ++i) {
      if (!mask.blocks[d][i].is_zero()) m.local.push_back({i / n, i % n, static_cast<int>(d), mask.blocks[d][i]});
    }
  }
  return m;
}

}  // namespace

SpectrumSubject mask_subject(const MasksDocument& document, const ExtraordinaryMask& mask) {
  if (mask.valence < 3) refuse("a valence is at least 3", mask.valence);
  SpectrumSubject subject;
  subject.regular = document.scheme;
  if (!document.scheme) {
    subject.matrix = of_blocks(mask);
  } else {
    SubdivisionMatrix m = subdivision_matrix(*document.scheme, mask.valence, ring_reach(*document.scheme));
    switch (*document.scheme) {
      case SpectrumScheme::loop: subject.matrix = with_centre(std::move(m), mask, false); break;
      case SpectrumScheme::catmull_clark: subject.matrix = with_centre(std::move(m), mask, true); break;
      case SpectrumScheme::doo_sabin: subject.matrix = with_face(std::move(m), mask); break;
      default: refuse(std::string("masks replace a rule of loop, catmull-clark or doo-sabin, not of ") + name_of(*document.scheme), mask.valence);
    }
  }
  subject.matrix.scheme = document.name;
  return subject;
}

}  // namespace hexact
