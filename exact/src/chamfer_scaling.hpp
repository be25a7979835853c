// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/chamfer.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hexact::detail {

/// The coefficients of all planes of a level for quick access.
class Coefficients {
 public:
  explicit Coefficients(const ChamferLevel& level);

  /// Whether all scaled planes fit 62 bits, and so all coefficients.
  [[nodiscard]] bool are_words() const noexcept { return words_; }
  /// Precondition: are_words().
  [[nodiscard]] std::int64_t word(std::uint32_t f) const noexcept {
    if (f < factor_words_.size()) return factor_words_[f];
    return weight_words_[step_of(f)];
  }
  [[nodiscard]] Integer integer(std::uint32_t f) const;

 private:
  /// The chamfer step that made facet f, from 1. Three quarters of all facets are of the last step.
  [[nodiscard]] std::size_t step_of(std::uint32_t f) const noexcept {
    std::size_t k = ends_.size();
    while (f < ends_[k - 1]) --k;
    return k;
  }

  const ChamferLevel& level_;
  bool words_ = false;
  std::vector<std::size_t> ends_;  ///< number of facets before step k + 1
  std::vector<std::int64_t> factor_words_, weight_words_;
};

}  // namespace hexact::detail
