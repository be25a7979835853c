// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/smooth_limit.hpp"

#include "chamfer_scale.hpp"
#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace hexact {
namespace {

using detail::Fault;
using Wide = __int128;

/// Thrown where 128 bits are not enough; the same is then done with big integers.
struct TooWide {};
/// Thrown where planes have to be multiplied by this for all offsets to become integers.
struct NeedsFactor {
  Integer factor;
};

int width(Wide x) {
  const auto m = static_cast<unsigned __int128>(x < 0 ? -x : x);
  const auto high = static_cast<std::uint64_t>(m >> 64);
  return high != 0 ? 64 + std::bit_width(high) : std::bit_width(static_cast<std::uint64_t>(m));
}

/// Products stay below 2^120, so that sums of a few of them fit.
Wide product(Wide x, Wide y) {
  if (width(x) + width(y) > 120) throw TooWide{};
  return x * y;
}
Integer product(const Integer& x, const Integer& y) { return x * y; }
int sign_of(Wide x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
int sign_of(const Integer& x) { return x.sign(); }
double to_double(Wide x) { return static_cast<double>(x); }
double to_double(const Integer& x) { return x.to_double(); }
/// x / y where y divides x, y != 0.
std::optional<Wide> whole_quotient(Wide x, Wide y) { return x % y == 0 ? std::optional(x / y) : std::nullopt; }
std::optional<Integer> whole_quotient(const Integer& x, const Integer& y) {
  if (mpz_divisible_p(x.raw(), y.raw()) == 0) return std::nullopt;
  return exact_quotient(x, y);
}
Wide half(Wide x) { return x / 2; }
Integer half(const Integer& x) { return exact_quotient(x, Integer(2)); }
Integer to_integer(Wide x) { return Integer(x); }
Integer to_integer(const Integer& x) { return x; }

Plane<Wide> stored(const IntegerPlanes& planes, std::size_t i, const Wide*) {
  if (!planes.is_narrow(i)) throw TooWide{};
  const auto& p = planes.narrow(i);
  return {p[0], p[1], p[2], p[3]};
}
Plane<Integer> stored(const IntegerPlanes& planes, std::size_t i, const Integer*) { return planes[i]; }

Wide from_integer(const Integer& x, const Wide*) {
  if (!x.fits_int64()) throw TooWide{};
  return x.to_int64();
}
Integer from_integer(const Integer& x, const Integer*) { return x; }

/// A factor of more bits is given up, see `mean_multipliers`.
constexpr std::size_t kMostFactorBits = 2048;

/// The levels of a chamfer with all planes in the scale in which E = (F + G − t)/2, and what is left of budgets.
template <class T>
class Follower {
 public:
  /// Planes of level 0 are multiplied by `multipliers`.
  Follower(const IntegerPlanes& planes, const std::vector<Integer>& multipliers, std::uint32_t first_level)
      : planes_(planes), level_(first_level) {
    scaled_.reserve(planes.size());
    for (std::size_t i = 0; i < multipliers.size(); ++i) {
      const Plane<T> p = stored(planes, i, static_cast<const T*>(nullptr));
      const T k = from_integer(multipliers[i], static_cast<const T*>(nullptr));
      scaled_.push_back({product(k, p.a), product(k, p.b), product(k, p.c), product(k, p.d)});
    }
  }

  /// The step that cuts the edges of `map`. What keeps it from being one that keeps the budgets, or nothing.
  Fault step(const HoneycombMap& map) {
    const std::vector<std::uint32_t> forward = detail::forward_half_edges(map);
    lift_.resize(map.half_edge_count());
    for (std::uint32_t e = 0; e < forward.size(); ++e) {
      const std::uint32_t h = forward[e], g = map.twin(h);
      if (Fault fault = add_mean(map.facet(h), map.facet(g)); !fault.empty()) return fault;
      const T t = scaled_[map.facet(h)].d + scaled_[map.facet(g)].d - (scaled_.back().d + scaled_.back().d);
      lift_[h] = lift_[g] = product(weight_, t);
      if (sign_of(t) <= 0) return edge_text(map, h) + ": its lift is not positive";
    }
    SmoothLevel report;
    report.level = level_;
    if (Fault fault = spend(map, report); !fault.empty()) return fault;
    bound_angles(map, forward, report);
    levels_.push_back(report);
    weight_ = weight_ + weight_;
    ++level_;
    return {};
  }

  /// Behind `step`: the new budgets. In the hexagon of the edge FG, towards F and towards G, the smaller defect of both ends.
  void earn(const HoneycombMap& map) {
    const std::vector<std::uint32_t> forward = detail::forward_half_edges(map);
    left_.resize(map.half_edge_count() + 6 * forward.size());
    const auto defect = [&](std::uint32_t h) {  // in the facet of h
      const std::uint32_t g = map.twin(h);
      const T at_origin = lift_[h] + lift_[map.previous(h)] - lift_[map.next(g)];
      const T at_target = lift_[h] + lift_[map.next(h)] - lift_[map.previous(g)];
      return at_origin < at_target ? at_origin : at_target;
    };
    for (std::size_t e = 0; e < forward.size(); ++e) {
      const std::size_t hexagon = map.half_edge_count() + 6 * e;
      left_[hexagon + 1] = defect(map.twin(forward[e]));
      left_[hexagon + 4] = defect(forward[e]);
    }
  }

  [[nodiscard]] std::vector<SmoothLevel> levels() && { return std::move(levels_); }

 private:
  static std::string edge_text(const HoneycombMap& map, std::uint32_t h) { return edge_name(map.origin(h), map.target(h)); }

  /// Appends the next stored plane as the mean of planes f and g, moved in.
  Fault add_mean(std::uint32_t f, std::uint32_t g) {
    const std::size_t own = scaled_.size();
    const Plane<T>&p = scaled_[f], &q = scaled_[g];
    Plane<T> mean{half(p.a + q.a), half(p.b + q.b), half(p.c + q.c), T(0)};
    Plane<T> e = stored(planes_, own, static_cast<const T*>(nullptr));
    const auto pivot = [](const Plane<T>& x, const Plane<T>& by) {
      return sign_of(by.a) != 0 ? x.a : sign_of(by.b) != 0 ? x.b : x.c;
    };
    std::optional<T> ratio = whole_quotient(pivot(mean, e), pivot(e, e));
    if (!ratio) {
      e = primitive(e);
      ratio = whole_quotient(pivot(mean, e), pivot(e, e));
    }
    const auto is_parallel = [&](const T& m, const T& n) { return product(m, pivot(e, e)) == product(n, pivot(mean, e)); };
    if (sign_of(pivot(mean, e)) * sign_of(pivot(e, e)) <= 0 || !is_parallel(mean.a, e.a) || !is_parallel(mean.b, e.b) ||
        !is_parallel(mean.c, e.c)) {
      return facet_name(own) + ": its normal is not the mean of those of facets " + std::to_string(f) + " and " + std::to_string(g) +
             ", in one scale for all edges";
    }
    if (!ratio) throw NeedsFactor{Rational(to_integer(pivot(mean, e)), to_integer(pivot(e, e))).denominator()};
    mean.d = product(*ratio, e.d);
    scaled_.push_back(mean);
    return {};
  }

  static Plane<T> primitive(const Plane<T>& p) {
    const Integer a = to_integer(p.a), b = to_integer(p.b), c = to_integer(p.c), d = to_integer(p.d);
    const Integer g = gcd(gcd(a, b), gcd(c, d));
    const auto part = [&](const Integer& x) { return from_integer(exact_quotient(x, g), static_cast<const T*>(nullptr)); };
    return {part(a), part(b), part(c), part(d)};
  }

  /// Takes the lifts of this step from the budgets: more than nothing has to be left.
  Fault spend(const HoneycombMap& map, SmoothLevel& report) {
    for (std::uint32_t h = 0; h < left_.size(); ++h) {
      if (!left_[h]) continue;
      T& left = *left_[h];
      report.largest_share = std::max(report.largest_share, to_double(lift_[h]) / to_double(left) * (1 + 0x1p-50));
      left = left - lift_[h];
      if (sign_of(left) > 0) continue;
      return facet_name(map.facet(h)) + ": its lifts towards facet " + std::to_string(map.facet(map.twin(h))) +
             " use up their budget, the last is " + to_integer(lift_[h]).str() + " and leaves " + to_integer(left).str();
    }
    return {};
  }

  /// Over the triangles of normals at the vertices that the step makes.
  void bound_angles(const HoneycombMap& map, const std::vector<std::uint32_t>& forward, SmoothLevel& report) const {
    const std::size_t facets = map.facet_count();
    std::vector<std::uint32_t> edge(map.half_edge_count());
    for (std::uint32_t e = 0; e < forward.size(); ++e) edge[forward[e]] = edge[map.twin(forward[e])] = e;
    TriangleBound worst;
    for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
      const auto star = map.star(v);
      std::array<std::size_t, 3> middle{};
      for (std::size_t k = 0; k < 3; ++k) middle[k] = facets + edge[star[k]];
      worst = larger(worst, triangle_bound(middle[0], middle[1], middle[2]));
      // star[k] and the half-edge before it lie in one facet.
      for (std::size_t k = 0; k < 3; ++k) {
        worst = larger(worst, triangle_bound(map.facet(star[k]), middle[k], facets + edge[map.previous(star[k])]));
      }
    }
    const double degrees = worst.pair < 1 ? 2 * std::asin(std::sqrt(worst.pair)) * 180 / std::numbers::pi : 180;
    report.angle_bound_deg = std::min(180.0, degrees * (1 + 0x1p-40));
    report.later_sine = std::sqrt(worst.later) * (1 + 0x1p-50);
  }

  /// Upper bounds of sin²(θ/2): of the angles between the three normals, and of those in all subdivisions of their
  /// triangle, times 4^k at the k-th.
  struct TriangleBound {
    double pair = 0, later = 0;
  };
  static TriangleBound larger(const TriangleBound& x, const TriangleBound& y) {
    return {std::max(x.pair, y.pair), std::max(x.later, y.later)};
  }

  /// |A − B|² = (|A| − |B|)² + 4|A||B| sin²(θ/2). In the triangle |x|² is at least the smallest product of two corners,
  /// itself included, and the differences of neighbours halve with each subdivision.
  TriangleBound triangle_bound(std::size_t i, std::size_t j, std::size_t k) const {
    const std::array<std::array<double, 3>, 3> n = {normal(i), normal(j), normal(k)};
    double least = std::numeric_limits<double>::infinity(), longest = 0;
    TriangleBound out;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = a; b < 3; ++b) {
        double dot = 0, size = 0, gap = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          dot += n[a][c] * n[b][c];
          size += std::fabs(n[a][c] * n[b][c]);
          // Entries are off by 2^-53 of themselves.
          const double d = std::fabs(n[a][c] - n[b][c]) + 0x1p-51 * (std::fabs(n[a][c]) + std::fabs(n[b][c]));
          gap += d * d;
        }
        least = std::min(least, dot - 0x1p-50 * size);
        longest = std::max(longest, gap);
        out.pair = std::max(out.pair, gap / (4 * length(n[a]) * length(n[b])) * (1 + 0x1p-48));
      }
    }
    out.later = least > 0 ? longest / (4 * least) * (1 + 0x1p-48) : std::numeric_limits<double>::infinity();
    return out;
  }
  static double length(const std::array<double, 3>& n) { return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]); }
  std::array<double, 3> normal(std::size_t i) const {
    return {to_double(scaled_[i].a), to_double(scaled_[i].b), to_double(scaled_[i].c)};
  }

  const IntegerPlanes& planes_;
  std::vector<Plane<T>> scaled_;
  std::vector<T> lift_;                 ///< τ of the step, by half-edge
  std::vector<std::optional<T>> left_;  ///< of the budget of each half-edge that has one
  std::vector<SmoothLevel> levels_;
  T weight_{1};
  std::uint32_t level_;
};

struct Followed {
  Fault fault;
  std::vector<SmoothLevel> levels;
};

template <class T>
Followed follow(const IntegerPlanes& planes, const std::vector<HoneycombMap>& maps, const std::vector<Integer>& multipliers,
                std::uint32_t first_level) {
  Follower<T> follower(planes, multipliers, first_level);
  Fault fault;
  for (const HoneycombMap& map : maps) {
    fault = follower.step(map);
    if (!fault.empty()) break;
    if (&map != &maps.back()) follower.earn(map);
  }
  return {fault, std::move(follower).levels()};
}

/// Multipliers of level 0 as integers that can be halved once for each step; empty where they are too large.
std::vector<Integer> integer_multipliers(const std::vector<Rational>& ratios, std::size_t steps) {
  Integer common(1);
  for (const Rational& x : ratios) {
    common = lcm(common, x.denominator());
    if (common.bit_length() > kMostFactorBits) return {};
  }
  std::vector<Integer> out;
  for (const Rational& x : ratios) {
    out.push_back((x * Rational(common)).numerator().shifted_left(static_cast<unsigned long>(steps)));
  }
  return out;
}

Followed follow_all(const IntegerPlanes& planes, const std::vector<HoneycombMap>& maps, std::uint32_t first_level) {
  const auto ratios = detail::mean_multipliers(planes, maps.front());
  if (!ratios) return {"the planes of the first step are no means of their neighbours in any scale", {}};
  std::vector<Integer> multipliers = integer_multipliers(*ratios, maps.size());
  while (!multipliers.empty() && multipliers.front().bit_length() <= kMostFactorBits) {
    try {
      try {
        return follow<Wide>(planes, maps, multipliers, first_level);
      } catch (const TooWide&) {
        return follow<Integer>(planes, maps, multipliers, first_level);
      }
    } catch (const NeedsFactor& need) {
      for (Integer& m : multipliers) m *= need.factor;
    }
  }
  return {"the planes are means of their neighbours only with factors of more than " + std::to_string(kMostFactorBits) + " bits", {}};
}

}  // namespace

SmoothLimit smooth_limit(const PlaneBody& body, const ProgressPart& progress) {
  const auto undecided = [](std::string reason) { return SmoothLimit{Verdict::undecided, std::move(reason), {}}; };
  if (body.field != Field::rational) return undecided("only decided for bodies over the rational numbers");
  if (Fault fault = detail::trivalent_fault(body.loops, body.vertex_count()); !fault.empty()) return undecided(fault);
  const MeshTopology topology = analyse_topology(body.loops, body.vertex_count());
  if (Fault fault = detail::convex_fault(body.planes, body.loops, body.triples, topology); !fault.empty()) {
    return undecided("only decided for convex bodies: " + fault);
  }
  const detail::ChamferStart start = detail::chamfer_start_of(body);
  if (start.steps == 0) return undecided("the last level does not come from a chamfer step");
  std::vector<HoneycombMap> maps;
  try {
    const Fault fault = detail::replay_fault(body.planes, body, start.body, start.first,
                                             [&](const HoneycombMap& map, detail::CutKind) { maps.push_back(map); },
                                             progress.part(0, 0.7));
    if (!fault.empty()) return undecided(fault);
  } catch (const InvalidInput& e) {
    return undecided(std::string("the level before the chamfer steps is no trivalent surface: ") + e.what());
  }
  progress.report(0.7);
  Followed followed = follow_all(body.planes, maps, start.first);
  const Verdict verdict = followed.fault.empty() ? Verdict::proved : Verdict::undecided;
  return {verdict, std::move(followed.fault), std::move(followed.levels)};
}

}  // namespace hexact
