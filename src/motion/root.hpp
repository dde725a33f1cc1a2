// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "impinge/measures.hpp"
#include "motion/polynomial.hpp"

namespace impinge::motion {

/// A root in [0, 1] of a polynomial of time: a rational number, or the only root inside an interval, where the
/// polynomial changes sign. Signs of other polynomials at it are exact.
class Root {
 public:
  /// t = time / (rest + time)
  static Root at(Integer rest, Integer time);
  /// `of` has exactly one root inside the interval, a simple one.
  Root(Polynomial of, Dyadic interval);

  /// Of a polynomial of degree 3 with the signs of its ends at the ends of time, the only root between neighbouring
  /// doubles, a simple one.
  static Root only_one(const Polynomial& of, const Interval& between);

  /// The root between equal or neighbouring doubles.
  [[nodiscard]] Interval bounds() const;
  /// Makes signs cheaper: `bounds` are what `bounds()` says.
  void narrow(const Interval& bounds);
  /// Of a polynomial of degree 2 at most. Narrows the interval as far as it must.
  int sign(const Polynomial& p);

 private:
  Root() = default;
  void halve();
  void be(Integer rest, Integer time);
  [[nodiscard]] int side_of(double t) const;

  bool rational_ = false;
  Integer rest_, time_;
  Polynomial of_, inside_;  // the latter over the interval
  Dyadic interval_;
};

/// All roots in [0, 1], each once and in no order, of a polynomial that is not zero.
std::vector<Root> roots(const Polynomial& p);

}  // namespace impinge::motion
