// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/ids.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hexact {

/// The vertex loops of all facets, one after another: loop f is counter-clockwise seen from outside.
/// An empty loop stands for a plane without a facet.
class FacetLoops {
 public:
  void reserve(std::size_t facets, std::size_t corners) {
    starts_.reserve(facets + 1);
    corners_.reserve(corners);
  }
  void add(std::span<const VertexId> loop) {
    corners_.insert(corners_.end(), loop.begin(), loop.end());
    starts_.push_back(static_cast<std::uint32_t>(corners_.size()));
  }
  /// Appends one corner to the loop that is being built; finish it with `close_loop`.
  void add_corner(VertexId v) { corners_.push_back(v); }
  void close_loop() { starts_.push_back(static_cast<std::uint32_t>(corners_.size())); }

  [[nodiscard]] std::size_t size() const noexcept { return starts_.size() - 1; }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  /// Sum of all loop lengths = number of half-edges.
  [[nodiscard]] std::size_t corner_count() const noexcept { return corners_.size(); }
  [[nodiscard]] std::span<const VertexId> operator[](std::size_t f) const noexcept {
    return {corners_.data() + starts_[f], corners_.data() + starts_[f + 1]};
  }
  [[nodiscard]] std::span<const VertexId> operator[](FacetId f) const noexcept {
    return (*this)[index(f)];
  }
  /// Number of the half-edge that leaves the first corner of loop f.
  [[nodiscard]] std::size_t start(std::size_t f) const noexcept { return starts_[f]; }
  [[nodiscard]] std::span<const VertexId> corners() const noexcept { return corners_; }

  friend bool operator==(const FacetLoops&, const FacetLoops&) = default;

 private:
  std::vector<std::uint32_t> starts_{0};
  std::vector<VertexId> corners_;
};

}  // namespace hexact
