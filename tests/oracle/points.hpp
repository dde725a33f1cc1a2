// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>

#include "impinge/mesh.hpp"
#include "rational.hpp"
#include "scenes/random.hpp"

/// Random points for predicates, and the same points as rationals.
namespace impinge::points {

inline oracle::Vec exact(const Point& p) { return oracle::vec(p.x, p.y, p.z); }

template <class Shape>
oracle::Corners exact_corners(const Shape& shape) {
  oracle::Corners corners;
  for (const Point& p : shape) corners.push_back(exact(p));
  return oracle::simplified(corners);
}

using Source = std::function<Point(scenes::Random&)>;

inline Source integers(int low, int high) {
  return [=](scenes::Random& random) {
    const int x = random.integer(low, high);
    const int y = random.integer(low, high);
    return Point{static_cast<double>(x), static_cast<double>(y), static_cast<double>(random.integer(low, high))};
  };
}

/// Points of a tilted lattice, rounded, then up to two ulps off: collinear and coplanar but for rounding.
inline Source nearly_degenerate() {
  return [](scenes::Random& random) {
    const int i = random.integer(-2, 2);
    const int j = random.integer(-2, 2);
    const int k = random.integer(0, 7) == 0 ? random.integer(-1, 1) : 0;
    const auto off = [&random](double x) {
      // Zero stays: its neighbours lie outside the domain.
      for (int step = random.integer(-2, 2); step != 0 && x != 0; step -= step > 0 ? 1 : -1)
        x = std::nextafter(x, step > 0 ? 1e300 : -1e300);
      return x;
    };
    return Point{off(0.1 + 0.7 * i + 0.3 * j - 0.2 * k), off(12.3 - 0.2 * i + 0.9 * j + 0.4 * k),
                 off(-7.7 + 0.6 * i + 0.1 * j + 0.8 * k)};
  };
}

/// Numbers of the whole domain: signed, up to 53 bits anywhere between 2^-358 and 2^300, and often its borders.
inline double anywhere(scenes::Random& random) {
  const double sign = random.integer(0, 1) == 0 ? 1 : -1;
  switch (random.integer(0, 7)) {
    case 0:
      return 0;
    case 1:
      return sign * 0x1p-358;
    case 2:
      return sign * 0x1.fffffffffffffp299;
    case 3:
      return sign * std::ldexp(1.0, random.integer(-358, 299));
    default:
      return sign * std::ldexp(static_cast<double>(random.bits() >> 11), random.integer(-358, 247));
  }
}

inline Source whole_domain() {
  return [](scenes::Random& random) {
    const double x = anywhere(random);
    const double y = anywhere(random);
    return Point{x, y, anywhere(random)};
  };
}

/// Integers times a power of two for each axis: as degenerate as integers, at the ends of the domain.
inline Source stretched_integers(double x, double y, double z) {
  return [=, source = integers(-1, 1)](scenes::Random& random) {
    const Point p = source(random);
    return Point{p.x * x, p.y * y, p.z * z};
  };
}

inline Source anything() {
  return [](scenes::Random& random) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    return Point{x, y, random.uniform(-1, 1)};
  };
}

}  // namespace impinge::points
