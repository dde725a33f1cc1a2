// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Contract 3.1 on a device: whole answers, held against the plain reference's.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <set>
#include <utility>

#include "impinge/devices.hpp"
#include "impinge/io.hpp"
#include "scenes/contact_depth.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/gpu/environment.hpp"
#include "tests/pipeline/crowd.hpp"

namespace impinge {
namespace {

namespace fs = std::filesystem;

class OnDevice : public testing::TestWithParam<const char*> {
 protected:
  static Options options(Options::Find find = Options::Find::all) { return {.find = find, .backend = GetParam()}; }
  /// Large scenes are for the fast forms; the plain ones and their drawn twin get up to 2,000 triangles.
  static bool is_plain() { return std::string_view(GetParam()) == "raster"; }

  static void expect_same(const Contacts& expected, const Result<Contacts>& found) {
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(found->warnings.empty()) << found->warnings[0];
    test::expect_same(expected, *found);
  }
};

TEST_P(OnDevice, HardFamiliesAreAnsweredAsByTheReference) {
  std::uint64_t tests = 0, unsure = 0;
  for (std::uint64_t seed = 1; seed <= (test::is_smaller_set() ? 1 : 3); ++seed) {
    test::Seeded seeded(seed);
    for (const test::NamedScene& named : test::hard_scenes(seeded.random, 40)) {
      SCOPED_TRACE(named.name);
      const Contacts expected = test::scene_of(named.scene).collide({.backend = "paper"}).value();
      for (const std::uint32_t leaf_size : {0u, 1u, 100u}) {
        const auto found = test::scene_of(named.scene, leaf_size).collide(options());
        expect_same(expected, found);
        tests += found->statistics.triangle_pairs, unsure += found->statistics.exact_calls;
      }
    }
  }
  std::cout << "left to exact arithmetic: " << unsure << " of " << tests << " pairs of triangles\n";
}

/// Meshes whose numbers are the same but for a power of two, and a translation that leaves them few digits.
TEST_P(OnDevice, TinyHugeAndFarScenesAreAnsweredAsByTheReference) {
  test::Seeded seeded(7);
  for (const int exponent : {-340, -149, -126, -30, 0, 40, 126, 270})
    for (const double away : {0.0, 1.0, 0x1p20}) {
      SCOPED_TRACE("2^" + std::to_string(exponent) + ", moved by " + std::to_string(away));
      const double scale = std::ldexp(1.0, exponent);
      scenes::PlacedScene scene;
      scene.meshes = {scenes::torus_knot_of(600), scenes::integer_soup(seeded.random, 60, 3)};
      for (scenes::MeshData& mesh : scene.meshes)
        for (double& x : mesh.xyz) x = scale * (std::round(x * 0x1p10) * 0x1p-10 + away);
      for (std::uint32_t i = 0; i < 2; ++i) scene.objects.push_back({.mesh = i});
      scene.objects.push_back({.mesh = 0, .pose = {.t = {0.125 * scale, -0.25 * scale, 0}}});
      const auto expected = test::scene_of(scene).collide({.backend = "paper"});
      ASSERT_TRUE(expected) << expected.error().message;
      EXPECT_GT(expected->triangles.size(), 100u);
      expect_same(*expected, test::scene_of(scene).collide(options()));
    }
}

TEST_P(OnDevice, AUnitMayBeAThousandthOfTheOthers) {
  test::Seeded seeded(8);
  scenes::PlacedScene scene;
  scene.meshes = {scenes::bumpy_grid(24, 24, 0.25), scenes::torus_knot_of(900)};
  scene.objects = {{.mesh = 0}};
  for (const double size : {1e-3, 1e-6, 1e-12, 1e-30}) {
    scenes::MeshData small = scene.meshes[1];
    for (double& x : small.xyz) x *= size;
    scene.meshes.push_back(small);
    // Where the grid has a vertex, so that something touches however small it is.
    const auto& grid = scene.meshes[0].xyz;
    scene.objects.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1),
                             .pose = {.t = {grid[300], grid[301], grid[302]}}});
  }
  const Contacts expected = test::scene_of(scene).collide({.backend = "paper"}).value();
  EXPECT_GT(expected.triangles.size(), 100u);
  expect_same(expected, test::scene_of(scene).collide(options()));
}

TEST_P(OnDevice, ACrowdIsAnsweredAsByTheReference) {
  const scenes::PlacedScene placed = test::crowd(2);
  const Scene scene = test::scene_of(placed);
  const Contacts expected = scene.collide({.backend = "paper"}).value();
  for (const int threads : {0, 1, 2, 8}) {
    Options some = options();
    some.threads = threads;
    expect_same(expected, scene.collide(some));
  }
  for (const std::uint64_t limit : {std::uint64_t{0}, std::uint64_t{7}, expected.triangles.size() - 1}) {
    Options some = options();
    some.limit = limit;
    expect_same(scene.collide({.limit = limit, .backend = "paper"}).value(), scene.collide(some));
  }
  for (const std::uint8_t kinds : {kCrossing, kTouching, kCoplanar}) {
    Options some = options();
    some.kinds = kinds;
    expect_same(scene.collide({.kinds = kinds, .backend = "paper"}).value(), scene.collide(some));
  }
}

TEST_P(OnDevice, TheFirstContactIsATrueOne) {
  const scenes::PlacedScene placed = test::crowd(5);
  const Scene scene = test::scene_of(placed);
  for (const std::uint8_t kinds : {kAllKinds, kCrossing, kTouching, kCoplanar}) {
    Options some = options(Options::Find::first);
    some.kinds = kinds;
    const Contacts all = scene.collide({.kinds = kinds, .backend = "paper"}).value();
    const Contacts first = scene.collide(some).value();
    EXPECT_EQ(first.objects, all.objects);
    EXPECT_EQ(first.triangles.size(), all.objects.size());
    EXPECT_EQ(first.hash, 0u);
    const auto every = test::listed(all);
    for (const test::Contact& witness : test::listed(first))
      EXPECT_TRUE(std::binary_search(every.begin(), every.end(), witness));
  }
}

/// A device keeps what it has of a mesh: not that of the vertices before.
TEST_P(OnDevice, DeformedMeshesAreAnsweredAsByBruteForce) {
  test::Seeded seeded(21);
  const std::size_t step = test::is_smaller_set() ? 4 : 1;
  const auto families = test::hard_scenes(seeded.random, 24);
  for (std::size_t i = 0; i < families.size(); i += step) {
    SCOPED_TRACE(families[i].name);
    const scenes::PlacedScene& truth = families[i].scene;
    scenes::PlacedScene before = truth;
    for (scenes::MeshData& mesh : before.meshes) {
      double largest = 0;
      for (const double x : mesh.xyz) largest = std::max(largest, std::abs(x));
      for (double& x : mesh.xyz) x = seeded.random.uniform(-largest, largest);
    }
    Scene scene;
    std::vector<ObjectId> ids;
    const std::vector<Mesh> meshes = test::meshes_of(before, i % 2 == 0 ? 0 : 5);
    for (const auto& object : before.objects) ids.push_back(scene.add(meshes[object.mesh], object.pose).value());
    for (const scenes::PlacedScene* now : {&std::as_const(before), &truth, &std::as_const(before)}) {
      for (std::size_t k = 0; k < ids.size(); ++k)
        ASSERT_TRUE(scene.set_vertices(ids[k], now->meshes[now->objects[k].mesh].xyz));
      const auto found = scene.collide(options());
      ASSERT_TRUE(found) << found.error().message;
      EXPECT_TRUE(found->warnings.empty());
      ASSERT_EQ(test::listed(*found), test::brute_force(*now));
    }
    const auto &a = truth.objects[0], &b = truth.objects[1];
    const auto deformed = [&](const scenes::PlacedObject& object) {
      return meshes[object.mesh].deformed(truth.meshes[object.mesh].xyz).value();
    };
    ASSERT_EQ(test::listed(collide(deformed(a), a.pose, deformed(b), b.pose, options()).value()),
              test::brute_force(truth));
  }
}

/// Every triangle against each later one, by the exact predicate: they have no vertices in common.
std::vector<test::Contact> brute_force_of_soup(const scenes::MeshData& soup, const Pose& pose) {
  std::vector<test::Contact> contacts;
  const scenes::PlacedScene twice{.meshes = {soup}, .objects = {{.mesh = 0, .pose = pose}, {.mesh = 0, .pose = pose}}};
  for (const auto& [first, second, a, b, kind] : test::brute_force(twice))
    if (a < b) contacts.push_back({0, 0, a, b, kind});
  return contacts;
}

TEST_P(OnDevice, SelfCollisionIsAnsweredAsByBruteForce) {
  test::Seeded seeded(22);
  for (const Pose& pose : {Pose{}, scenes::random_motion(seeded.random, 3)}) {
    const scenes::MeshData soup = scenes::triangle_soup(seeded.random, 300, 0.5),
                           other = scenes::triangle_soup(seeded.random, 300, 0.3);
    const auto expected = brute_force_of_soup(soup, pose), of_other = brute_force_of_soup(other, pose);
    EXPECT_GT(expected.size(), 100u);
    for (const std::uint32_t leaf_size : {0u, 1u, 100u}) {
      const Mesh mesh = test::mesh_of(soup, leaf_size);
      for (const Adjacency adjacency : {Adjacency::by_position, Adjacency::by_index}) {
        Options some = options();
        some.adjacency = adjacency;
        EXPECT_EQ(test::listed(self_collide(mesh, pose, some).value()), expected);
        EXPECT_EQ(test::listed(self_collide(mesh.deformed(other.xyz).value(), pose, some).value()), of_other);
      }
      // The CPU does an object with itself, and the device what is between it and others.
      Scene scene;
      const ObjectId id = scene.add(mesh, pose).value();
      ASSERT_TRUE(scene.add(test::mesh_of(other, leaf_size), pose));
      ASSERT_TRUE(scene.self(id, true));
      for (const auto& [numbers, own] : {std::pair(&soup, &expected), std::pair(&other, &of_other)}) {
        ASSERT_TRUE(scene.set_vertices(id, numbers->xyz));
        std::vector<test::Contact> all = *own;
        for (const test::Contact& contact : test::brute_force(
                 {.meshes = {*numbers, other}, .objects = {{.mesh = 0, .pose = pose}, {.mesh = 1, .pose = pose}}}))
          all.push_back(contact);
        const Contacts found = scene.collide(options()).value();
        EXPECT_TRUE(found.warnings.empty());
        EXPECT_EQ(test::listed(found), all);
      }
    }
  }
  // With vertices in common, where the reference is held to the definition in rational numbers (oracle/self_test.cpp).
  scenes::MeshData knots = scenes::torus_knot_of(968);
  const scenes::MeshData shifted = scenes::shifted(knots, 0.3, 0.2, 0.1);
  const auto offset = static_cast<std::uint32_t>(knots.vertex_count());
  knots.xyz.insert(knots.xyz.end(), shifted.xyz.begin(), shifted.xyz.end());
  for (const std::uint32_t v : shifted.triangles) knots.triangles.push_back(v + offset);
  for (const scenes::MeshData& mesh : {knots, scenes::with_duplicates(scenes::cube(), 2), scenes::bumpy_grid(12, 12)})
    expect_same(self_collide(test::mesh_of(mesh), {}, {.backend = "paper"}).value(),
                self_collide(test::mesh_of(mesh), {}, options()));
}

TEST_P(OnDevice, ManyPosesAreAnsweredAtOnce) {
  test::Seeded seeded(9);
  const Mesh a = test::mesh_of(scenes::torus_knot_of(968)), b = test::mesh_of(scenes::bumpy_grid(12, 12, 0.25));
  std::vector<Pose> poses;
  for (int i = 0; i < (test::is_smaller_set() ? 50 : 300); ++i) {
    poses.push_back(scenes::random_motion(seeded.random, i % 4 == 0 ? 20 : 2));
    if (i % 3 == 0) poses.back().R = scenes::stretched_rotation(seeded.random);
    if (i % 5 == 0) poses.back() = {};
  }
  const Pose still;
  expect_same(collide_poses(a, poses, b, {&still, 1}, {.backend = "paper"}).value(),
              collide_poses(a, poses, b, {&still, 1}, options()));
  expect_same(collide_poses(b, {&still, 1}, a, poses, {.backend = "paper"}).value(),
              collide_poses(b, {&still, 1}, a, poses, options()));
}

io::Model model_of(const fs::path& file) {
  auto model = io::read(file);
  EXPECT_TRUE(model) << model.error().message;
  return model ? *std::move(model) : io::Model{};
}

TEST_P(OnDevice, RealMeshesAreAnsweredAsByTheReference) {
  std::vector<const char*> names{"helmet.off"};  // 1,000 triangles; the others have up to 52,000
  if (!is_plain()) names.push_back("elephant.off");
  if (!is_plain() && !test::is_smaller_set()) names.insert(names.end(), {"mech-holes-shark.off", "armadillo.off"});
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const io::Model model = model_of(fs::path(IMPINGE_DATA_DIR) / "cgal/data/meshes" / name);
    ASSERT_EQ(model.objects.size(), 1u);
    const Mesh& mesh = model.objects[0].mesh;
    scenes::Random random(3);
    for (const double depth : {-0.01, 0.0005, 0.03}) {
      SCOPED_TRACE(depth);
      const auto poses = scenes::near_first_touch(random, mesh, mesh, depth);
      ASSERT_TRUE(poses);
      const Contacts expected = collide(mesh, poses->a, mesh, poses->b, {.backend = "paper"}).value();
      EXPECT_EQ(expected.triangles.empty(), depth < 0);
      expect_same(expected, collide(mesh, poses->a, mesh, poses->b, options()));
    }
  }
}

TEST_P(OnDevice, AssembliesAreAnsweredAsByTheReference) {
  if (is_plain()) GTEST_SKIP();
  for (const char* name : {"glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", "IFC/AC14-FZK-Haus.ifc"}) {
    SCOPED_TRACE(name);
    Scene scene;
    for (const io::Object& object : model_of(fs::path(IMPINGE_MODELS_DIR) / name).objects)
      ASSERT_TRUE(scene.add(object.mesh, object.pose));
    ASSERT_TRUE(scene.update());
    const Contacts expected = scene.collide({.backend = "paper"}).value();
    EXPECT_GT(expected.objects.size(), 50u);
    expect_same(expected, scene.collide(options()));
    if (test::is_smaller_set()) break;
  }
}

/// Two patches of cells of 2.5e-7 in each mesh, and one triangle far away: the origins of the trees are far apart
/// beside the patches that lie on each other, so that what rounding leaves of one in the other's frame is large.
TEST_P(OnDevice, SmallFlushPatchesFarFromTheirTreesOriginsAreAnsweredAsByTheReference) {
  const int cells = is_plain() ? 8 : 40;
  const auto patches = [&](double beside, double low, double high, double far) {
    scenes::MeshData data;
    for (const double z : {low, high}) {
      const scenes::MeshData patch = scenes::shifted(scenes::flat_grid(cells, cells, 1e-5 / cells), beside, 0, z);
      const auto first = static_cast<std::uint32_t>(data.xyz.size() / 3);
      data.xyz.insert(data.xyz.end(), patch.xyz.begin(), patch.xyz.end());
      for (const std::uint32_t vertex : patch.triangles) data.triangles.push_back(first + vertex);
    }
    data.add_triangle({0.9 * far, 0.1, 0.77 * far, far, 0.2, 0.8 * far, 0.93 * far, 0.3, 0.71 * far});
    return test::mesh_of(data);
  };
  const Mesh a = patches(0, -0.2371, 0.1, -1), b = patches(3.137e-6, 0.1, 0.5913, 1);
  for (const Pose& pose : {Pose{}, Pose{.R = {0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1}}}) {
    const Contacts expected = collide(a, pose, b, pose, {.backend = "paper"}).value();
    EXPECT_GT(expected.triangles.size(), 100u);
    expect_same(expected, collide(a, pose, b, pose, options()));
  }
}

/// However the work is split, in one large pair, in a crowd, and in many poses.
TEST(Hybrid, EverySplitGivesTheSameAnswer) {
  test::Seeded seeded(12);
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(40'000)), small = test::mesh_of(scenes::torus_knot_of(200));
  const Pose moved{.t = {0.3, 0.2, 0.1}};
  std::vector<Pose> poses;
  for (int i = 0; i < 300; ++i) poses.push_back(scenes::random_motion(seeded.random, i % 4 == 0 ? 20 : 1));
  const Scene scene = test::scene_of(test::crowd(2));
  const auto large = [&](const Options& options) { return collide(knot, {}, knot, moved, options).value(); };
  const auto many = [&](const Options& options) {
    return collide_poses(small, poses, small, {&moved, 1}, options).value();
  };
  const auto crowd = [&](const Options& options) { return scene.collide(options).value(); };
  const std::vector<std::function<Contacts(const Options&)>> questions{large, many, crowd};
  for (const auto& question : questions) {
    const Contacts expected = question({.backend = "paper"});
    test::expect_same(expected, question({.backend = "hybrid"}));  // as it sees fit
    const Contacts first = question({.find = Options::Find::first, .backend = "paper"});
    EXPECT_GT(expected.triangles.size(), 1000u);
    for (int tenths = 0; tenths <= 10; ++tenths) {
      SCOPED_TRACE("share " + std::to_string(tenths) + "/10");
      for (const int threads : {1, 2}) {
        Options options{.threads = threads, .backend = "hybrid", .device_share = tenths / 10.0};
        const Contacts found = question(options);
        EXPECT_TRUE(found.warnings.empty());
        test::expect_same(expected, found);
        const bool is_large = found.statistics.object_pairs == 1 || found.statistics.object_pairs >= 256;
        const double seconds = found.statistics.device_seconds;
        EXPECT_TRUE(tenths == 0 ? seconds == 0 : !is_large || seconds > 0) << seconds;
        options.find = Options::Find::first;
        EXPECT_EQ(question(options).objects, first.objects);
      }
      if (test::is_smaller_set()) tenths += 4;
    }
  }
}

/// Calibration says that the device is so quick.
void claim(const char* constants) {
  const DeviceInfo device = devices().value().at(0);
  set_calibration("impinge calibration 2\ndevice " + std::string(constants) + " " + device.name + ", " + device.driver +
                  "\n");
}
constexpr const char *kQuick = "1e-6 1e-11 1e-11 1e-11 0", *kSlow = "0.9 1e-6 1e-6 1e-6 0";

TEST(Hybrid, EachWayIsTriedAndGivesTheSameAnswer) {
  test::Seeded seeded(31);
  const Mesh knot = test::mesh_of(scenes::torus_knot_of(200));
  std::vector<Pose> poses;
  for (int i = 0; i < 300; ++i) poses.push_back(scenes::random_motion(seeded.random, 1));
  const auto ask = [&](const char* backend, Workspace& workspace) {
    return collide_poses(knot, poses, knot, {&poses[0], 1}, {.backend = backend}, &workspace).value();
  };
  Workspace of_reference;
  const Contacts expected = ask("paper", of_reference);
  EXPECT_GT(expected.triangles.size(), 1000u);
  // Whether the device had a part, and the CPU beside it.
  const std::set<std::pair<bool, bool>> ways{{true, true}, {true, false}, {false, false}};
  std::set<std::pair<bool, bool>> seen;
  const auto start = std::chrono::steady_clock::now();
  while (seen != ways && std::chrono::steady_clock::now() - start < std::chrono::seconds(60)) {
    Workspace workspace;
    for (int query = 0; query < 5; ++query) {
      claim(kQuick);
      const Contacts found = ask("hybrid", workspace);
      test::expect_same(expected, found);
      const std::pair sides{found.statistics.device_seconds > 0, found.statistics.cpu_seconds > 0};
      if (ways.contains(sides)) seen.insert(sides);
    }
  }
  EXPECT_EQ(seen, ways);
}

/// What backends give to a device that nobody forces on them.
class ByItself : public testing::TestWithParam<const char*> {
 protected:
  ByItself() {
    test::Seeded seeded(31);
    for (int i = 0; i < 300; ++i) poses_.push_back(scenes::random_motion(seeded.random, 1));
  }
  [[nodiscard]] Contacts ask(const char* backend) const {
    Workspace workspace;  // which knows nothing of how long the query took before
    return collide_poses(knot_, poses_, knot_, {&still_, 1}, {.backend = backend}, &workspace).value();
  }

 private:
  const Mesh knot_ = test::mesh_of(scenes::torus_knot_of(2'000));
  const Pose still_;
  std::vector<Pose> poses_;
};

TEST_P(ByItself, ADeviceThatGainsIsGivenWorkAndNoOther) {
  const Contacts expected = ask("simd");
  EXPECT_GT(expected.triangles.size(), 1000u);
  EXPECT_EQ(expected.statistics.device_seconds, 0);
  double device_seconds = 0;
  const auto start = std::chrono::steady_clock::now();
  // Until the program has been at it for long enough to open a device.
  while (device_seconds == 0 && std::chrono::steady_clock::now() - start < std::chrono::seconds(60)) {
    claim(kQuick);
    const Contacts found = ask(GetParam());
    device_seconds = found.statistics.device_seconds;
    EXPECT_TRUE(found.warnings.empty());
    test::expect_same(expected, found);
  }
  EXPECT_GT(device_seconds, 0);
  claim(kSlow);
  const Contacts found = ask(GetParam());
  EXPECT_EQ(found.statistics.device_seconds, 0);
  test::expect_same(expected, found);
  EXPECT_EQ(ask("simd").statistics.device_seconds, 0);
}

TEST_P(ByItself, AProgramOnTheCpuIsGivenNothing) {
  if (devices().value().at(0).type != DeviceInfo::Type::cpu) GTEST_SKIP() << "the device is hardware";
  const test::WithLimits not_declared_hardware({});
  claim(kQuick);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(ask(GetParam()).statistics.device_seconds, 0);
}

TEST_P(ByItself, NoneInTheEnvironmentIsGivenNothing) {
  claim(kQuick);
  setenv("IMPINGE_DEVICE", "none", 1);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(ask(GetParam()).statistics.device_seconds, 0);
  unsetenv("IMPINGE_DEVICE");
}

INSTANTIATE_TEST_SUITE_P(Each, ByItself, testing::Values("hybrid", "auto"),
                         [](const auto& of) { return std::string(of.param); });
INSTANTIATE_TEST_SUITE_P(Each, OnDevice, testing::Values("gpu", "raster", "hybrid"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace impinge
