// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/cut_policy.hpp"

#include <algorithm>
#include <string>

namespace hexact {
namespace {

std::string edge_name(const HoneycombMap& map, std::uint32_t h) {
  const std::uint32_t a = map.origin(h), b = map.target(h);
  return "edge " + std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b));
}

QuadraticField odds(const QuadraticField& x) { return x / (QuadraticField(1) - x); }

bool out_of_range(const QuadraticField& x, const QuadraticField& y) {
  return x.sign() < 0 || y.sign() < 0 || (QuadraticField(1) - x - y).sign() <= 0;
}

Finding range_finding(const HoneycombMap& map, std::uint32_t h, const QuadraticField& x, const QuadraticField& y) {
  return {"ParameterOutOfRange",
          "the parameters " + x.str() + " and " + y.str() + " must be at least 0 with a sum below 1, condition (1)",
          edge_name(map, h), {}};
}

/// Condition (1). A size policy has few values, so one edge of each kind is enough.
void check_ranges(const HoneycombMap& map, const CutPolicy& policy, std::size_t limit, std::vector<Finding>& out) {
  const bool by_size = std::holds_alternative<SizePolicy>(policy);
  const std::size_t base_half_edges =
      map.base_facet_count() == map.facet_count()
          ? map.half_edge_count()
          : map.facet_start(static_cast<std::uint32_t>(map.base_facet_count()));
  // Above level 0 every further half-edge lies between two hexagons, as the last one does.
  const std::size_t count = by_size ? base_half_edges : map.half_edge_count();
  const auto check = [&](std::uint32_t h) {
    const QuadraticField x = asked_parameter(map, policy, h);
    const QuadraticField y = asked_parameter(map, policy, map.twin(h));
    if (out_of_range(x, y)) out.push_back(range_finding(map, h, x, y));
  };
  for (std::uint32_t h = 0; h < count && out.size() < limit; ++h) {
    if (by_size || h < map.twin(h)) check(h);
  }
  if (by_size && count < map.half_edge_count() && out.size() < limit) {
    for (std::uint32_t h = static_cast<std::uint32_t>(map.half_edge_count()); h-- > count;) {
      if (map.facet(h) >= map.base_facet_count() && map.facet(map.twin(h)) >= map.base_facet_count()) {
        check(h);
        break;
      }
    }
  }
}

/// Condition (8): opposite cut lines of a quadrilateral must not both be the diagonal.
bool quad_collapses(const HoneycombMap& map, const CutPolicy& policy, std::uint32_t start) {
  std::array<bool, 4> zero{};
  std::uint32_t h = start;
  for (bool& z : zero) {
    z = asked_parameter(map, policy, h).is_zero() &&
        asked_parameter(map, policy, map.twin(map.previous(h))).is_zero();
    h = map.next(h);
  }
  return (zero[0] && zero[2]) || (zero[1] && zero[3]);
}

/// Condition (10) in the closed form s + t > 1 with odds of the parameters.
bool triangle_is_overcut(const HoneycombMap& map, const CutPolicy& policy, std::uint32_t start) {
  QuadraticField s(0), along(1), against(1);
  std::uint32_t h = start;
  for (int j = 0; j < 3; ++j) {
    const QuadraticField a = odds(asked_parameter(map, policy, h));
    const QuadraticField b = odds(asked_parameter(map, policy, map.twin(h)));
    s += a * b;
    along *= a;
    against *= b;
    h = map.next(h);
  }
  return (s + along + against - QuadraticField(1)).sign() <= 0;
}

}  // namespace

QuadraticField asked_parameter(const HoneycombMap& map, const CutPolicy& policy, std::uint32_t h) {
  if (const auto* sizes = std::get_if<SizePolicy>(&policy)) {
    return sizes->for_size(std::min(map.facet_size(map.facet(h)), map.facet_size(map.facet(map.twin(h)))));
  }
  HEXACT_EXPECTS(std::holds_alternative<HalfEdgePolicy>(policy));
  return std::get<HalfEdgePolicy>(policy)(map, make_id<HalfEdgeId>(h));
}

std::vector<Finding> condition_violations(const HoneycombMap& map, const CutPolicy& policy, std::size_t limit) {
  std::vector<Finding> out;
  if (std::holds_alternative<PlanePolicy>(policy)) return out;
  check_ranges(map, policy, limit, out);
  if (!out.empty()) return out;
  for (std::uint32_t f = 0; f < map.base_facet_count() && out.size() < limit; ++f) {
    const std::string name = "facet " + std::to_string(f);
    if (map.facet_size(f) == 4 && quad_collapses(map, policy, map.facet_start(f))) {
      out.push_back({"QuadCollapse", "the cuts of two opposite corners coincide, condition (8)", name, {}});
    }
    if (map.facet_size(f) == 3 && triangle_is_overcut(map, policy, map.facet_start(f))) {
      out.push_back({"TriangleOvercut", "the three cuts leave nothing, condition (10)", name, {}});
    }
  }
  return out;
}

SizePolicy static_policy_sqrt5() {
  const QuadraticField pentagon(Rational(Integer(11), Integer(38)), Rational(Integer(-3), Integer(38)));
  SizePolicy policy = static_policy_rational();
  policy.by_size[5] = pentagon;
  return policy;
}

SizePolicy static_policy_rational() {
  const auto q = [](int p, int r) { return QuadraticField(Rational(Integer(p), Integer(r))); };
  // Sizes 0 to 2 do not occur.
  return {{q(0, 1), q(0, 1), q(0, 1), q(2, 5), q(1, 4), q(11, 97), q(0, 1)}};
}

}  // namespace hexact
