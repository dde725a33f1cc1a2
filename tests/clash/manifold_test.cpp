// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/vec3.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;

std::array<double, 9> turn(int axis, double angle) {
  const std::size_t i = static_cast<std::size_t>(axis + 1) % 3, j = static_cast<std::size_t>(axis + 2) % 3;
  std::array<double, 9> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
  R[4 * i] = R[4 * j] = std::cos(angle), R[3 * i + j] = -std::sin(angle), R[3 * j + i] = std::sin(angle);
  return R;
}

Vec3 placed(const Pose& pose, const Vec3& p) { return to_mat3(pose.R) * p + Vec3{pose.t[0], pose.t[1], pose.t[2]}; }

Pose after(const Pose& second, const Pose& first) {
  const Mat3 R = to_mat3(second.R) * to_mat3(first.R);
  const Vec3 t = placed(second, {first.t[0], first.t[1], first.t[2]});
  return {.R = {R[0].x, R[0].y, R[0].z, R[1].x, R[1].y, R[1].z, R[2].x, R[2].y, R[2].z}, .t = {t.x, t.y, t.z}};
}

/// Each with its pose; a is a slab, if nothing else is said, with its top at z = 0.
struct Pair {
  std::string name;
  MeshData a, b;
  Pose pose_a, pose_b;
  Vec3 normal;
  double depth;
  std::vector<Vec3> deepest;  ///< of b's points, those of this depth
  std::uint32_t size;         ///< of all points, or 0 if it does not matter
};

MeshData slab() { return scenes::box({-4, -4, -1}, {4, 4, 0}); }
MeshData centred_cube() { return scenes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}); }

std::vector<Vec3> corners(double x0, double x1, double y0, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x0, y1, z}, {x1, y1, z}};
}

/// Boxes one in the other by a tenth, whose sides are flush with each other's: some, all, at either end.
std::vector<Pair> flush_pairs() {
  const MeshData cube = scenes::cube(), wide = scenes::box({0, 0, 0}, {2, 2, 1});
  const auto upon = [](std::string name, MeshData a, MeshData b, double x0, double x1, double y0, double y1) {
    const Pose pose{.t = {x0, y0, 0.9}};
    return Pair{std::move(name), std::move(a), std::move(b), {}, pose, {0, 0, 1}, 0.1, corners(x0, x1, y0, y1, 0.9), 4};
  };
  Pair nearly = upon("all sides but for 1e-19", cube, cube, 0, 1, 0, 1);
  nearly.pose_b.t = {1e-19, 1e-19, 0.9};
  return {
      upon("a flush side", wide, cube, 0.5, 1.5, 0, 1),
      upon("a flush side at the far end", wide, cube, 0.5, 1.5, 1, 2),
      upon("two flush sides", wide, cube, 0, 1, 0, 1),
      upon("two flush sides at the far end", wide, cube, 1, 2, 1, 2),
      upon("two flush sides at different ends", wide, cube, 0, 1, 1, 2),
      upon("two flush sides that face away", wide, scenes::box({0, 0, 0}, {1, 2, 1}), 0.5, 1.5, 0, 2),
      upon("three flush sides", wide, scenes::box({0, 0, 0}, {1, 2, 1}), 0, 1, 0, 2),
      upon("all sides", cube, cube, 0, 1, 0, 1),
      upon("flush sides, one beyond", cube, cube, 0.25, 1, 0, 1),
      upon("flush sides of many cells", wide, scenes::box({0, 0, 0}, {1, 1, 1}, 5), 0.5, 1.5, 0, 1),
      upon("flush with lines of cells", scenes::box({0, 0, 0}, {2, 2, 1}, 4), cube, 0.5, 1.5, 0, 1),
      std::move(nearly),
  };
}

/// Normals, depths and points by elementary geometry.
std::vector<Pair> known_pairs() {
  const double half = std::sqrt(0.5), tilt = 0.1;
  const Pose on_slab{.t = {0.25, -0.5, -0.125}};
  const std::vector<Vec3> feet = corners(0.25, 1.25, -0.5, 0.5, -0.125);
  // A cube that stands on an edge along y, or on a corner.
  const Pose on_edge{.R = turn(1, tilt), .t = {0, 0, std::sin(tilt) - 0.05}};
  const Pose on_corner = after({.t = {0, 0, -0.05}}, {.R = after({.R = turn(1, -0.6)}, {.R = turn(0, 0.7)}).R});
  const Vec3 edge = placed(on_edge, {1, 0, 0});
  const auto by_an_eighth = [&](std::string name, MeshData a, MeshData b) {
    return Pair{std::move(name), std::move(a), std::move(b), {}, on_slab, {0, 0, 1}, 0.125, feet, 4};
  };
  return {
      by_an_eighth("box in a slab", slab(), scenes::cube()),
      by_an_eighth("box of many cells", slab(), scenes::box({0, 0, 0}, {1, 1, 1}, 5)),
      by_an_eighth("slab of many cells", scenes::box({-4, -4, -1}, {4, 4, 0}, 9), scenes::cube()),
      by_an_eighth("normals inwards", scenes::inverted(slab()), scenes::inverted(scenes::cube())),
      {"slab in a box below",
       scenes::shifted(scenes::cube(), 0.25, -0.5, -0.875),
       slab(),
       {},
       {.t = {0, 0, 1}},
       {0, 0, 1},
       0.125,
       {},
       4},
      {"flush", slab(), scenes::cube(), {}, {.t = {0.25, -0.5, 0}}, {0, 0, 1}, 0, corners(0.25, 1.25, -0.5, 0.5, 0), 4},
      {"boxes one upon the other, not quite",
       scenes::cube(),
       scenes::cube(),
       {},
       {.t = {0.25, 0.125, 1 - 0x1p-7}},
       {0, 0, 1},
       0x1p-7,
       corners(0.25, 1, 0.125, 1, 1 - 0x1p-7),
       4},
      {"box on an edge", slab(), scenes::cube(), {}, on_edge, {0, 0, 1}, 0.05, {edge, {edge.x, 1, edge.z}}, 4},
      {"box on a corner", slab(), scenes::cube(), {}, on_corner, {0, 0, 1}, 0.05, {{0, 0, -0.05}}, 0},
      {"ball on a slab",
       slab(),
       scenes::uv_sphere(24, 24),
       {},
       {.t = {0.1, 0.2, 0.9}},
       {0, 0, 1},
       0.1,
       {{0.1, 0.2, -0.1}},
       0},
      {"ball on a ball",
       scenes::uv_sphere(24, 24),
       scenes::uv_sphere(24, 24),
       {},
       {.t = {0, 0, 1.9}},
       {0, 0, 1},
       0.1,
       {},
       0},
      {"edges that cross",
       centred_cube(),
       centred_cube(),
       {.R = turn(0, std::numbers::pi / 4)},
       {.R = turn(1, std::numbers::pi / 4), .t = {0, 0, 2 * half - 0.01}},
       {0, 0, 1},
       0.01,
       {},
       0},
      {"edge on a face",
       slab(),
       centred_cube(),
       {},
       {.R = {1, 0, 0, 0, 0.8, -0.6, 0, 0.6, 0.8}, .t = {0, 0, 0.7}},
       {0, 0, 1},
       0,
       {},
       2},
  };
}

struct Frame {
  std::string name;
  double scale;
  Pose pose;
};
std::vector<Frame> frames() {
  scenes::Random random(7);
  return {{"at rest", 1, {}},
          {"moved", 1, scenes::random_motion(random, 3)},
          {"far", 1, scenes::random_motion(random, 1e6)},
          {"tiny", 0x1p-70, scenes::random_motion(random, 0x1p-70)},
          {"large", 0x1p60, scenes::random_motion(random, 0x1p60)}};
}

/// One frame of a scene in which everything is as it was or moves.
std::vector<Manifold> next(ContactManifolds& manifolds, const Scene& scene) {
  const auto found = manifolds.update(scene, scene.collide().value());
  EXPECT_TRUE(found) << found.error().message;
  return {found->begin(), found->end()};
}

Manifold only(const std::vector<Manifold>& found) {
  EXPECT_EQ(found.size(), 1u);
  return found.empty() ? Manifold{} : found[0];
}

TEST(Manifolds, AreThoseOfElementaryGeometry) {
  std::vector<Pair> pairs = known_pairs();
  for (Pair& pair : flush_pairs()) pairs.push_back(std::move(pair));
  for (const Pair& pair : pairs)
    for (const Frame& frame : frames())
      for (const bool swapped : {false, true}) {
        SCOPED_TRACE(pair.name + ", " + frame.name + (swapped ? ", swapped" : ""));
        const double s = frame.scale;
        const auto at = [&](Pose pose) {
          for (double& t : pose.t) t *= s;
          return after(frame.pose, pose);
        };
        const auto mesh = [&](const MeshData& m) { return test::mesh_of(scenes::scaled(m, s, s, s)); };
        Scene scene;
        for (const bool is_a : {!swapped, swapped})
          ASSERT_TRUE(scene.add(mesh(is_a ? pair.a : pair.b), at(is_a ? pair.pose_a : pair.pose_b)));
        // Coordinates are off by 2^-53 of the largest, and directions by that over the size of the region; what
        // touches at rest may be apart after a motion.
        const Vec3 t{frame.pose.t[0], frame.pose.t[1], frame.pose.t[2]};
        const double off = 1e-15 * (norm(t) + 10 * s), bend = 1e-9 + 100 * off / s;
        ContactManifolds manifolds;
        const std::vector<Manifold> found = next(manifolds, scene);
        if (pair.depth == 0 && frame.name != "at rest") continue;
        const Manifold manifold = only(found);
        const Vec3 normal = (swapped ? -1.0 : 1.0) * (to_mat3(frame.pose.R) * pair.normal);
        EXPECT_LE(norm(manifold.normal - normal), bend);
        EXPECT_NEAR(manifold.depth, s * pair.depth, 20 * off + 10 * s * bend * bend);
        EXPECT_EQ(manifold.size, pair.size > 0 ? pair.size : manifold.size);
        ASSERT_GE(manifold.size, 1u);
        for (std::size_t i = 0; i < manifold.size; ++i) {
          const ManifoldPoint& point = manifold.points[i];
          EXPECT_NEAR(dot(point.a - point.b, manifold.normal), point.depth, 10 * off);
          EXPECT_LE(point.depth, manifold.depth);
        }
        for (const Vec3& expected : pair.deepest) {
          const Vec3 world = placed(frame.pose, s * expected);
          const auto is_it = [&](const ManifoldPoint& p) {
            return norm((swapped ? p.a : p.b) - world) < 100 * off + s * bend && p.depth >= manifold.depth - 100 * off;
          };
          EXPECT_TRUE(std::any_of(manifold.points.begin(), manifold.points.begin() + manifold.size, is_it))
              << world.x << ' ' << world.y << ' ' << world.z;
        }
      }
}

/// By the definition: the extent along the normal of the vertices of each that lie in the other and of the contour,
/// from the exact inside test and the exact regions.
TEST(Manifolds, HaveTheExtentOfTheirPatches) {
  test::Seeded seeded(11);
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const auto shape = [&] {
      const double x = seeded.random.uniform(0.5, 1), y = seeded.random.uniform(0.5, 1);
      return i % 2 == 0 ? scenes::scaled(scenes::uv_sphere(12, 12), x, y, 1)
                        : scenes::scaled(scenes::box({-1, -1, -1}, {1, 1, 1}, 3), x, y, 1);
    };
    const Mesh a = test::mesh_of(shape()), b = test::mesh_of(shape());
    const Pose pose_a = scenes::random_motion(seeded.random, 0.2), pose_b = scenes::random_motion(seeded.random, 1.2);
    Scene scene;
    ASSERT_TRUE(scene.add(a, pose_a));
    ASSERT_TRUE(scene.add(b, pose_b));
    ContactManifolds manifolds;
    const std::vector<Manifold> found = next(manifolds, scene);
    const std::vector<Region> regions = contact_regions(a, pose_a, b, pose_b).value();
    if (found.size() != 1 || regions.size() != 1 || regions[0].area == 0) continue;
    const Vec3 n = found[0].normal;
    EXPECT_GT(dot(n, regions[0].normal), 0);
    double high = -kInfinity, low = kInfinity;
    const auto see_both = [&](const Vec3& p) { high = std::max(high, dot(p, n)), low = std::min(low, dot(p, n)); };
    for (const auto& line : regions[0].lines)
      for (const Vec3& p : line) see_both(p);
    for (const Vec3& v : a.vertices())
      if (const Vec3 p = world_vertex(pose_a, v); locate(p, b, pose_b).value() == Location::inside)
        high = std::max(high, dot(p, n));
    for (const Vec3& v : b.vertices())
      if (const Vec3 p = world_vertex(pose_b, v); locate(p, a, pose_a).value() == Location::inside)
        low = std::min(low, dot(p, n));
    EXPECT_NEAR(found[0].depth, high - low, 1e-13);
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

/// Two feet that slide over a floor of many cells, while both turn and move.
TEST(Manifolds, KeepTheirIdsAndTheOrderOfTheirPoints) {
  const MeshData feet = scenes::joined(scenes::cube(), scenes::shifted(scenes::cube(), 2, 0, 0));
  Scene scene;
  const ObjectId floor = scene.add(test::mesh_of(scenes::box({-9, -9, -1}, {9, 9, 0}, 18))).value();
  const ObjectId table = scene.add(test::mesh_of(feet)).value();
  ContactManifolds manifolds;
  std::vector<Manifold> before;
  for (int i = 0; i < 20; ++i) {
    const Pose cart{.R = turn(2, 0.2 * i), .t = {3.0 * i, 1.0 * i, 0}};
    const Pose on_floor{.R = turn(2, 0.01 * i), .t = {-4 + 0.3 * i, 0.11 * i, -0.1}};
    ASSERT_TRUE(scene.set_pose(floor, cart));
    ASSERT_TRUE(scene.set_pose(table, after(cart, on_floor)));
    const std::vector<Manifold> found = next(manifolds, scene);
    ASSERT_EQ(found.size(), 2u);
    for (const Manifold& manifold : found) {
      ASSERT_EQ(manifold.size, 4u);
      if (i == 0) continue;
      const auto same = [&](const Manifold& m) { return m.id == manifold.id; };
      const auto old = std::find_if(before.begin(), before.end(), same);
      ASSERT_NE(old, before.end());
      for (std::size_t k = 0; k < 4; ++k) {
        // In the table's frame points stand still.
        const auto own = [&](const Vec3& p, int frame) {
          const Pose then = after({.R = turn(2, 0.2 * frame), .t = {3.0 * frame, 1.0 * frame, 0}},
                                  {.R = turn(2, 0.01 * frame), .t = {-4 + 0.3 * frame, 0.11 * frame, -0.1}});
          return transpose(to_mat3(then.R)) * (p - Vec3{then.t[0], then.t[1], then.t[2]});
        };
        EXPECT_LE(norm(own(manifold.points[k].b, i) - own(old->points[k].b, i - 1)), 1e-9);
      }
    }
    before = found;
  }
  // What was apart is another contact, and so is that of another object at the same index.
  std::vector<std::uint64_t> ids{before[0].id, before[1].id};
  const auto expect_new = [&] {
    for (const Manifold& manifold : next(manifolds, scene)) {
      EXPECT_EQ(std::count(ids.begin(), ids.end(), manifold.id), 0);
      ids.push_back(manifold.id);
    }
  };
  ASSERT_TRUE(scene.set_pose(floor, {}));
  ASSERT_TRUE(scene.set_pose(table, {.t = {0, 0, 1}}));
  EXPECT_EQ(next(manifolds, scene).size(), 0u);
  ASSERT_TRUE(scene.set_pose(table, {.t = {0, 0, -0.1}}));
  expect_new();
  ASSERT_TRUE(scene.remove(table));
  ASSERT_EQ(scene.add(test::mesh_of(feet), {.t = {0, 0, -0.1}}).value().index, table.index);
  expect_new();
  EXPECT_EQ(ids.size(), 6u);
}

/// Contacts that the scene cannot have.
TEST(Manifolds, RefuseContactsOfOthers) {
  Scene two, one;
  const Mesh cube = test::mesh_of(scenes::cube()), tetrahedron = test::mesh_of(scenes::box({0, 0, 0}, {1, 1, 1}, 2));
  ASSERT_TRUE(two.add(tetrahedron));
  ASSERT_TRUE(two.add(tetrahedron, {.t = {0.5, 0.5, 0.5}}));
  ASSERT_TRUE(one.add(cube));
  const Contacts contacts = two.collide().value();
  ContactManifolds manifolds;
  const auto code = [&](const Scene& scene, const Contacts& some) {
    return manifolds.update(scene, some).error().code;
  };
  EXPECT_EQ(code(one, contacts), Code::unknown_id);
  ASSERT_TRUE(one.add(cube));
  EXPECT_EQ(code(one, contacts), Code::unknown_id);
  EXPECT_EQ(code(two, two.collide({.limit = 1}).value()), Code::bad_option);
  EXPECT_EQ(code(two, two.collide({.find = Options::Find::first}).value()), Code::bad_option);
  EXPECT_EQ(code(two, two.collide({.kinds = kCrossing}).value()), Code::bad_option);
  EXPECT_EQ(next(manifolds, two).size(), 1u);

  // Of an object with itself there is nothing to leave.
  const MeshData crossed = scenes::joined(scenes::cube(), scenes::shifted(scenes::cube(), 0.5, 0.5, 0.5));
  Scene alone;
  ASSERT_TRUE(alone.self(alone.add(test::mesh_of(crossed)).value(), true));
  EXPECT_EQ(alone.collide()->objects.size(), 1u);
  EXPECT_TRUE(next(manifolds, alone).empty());
}

}  // namespace
}  // namespace impinge
