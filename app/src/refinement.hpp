// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/chamfer.hpp"
#include "hexact/exact/honeycomb.hpp"
#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/policies.hpp"
#include "hexact/exact/snapped_honeycomb.hpp"
#include "hexact/kernel/honeycomb_double.hpp"
#include "hexact/kernel/honeycomb_statistics.hpp"

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace hexact::app {

/// By its name on the command line.
[[nodiscard]] Arithmetic arithmetic_named(const std::string& name);

/// What is reported about one step beside the measures; empty where the arithmetic does not give it.
struct StepReport {
  std::string delta;                      ///< the exact number
  std::optional<double> least_delta;      ///< snapped: proven lower bound of delta
  std::optional<double> parameter_change; ///< snapped: proven upper bound
  std::optional<double> min_parameter;    ///< snapped: proven lower bound
  std::optional<std::size_t> plane_bits;  ///< chamfer: width of the widest coefficient of a plane that the step made
  double seconds = 0;
};

/// One level of a honeycomb in any arithmetic, or of a chamfer, and how it is refined.
class Refinement {
 public:
  /// Throws InvalidInput where the body does not suit the arithmetic.
  Refinement(const PlaneBody& base, Arithmetic arithmetic, int max_bits);
  explicit Refinement(ChamferLevel start);

  /// Replaces the level by the next one, all exact conditions decided. Throws InvalidInput naming the violation;
  /// Cancelled within a level of exact numbers, else between levels.
  StepReport advance(const PolicySchedule& schedule, const ProgressPart& progress);
  /// Makes the level one of a chamfer, unless it is. Throws what `chamfer_start` throws; UsageError for levels over other
  /// numbers than Q.
  void start_chamfer(std::span<const Rational> factors);
  /// Replaces the level by the next one of a chamfer. Precondition: start_chamfer. Throws InvalidInput.
  StepReport chamfer(const LiftRule& rule, const ProgressPart& progress);

  [[nodiscard]] const HoneycombMap& map() const;
  /// The level as an exact body. Precondition: the arithmetic is exact.
  [[nodiscard]] PlaneBody body() const;
  /// Rounded vertices in file coordinates (exactly rounded where the arithmetic is exact).
  [[nodiscard]] RoundedVertices vertices(FloatFormat format = FloatFormat::binary64) const;
  [[nodiscard]] HoneycombStatistics statistics() const;
  /// Outward unit normal of each facet, from its plane where there is one.
  [[nodiscard]] std::vector<Point3<double>> normals() const;
  [[nodiscard]] bool is_exact() const { return !std::holds_alternative<DoubleLevel>(level_); }

 private:
  std::variant<SnappedLevel, HoneycombLevel<Rational>, HoneycombLevel<QuadraticField>, DoubleLevel, ChamferLevel> level_;
  SnappedOptions snapped_;
};

/// Facet addresses of a level.
[[nodiscard]] std::vector<FacetAddress> addresses_of(const HoneycombMap& map);

}  // namespace hexact::app
