// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/midedge_facet_limits.hpp"

#include "hexact/exact/midedge_boundary_limit.hpp"
#include "hexact/kernel/midedge_counts.hpp"
#include "hexact/kernel/midedge_part.hpp"
#include "hexact/kernel/parallel.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace hexact {
namespace {

using Level = MidedgeLevel<Rational>;
using Point = Point3<Rational>;
using FacetLimit = std::optional<MidedgeLimit>;

constexpr std::size_t kGrain = 16;
constexpr std::size_t kBatch = 4096;       ///< facets refined together: bounds the memory
constexpr unsigned kMostDropSteps = 8;     ///< a facet that has no two rings by then never gets them
constexpr std::size_t kLongestRun = 200;   ///< of boundary vertices with two edges, under `close`: n of them last n steps

/// What is known of a facet on some level.
enum class Stage : std::uint8_t {
  waiting,      ///< further steps are needed
  inner,        ///< MidedgeLimits has its limit
  at_boundary,  ///< MidedgeBoundaryLimits has it
  mean,         ///< the mean of its corners is the limit, without normal
  endless,      ///< it would take too many steps
  never,
};

/// Corners in a row with both sides on the boundary. Precondition: the facet does not stand alone.
std::size_t longest_run(const MidedgeBoundaryPattern& pattern) {
  std::size_t longest = 0, run = 0;
  for (std::size_t i = 0; i < 2 * pattern.size(); ++i) {
    const bool on_boundary = pattern[i % pattern.size()] == MidedgeCorner::rim;
    run = on_boundary ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest == 0 ? 0 : longest - 1;  // the first of the sides has a corner with another edge
}

Stage stage_of(const MidedgeMap& map, std::uint32_t f, const MidedgeLimitPlan& plan) {
  const MidedgeBoundaryPattern pattern = midedge_boundary_pattern(map, f);
  const bool simple = plan.rule == MidedgeRule::simple;
  if (!touches_boundary(pattern)) return simple || !midedge_net(map, f).empty() ? Stage::inner : Stage::waiting;
  if (plan.boundary == MidedgeBoundary::drop) return simple ? Stage::mean : Stage::never;
  if (stands_alone(pattern)) return Stage::mean;
  if (plan.boundary == MidedgeBoundary::close) return longest_run(pattern) <= kLongestRun ? Stage::waiting : simple ? Stage::mean : Stage::endless;
  if (simple) return Stage::mean;
  return midedge_boundary_net(map, f) ? Stage::at_boundary : Stage::waiting;
}

Point mean_of(const Level& level, std::span<const std::uint32_t> vertices) {
  Point sum;
  for (const std::uint32_t v : vertices) {
    const Point& p = level.points[v];
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  }
  const Rational n(static_cast<long>(vertices.size()));
  return {sum.x / n, sum.y / n, sum.z / n};
}

/// Facets of a level, and where their limits go in the result.
struct Pending {
  std::vector<std::uint32_t> facets, slots;
};

/// Limits of facets, level by level.
class LimitSearch {
 public:
  LimitSearch(const MidedgeLimitPlan& plan, std::size_t count, const ProgressPart& progress)
      : plan_(plan), progress_(progress), inner_(plan.rule), at_boundary_(progress), results_(count) {}

  std::vector<FacetLimit> run(const Level& level, std::span<const std::uint32_t> facets) {
    Pending all{{facets.begin(), facets.end()}, std::vector<std::uint32_t>(facets.size())};
    std::iota(all.slots.begin(), all.slots.end(), 0u);
    progress_.report(0);
    const Pending waiting = settle(level, all);
    for (std::size_t begin = 0; begin < waiting.facets.size(); begin += kBatch) {
      const auto batch = [&](const std::vector<std::uint32_t>& list) {
        return std::vector<std::uint32_t>(list.begin() + static_cast<std::ptrdiff_t>(begin),
                                          list.begin() + static_cast<std::ptrdiff_t>(std::min(begin + kBatch, list.size())));
      };
      progress_.report(static_cast<double>(begin) / static_cast<double>(waiting.facets.size()));
      refine(level, {batch(waiting.facets), batch(waiting.slots)});
    }
    progress_.report(1);
    return std::move(results_);
  }

 private:
  /// Two steps at a time, until all limits are there or given up.
  void refine(const Level& level, Pending pending) {
    std::optional<Level> part;
    for (unsigned steps = 0; !pending.facets.empty() && !given_up(steps); steps += 2) {
      progress_.check();
      part = stepped_part(part ? *part : level, pending.facets);
      std::iota(pending.facets.begin(), pending.facets.end(), 0u);
      pending = settle(*part, pending);
    }
  }
  [[nodiscard]] Pending settle(const Level& level, const Pending& pending);
  [[nodiscard]] FacetLimit limit(const Level& level, std::uint32_t f, Stage stage) const;
  [[nodiscard]] bool given_up(unsigned steps) const;
  [[nodiscard]] Level stepped_part(const Level& level, std::span<const std::uint32_t> facets) const;

  const MidedgeLimitPlan plan_;
  const ProgressPart progress_;
  MidedgeLimits inner_;
  MidedgeBoundaryLimits at_boundary_;
  std::vector<FacetLimit> results_;
};

/// Names the smallest facet, whichever thread met one first.
void refuse_endless(std::span<const std::uint32_t> facets, std::span<const Stage> stage) {
  std::optional<std::uint32_t> first;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (stage[i] == Stage::endless) first = std::min(first.value_or(facets[i]), facets[i]);
  }
  if (!first) return;
  throw ResourceLimit("limit points need more than " + std::to_string(kLongestRun) + " further steps: " + facet_name(*first) +
                      " has as many boundary vertices with two edges in a row");
}

/// Takes the limits that the level gives; returns what has to wait.
Pending LimitSearch::settle(const Level& level, const Pending& pending) {
  const std::vector<std::uint32_t>& facets = pending.facets;
  std::vector<Stage> stage(facets.size());
  for_ranges(facets.size(), kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i != end; ++i) stage[i] = stage_of(level.map, facets[i], plan_);
  });
  refuse_endless(facets, stage);
  Pending waiting;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (stage[i] == Stage::inner) inner_.prepare(level.map.facet_size(facets[i]));
    if (stage[i] == Stage::at_boundary) at_boundary_.prepare(midedge_boundary_pattern(level.map, facets[i]));
    if (stage[i] != Stage::waiting) continue;
    waiting.facets.push_back(facets[i]);
    waiting.slots.push_back(pending.slots[i]);
  }
  for_ranges(facets.size(), kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i != end; ++i) {
      if (stage[i] != Stage::waiting) results_[pending.slots[i]] = limit(level, facets[i], stage[i]);
    }
  });
  return waiting;
}

FacetLimit LimitSearch::limit(const Level& level, std::uint32_t f, Stage stage) const {
  progress_.check();
  switch (stage) {
    case Stage::inner:
      return inner_(level, f);
    case Stage::at_boundary:
      if (auto point = at_boundary_(level, f)) return MidedgeLimit{std::move(*point), std::nullopt};
      return std::nullopt;
    case Stage::mean:
      return MidedgeLimit{mean_of(level, level.map.loop(f)), std::nullopt};
    case Stage::endless:
    case Stage::waiting:
    case Stage::never:
      break;
  }
  return std::nullopt;
}

bool LimitSearch::given_up(unsigned steps) const {
  if (plan_.boundary == MidedgeBoundary::drop) return steps >= kMostDropSteps;
  HEXACT_INVARIANT(steps < kLongestRun + 16);
  return false;
}

/// Refuses further steps that would make too many facets.
void check_room(const MidedgeMap& map, unsigned steps, const MidedgeLimitPlan& plan) {
  const MidedgeCounts next = midedge_counts_after(map, steps, plan.boundary);
  if (next.facets <= static_cast<double>(plan.most_facets)) return;
  throw ResourceLimit("limit points need further steps of the mesh until two rings of quadrilaterals surround each facet, to " +
                      std::to_string(static_cast<std::size_t>(next.facets)) + " facets; at most " + std::to_string(plan.most_facets) +
                      " are allowed");
}

/// Two steps of the facets and two rings around them; they become the first facets.
Level LimitSearch::stepped_part(const Level& level, std::span<const std::uint32_t> facets) const {
  MidedgePart part = midedge_part(level.map, facets, 2);
  const bool dropping = plan_.boundary == MidedgeBoundary::drop;  // then only one step is counted exactly
  check_room(part.map, dropping ? 1 : 2, plan_);
  Level cut{std::move(part.map), {}};
  for (const std::uint32_t v : part.vertices) cut.points.push_back(level.points[v]);
  if (plan_.boundary == MidedgeBoundary::dual) return midedge_double_step(cut, plan_.rule);
  const Level next = midedge_step(cut, plan_.rule, plan_.boundary);
  if (dropping) check_room(next.map, 1, plan_);
  return midedge_step(next, plan_.rule, plan_.boundary);
}

constexpr std::uint32_t kNoFacet = UINT32_MAX;

/// The facets of a next level that vertices and edges of this one became.
struct Successors {
  std::vector<std::uint32_t> of_vertex, of_edge;
};

Successors successors(const MidedgeMap& before, const MidedgeMap& after) {
  Successors result{std::vector<std::uint32_t>(before.vertex_count(), kNoFacet), std::vector<std::uint32_t>(before.edge_count(), kNoFacet)};
  for (auto f = static_cast<std::uint32_t>(before.facet_count()); f < after.facet_count(); ++f) {
    const FacetAddress address = after.address(f);
    auto& list = address.level == before.level() + 1 ? result.of_vertex : result.of_edge;
    list[index(*address.parent)] = f;
  }
  return result;
}

/// The facet that stands in the middle of f1, e1, f2, …, fm around a boundary vertex. `start` begins its fan.
std::uint32_t middle_of_fan(const MidedgeMap& map, std::uint32_t start, const RawVector<std::uint32_t>& edge, const Successors& next) {
  std::vector<std::uint32_t> fan;
  for (std::uint32_t h = start; h != kNoTwin; h = map.twin(map.previous(h))) fan.push_back(h);
  const std::size_t half = fan.size() / 2;
  return fan.size() % 2 == 1 ? map.facet(fan[half]) : next.of_edge[edge[fan[half]]];
}

std::vector<Point> closed_vertex_limits(const Level& level, const MidedgeLimitPlan& plan, const ProgressPart& progress) {
  std::vector<std::uint32_t> facets(level.map.vertex_count());
  std::iota(facets.begin(), facets.end(), static_cast<std::uint32_t>(level.map.facet_count()));
  std::vector<Point> points;
  for (auto& limit : midedge_facet_limits(midedge_step(level, plan.rule, MidedgeBoundary::close), plan, facets, progress)) {
    HEXACT_INVARIANT(limit.has_value());
    points.push_back(std::move(limit->point));
  }
  return points;
}

std::vector<Point> dual_vertex_limits(const Level& level, const MidedgeLimitPlan& plan, const ProgressPart& progress) {
  const MidedgeMap& map = level.map;
  const Level next = midedge_double_step(level, plan.rule);
  const Successors became = successors(map, next.map);
  const std::vector<std::uint32_t> start = map.fan_starts();
  const RawVector<std::uint32_t> edge = map.edge_numbers();
  // Several boundary vertices may go to the limit of one facet.
  std::vector<std::uint32_t> facets, slot_of_facet(next.map.facet_count(), kNoFacet), slot_of_vertex;
  for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
    const bool inner = map.twin(start[v]) != kNoTwin;
    const std::uint32_t f = inner ? became.of_vertex[v] : middle_of_fan(map, start[v], edge, became);
    if (slot_of_facet[f] == kNoFacet) {
      slot_of_facet[f] = static_cast<std::uint32_t>(facets.size());
      facets.push_back(f);
    }
    slot_of_vertex.push_back(slot_of_facet[f]);
  }
  const std::vector<FacetLimit> limits = midedge_facet_limits(next, plan, facets, progress);
  std::vector<Point> points;
  for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
    const FacetLimit& limit = limits[slot_of_vertex[v]];
    if (!limit) {
      throw ResourceLimit(vertex_name(v) + " goes to the limit of a facet at the boundary whose limit depends on more than " +
                          std::to_string(MidedgeBoundaryLimits::kLargestNet) + " vertices: too many for exact elimination");
    }
    points.push_back(limit->point);
  }
  return points;
}

/// Sends the vertices of each boundary loop to their mean.
void contract_boundary_loops(const Level& level, std::vector<Point>& points) {
  const MidedgeMap& map = level.map;
  std::vector<std::uint32_t> leaving(map.vertex_count(), kNoTwin);
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    if (map.twin(h) == kNoTwin) leaving[map.origin(h)] = h;
  }
  for (std::uint32_t v = 0; v < leaving.size(); ++v) {
    std::vector<std::uint32_t> loop;
    for (std::uint32_t w = v; leaving[w] != kNoTwin;) {
      loop.push_back(w);
      w = map.target(std::exchange(leaving[w], kNoTwin));
    }
    if (loop.empty()) continue;
    const Point mean = mean_of(level, loop);
    for (const std::uint32_t w : loop) points[w] = mean;
  }
}

std::vector<Point> close_vertex_limits(const Level& level, const MidedgeLimitPlan& plan, const ProgressPart& progress) {
  const MidedgeMap& map = level.map;
  const Level next = midedge_step(level, plan.rule, MidedgeBoundary::close);
  const Successors became = successors(map, next.map);
  const std::vector<std::uint32_t> start = map.fan_starts();
  std::vector<std::uint32_t> vertices, facets;
  for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
    if (map.twin(start[v]) == kNoTwin) continue;
    vertices.push_back(v);
    facets.push_back(became.of_vertex[v]);
  }
  std::vector<Point> points(map.vertex_count());
  std::vector<FacetLimit> limits = midedge_facet_limits(next, plan, facets, progress);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    HEXACT_INVARIANT(limits[i].has_value());
    points[vertices[i]] = std::move(limits[i]->point);
  }
  contract_boundary_loops(level, points);
  return points;
}

}  // namespace

std::vector<std::optional<MidedgeLimit>> midedge_facet_limits(const MidedgeLevel<Rational>& level, const MidedgeLimitPlan& plan,
                                                              std::span<const std::uint32_t> facets, const ProgressPart& progress) {
  return LimitSearch(plan, facets.size(), progress).run(level, facets);
}

void require_vertex_limits(const MidedgeMap& map, MidedgeBoundary boundary) {
  if (map.closed() || boundary != MidedgeBoundary::drop) return;
  std::uint32_t h = 0;
  while (map.twin(h) != kNoTwin) ++h;
  throw InvalidInput("HasBoundary", "has a facet on one side only: under the policy drop nothing is known of the limits of boundary vertices; "
                     "use dual or close", edge_name(map.origin(h), map.target(h)));
}

std::vector<Point3<Rational>> midedge_vertex_limits(const MidedgeLevel<Rational>& level, const MidedgeLimitPlan& plan,
                                                    const ProgressPart& progress) {
  require_vertex_limits(level.map, plan.boundary);
  if (level.map.closed()) return closed_vertex_limits(level, plan, progress);
  return plan.boundary == MidedgeBoundary::dual ? dual_vertex_limits(level, plan, progress) : close_vertex_limits(level, plan, progress);
}

}  // namespace hexact
