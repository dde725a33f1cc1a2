// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

/// Polynomials of time with integer coefficients, of degree 3 at most. Time t in [0, 1] is written s = 1 - t and t, and
/// a polynomial as the homogeneous c0 s^d + c1 s^(d-1) t + ... + cd t^d: its coefficients are those in Bernstein form
/// times binomial numbers. With u = t / s it is the ordinary c0 + c1 u + ... + cd u^d, whose positive roots are the
/// roots in t's open interval, so that Descartes' rule of signs counts them: there are as many as the coefficients
/// change sign, or fewer by an even number.
namespace impinge::motion {

/// Of any length; what coordinates of 60 bits lead to fits without an allocation.
using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
                                      512, 0, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked,
                                      std::allocator<boost::multiprecision::limb_type>>,
                                  boost::multiprecision::et_off>;

/// x / 2^unit, of which x is a multiple.
Integer integer(double x, int unit);

struct Polynomial {
  std::array<Integer, 4> coefficients;
  int degree = 0;  ///< of the homogeneous form: coefficients beyond it are 0, those up to it may be

  [[nodiscard]] bool is_zero() const;
  /// Sign at (s, t), neither negative.
  [[nodiscard]] int sign(const Integer& s, const Integer& t) const;
  /// How often the coefficients change sign, zeros left out.
  [[nodiscard]] int variations() const;
  /// The sign just after the start, and throughout the open interval where `variations()` is 0.
  [[nodiscard]] int first_sign() const;
};

/// What moves from `at0` to `at1`.
inline Polynomial linear(const Integer& at0, const Integer& at1) { return {{at0, at1}, 1}; }

Polynomial operator+(const Polynomial& a, const Polynomial& b);  ///< of one degree
Polynomial operator-(const Polynomial& a, const Polynomial& b);  ///< of one degree
Polynomial operator*(const Polynomial& a, const Polynomial& b);

/// An interval of time with dyadic ends: [first, first + 1] / 2^level.
struct Dyadic {
  Integer first = 0;
  unsigned level = 0;
};

/// The polynomial over an interval, stretched to [0, 1], times a power of two.
Polynomial restricted(const Polynomial& p, const Dyadic& to);

/// The ordinary polynomial in u without its roots at u = 0 and, as the homogeneous form has them, at infinity.
Polynomial without_ends(Polynomial p);

/// As polynomials in u, not both of them zero: the greatest common divisor, up to a factor, and p / divisor, up to a
/// factor, for a divisor of p. (Euclid's algorithm by pseudo-division.)
Polynomial common_divisor(Polynomial p, Polynomial q);
Polynomial quotient(Polynomial p, const Polynomial& divisor);
Polynomial derivative(const Polynomial& p);

}  // namespace impinge::motion
