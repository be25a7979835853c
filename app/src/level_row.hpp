// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/kernel/honeycomb_statistics.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>

namespace hexact::app {

struct LevelCounts {
  std::uint32_t level = 0;
  std::size_t vertices = 0, edges = 0, facets = 0;
};

/// What a report says of a level under every scheme; `delta` is null until a scheme fills it.
inline nlohmann::ordered_json level_row(const LevelCounts& n, double seconds, const HoneycombStatistics& s) {
  nlohmann::ordered_json row;
  row["level"] = n.level;
  row["vertices"] = n.vertices;
  row["edges"] = n.edges;
  row["faces"] = n.facets;
  row["seconds"] = seconds;
  row["max_normal_angle_deg"] = s.max_normal_angle_deg;
  row["median_normal_angle_deg"] = s.median_normal_angle_deg;
  row["longest_edge"] = s.longest_edge;
  row["shortest_edge"] = s.shortest_edge;
  row["max_facet_diameter"] = s.max_facet_diameter;
  row["delta"] = nullptr;
  return row;
}

/// Counts of a map of any scheme.
template <class Map>
LevelCounts counts_of(const Map& map) {
  return {map.level(), map.vertex_count(), map.edge_count(), map.facet_count()};
}

}  // namespace hexact::app
