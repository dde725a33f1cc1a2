// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "paper/obb.hpp"

#include <gmpxx.h>

#include <cmath>
#include <numeric>

#include "core/pose.hpp"
#include "paper/obb_overlap.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/hierarchy/pinned.hpp"

namespace impinge {
namespace {

using paper::Obb;

using Rational3 = std::array<mpq_class, 3>;
Rational3 rational(const Vec3& v) { return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)}; }
mpq_class determinant(const Rational3& a, const Rational3& b, const Rational3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Whether p = center + axesᵀ u has a solution within the half extents, by Cramer's rule in rationals.
bool holds(const Obb& box, const Vec3& p) {
  Rational3 d = rational(p);
  const Rational3 center = rational(box.center);
  for (std::size_t i = 0; i < 3; ++i) d[i] -= center[i];
  const Rational3 x = rational(box.axes[0]), y = rational(box.axes[1]), z = rational(box.axes[2]);
  const mpq_class all = abs(mpq_class(determinant(x, y, z)));
  return abs(mpq_class(determinant(d, y, z))) <= all * box.half.x &&
         abs(mpq_class(determinant(x, d, z))) <= all * box.half.y &&
         abs(mpq_class(determinant(x, y, d))) <= all * box.half.z;
}

std::vector<std::uint32_t> all_triangles(const Mesh& mesh) {
  std::vector<std::uint32_t> ids(mesh.triangle_count());
  std::iota(ids.begin(), ids.end(), 0u);
  return ids;
}

void expect_true_box(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  const Obb box = paper::fit_obb(test::numbers_of(mesh), triangles);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) ASSERT_NEAR(dot(box.axes[i], box.axes[j]), i == j ? 1 : 0, 0x1p-49);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : mesh.triangles()[t]) ASSERT_TRUE(holds(box, mesh.vertices()[v]));
}

TEST(FitObb, HoldsEveryVertex) {
  test::Seeded seeded(1);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random)) {
    SCOPED_TRACE(named.name);
    for (const auto& object : scenes::baked(named.scene).meshes) {
      const Mesh mesh = test::mesh_of(object);
      const std::vector<std::uint32_t> all = all_triangles(mesh);
      expect_true_box(mesh, all);
      expect_true_box(mesh, std::span(all).first(1));
      expect_true_box(mesh, std::span(all).last(all.size() / 3));
    }
  }
}

/// Parts much smaller than the mesh, its offset or the unit: their covariance underflows beside it.
TEST(FitObb, HoldsEveryVertexAtEveryScale) {
  for (int power = -300; power <= 290; power += 10) {
    test::Seeded seeded(static_cast<std::uint64_t>(power + 1000));
    scenes::MeshData numbers = scenes::scaled(scenes::triangle_soup(seeded.random, 3, 1), std::ldexp(1.0, power),
                                              std::ldexp(1.0, power), std::ldexp(0x1p-40, power));
    numbers.add_triangle({1e6, 1e6, 0, -1e6, 0, 0, 0, 0, 1});
    const Mesh mesh = test::mesh_of(numbers);
    const std::vector<std::uint32_t> all = all_triangles(mesh);
    expect_true_box(mesh, all);
    for (std::size_t i = 0; i < all.size(); ++i) expect_true_box(mesh, std::span(all).subspan(i, 1));
  }
}

TEST(FitObb, IsTightAroundATurnedBox) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    test::Seeded seeded(seed);
    const auto bar =
        scenes::baked(scenes::box({-4, -2, -0.5}, {4, 2, 0.5}, 4), scenes::random_motion(seeded.random, 9));
    const Mesh mesh = test::mesh_of(bar);
    const Obb box = paper::fit_obb(test::numbers_of(mesh), all_triangles(mesh));
    const double volume = 8 * box.half.x * box.half.y * box.half.z;
    EXPECT_GE(volume, 32 * (1 - 1e-9));
    EXPECT_LE(volume, 32 * 1.5);  // the faces' diagonals turn the covariance a little
  }
}

bool may_overlap(const Obb& a, const Pose& pose_a, const MeshData& mesh_a, const Obb& b, const Pose& pose_b,
                 const MeshData& mesh_b) {
  const paper::RelativePose relative(pose_a, mesh_a, pose_b, mesh_b);
  return paper::may_overlap(a, relative.moved(b), relative.margin);
}

struct Placed {
  Mesh mesh;
  Pose pose;
};

/// A mesh of one triangle that `pose` brings to `corner` bit for bit, the other corners near `u` and `v`; nothing where
/// rounding leaves no such vertex.
std::optional<Placed> triangle_through(const Point& corner, const Point& u, const Point& v, const Pose& pose) {
  const std::optional<Vec3> y = test::pinned(corner, pose);
  if (!y) return std::nullopt;
  const Vec3 p = test::unposed(u, pose), q = test::unposed(v, pose);
  scenes::MeshData numbers;
  numbers.add_triangle({y->x, y->y, y->z, p.x, p.y, p.z, q.x, q.y, q.z});
  return Placed{test::mesh_of(numbers, 1), pose};
}

/// Two large flat triangles that share just a corner, one lying on the other's plane or hanging off its edge: along the
/// separating axis there is nothing to spare but the margin, and the corner is far from both boxes' centres, where a
/// matrix off a rotation shifts it most.
TEST(MayOverlap, NeverPartsTrianglesThatShareAPoint) {
  int attacks = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const double reach = std::array{0.0, 1.0, 1e3, 1e6}[seed % 4];
    std::array<Pose, 2> poses;
    for (Pose& pose : poses) {
      pose = scenes::random_motion(random, reach);
      if (seed % 3 != 0) pose.R = scenes::stretched_rotation(random, 9e-7);
      pose.t = poses[0].t;  // so that the meshes lie near their own origins
    }
    const double size = std::ldexp(1.0, random.integer(-20, 20));
    const Mat3 axes = to_mat3(scenes::random_rotation(random));
    const auto at = [&](double x, double y, double z) {
      return world_vertex({Pose{}.R, poses[0].t}, size * (transpose(axes) * Vec3{x, y, z}));
    };
    const Point corner = at(0, 0, 0);
    const double lift = seed % 2 == 0 ? 0 : random.uniform(0, 1);  // 0: as good as coplanar
    const auto flat = triangle_through(corner, at(1, random.uniform(-0.2, 0.2), 0), at(random.unit(), 1, 0), poses[0]);
    const auto other = triangle_through(corner, at(-1, -random.unit(), lift),
                                        at(-random.unit(), random.uniform(-1, 1), lift), poses[1]);
    if (!flat || !other) continue;
    for (const char* backend : {"simd", "paper"}) {
      const auto touch = collide(flat->mesh, poses[0], other->mesh, poses[1], {.backend = backend});
      ASSERT_TRUE(touch);
      EXPECT_EQ(touch->triangles.size(), 1u) << backend;
    }
    ASSERT_TRUE(
        intersects(test::world_triangles(flat->mesh, poses[0])[0], test::world_triangles(other->mesh, poses[1])[0]));
    const std::array<std::uint32_t, 1> first{0};
    const MeshData &a = test::numbers_of(flat->mesh), &b = test::numbers_of(other->mesh);
    const Obb box_a = paper::fit_obb(a, first), box_b = paper::fit_obb(b, first);
    EXPECT_TRUE(may_overlap(box_a, poses[0], a, box_b, poses[1], b));
    EXPECT_TRUE(may_overlap(box_b, poses[1], b, box_a, poses[0], a));
    EXPECT_TRUE(paper::may_reach(box_a, poses[0], rounding_radius(poses[0], a), {corner, corner}));
    EXPECT_TRUE(paper::may_reach(box_b, poses[1], rounding_radius(poses[1], b), {corner, corner}));
    ++attacks;
  }
  EXPECT_GT(attacks, 1500);
}

/// A triangle that is a point has no extent for errors to hide in: only the rounding of its world vertex is left.
TEST(MayOverlap, NeverPartsPointsThatRoundToOneWorldVertex) {
  int attacks = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    test::Seeded seeded(seed);
    std::array<Pose, 2> poses;
    for (Pose& pose : poses) {
      pose = scenes::random_motion(seeded.random, 1e6);
      pose.R = scenes::stretched_rotation(seeded.random);
      pose.t = poses[0].t;
    }
    const Point p = world_vertex(poses[0], {seeded.random.unit(), seeded.random.unit(), seeded.random.unit()});
    const auto one = triangle_through(p, p, p, poses[0]), other = triangle_through(p, p, p, poses[1]);
    if (!one || !other) continue;
    const std::array<std::uint32_t, 1> first{0};
    const auto point_box = [&](const Mesh& mesh) {
      scenes::MeshData point;
      const Point& v = mesh.vertices()[0];
      point.add_triangle({v.x, v.y, v.z, v.x, v.y, v.z, v.x, v.y, v.z});
      return test::mesh_of(point);
    };
    const Mesh mesh_a = point_box(one->mesh), mesh_b = point_box(other->mesh);
    const MeshData &a = test::numbers_of(mesh_a), &b = test::numbers_of(mesh_b);
    const Obb box_a = paper::fit_obb(a, first), box_b = paper::fit_obb(b, first);
    EXPECT_TRUE(may_overlap(box_a, poses[0], a, box_b, poses[1], b));
    EXPECT_TRUE(paper::may_reach(box_a, poses[0], rounding_radius(poses[0], a), {p, p}));
    EXPECT_TRUE(paper::may_reach(box_b, poses[1], rounding_radius(poses[1], b), {p, p}));
    for (const char* backend : {"simd", "paper"})
      EXPECT_EQ(collide(mesh_a, poses[0], mesh_b, poses[1], {.backend = backend})->triangles.size(), 1u) << backend;
    ++attacks;
  }
  EXPECT_GT(attacks, 200);
}

/// The ends of a segment are the corners of what its box reaches, so that the rounding of the world's vertices shows.
TEST(MayReach, HoldsTheWorldVerticesOfASegment) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    Pose pose = scenes::random_motion(random, 1e6);
    if (seed % 2 == 0) pose.R = scenes::stretched_rotation(random);
    scenes::MeshData numbers;
    const Vec3 p{random.unit(), random.unit(), random.unit()}, q{random.unit(), random.unit(), random.unit()};
    numbers.add_triangle({p.x, p.y, p.z, q.x, q.y, q.z, p.x, p.y, p.z});
    const Mesh mesh = test::mesh_of(numbers);
    const std::array<std::uint32_t, 1> first{0};
    const Obb box = paper::fit_obb(test::numbers_of(mesh), first);
    for (const Vec3& v : {p, q}) {
      const Point w = world_vertex(pose, v);
      EXPECT_TRUE(paper::may_reach(box, pose, rounding_radius(pose, test::numbers_of(mesh)), {w, w}));
    }
    const Point far = world_vertex(pose, p) + Vec3{3, 0, 0};
    EXPECT_FALSE(paper::may_reach(box, pose, rounding_radius(pose, test::numbers_of(mesh)), {far, far}));
  }
}

TEST(MayOverlap, PartsBoxesThatAreClearlyApart) {
  test::Seeded seeded(4);
  const Mesh bar = test::mesh_of(scenes::box({-4, -1, -1}, {4, 1, 1}));
  const MeshData& numbers = test::numbers_of(bar);
  const Obb box = paper::fit_obb(numbers, all_triangles(bar));
  const double half_diagonal = std::sqrt(18.0);
  int parted = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose a = scenes::random_motion(seeded.random, 0);
    Pose b = scenes::random_motion(seeded.random, 0);
    const Mat3 directions = to_mat3(scenes::random_rotation(seeded.random));
    const auto apart = [&](double distance) {
      const Vec3 t = distance * directions[0];
      b.t = {t.x, t.y, t.z};
      return !may_overlap(box, a, numbers, box, b, numbers);
    };
    EXPECT_TRUE(apart(2.1 * half_diagonal));
    EXPECT_FALSE(apart(0.9));  // both hold a ball of radius 1 about their centres
    parted += apart(1.2 * half_diagonal);
  }
  EXPECT_GT(parted, 50);  // the axes do their work, not just the size
}

}  // namespace
}  // namespace impinge
