// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "impinge/impinge.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

/// The error has this code, and its sentence has each of these words.
template <class T>
void expect_error(const Result<T>& result, Code code, std::initializer_list<const char*> words) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, code);
  for (const char* word : words)
    EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
}

Result<Mesh> create(const std::vector<double>& xyz, const std::vector<std::uint32_t>& triangles,
                    const TreeConfig& tree = {}) {
  return Mesh::create(std::span<const double>(xyz), triangles, tree);
}

TEST(MeshCreate, NamesThePlaceOfWhatIsWrong) {
  const std::vector<double> three{0, 0, 0, 1, 0, 0, 0, 1, 0};
  expect_error(create({0, 0, 0, 1}, {}), Code::bad_mesh, {"coordinates", "4"});
  expect_error(create(three, {0, 1}), Code::bad_mesh, {"indices", "2"});
  expect_error(create(three, {0, 1, 2, 2, 1, 3}), Code::bad_mesh, {"triangle 1", "vertex 3"});
  expect_error(create(three, {0, 1, 0xFFFFFFFF}), Code::bad_mesh, {"triangle 0", "4294967295"});
  expect_error(create({}, {0, 0, 0}), Code::bad_mesh, {"triangle 0", "vertex 0"});
  for (const double bad : {kNaN, kInfinity, -kInfinity})
    for (std::size_t i = 0; i < 9; ++i) {
      std::vector<double> xyz = three;
      xyz[i] = bad;
      const std::string vertex = "vertex " + std::to_string(i / 3);
      expect_error(create(xyz, {0, 1, 2}), Code::bad_mesh, {vertex.c_str(), "finite"});
      const std::vector<float> floats(xyz.begin(), xyz.end());
      const std::vector<std::uint32_t> none;
      expect_error(Mesh::create(std::span<const float>(floats), none), Code::bad_mesh, {vertex.c_str(), "finite"});
    }
  for (const std::uint32_t size : {257u, 0xFFFFFFFFu})
    expect_error(create(three, {0, 1, 2}, {size}), Code::bad_option, {"leaf_size", std::to_string(size).c_str()});
  for (const std::uint32_t size : {0u, 1u, 256u}) EXPECT_TRUE(create(three, {0, 1, 2}, {size}));
}

TEST(MeshTree, IsMadeAtOnceOrBitByBitWithTheSameAnswers) {
  const scenes::MeshData knot = scenes::torus_knot_of(968);
  const Pose pose{.t = {0.3, 0.2, 0.1}};
  const Mesh lazy = test::mesh_of(knot);
  const std::size_t empty = lazy.memory_bytes();
  EXPECT_GT(empty, 0u);
  const Contacts expected = collide(lazy, {}, lazy, pose, {.threads = 1}).value();
  EXPECT_GT(expected.statistics.nodes_built, 0u);
  EXPECT_GT(lazy.memory_bytes(), empty);
  for (const int threads : {0, 1, 2, 8}) {
    const Mesh built = test::mesh_of(knot);
    ASSERT_TRUE(built.build_tree(threads));
    const std::size_t whole = built.memory_bytes();
    EXPECT_GT(whole, empty);
    const Contacts found = collide(built, {}, built, pose, {.threads = 1}).value();
    test::expect_same(expected, found);
    EXPECT_EQ(found.statistics.nodes_built, 0u);
    EXPECT_EQ(built.memory_bytes(), whole);
    ASSERT_TRUE(built.build_tree(threads));  // again
    ASSERT_TRUE(lazy.build_tree(threads));   // what is left
    test::expect_same(expected, collide(lazy, {}, lazy, pose).value());
  }
  EXPECT_EQ(collide(lazy, {}, lazy, {}, {.threads = 1})->statistics.nodes_built, 0u);
}

TEST(MeshTree, OfWhatHasNoTriangles) {
  const Mesh empty = test::mesh_of({});
  EXPECT_TRUE(empty.build_tree());
  EXPECT_TRUE(empty.build_tree(2));
  expect_error(empty.build_tree(-1), Code::bad_option, {"threads", "-1"});
  expect_error(test::mesh_of(scenes::cube()).build_tree(-3), Code::bad_option, {"threads", "-3"});
}

TEST(MeshCreate, KeepsWhatItIsGiven) {
  const Mesh mesh = create({0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 7, 7}, {0, 1, 2, 2, 2, 2, 0, 1, 2}).value();
  EXPECT_EQ(mesh.vertex_count(), 4u);
  EXPECT_EQ(mesh.triangle_count(), 3u);
  EXPECT_EQ(mesh.vertices()[3], (Point{7, 7, 7}));
  EXPECT_EQ(mesh.triangles()[1], (std::array<std::uint32_t, 3>{2, 2, 2}));
  // The last vertex is not in use: the sphere is about the longest segment of the others.
  EXPECT_NEAR(mesh.sphere_radius(), std::sqrt(77.0) / 2, 1e-12);
  EXPECT_NEAR(mesh.sphere_center().z, 3, 1e-12);
}

TEST(Mesh, WithoutTrianglesTouchesNothing) {
  const Mesh empty = create({}, {}).value(), points = create({0, 0, 0, 1, 1, 1}, {}).value();
  const Mesh cube = test::mesh_of(scenes::cube());
  for (const Mesh& nothing : {empty, points}) {
    EXPECT_EQ(nothing.sphere_radius(), 0);
    EXPECT_EQ(nothing.sphere_center(), (Point{0, 0, 0}));
    const auto contacts = collide(nothing, {}, cube, {});
    ASSERT_TRUE(contacts);
    EXPECT_TRUE(contacts->objects.empty());
    EXPECT_EQ(contacts->offsets, std::vector<std::uint64_t>{0});
    EXPECT_EQ(contacts->hash, 0u);
    Scene scene;
    const ObjectId id = scene.add(nothing).value();
    ASSERT_TRUE(scene.add(cube));
    EXPECT_EQ(scene.size(), 2u);
    EXPECT_TRUE(scene.collide()->objects.empty());
    EXPECT_TRUE(scene.set_pose(id, {}));
    EXPECT_TRUE(scene.remove(id));
  }
}

TEST(Mesh, OfFloatsIsThatOfTheSameDoubles) {
  test::Seeded seeded(1);
  const scenes::MeshData soup = scenes::triangle_soup(seeded.random, 200, 0.5);
  const std::vector<float> floats(soup.xyz.begin(), soup.xyz.end());
  const std::vector<double> doubles(floats.begin(), floats.end());
  const Mesh of_floats = Mesh::create(std::span<const float>(floats), soup.triangles).value();
  const Mesh of_doubles = create(doubles, soup.triangles).value();
  EXPECT_EQ(of_floats.precision(), Precision::single);
  EXPECT_EQ(of_doubles.precision(), Precision::whole);
  const Pose pose = scenes::random_motion(seeded.random, 0.3);
  const Contacts expected = collide(of_doubles, {}, of_doubles, pose).value();
  EXPECT_FALSE(expected.triangles.empty());
  test::expect_same(expected, collide(of_floats, {}, of_floats, pose).value());
}

/// The mesh of these numbers, deformed from other ones, whose tree is there to be refitted or is not.
Mesh deformed_to(const scenes::MeshData& numbers, bool has_tree, scenes::Random& random, std::uint32_t leaf_size = 0) {
  scenes::MeshData before = numbers;
  for (double& x : before.xyz) x = random.uniform(-1, 1);
  const Mesh mesh = test::mesh_of(before, leaf_size);
  if (has_tree) {
    EXPECT_TRUE(mesh.build_tree(1));
  }
  return mesh.deformed(numbers.xyz).value();
}

TEST(Deformed, AnswersAsTheMeshOfTheSameNumbers) {
  test::Seeded seeded(3);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 24)) {
    SCOPED_TRACE(named.name);
    const auto &a = named.scene.objects[0], &b = named.scene.objects[1];
    for (const std::uint32_t leaf_size : {0u, 5u}) {
      const auto meshes = test::meshes_of(named.scene, leaf_size);
      const Mesh mesh_a = deformed_to(named.scene.meshes[a.mesh], true, seeded.random, leaf_size),
                 mesh_b = deformed_to(named.scene.meshes[b.mesh], leaf_size == 0, seeded.random, leaf_size);
      for (const char* const backend : {"simd", "paper"}) {
        const Options options{.threads = 1, .backend = backend};
        const auto expected = collide(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose, options),
                   found = collide(mesh_a, a.pose, mesh_b, b.pose, options);
        ASSERT_TRUE(expected && found);
        test::expect_same(*expected, *found);
        EXPECT_EQ(test::listed(*found), test::brute_force(named.scene));
        test::expect_same(*expected, test::scene_of(named.scene, leaf_size).collide(options).value());
      }
      EXPECT_EQ(mesh_a.sphere_radius(), meshes[a.mesh].sphere_radius());
    }
  }
}

TEST(Deformed, MeasuresAndJudgesAsTheMeshOfTheSameNumbers) {
  test::Seeded seeded(4);
  const scenes::MeshData ball = scenes::uv_sphere(24, 16), knot = scenes::torus_knot_of(968);
  for (const double x : {1.2, 2.5, 9.0})
    for (const bool mild : {false, true}) {
      scenes::MeshData before = ball;
      for (double& c : before.xyz) c += mild ? 0.1 * std::sin(9 * c) : seeded.random.uniform(-1, 1);
      const Mesh fresh = test::mesh_of(ball), other = test::mesh_of(knot);
      const Mesh source = test::mesh_of(before);
      EXPECT_TRUE(source.build_tree(1));
      const Mesh deformed = source.deformed(ball.xyz).value();
      const Pose pose{.t = {x, 0.1, 0.2}};
      const Nearest expected = distance(fresh, {}, other, pose).value(),
                    found = distance(deformed, {}, other, pose).value();
      EXPECT_NEAR(expected.distance, found.distance, expected.error + found.error);
      EXPECT_EQ(expected.distance == 0, found.distance == 0);
      EXPECT_EQ(closer_than(deformed, {}, other, pose, 0.5).value(), expected.distance < 0.5);
      EXPECT_EQ(locate({0.1, 0.2, 0.3}, deformed).value(), Location::inside);
      const ClashOptions options{.tolerance = 0.01, .clearance = 1, .regions = true};
      const Clash judged = judge(fresh, {}, other, pose, options).value(),
                  again = judge(deformed, {}, other, pose, options).value();
      EXPECT_EQ(judged.verdict, again.verdict);
      EXPECT_EQ(judged.contacts, again.contacts);
      EXPECT_EQ(judged.regions.size(), again.regions.size());
      const auto regions = contact_regions(fresh, {}, other, pose).value(),
                 same = contact_regions(deformed, {}, other, pose).value();
      ASSERT_EQ(regions.size(), same.size());
      for (std::size_t i = 0; i < regions.size(); ++i) {
        EXPECT_EQ(regions[i].triangles_a, same[i].triangles_a);
        EXPECT_EQ(regions[i].triangles_b, same[i].triangles_b);
        EXPECT_EQ(regions[i].lines, same[i].lines);
      }
    }
}

TEST(Deformed, NamesTheVertexThatIsWrong) {
  const Mesh cube = test::mesh_of(scenes::cube());
  std::vector<double> xyz = scenes::cube().xyz;
  const std::string count = std::to_string(cube.vertex_count());
  for (const double bad : {kNaN, kInfinity}) {
    std::vector<double> with_bad = xyz;
    with_bad[13] = bad;
    expect_error(cube.deformed(with_bad), Code::bad_mesh, {"vertex 4", "finite"});
  }
  expect_error(cube.deformed(std::span(xyz).first(16)), Code::bad_mesh, {"vertex 5", count.c_str()});
  expect_error(cube.deformed({}), Code::bad_mesh, {"vertex 0", count.c_str()});
  xyz.push_back(1);
  expect_error(cube.deformed(xyz), Code::bad_mesh, {("vertex " + count).c_str(), count.c_str()});
  EXPECT_TRUE(test::mesh_of({}).deformed({}));
}

TEST(Transformed, IsThePoseBaked) {
  test::Seeded seeded(2);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random, 24)) {
    SCOPED_TRACE(named.name);
    const std::vector<Mesh> meshes = test::meshes_of(named.scene);
    std::vector<Mesh> baked;
    for (const auto& object : named.scene.objects)
      baked.push_back(meshes[object.mesh].transformed({object.pose.R, object.pose.t}).value());
    const auto &a = named.scene.objects[0], &b = named.scene.objects[1];
    for (std::size_t i = 0; i < baked[0].vertex_count(); ++i)
      ASSERT_EQ(baked[0].vertices()[i], world_vertex(a.pose, meshes[a.mesh].vertices()[i]));
    const auto posed = collide(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose),
               at_rest = collide(baked[0], {}, baked[1], {});
    ASSERT_TRUE(posed && at_rest);
    EXPECT_EQ(test::listed(*posed), test::listed(*at_rest));
  }
}

TEST(Transformed, MirrorsAndScalesAndKeepsOrder) {
  const Mesh cube = test::mesh_of(scenes::cube(), 3);
  const Mesh mirrored = cube.transformed({{-2, 0, 0, 0, 1, 0, 0, 0, 0}, {5, 0, 0}}).value();
  EXPECT_TRUE(std::equal(cube.triangles().begin(), cube.triangles().end(), mirrored.triangles().begin()));
  for (std::size_t i = 0; i < cube.vertex_count(); ++i)
    EXPECT_EQ(mirrored.vertices()[i], (Point{5 - 2 * cube.vertices()[i].x, cube.vertices()[i].y, 0}));
}

TEST(Transformed, RefusesWhatIsNotFinite) {
  const Mesh cube = test::mesh_of(scenes::cube());
  for (const double bad : {kNaN, kInfinity}) {
    Affine map;
    map.m[4] = bad;
    expect_error(cube.transformed(map), Code::bad_pose, {"matrix", "finite"});
    map = {};
    map.t[2] = bad;
    expect_error(cube.transformed(map), Code::bad_pose, {"translation", "finite"});
  }
  Affine huge;
  huge.m[0] = huge.t[0] = 1e308;
  expect_error(cube.transformed(huge), Code::out_of_range, {"vertex"});
}

TEST(Collide, RefusesBadPosesAndWorldsOutOfRange) {
  const Mesh cube = test::mesh_of(scenes::cube());
  const Pose mirror{.R = {-1, 0, 0, 0, 1, 0, 0, 0, 1}}, far{.t = {0, 0x1p300, 0}}, fine{.t = {0, 0x1p299, 0}};
  expect_error(collide(cube, {}, cube, mirror), Code::bad_pose, {"Mesh::transformed"});
  expect_error(collide(cube, mirror, cube, {}), Code::bad_pose, {"Mesh::transformed"});
  expect_error(collide(cube, {}, cube, far), Code::out_of_range, {"object 1", "2^300"});
  expect_error(collide(cube, far, cube, {}), Code::out_of_range, {"object 0", "2^300"});
  EXPECT_TRUE(collide(cube, fine, cube, {}));
  const Mesh small = cube.transformed({{0x1p-359, 0, 0, 0, 0x1p-359, 0, 0, 0, 0x1p-359}, {}}).value();
  expect_error(collide(small, {}, cube, {}), Code::out_of_range, {"object 0 is out of range", "2^-300"});
  // Where all of it is in the world, which is in the domain.
  EXPECT_EQ(collide(small, {.t = {1, 1, 1}}, cube, {})->objects.size(), 1u);
}

/// A mesh whose own numbers are below the least normal double, at a pose that rounds them away: all of it is one point.
TEST(Collide, TakesAMeshOfDenormalsAtAPoseInTheDomain) {
  const Mesh cube = test::mesh_of(scenes::cube());
  for (const double size : {0x1p-1074, 0x1p-1030, 0x1p-1000}) {
    const Mesh dust = cube.transformed({{size, 0, 0, 0, size, 0, 0, 0, size}, {}}).value();
    const auto contacts = collide(dust, {.t = {1, 0.5, 0.25}}, cube, {});
    ASSERT_TRUE(contacts) << contacts.error().message;
    EXPECT_GE(contacts->triangles.size(), 12u);  // every triangle of the dust with the face's one or two
    for (const Kind kind : contacts->kinds) EXPECT_EQ(kind, Kind::touching);
    EXPECT_TRUE(collide(dust, {.t = {1.5, 0.5, 0.25}}, cube, {})->triangles.empty());
  }
}

}  // namespace
}  // namespace impinge
