// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/tree_relation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "hierarchy/wide_tree.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/hierarchy/exact_frames.hpp"

/// The bounds of a relation against rational numbers, on poses off a rotation by 9e-7 and far from the origin.
namespace impinge {
namespace {

using hierarchy::TreeRelation;
using test::Rational3;

struct Side {
  Mesh mesh;
  Pose pose;
  int unit;
};

/// `off` is a distance of the vertices from the mesh's origin.
Side any_side(scenes::Random& random, int size_exponent, double off, double reach, bool stretched) {
  scenes::MeshData soup = scenes::triangle_soup(random, 3, 1);
  const double size = std::ldexp(1.0, size_exponent);
  soup = scenes::shifted(scenes::scaled(std::move(soup), size, size, size), off, -off, off / 3);
  Pose pose = scenes::random_motion(random, reach);
  if (stretched) pose.R = scenes::stretched_rotation(random, 9e-7);
  Mesh mesh = test::mesh_of(soup);
  const int unit = hierarchy::WideTree(test::numbers_of(mesh), 8).unit_exponent();
  return {std::move(mesh), pose, unit};
}

/// Relates the two, the larger unit first.
TreeRelation related(Side& a, Side& b) {
  if (a.unit < b.unit) std::swap(a, b);
  return hierarchy::relate(test::numbers_of(a.mesh), a.pose, a.unit, test::numbers_of(b.mesh), b.pose, b.unit);
}

mpq_class most_off(const std::array<Rational3, 3>& m) {
  mpq_class most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      mpq_class e = i == k ? -1 : 0;
      for (std::size_t l = 0; l < 3; ++l) e += m[l][i] * m[l][k];
      most = std::max<mpq_class>(most, abs(e));
    }
  return most;
}

std::array<Rational3, 3> matrix(const TreeRelation& relation) {
  std::array<Rational3, 3> m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) m[i][k] = relation.rows[i][k];
  return m;
}

/// The least and the greatest share of a bound that was used up.
struct Shares {
  double greatest = 0;
  void add(const mpq_class& used, double bound) {
    const mpq_class share = used / (mpq_class(bound) * mpq_class(bound));
    greatest = std::max(greatest, std::sqrt(share.get_d()));
  }
};

/// However far apart two world vertices are, the map takes the one's mesh point to the other's, but for what lies
/// between them in the world: a shared point is a special case, and one between vertices is no worse than they are.
/// A quarter of the error is for what users of the relation add in double, a quarter to spare.
TEST(TreeRelation, ErrorHoldsForWorldVertices) {
  Shares shares;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const double reach = std::array{0.0, 1.0, 1e6, 1e15}[seed % 4], off = std::array{0.0, 1e6, 1e15}[seed / 4 % 3];
    const int size = random.integer(-20, 20), other = seed % 5 == 0 ? random.integer(-60, 60) : random.integer(-20, 20);
    Side a = any_side(random, size, off, reach, seed % 3 != 0), b = any_side(random, other, off, reach, seed % 3 == 2);
    if (seed % 2 == 0) b.pose.t = a.pose.t;
    const TreeRelation relation = related(a, b);
    ASSERT_GE(a.unit, b.unit);
    const test::Unposed unposed(a.pose, a.unit);
    const std::array<Rational3, 3> m = matrix(relation);
    for (const Point& p : a.mesh.vertices())
      for (const Point& q : b.mesh.vertices()) {
        const Rational3 x = test::in_unit(test::rational(p), a.unit), y = test::in_unit(test::rational(q), b.unit);
        Rational3 off_by = unposed.direction(
            test::difference(test::rational(world_vertex(b.pose, q)), test::rational(world_vertex(a.pose, p))));
        for (std::size_t i = 0; i < 3; ++i) {
          mpq_class mapped = relation.t[i];
          for (std::size_t k = 0; k < 3; ++k) mapped += m[i][k] * (mpq_class(relation.scale) * y[k]);
          off_by[i] = mapped - x[i] - off_by[i];
        }
        ASSERT_LE(test::square(off_by), mpq_class(relation.error / 2) * mpq_class(relation.error / 2));
        shares.add(test::square(off_by), relation.error / 2);
      }
  }
  std::cout << "at most " << shares.greatest << " of the bound was used\n";
  EXPECT_GT(shares.greatest, 0.02);  // the attack comes near enough to notice a bound fifty times as small
}

TEST(TreeRelation, DefectHoldsForTheMatrix) {
  double greatest = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    test::Seeded seeded(seed);
    Side a = any_side(seeded.random, 0, 0, 1, seed % 3 != 0), b = any_side(seeded.random, 0, 0, 1, seed % 3 != 1);
    const TreeRelation relation = related(a, b);
    const mpq_class defect = most_off(matrix(relation));
    ASSERT_LE(defect, mpq_class(relation.defect));
    greatest = std::max(greatest, mpq_class(defect / mpq_class(relation.defect)).get_d());
  }
  EXPECT_GT(greatest, 0.1);
}

/// What is stored more than once says the same, and nothing stands in the lanes that vectors read along.
TEST(TreeRelation, HoldsItsMatrixTwice) {
  test::Seeded seeded(1);
  for (const int other : {0, -1, -40, -600}) {
    Side a = any_side(seeded.random, 0, 0, 10, true), b = any_side(seeded.random, other, 0, 10, true);
    const TreeRelation relation = related(a, b);
    EXPECT_EQ(relation.scale, std::ldexp(1.0, b.unit - a.unit));
    EXPECT_LE(relation.scale, 1);
    EXPECT_EQ(relation.t[3], 0);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(relation.rows[i][3], 0);
      EXPECT_EQ(relation.scaled_columns[i][3], 0);
      for (int k = 0; k < 3; ++k) EXPECT_EQ(relation.scaled_columns[k][i], relation.scale * relation.rows[i][k]);
    }
  }
}

}  // namespace
}  // namespace impinge
