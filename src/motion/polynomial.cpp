// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "motion/polynomial.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "core/number.hpp"

namespace impinge::motion {

Integer integer(double x, int unit) {
  if (x == 0) return 0;
  const int lowest = lowest_bit(x);
  return Integer(static_cast<std::int64_t>(std::ldexp(x, -lowest))) << (lowest - unit);
}

bool Polynomial::is_zero() const {
  for (int i = 0; i <= degree; ++i)
    if (!coefficients[i].is_zero()) return false;
  return true;
}

int Polynomial::sign(const Integer& s, const Integer& t) const {
  Integer value = coefficients[degree], power = 1;  // Horner's scheme from the end of time, with s as the unit
  for (int i = degree; i-- > 0;) {
    power *= s;
    value = value * t + coefficients[i] * power;
  }
  return value.sign();
}

int Polynomial::variations() const {
  int changes = 0, last = 0;
  for (int i = 0; i <= degree; ++i) {
    const int sign = coefficients[i].sign();
    changes += int{sign * last < 0};
    if (sign != 0) last = sign;
  }
  return changes;
}

int Polynomial::first_sign() const {
  for (int i = 0; i <= degree; ++i)
    if (const int sign = coefficients[i].sign(); sign != 0) return sign;
  return 0;
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial sum = a;
  for (int i = 0; i <= b.degree; ++i) sum.coefficients[i] += b.coefficients[i];
  return sum;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
  Polynomial difference = a;
  for (int i = 0; i <= b.degree; ++i) difference.coefficients[i] -= b.coefficients[i];
  return difference;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product;
  product.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i)
    for (int j = 0; j <= b.degree; ++j) product.coefficients[i + j] += a.coefficients[i] * b.coefficients[j];
  return product;
}

// With the start of time, 1 = s + t, in the place of s; then 2^level t = first + t'; then the interval's own s' = 1 -
// t'. Each is a shift of one variable (Horner's scheme), and all but the second are without products.
Polynomial restricted(const Polynomial& p, const Dyadic& to) {
  if (to.level == 0) return p;
  Polynomial result = p;
  const int d = p.degree;
  auto& c = result.coefficients;
  for (int i = 0; i < d; ++i)
    for (int j = 1; j <= d - i; ++j) c[j] -= c[j - 1];
  for (int i = 0; i < d; ++i) c[i] <<= to.level * static_cast<unsigned>(d - i);
  for (int i = 0; i < d; ++i)
    for (int j = d - 1; j >= i; --j) c[j] += to.first * c[j + 1];
  for (int i = 0; i < d; ++i)
    for (int j = 1; j <= d - i; ++j) c[j] += c[j - 1];
  return result;
}

namespace {

void trim(Polynomial& p) {
  while (p.degree > 0 && p.coefficients[p.degree].is_zero()) --p.degree;
}

}  // namespace

Polynomial without_ends(Polynomial p) {
  trim(p);
  while (p.degree > 0 && p.coefficients[0].is_zero()) {
    for (int i = 0; i < p.degree; ++i) p.coefficients[i] = p.coefficients[i + 1];
    p.coefficients[p.degree--] = 0;
  }
  return p;
}

namespace {

/// Leaves in `p` what is left of it, times powers of the divisor's leading coefficient, and returns the quotient,
/// times such powers.
Polynomial divide(Polynomial& p, const Polynomial& divisor) {
  Polynomial quotient;
  quotient.degree = p.degree - divisor.degree;
  const Integer& leading = divisor.coefficients[divisor.degree];
  for (int i = quotient.degree; i >= 0; --i) {
    const Integer factor = p.coefficients[i + divisor.degree];
    for (Integer& c : quotient.coefficients) c *= leading;
    for (Integer& c : p.coefficients) c *= leading;
    quotient.coefficients[i] = factor;
    for (int j = 0; j <= divisor.degree; ++j) p.coefficients[i + j] -= factor * divisor.coefficients[j];
  }
  trim(p);
  return quotient;
}

}  // namespace

Polynomial common_divisor(Polynomial p, Polynomial q) {
  trim(p);
  trim(q);
  if (p.degree < q.degree) std::swap(p, q);
  while (!q.is_zero()) {
    if (q.degree == 0) return {{Integer(1)}, 0};
    divide(p, q);
    std::swap(p, q);
  }
  return p;
}

Polynomial quotient(Polynomial p, const Polynomial& divisor) { return divide(p, divisor); }

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  result.degree = p.degree - 1;
  for (int i = 1; i <= p.degree; ++i) result.coefficients[i - 1] = i * p.coefficients[i];
  return result;
}

}  // namespace impinge::motion
