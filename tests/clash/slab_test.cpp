// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/slab.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/support.hpp"
#include "tests/oracle/rational.hpp"

// A slab holds every point within a 2048th of the tolerance of its triangle, and no point of it is farther than the
// tolerance. Points are held against the slab's half spaces as the library does, distances are rational.

namespace {

using oracle::operator-;

using impinge::Triangle;
using impinge::Vec3;
using impinge::clash::HalfSpace;
using impinge::clash::Slab;
namespace test = impinge::test;

oracle::Vec exact(const Vec3& p) { return oracle::vec(p.x, p.y, p.z); }

/// Of the square of the distance to a segment.
mpq_class square_to(const oracle::Vec& p, const oracle::Vec& from, const oracle::Vec& to) {
  const oracle::Vec along = to - from, reach = p - from;
  const mpq_class length = oracle::dot(along, along);
  mpq_class t = length == 0 ? mpq_class(0) : mpq_class(oracle::dot(reach, along) / length);
  t = std::clamp(t, mpq_class(0), mpq_class(1));
  const oracle::Vec rest{mpq_class(reach[0] - t * along[0]), mpq_class(reach[1] - t * along[1]),
                         mpq_class(reach[2] - t * along[2])};
  return oracle::dot(rest, rest);
}

mpq_class square_to(const Vec3& point, const Triangle& triangle) {
  const oracle::Vec p = exact(point), a = exact(triangle[0]), b = exact(triangle[1]), c = exact(triangle[2]);
  const oracle::Vec normal = oracle::cross(b - a, c - a);
  if (!oracle::is_zero(normal)) {
    const auto side = [&](const oracle::Vec& from, const oracle::Vec& to) {
      return oracle::dot(oracle::cross(to - from, p - from), normal);
    };
    if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0) {
      const mpq_class height = oracle::dot(normal, p - a);
      return height * height / oracle::dot(normal, normal);
    }
  }
  return std::min({square_to(p, a, b), square_to(p, b, c), square_to(p, c, a)});
}

bool holds(const Slab& slab, const Vec3& p) {
  const auto within = [&](const HalfSpace& half) { return impinge::dot(half.normal, p) <= half.offset; };
  return within(slab.top) && within(slab.bottom) &&
         std::all_of(slab.sides.begin(), slab.sides.begin() + static_cast<std::ptrdiff_t>(slab.size), within);
}

Vec3 direction(impinge::scenes::Random& random) {
  const Vec3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  return (1 / (impinge::norm(v) + 0x1p-60)) * v;
}

/// Triangles of all proportions, down to segments and points, with coordinates up to 1.
Triangle some_triangle(impinge::scenes::Random& random) {
  const auto point = [&] {
    return Vec3{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
  };
  Triangle t{point(), point(), point()};
  const double narrow = std::ldexp(1.0, -random.integer(0, 50));
  switch (random.integer(0, 4)) {
    case 0:
      break;
    case 1:  // a needle
      t[1] = t[0] + narrow * direction(random);
      break;
    case 2:  // a cap
      t[1] = t[0] + random.unit() * (t[2] - t[0]) + narrow * direction(random);
      break;
    case 3:  // small
      t[1] = t[0] + narrow * direction(random), t[2] = t[0] + narrow * direction(random);
      break;
    default:
      t[2] = t[random.integer(0, 1)];
  }
  return t;
}

TEST(Slab, HoldsWhatIsNearAndNothingThatIsFar) {
  int made = 0, unsure = 0, held = 0, flat = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    test::Seeded seeded(seed);
    auto& random = seeded.random;
    const Triangle t = some_triangle(random);
    const double tolerance = std::ldexp(1.0, -random.integer(4, 36));
    const auto slab = impinge::clash::make_slab(t, tolerance, 1);
    ++(slab ? made : unsure);
    if (!slab) continue;
    flat += slab->has_plane ? 1 : 0;
    const mpq_class most = mpq_class(tolerance) * tolerance;
    for (int i = 0; i < 12; ++i) {
      const double u = random.unit(), v = random.unit() * (1 - u);
      const Vec3 on = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      const Vec3 near = on + 0x1p-12 * tolerance * direction(random);
      EXPECT_TRUE(holds(*slab, near)) << "a point within 2^-12 of the tolerance";
      EXPECT_TRUE(overlap(slab->box, {near, near}));
      // Near a corner, an edge or the top: where a slab may reach too far.
      const Vec3 corner = t[static_cast<std::size_t>(random.integer(0, 2))];
      const Vec3 from = random.integer(0, 1) == 0 ? on : corner;
      const Vec3 far = from + random.uniform(0.9, 1.2) * tolerance * direction(random);
      if (!holds(*slab, far)) continue;
      ++held;
      EXPECT_LE(square_to(far, t), most);
    }
    // The corners of the slab itself, as far as floating point finds them: along its sides' outward normals.
    for (std::size_t i = 0; i < slab->size; ++i) {
      for (const HalfSpace* face : {&slab->top, &slab->bottom}) {
        for (const Vec3& corner : t) {
          Vec3 p = corner + (face->offset - impinge::dot(face->normal, corner)) * (1 - 0x1p-30) * face->normal;
          p = p +
              (slab->sides[i].offset - impinge::dot(slab->sides[i].normal, p)) * (1 - 0x1p-30) * slab->sides[i].normal;
          if (!holds(*slab, p)) continue;
          ++held;
          EXPECT_LE(square_to(p, t), most);
        }
      }
    }
    if (HasFailure()) FAIL() << "seed " << seed << ", tolerance " << tolerance;
  }
  // Nothing of this is empty talk.
  EXPECT_GT(made, 3500);
  EXPECT_GT(flat, 1500);
  EXPECT_GT(held, 4000);
  RecordProperty("unsure", unsure);
}

}  // namespace
