// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pairs.hpp"

#include <algorithm>
#include <cstdio>

#include "core/number.hpp"
#include "core/vec3.hpp"
#include "scenes/motion.hpp"

namespace impinge::test {
namespace {

using scenes::Random;

Triangle triangle_of(const points::Source& source, Random& random) {
  const Point a = source(random), b = source(random);
  return {a, b, source(random)};
}

Vec3 integers_below(Random& random, int limit) {
  const double x = random.integer(-limit, limit), y = random.integer(-limit, limit);
  return {x, y, static_cast<double>(random.integer(-limit, limit))};
}

/// As CAD has it: decimal numbers, one of the coordinates the same mostly.
points::Source decimals() {
  return [](Random& random) {
    const double x = 0.1 * random.integer(0, 4), y = 0.3 * random.integer(0, 3);
    return Point{x, y, random.integer(0, 3) == 0 ? 0.7 * random.integer(0, 2) : 0.7};
  };
}

/// Integers and what is left of zeros and ones when they were computed.
points::Source dusty(int lowest) {
  return [=](Random& random) {
    const auto number = [&] {
      const double dust =
          random.integer(0, 2) == 0 ? std::ldexp(random.integer(-3, 3), random.integer(lowest, -50)) : 0;
      return random.integer(-1, 2) + dust;
    };
    const double x = number(), y = number();
    return Point{x, y, number()};
  };
}

/// Integers of up to `bits` bits, of which the lowest one is set mostly.
points::Source long_integers(int bits) {
  return [=](Random& random) {
    const auto number = [&] {
      const double low = random.integer(-2, 2), high = random.integer(-1, 1);
      return std::ldexp(high, bits - 1) + low;
    };
    const double x = number(), y = number();
    return Point{x, y, number()};
  };
}

/// Lattice points where a motion takes them, so that what was in one plane is off it by rounding. `apart`: a's points
/// and b's are rounded after different sums.
PairFamily moved_lattice(std::string name, double reach, bool apart) {
  return {std::move(name), [=](Random& random) {
            const Pose pose = scenes::random_motion(random, reach);
            const points::Source source = points::integers(0, 2);
            Pair pair{triangle_of(source, random), triangle_of(source, random)};
            if (random.integer(0, 1) == 0) pair[1][0] = pair[0][1];
            // The same places by the pose of an object that stands at `shift`.
            const Vec3 shift = apart ? integers_below(random, 2) : Vec3{0, 0, 0};
            const Point t = world_vertex(pose, shift);
            for (Point& p : pair[0]) p = world_vertex(pose, p);
            for (Point& p : pair[1]) p = world_vertex({.R = pose.R, .t = {t.x, t.y, t.z}}, p - shift);
            return pair;
          }};
}

/// Two integers of up to `bits` bits without a common divisor, and c, d with a d - b c = 1.
std::array<double, 4> unimodular(Random& random, int bits) {
  for (;;) {
    const auto number = [&] { return static_cast<std::int64_t>(random.bits() >> (64 - bits)) | 1; };
    const std::int64_t a = number(), b = number();
    std::int64_t r0 = a, r1 = b, s0 = 1, s1 = 0, t0 = 0, t1 = 1;
    while (r1 != 0) {
      const std::int64_t q = r0 / r1;
      r0 -= q * r1, s0 -= q * s1, t0 -= q * t1;
      std::swap(r0, r1), std::swap(s0, s1), std::swap(t0, t1);
    }
    if (r0 == 1)
      return {static_cast<double>(a), static_cast<double>(b), static_cast<double>(-t0), static_cast<double>(s0)};
  }
}

/// Determinants of 0 and a few units though their terms are of `3 bits + 24` bits: below what doubles, or two of them,
/// can tell from rounding.
PairFamily sheared(std::string name, int bits) {
  return {std::move(name), [=](Random& random) {
            const auto [a, b, c, d] = unimodular(random, bits);
            const Vec3 u{a, b, 0}, v{c, d, 0};
            const auto off = [&] {
              const double i = random.integer(-1, 2), j = random.integer(-1, 2), k = random.integer(-1, 1);
              return i * u + j * v + Vec3{0, 0, k};
            };
            Pair pair{Triangle{Vec3{0, 0, 0}, u, v}, Triangle{off(), off(), off()}};
            const double s = random.integer(-255, 255), t = random.integer(-255, 255), r = random.integer(-255, 255);
            for (Triangle& triangle : pair)
              for (Point& p : triangle) {
                p.z += r * p.x + s * p.y;  // without rounding: these are integers below 2^53
                p.x += t * p.y;
                p = p + Vec3{7, -3, 11};
              }
            return pair;
          }};
}

/// Two triangles of such points, with none to three corners in common.
Pair pair_of(const points::Source& source, Random& random) {
  Pair pair{triangle_of(source, random), triangle_of(source, random)};
  const int shared = std::max(0, random.integer(-2, 3)), first = random.integer(0, 2);
  for (int i = 0; i < shared; ++i)
    pair[1][i] = pair[0][random.integer(0, 7) == 0 ? random.integer(0, 2) : (first + i) % 3];
  return pair;
}

/// On a lattice in a plane that no axis need be parallel to; some points are one step off it.
Pair pair_on_tilted_lattice(int limit, Random& random) {
  const Vec3 o = integers_below(random, limit), u = integers_below(random, limit), v = integers_below(random, limit);
  const auto point = [&](Random& r) {
    const Vec3 off = r.integer(0, 7) == 0 ? integers_below(r, 1) : Vec3{0, 0, 0};
    const double i = r.integer(-2, 2), j = r.integer(-2, 2);
    return o + i * u + j * v + off;
  };
  return pair_of(point, random);
}

}  // namespace

std::vector<PairFamily> pair_families() {
  std::vector<PairFamily> families{
      moved_lattice("lattice in motion", 10, false),
      moved_lattice("lattice in motion at the origin", 0, false),
      moved_lattice("lattice in motion, a million away", 1e6, false),
      moved_lattice("two lattices in motion", 10, true),
      moved_lattice("two lattices in motion, a million away", 1e6, true),
      sheared("determinants of a unit, terms of 60 bits", 12),
      sheared("determinants of a unit, terms of 129 bits", 35),
  };
  const auto add_tilted = [&](const char* name, int limit) {
    families.push_back({name, [=](Random& random) { return pair_on_tilted_lattice(limit, random); }});
  };
  add_tilted("tilted lattice of 3", 3);
  add_tilted("tilted lattice of 1000", 1000);
  add_tilted("tilted lattice of 2^22", 1 << 22);  // its points are from below 2^24 to above
  add_tilted("tilted lattice of 2^29", 1 << 29);
  const auto add = [&](std::string name, const points::Source& source) {
    families.push_back({std::move(name), [=](Random& random) { return pair_of(source, random); }});
  };
  add("integers 0 to 1", points::integers(0, 1));
  add("integers -1 to 1", points::integers(-1, 1));
  add("integers 0 to 3", points::integers(0, 3));
  add("integers to 1000", points::integers(-1000, 1000));
  for (const int bits : {24, 25, 52}) add("integers of " + std::to_string(bits) + " bits", long_integers(bits));
  add("decimals", decimals());
  add("nearly degenerate", points::nearly_degenerate());
  add("uniform", points::anything());
  add("dust of 2^-60", dusty(-60));
  add("dust of 2^-110", dusty(-110));
  add("whole domain", points::whole_domain());
  add("lattice of both ends", points::stretched_integers(0x1p299, 1, 0x1p-358));
  return families;
}

std::optional<Kind> kind_of(const Pair& pair) {
  const auto meeting = oracle::meeting(points::exact_corners(pair[0]), points::exact_corners(pair[1]));
  return meeting ? std::optional(static_cast<Kind>(*meeting)) : std::nullopt;
}

int side_of(const Point& a, const Point& b, const Point& c, const Point& d) {
  using oracle::operator-;
  const auto o = points::exact(a);
  return sgn(oracle::dot(oracle::cross(points::exact(b) - o, points::exact(c) - o), points::exact(d) - o));
}

Pair varied(const Pair& pair, Random& random) {
  std::array<int, 3> axes{0, 1, 2};
  std::array<double, 3> factors{};
  for (int i = 2; i > 0; --i) std::swap(axes[i], axes[random.integer(0, i)]);
  for (int axis = 0; axis < 3; ++axis) {
    int lowest = 300, highest = -358;
    for (const Triangle& t : pair)
      for (const Point& p : t) {
        const double x = component(p, axis);
        if (x != 0) lowest = std::min(lowest, lowest_bit(x)), highest = std::max(highest, exponent(x));
      }
    const int shift = lowest > highest ? 0 : random.integer(-358 - lowest, 299 - highest);
    factors[axis] = std::ldexp(random.integer(0, 1) == 0 ? 1 : -1, random.integer(0, 2) == 0 ? 0 : shift);
  }
  const auto mapped = [&](const Point& p) {
    std::array<double, 3> q{factors[0] * p.x, factors[1] * p.y, factors[2] * p.z};
    return Point{q[axes[0]], q[axes[1]], q[axes[2]]};
  };
  const bool swapped = random.integer(0, 1) == 1;
  Pair result{pair[swapped ? 1 : 0], pair[swapped ? 0 : 1]};
  for (Triangle& t : result) {
    for (int i = 2; i > 0; --i) std::swap(t[i], t[random.integer(0, i)]);
    for (Point& p : t) p = mapped(p);
  }
  return result;
}

std::string written(const Pair& pair) {
  std::string text;
  for (const Triangle& t : pair)
    for (const Point& p : t) {
      std::array<char, 128> point{};
      std::snprintf(point.data(), point.size(), "(%a, %a, %a) ", p.x, p.y, p.z);
      text += point.data();
    }
  return text;
}

}  // namespace impinge::test
