// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace hexact {

/// Position of a vertex in a mesh, 0-based.
enum class VertexId : std::uint32_t {};
/// Position of a facet (and of its plane) in a mesh, 0-based.
enum class FacetId : std::uint32_t {};
/// Position of a half-edge, 0-based; half-edges are stored facet by facet.
enum class HalfEdgeId : std::uint32_t {};

template <class Id>
concept IndexType = requires(Id id) { static_cast<std::uint32_t>(id); } && sizeof(Id) == 4;

/// The plain number behind a typed index, for subscripting.
template <IndexType Id>
[[nodiscard]] constexpr std::size_t index(Id id) noexcept {
  return static_cast<std::size_t>(static_cast<std::uint32_t>(id));
}

/// Makes a typed index from a plain number; the caller guarantees that it fits 32 bits.
template <IndexType Id>
[[nodiscard]] constexpr Id make_id(std::size_t i) noexcept {
  return static_cast<Id>(static_cast<std::uint32_t>(i));
}

}  // namespace hexact
