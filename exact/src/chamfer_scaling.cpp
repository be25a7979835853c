// SPDX-License-Identifier: LGPL-3.0-or-later
#include "chamfer_scaling.hpp"

#include "primitive_plane.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hexact {
namespace {

constexpr std::size_t kWordBits = 62;

/// A positive number as mantissa·2^exponent, 1/2 <= mantissa < 1.
struct Scaled {
  double mantissa = 0;
  long exponent = 0;
};

Scaled normalised(double mantissa, long exponent) {
  int shift = 0;
  mantissa = std::frexp(mantissa, &shift);
  return {mantissa, exponent + shift};
}

/// x·2^-shift in floating point; the caller sees to it that the result is in range.
double scaled_down(const Integer& x, long shift) {
  long e = 0;
  const double m = mpz_get_d_2exp(&e, x.raw());
  const long power = e - shift;
  return power < -1000 ? 0 : std::ldexp(m, static_cast<int>(power));
}

/// Length of the normal, to about 2^-50 relative.
Scaled normal_length(const Plane<Integer>& p) {
  const long bits = static_cast<long>(std::max({p.a.bit_length(), p.b.bit_length(), p.c.bit_length()}));
  const double a = scaled_down(p.a, bits), b = scaled_down(p.b, bits), c = scaled_down(p.c, bits);
  return normalised(std::sqrt(a * a + b * b + c * c), bits);
}

/// The nearest integer to a positive number, at least 1.
Integer rounded(const Scaled& x) {
  if (x.exponent <= 0) return Integer(1);
  if (x.exponent <= 52) return Integer(std::max<long long>(1, std::llrint(std::ldexp(x.mantissa, static_cast<int>(x.exponent)))));
  return Integer(std::llrint(std::ldexp(x.mantissa, 53))).shifted_left(static_cast<unsigned long>(x.exponent - 53));
}

/// Integer factors that bring all lengths to 2^j times the largest within 2^-12, for the smallest such j.
std::vector<Integer> equalising_factors(const std::vector<Scaled>& lengths) {
  const Scaled largest = *std::max_element(lengths.begin(), lengths.end(), [](const Scaled& x, const Scaled& y) {
    return x.exponent != y.exponent ? x.exponent < y.exponent : x.mantissa < y.mantissa;
  });
  std::vector<Integer> factors(lengths.size());
  for (long j = 0;; ++j) {
    const bool equal = [&] {
      for (std::size_t f = 0; f < lengths.size(); ++f) {
        const Scaled wanted = normalised(largest.mantissa / lengths[f].mantissa, largest.exponent + j - lengths[f].exponent);
        factors[f] = rounded(wanted);
        if (std::fabs(scaled_down(factors[f], wanted.exponent) / wanted.mantissa - 1) > 0x1p-12) return false;
      }
      return true;
    }();
    if (equal) return factors;
    HEXACT_INVARIANT(j < 13);  // a factor of at least 2^12 rounds within 2^-13
  }
}

void divide_by_content(std::vector<Integer>& factors) {
  Integer g;
  for (const Integer& k : factors) {
    g = gcd(g, k);
    if (g == Integer(1)) return;
  }
  for (Integer& k : factors) k = exact_quotient(k, g);
}

/// The coprime integers proportional to positive rational numbers.
std::vector<Integer> coprime(const std::vector<Rational>& numbers) {
  Integer denominator(1);
  for (const Rational& x : numbers) denominator = lcm(denominator, x.denominator());
  std::vector<Integer> out;
  out.reserve(numbers.size());
  for (const Rational& x : numbers) out.push_back(exact_quotient(x.numerator() * denominator, x.denominator()));
  divide_by_content(out);
  return out;
}

/// For each plane of the start, plane in file coordinates over the coprime integers of its half-space.
std::vector<Rational> contents(const SnappedLevel& surface, std::size_t count) {
  PlaneBody body;
  body.scale = surface.scale;
  body.shift = surface.shift;
  std::vector<Rational> out;
  out.reserve(count);
  for (std::size_t f = 0; f < count; ++f) {
    body.planes = {};
    body.planes.push_back(surface.planes[f]);
    const Plane<Rational> plane = detail::file_plane(body, 0);
    const Plane<Integer> p = detail::primitive(plane);
    out.push_back(!p.a.is_zero() ? plane.a / Rational(p.a) : !p.b.is_zero() ? plane.b / Rational(p.b) : plane.c / Rational(p.c));
  }
  return out;
}

std::vector<Integer> given_factors(const SnappedLevel& surface, std::span<const Rational> factors) {
  const std::size_t count = surface.map.facet_count();
  if (factors.size() != count) {
    throw InvalidInput("BadLifts", std::to_string(factors.size()) + " factors are given, there are " + std::to_string(count) + " facets", "");
  }
  std::vector<Rational> scaled = contents(surface, count);
  for (std::size_t f = 0; f < count; ++f) {
    if (factors[f].sign() <= 0) {
      throw InvalidInput("BadLifts", "its factor " + factors[f].str() + " is not positive", "facet " + std::to_string(f));
    }
    scaled[f] = factors[f] / scaled[f];
  }
  return coprime(scaled);
}

void require_convex(const SnappedLevel& surface) {
  std::vector<Finding> findings;
  for (const SignViolation& v : sign_violations(surface)) findings.push_back(explain(v, surface.map));
  if (!findings.empty()) throw InvalidInput(std::move(findings));
}

}  // namespace

namespace detail {

Coefficients::Coefficients(const ChamferLevel& level)
    : level_(level),
      words_(level.normal_bound.bit_length() <= kWordBits && level.offset_bound.bit_length() <= kWordBits) {
  const HoneycombMap& map = level.surface.map;
  const auto steps = static_cast<std::uint32_t>(level.weights.size());
  for (std::uint32_t k = 1; k < steps; ++k) ends_.push_back(map.facet_count_at(map.level() - steps + k));
  if (!words_) return;
  for (const Integer& k : level.factors) factor_words_.push_back((k * level.weights[0]).to_int64());
  for (const Integer& w : level.weights) weight_words_.push_back(w.to_int64());
}

Integer Coefficients::integer(std::uint32_t f) const {
  return f < level_.factors.size() ? level_.factors[f] * level_.weights[0] : level_.weights[step_of(f)];
}

}  // namespace detail

Integer coefficient(const ChamferLevel& level, std::uint32_t f) {
  HEXACT_EXPECTS(f < level.surface.map.facet_count());
  return detail::Coefficients(level).integer(f);
}

Plane<Integer> scaled_plane(const ChamferLevel& level, std::uint32_t f) {
  const Integer k = coefficient(level, f);
  const Plane<Integer> p = level.surface.planes[f];
  return {k * p.a, k * p.b, k * p.c, k * p.d};
}

RawVector<Point3<double>> scaled_normals(const ChamferLevel& level) {
  const detail::Coefficients coefficients(level);
  const IntegerPlanes& planes = level.surface.planes;
  const auto count = static_cast<std::uint32_t>(planes.size());
  RawVector<Point3<double>> normals(count);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 1 << 13), [&](const auto& range) {
    for (std::uint32_t f = range.begin(); f != range.end(); ++f) {
      if (coefficients.are_words() && planes.is_narrow(f)) {
        const auto& p = planes.narrow(f);
        const double k = static_cast<double>(coefficients.word(f)) /
                         std::ldexp(level.unit_mantissa, static_cast<int>(level.unit_exponent));
        normals[f] = {static_cast<double>(p[0]) * k, static_cast<double>(p[1]) * k, static_cast<double>(p[2]) * k};
        continue;
      }
      const Integer k = coefficients.integer(f);
      const Plane<Integer> p = planes[f];
      const auto entry = [&](const Integer& x) { return scaled_down(k * x, level.unit_exponent) / level.unit_mantissa; };
      normals[f] = {entry(p.a), entry(p.b), entry(p.c)};
    }
  });
  return normals;
}

LiftScale lift_scale(const ChamferLevel& level) {
  std::vector<Rational> scaled = contents(level.surface, level.start_facets());
  for (std::size_t f = 0; f < scaled.size(); ++f) scaled[f] *= Rational(level.factors[f]);
  LiftScale out;
  out.factors = coprime(scaled);
  // scaled plane = factor·content·(coprime plane) = c·κ·(coprime plane) in file coordinates, at the start; weights[0] holds
  // the multipliers and 2 for each step since, of which documents know.
  const Rational c = scaled[0] / Rational(out.factors[0]);
  const long steps = static_cast<long>(level.weights.size()) - 1;
  out.unit = (c * Rational(level.weights[0])).scaled(-steps - level.surface.scale);
  return out;
}

ChamferLevel chamfer_start(SnappedLevel base, std::span<const Rational> factors) {
  require_convex(base);
  ChamferLevel level{std::move(base), {}, {Integer(1)}, 1, 0, {}, {}};
  const IntegerPlanes& planes = level.surface.planes;
  std::vector<Scaled> lengths;
  lengths.reserve(planes.size());
  for (std::size_t f = 0; f < planes.size(); ++f) lengths.push_back(normal_length(planes[f]));
  level.factors = factors.empty() ? equalising_factors(lengths) : given_factors(level.surface, factors);
  divide_by_content(level.factors);
  const auto magnitude = [](const Integer& x) { return x.sign() < 0 ? -x : x; };
  Scaled longest{0.5, std::numeric_limits<long>::min()};
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const Integer& k = level.factors[f];
    const Plane<Integer> p = planes[f];
    level.normal_bound = std::max({level.normal_bound, magnitude(k * p.a), magnitude(k * p.b), magnitude(k * p.c)});
    level.offset_bound = std::max(level.offset_bound, magnitude(k * p.d));
    long e = 0;
    const double m = mpz_get_d_2exp(&e, k.raw());
    const Scaled length = normalised(m * lengths[f].mantissa, e + lengths[f].exponent);
    if (length.exponent > longest.exponent || (length.exponent == longest.exponent && length.mantissa > longest.mantissa)) {
      longest = length;
    }
  }
  level.unit_mantissa = longest.mantissa;
  level.unit_exponent = longest.exponent;
  return level;
}

ChamferLevel chamfer_start(const PlaneBody& body, std::span<const Rational> factors) {
  if (body.field != Field::rational) {
    throw InvalidInput("FieldNotRational", "a chamfer needs planes over Q; prepare --snap rounds those over Q(sqrt5)", "");
  }
  return chamfer_start(snapped_start(body), factors);
}

}  // namespace hexact
