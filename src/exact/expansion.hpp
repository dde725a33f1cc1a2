// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "core/strict_arithmetic.hpp"

/// Floating-point expansions: a number as an unevaluated sum of non-overlapping doubles, least significant first, zeros
/// left out (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997).
/// All on the stack. Needs round-to-nearest and products without over- or underflow, as in the
/// exact domain (core/pose.hpp).
namespace impinge::exact {

/// The rounded result and the error made by rounding; their sum is exact.
struct Two {
  double high, low;
};

inline Two two_sum(double a, double b) {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

inline Two fast_two_sum(double a, double b) {  // |a| >= |b|
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

inline Two two_difference(double a, double b) {
  const double difference = a - b;
  const double b_virtual = a - difference;
  const double a_virtual = difference + b_virtual;
  return {difference, (a - a_virtual) + (b_virtual - b)};
}

/// Two halves of 26 bits (Dekker). |a| < 2^996 keeps the product with 2^27 + 1 finite.
inline Two split(double a) {
  const double c = 134217729.0 * a;
  const double high = c - (c - a);
  return {high, a - high};
}

inline Two two_product(double a, double b, const Two& b_split) {
  const double product = a * b;
  const Two a_split = split(a);
  const double error =
      ((product - a_split.high * b_split.high) - a_split.low * b_split.high) - a_split.high * b_split.low;
  return {product, a_split.low * b_split.low - error};
}

inline Two two_product(double a, double b) { return two_product(a, b, split(b)); }

/// At most N components.
template <std::size_t N>
struct Expansion {
  std::array<double, N> component;
  std::size_t size = 0;

  void push(double x) {
    if (x != 0) component[size++] = x;
  }
  /// The largest component has the sign of the whole.
  [[nodiscard]] int sign() const {
    if (size == 0) return 0;
    return component[size - 1] > 0 ? 1 : -1;
  }
};

inline Expansion<2> expansion(const Two& x) {
  Expansion<2> e;
  e.push(x.low);
  e.push(x.high);
  return e;
}

/// Shewchuk's fast expansion sum with zero elimination.
template <std::size_t N, std::size_t M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> h;
  std::size_t i = 0, j = 0;
  const auto next = [&] {
    const bool from_e =
        j == f.size || (i < e.size && (f.component[j] > e.component[i]) == (f.component[j] > -e.component[i]));
    return from_e ? e.component[i++] : f.component[j++];
  };
  if (e.size + f.size == 0) return h;
  double q = next();
  bool first = true;
  while (i < e.size || j < f.size) {
    const double x = next();
    const Two sum = first ? fast_two_sum(x, q) : two_sum(q, x);
    first = false;
    h.push(sum.low);
    q = sum.high;
  }
  h.push(q);
  return h;
}

template <std::size_t N>
Expansion<N> operator-(Expansion<N> e) {
  for (std::size_t i = 0; i < e.size; ++i) e.component[i] = -e.component[i];
  return e;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> operator-(const Expansion<N>& e, const Expansion<M>& f) {
  return e + -f;
}

/// Shewchuk's scale expansion with zero elimination.
template <std::size_t N, std::size_t M>
void scale(const Expansion<N>& e, double b, Expansion<M>& h) {
  static_assert(M >= 2 * N);
  if (e.size == 0) return;
  const Two b_split = split(b);
  Two product = two_product(e.component[0], b, b_split);
  h.push(product.low);
  double q = product.high;
  for (std::size_t i = 1; i < e.size; ++i) {
    product = two_product(e.component[i], b, b_split);
    const Two sum = two_sum(q, product.low);
    h.push(sum.low);
    const Two carry = fast_two_sum(product.high, sum.high);
    h.push(carry.low);
    q = carry.high;
  }
  h.push(q);
}

template <std::size_t N>
Expansion<4 * N> operator*(const Expansion<N>& e, const Expansion<2>& f) {
  Expansion<4 * N> h;
  if (f.size == 1) scale(e, f.component[0], h);  // the usual case of real data: differences are doubles
  if (f.size < 2) return h;
  Expansion<2 * N> low, high;
  scale(e, f.component[0], low);
  scale(e, f.component[1], high);
  return low + high;
}

}  // namespace impinge::exact
