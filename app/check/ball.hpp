// SPDX-License-Identifier: LGPL-3.0-or-later
// Real and complex numbers that are known up to an error: multiples of 2^-320 with a radius.
#pragma once

#include <gmpxx.h>

#include <vector>

namespace check {

constexpr unsigned kFraction = 320;

struct Ball {
  mpz_class m, r;  // (m ± r) / 2^320
  Ball() = default;
  explicit Ball(const mpq_class& x) : Ball(x, x) {}
  Ball(const mpq_class& lo, const mpq_class& hi) {  // contains both
    const mpz_class a = floored(lo), b = floored(hi) + 1;
    m = (a + b) / 2;
    r = (b - a) / 2 + 1;
  }
  // 1, -1, or 0 when it is not certain.
  int sign() const { return m > r ? 1 : -m > r ? -1 : 0; }
  mpz_class lower() const { return m - r; }
  mpz_class upper() const { return m + r; }

 private:
  static mpz_class floored(const mpq_class& x) {
    mpz_class n = x.get_num(), q;
    mpz_mul_2exp(n.get_mpz_t(), n.get_mpz_t(), kFraction);
    mpz_fdiv_q(q.get_mpz_t(), n.get_mpz_t(), x.get_den_mpz_t());
    return q;
  }
};
inline mpz_class shifted(const mpz_class& x) {  // x / 2^320, towards minus infinity
  mpz_class y;
  mpz_fdiv_q_2exp(y.get_mpz_t(), x.get_mpz_t(), kFraction);
  return y;
}
inline Ball make_ball(mpz_class m, mpz_class r) {
  Ball b;
  b.m = std::move(m);
  b.r = std::move(r);
  return b;
}
inline Ball operator+(const Ball& a, const Ball& b) { return make_ball(a.m + b.m, a.r + b.r); }
inline Ball operator-(const Ball& a, const Ball& b) { return make_ball(a.m - b.m, a.r + b.r); }
inline Ball operator*(const Ball& a, const Ball& b) {
  return make_ball(shifted(a.m * b.m), shifted(abs(a.m) * b.r + abs(b.m) * a.r + a.r * b.r) + 2);
}
// |a/b - q| <= (ra + |q| rb) / (|b| - rb) for the quotient q of the middles. b.sign() must not be 0.
inline Ball operator/(const Ball& a, const Ball& b) {
  mpz_class n = a.m, q, e = a.r, d = abs(b.m) - b.r, r;
  mpz_mul_2exp(n.get_mpz_t(), n.get_mpz_t(), kFraction);
  mpz_fdiv_q(q.get_mpz_t(), n.get_mpz_t(), b.m.get_mpz_t());
  mpz_mul_2exp(e.get_mpz_t(), e.get_mpz_t(), kFraction);
  e += (abs(q) + 1) * b.r;
  mpz_cdiv_q(r.get_mpz_t(), e.get_mpz_t(), d.get_mpz_t());
  return make_ball(q, r + 2);
}
inline Ball root(const Ball& a) {  // of a number that is not negative
  const auto scaled = [](mpz_class x) {
    if (x < 0) x = 0;
    mpz_mul_2exp(x.get_mpz_t(), x.get_mpz_t(), kFraction);
    return mpz_class(sqrt(x));
  };
  const mpz_class lo = scaled(a.lower()), hi = scaled(a.upper()) + 1;
  return make_ball((lo + hi) / 2, (hi - lo) / 2 + 1);
}

struct ComplexBall {
  Ball x, y;
};
inline ComplexBall operator+(const ComplexBall& a, const ComplexBall& b) { return {a.x + b.x, a.y + b.y}; }
inline ComplexBall operator-(const ComplexBall& a, const ComplexBall& b) { return {a.x - b.x, a.y - b.y}; }
inline ComplexBall operator*(const ComplexBall& a, const ComplexBall& b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
inline ComplexBall operator*(const ComplexBall& a, const Ball& b) { return {a.x * b, a.y * b}; }
inline Ball length2(const ComplexBall& a) { return a.x * a.x + a.y * a.y; }
inline Ball cross(const ComplexBall& a, const ComplexBall& b) { return a.x * b.y - a.y * b.x; }
inline ComplexBall operator/(const ComplexBall& a, const ComplexBall& b) {
  const Ball n = length2(b);
  const ComplexBall p = a * ComplexBall{b.x, Ball() - b.y};
  return {p.x / n, p.y / n};
}

}  // namespace check
