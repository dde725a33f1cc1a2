// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gmpxx.h>

#include <cmath>
#include <limits>

#include "core/pose.hpp"
#include "scene/placed_block.hpp"
#include "scene/validate_pose.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

void expect_holds_world_vertices(const scene::PlacedObject& object, const Mesh& mesh, const Pose& pose) {
  const mpq_class square = mpq_class(object.sphere.radius) * object.sphere.radius;
  for (const auto& triangle : mesh.triangles())
    for (const std::uint32_t i : triangle) {
      const Point w = world_vertex(pose, mesh.vertices()[i]);
      ASSERT_TRUE(overlap(object.box, {w, w}));
      const mpq_class x = mpq_class(w.x) - object.sphere.center.x, y = mpq_class(w.y) - object.sphere.center.y,
                      z = mpq_class(w.z) - object.sphere.center.z;
      ASSERT_LE(x * x + y * y + z * z, square);
    }
}

TEST(Place, BoundsHoldEveryWorldVertex) {
  test::Seeded seeded(1);
  for (const test::NamedScene& named : test::hard_scenes(seeded.random)) {
    SCOPED_TRACE(named.name);
    const std::vector<Mesh> meshes = test::meshes_of(named.scene);
    for (const auto& object : named.scene.objects) {
      const Mesh& mesh = meshes[object.mesh];
      const auto placed = scene::place(test::numbers_of(mesh), object.pose, 5);
      EXPECT_EQ(placed.mesh, &test::numbers_of(mesh));
      EXPECT_EQ(placed.group, 5u);
      EXPECT_TRUE(placed.in_domain);
      expect_holds_world_vertices(placed, mesh, object.pose);
    }
  }
}

/// Where a bound has least to spare: vertices at its border, the matrix off by 9e-7, a translation of 1e6.
TEST(Place, BoundsHoldWhereTheyAreTight) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    scenes::MeshData numbers = seed % 2 == 0 ? scenes::cube() : scenes::uv_sphere(8, 6);
    numbers = scenes::shifted(numbers, random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
    const Mesh mesh = test::mesh_of(numbers);
    Pose pose = scenes::random_motion(random, seed % 3 == 0 ? 1e6 : seed % 3 == 1 ? 1 : 0);
    if (seed % 4 != 0) pose.R = scenes::stretched_rotation(random);
    expect_holds_world_vertices(scene::place(test::numbers_of(mesh), pose, 0), mesh, pose);
  }
}

/// Unit cubes at quarters of their size: they share a point where no coordinate differs by more than 1.
TEST(Place, BlocksAreApartWhereNoPointIsShared) {
  const Mesh cube = test::mesh_of(scenes::cube());
  const Pose origin;
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    for (int i = 0; i < 17 * 17 * 17; ++i) {
      const Pose pose{.t = {0.25 * (i % 17) - 2, 0.25 * (i / 17 % 17) - 2, 0.25 * (i / 289) - 2}};
      const double most = std::max({std::abs(pose.t[0]), std::abs(pose.t[1]), std::abs(pose.t[2])});
      scene::PlacedBlock block;
      block.add(test::numbers_of(cube), origin), block.add(test::numbers_of(cube), pose);
      ASSERT_EQ(block.compute_apart(), most > 1) << pose.t[0] << ' ' << pose.t[1] << ' ' << pose.t[2];
    }
  }
}

/// Every lane of a block, full or not, has its own mesh and pose, on every instruction set.
TEST(Place, BlocksKeepTheirLanesApart) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    test::Seeded seeded(6);
    scenes::Random& random = seeded.random;
    for (int round = 0; round < 40; ++round) {
      std::vector<Mesh> meshes;
      std::vector<Pose> poses;
      std::vector<bool> are_valid;
      const std::size_t size = 1 + static_cast<std::size_t>(round) % scene::PlacedBlock::kMost;
      for (std::size_t i = 0; i < size; ++i) {
        meshes.push_back(
            test::mesh_of(scenes::shifted(scenes::cube(), random.uniform(-2, 2), random.uniform(-2, 2), 0)));
        Pose pose = scenes::random_motion(random, 1e6);
        if (i % 3 == 1) pose.R = scenes::stretched_rotation(random);
        const int fault = random.integer(0, 7);  // from 5 on there is none
        double& entry = pose.R[static_cast<std::size_t>(random.integer(0, 8))];
        if (fault == 0) entry += 0.01;
        if (fault == 1) entry = kNone;
        if (fault == 2) entry = -kInfinity;
        if (fault == 3) pose.t[static_cast<std::size_t>(random.integer(0, 2))] = kNone;
        if (fault == 4)
          std::swap(pose.R[0], pose.R[3]), std::swap(pose.R[1], pose.R[4]), std::swap(pose.R[2], pose.R[5]);
        poses.push_back(pose), are_valid.push_back(fault >= 5);
      }
      scene::PlacedBlock block;
      for (std::size_t i = 0; i < size; ++i) block.add(test::numbers_of(meshes[i]), poses[i]);
      block.compute();
      ASSERT_EQ(block.size(), size);
      for (std::size_t i = 0; i < size; ++i) {
        ASSERT_EQ(block.is_valid(i), are_valid[i]) << "lane " << i;
        if (!are_valid[i]) continue;
        scene::PlacedObject object;
        block.write(i, object);
        EXPECT_EQ(object.mesh, &test::numbers_of(meshes[i]));
        expect_holds_world_vertices(object, meshes[i], poses[i]);
        EXPECT_LT(norm(object.box.hi - object.box.lo), 4);
      }
    }
  }
}

TEST(Place, BoxAtRestIsTheMeshsBox) {
  const Mesh mesh = test::mesh_of(scenes::box({1, 2, 3}, {2, 4, 9}));
  const Box box = scene::place(test::numbers_of(mesh), {}, 0).box;
  const auto near = [](double x, double expected) { return std::abs(x - expected) <= 1e-12; };
  EXPECT_TRUE(near(box.lo.x, 1) && near(box.lo.y, 2) && near(box.lo.z, 3));
  EXPECT_TRUE(near(box.hi.x, 2) && near(box.hi.y, 4) && near(box.hi.z, 9));
}

TEST(Place, MeshWithoutTrianglesIsNowhere) {
  const Mesh mesh = Mesh::create(std::vector<double>{1, 2, 3}, {}).value();
  EXPECT_EQ(scene::place(test::numbers_of(mesh), {}, 0).mesh, nullptr);
}

TEST(Place, KeyIsOfTheNumbersAlone) {
  const Mesh cube = test::mesh_of(scenes::cube()), again = test::mesh_of(scenes::cube(), 2);
  const auto key = [](const Mesh& mesh, const Pose& pose) { return scene::key(test::numbers_of(mesh), pose); };
  EXPECT_EQ(key(cube, {}), key(again, {}));
  EXPECT_EQ(key(cube, {}), key(cube, {.R = {1, -0.0, 0, 0, 1, -0.0, 0, 0, 1}, .t = {-0.0, 0, -0.0}}));
  EXPECT_NE(key(cube, {}), key(cube, {.t = {0, 0, 0x1p-1074}}));
  EXPECT_NE(key(cube, {}), key(test::mesh_of(scenes::shifted(scenes::cube(), 1, 0, 0)), {}));
  scenes::MeshData negative = scenes::cube();
  for (double& x : negative.xyz)
    if (x == 0) x = -0.0;
  EXPECT_EQ(key(cube, {}), key(test::mesh_of(negative), {}));
}

/// The glance at the exponents never says yes where the full test says no.
TEST(Place, DomainIsThatOfTheWorldVertices) {
  int inside = 0, outside = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    scenes::MeshData numbers = scenes::cube();
    const int magnitude = seed % 2 == 0 ? random.integer(285, 310) : random.integer(-370, -250);
    for (double& x : numbers.xyz) x = std::ldexp(x == 0 ? 0 : random.uniform(0.5, 1), magnitude);
    const Mesh mesh = test::mesh_of(numbers);
    Pose pose = scenes::random_motion(random, 0);
    if (seed % 3 == 0) pose.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (double& t : pose.t) t = seed % 5 == 0 ? 0 : std::ldexp(random.uniform(-1, 1), random.integer(-320, 305));
    const bool expected = in_exact_domain(pose, test::numbers_of(mesh));
    const scene::PlacedObject placed = scene::place(test::numbers_of(mesh), pose, 0);
    ASSERT_EQ(placed.is_outside_exact_domain, !expected);
    ASSERT_EQ(placed.in_domain, expected || in_range(pose, test::numbers_of(mesh)));
    ++(expected ? inside : outside);
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
}

TEST(ValidatePose, HasItsBorderWhereTheContractHasIt) {
  int accepted = 0, refused = 0;
  double stretch = 1 + 4.9999e-7;
  for (int i = 0; i < 4000; ++i, stretch = std::nextafter(stretch + 1e-14, 2)) {
    Pose pose;
    pose.R[4] = stretch;
    const bool expected = stretch * stretch - 1 <= 1e-6;
    EXPECT_EQ(scene::validate(pose).has_value(), expected);
    ++(expected ? accepted : refused);
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
  test::Seeded seeded(5);
  for (int i = 0; i < 100; ++i) {
    Pose pose;
    pose.R = scenes::stretched_rotation(seeded.random, 9e-7);
    EXPECT_TRUE(scene::validate(pose));
    pose.R = scenes::stretched_rotation(seeded.random, 1.1e-6);
    EXPECT_FALSE(scene::validate(pose));
  }
}

TEST(ValidatePose, SaysWhatIsWrongAndWhatToDo) {
  const auto error_of = [](const Pose& pose) {
    const auto result = scene::validate(pose);
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error().code, Code::bad_pose);
    return result.error().message;
  };
  const auto names = [](const std::string& message, const char* word) {
    return message.find(word) != std::string::npos;
  };
  Pose pose;
  pose.R = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_TRUE(names(error_of(pose), "mirror") && names(error_of(pose), "Mesh::transformed"));
  pose.R = {2, 0, 0, 0, 2, 0, 0, 0, 2};
  EXPECT_TRUE(names(error_of(pose), "rotation") && names(error_of(pose), "Mesh::transformed"));
  pose.R = {};
  EXPECT_TRUE(names(error_of(pose), "rotation"));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (std::size_t i = 0; i < 9; ++i) {
      pose = {};
      pose.R[i] = bad;
      EXPECT_TRUE(names(error_of(pose), "matrix"));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      pose = {};
      pose.t[i] = bad;
      EXPECT_TRUE(names(error_of(pose), "translation"));
    }
  }
}

TEST(PoseFromQuaternion, TurnsAsItsAxisAndAngleSay) {
  // A quarter about z, of any length; and a third of a turn about (1, 1, 1), which moves x to y to z.
  for (const double length : {1.0, 0x1p-1060, 0x1p1000, 0x1.8p1023, -3.0}) {
    EXPECT_EQ(Pose::from_quaternion({.w = length, .z = length})->R,
              (std::array<double, 9>{0, -1, 0, 1, 0, 0, 0, 0, 1}));
    EXPECT_EQ(Pose::from_quaternion({length, length, length, length})->R,
              (std::array<double, 9>{0, 0, 1, 1, 0, 0, 0, 1, 0}));
  }
  EXPECT_EQ(Pose::from_quaternion({}, {1, 2, 3})->t, (std::array<double, 3>{1, 2, 3}));
  test::Seeded seeded(6);
  const auto random = [&] { return seeded.random.uniform(-1, 1); };
  for (int i = 0; i < 1000; ++i) {
    const Vec3 axis{random(), random(), random()};
    const double half = 3 * random();
    const Pose pose = Pose::from_quaternion({std::cos(half) * norm(axis), std::sin(half) * axis.x,
                                             std::sin(half) * axis.y, std::sin(half) * axis.z})
                          .value();
    EXPECT_LE(orthogonality_defect(pose), 1e-15);
    EXPECT_LE(norm(to_mat3(pose.R) * axis - axis), 1e-15);
    EXPECT_NEAR(pose.R[0] + pose.R[4] + pose.R[8], 1 + 2 * std::cos(2 * half), 1e-14);  // the trace
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Quaternion& bad : {Quaternion{0, 0, 0, 0}, Quaternion{.x = nan}, Quaternion{.w = kInfinity}})
    EXPECT_EQ(Pose::from_quaternion(bad).error().code, Code::bad_pose);
  EXPECT_EQ(Pose::from_quaternion({}, {0, nan, 0}).error().code, Code::bad_pose);
}

/// Of rotations rounded to some decimals: no rotation is nearer to what is left, neither the one that was rounded nor
/// one turned a little from what was found.
TEST(NearestPose, IsTheNearestRotation) {
  test::Seeded seeded(7);
  const auto off = [](const std::array<double, 9>& R, const std::array<double, 9>& S) {
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i) sum += (R[i] - S[i]) * (R[i] - S[i]);
    return sum;
  };
  int refused = 0;
  for (int i = 0; i < 500; ++i)
    for (const double unit : {1e-6, 1e-3, 3e-2}) {
      const auto rotation = scenes::random_rotation(seeded.random);
      Affine rounded{.m = rotation, .t = {1, 2, 3}};
      for (double& r : rounded.m) r = unit * std::round(r / unit);
      const Pose found = Pose::nearest(rounded).value();
      EXPECT_LE(orthogonality_defect(found), 1e-15);
      EXPECT_EQ(found.t, rounded.t);
      EXPECT_LE(off(found.R, rounded.m), off(rotation, rounded.m) + 1e-15);
      for (const double turn : {1e-4, -1e-4})
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<double, 4> q{1, 0, 0, 0};
          q[axis + 1] = turn / 2;
          const Mat3 turned = to_mat3(Pose::from_quaternion({q[0], q[1], q[2], q[3]})->R) * to_mat3(found.R);
          EXPECT_LE(off(found.R, rounded.m), off({turned[0].x, turned[0].y, turned[0].z, turned[1].x, turned[1].y,
                                                  turned[1].z, turned[2].x, turned[2].y, turned[2].z},
                                                 rounded.m));
        }
      if (unit == 1e-6) refused += !scene::validate({.R = rounded.m});
    }
  EXPECT_GT(refused, 50);  // what the function is for
  const auto code = [](const std::array<double, 9>& m) { return Pose::nearest({.m = m}).error().code; };
  EXPECT_EQ(code({2, 0, 0, 0, 2, 0, 0, 0, 2}), Code::bad_pose);
  EXPECT_EQ(code({-1, 0, 0, 0, 1, 0, 0, 0, 1}), Code::bad_pose);
  EXPECT_EQ(code({}), Code::bad_pose);
  EXPECT_EQ(code({kInfinity, 0, 0, 0, 1, 0, 0, 0, 1}), Code::bad_pose);
}

}  // namespace
}  // namespace impinge
