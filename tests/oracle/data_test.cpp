// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Real meshes: scans and CAD parts of Debian's libcgal-demo at random poses, and the two assemblies of
/// assimp-testmodels.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "expected.hpp"
#include "impinge/io.hpp"
#include "impinge/scene.hpp"
#include "scenes/contact_depth.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

namespace impinge {
namespace {

namespace fs = std::filesystem;
using scenes::MeshData;
using scenes::PlacedScene;
using scenes::Random;

io::Model model_of(const fs::path& file) {
  auto model = io::read(file);
  EXPECT_TRUE(model) << (model ? "" : model.error().message);
  return model ? *std::move(model) : io::Model{};
}

MeshData data_of(const Mesh& mesh) {
  MeshData data;
  for (const Point& p : mesh.vertices()) data.add_vertex(p.x, p.y, p.z);
  for (const auto& t : mesh.triangles()) data.add_triangle(t[0], t[1], t[2]);
  return data;
}

/// The one mesh of a file of libcgal-demo; nothing, and a failure, where it cannot be read.
std::optional<Mesh> sample(const char* name) {
  const fs::path file = fs::path(IMPINGE_DATA_DIR) / "cgal/data/meshes" / name;
  if (!fs::exists(file)) {
    ADD_FAILURE() << file << " is missing: run scripts/fetch_data.sh.";
    return std::nullopt;
  }
  const io::Model model = model_of(file);
  EXPECT_EQ(model.objects.size(), 1u) << file;
  return model.objects.size() == 1 ? std::optional(model.objects[0].mesh) : std::nullopt;
}

/// One mesh twice.
PlacedScene twice(const MeshData& mesh) {
  PlacedScene scene;
  scene.meshes = {mesh};
  scene.objects = {{.mesh = 0}, {.mesh = 0}};
  return scene;
}

/// The scene's two objects placed so, exactly.
expected::Set expect_exact_at(PlacedScene scene, const auto& poses) {
  scene.objects[0].pose = poses.a;
  scene.objects[1].pose = poses.b;
  return expected::expect_exact(scene);
}

class RealMesh : public testing::TestWithParam<const char*> {};

TEST_P(RealMesh, AgainstItselfApartLightAndDeep) {
  const auto found = sample(GetParam());
  ASSERT_TRUE(found);
  const Mesh& mesh = *found;
  const PlacedScene scene = twice(data_of(mesh));
  Random random(1);
  for (const double depth : {-0.01, 0.0005, 0.03}) {
    SCOPED_TRACE("depth " + std::to_string(depth));
    const auto poses = scenes::near_first_touch(random, mesh, mesh, depth);
    ASSERT_TRUE(poses) << poses.error().message;
    EXPECT_EQ(expect_exact_at(scene, *poses).empty(), depth < 0);
  }
  EXPECT_FALSE(expect_exact_at(scene, scenes::centers_apart(random, mesh, mesh, 0.2)).empty());
}

INSTANTIATE_TEST_SUITE_P(CgalDemo, RealMesh,
                         testing::Values("elephant.off", "camel.off", "armadillo.off", "cow.off", "anchor_dense.off",
                                         "homer.off", "knot2.off", "refined_elephant.off"));

TEST(RealMesh, ClosedPartOnItselfUnderOneMotion) {
  const auto mesh = sample("anchor.off");
  ASSERT_TRUE(mesh);
  const PlacedScene scene = twice(data_of(*mesh));
  Random random(1);
  const PlacedScene moved = scenes::moved(scene, scenes::random_motion(random, 10));
  const expected::Set set = expected::expect_exact(moved);
  EXPECT_GE(set.size(), scene.meshes[0].triangle_count());
  expected::expect_finds(set, scenes::baked(moved));
}

TEST(RealMesh, AgainstAnotherOfItsSize) {
  const auto elephant = sample("elephant.off");
  const auto lion = sample("lion-head.off");
  ASSERT_TRUE(elephant && lion);
  const double scale = elephant->sphere_radius() / lion->sphere_radius();
  const auto scaled = lion->transformed({.m = {scale, 0, 0, 0, scale, 0, 0, 0, scale}});
  ASSERT_TRUE(scaled) << scaled.error().message;
  const PlacedScene scene = scenes::pair_scene(data_of(*elephant), data_of(*scaled));
  Random random(1);
  const auto light = scenes::near_first_touch(random, *elephant, *scaled, 0.03);
  ASSERT_TRUE(light) << light.error().message;
  for (const auto& poses : {*light, scenes::centers_apart(random, *elephant, *scaled, 0.2)})
    EXPECT_FALSE(expect_exact_at(scene, poses).empty());
}

TEST(Knots, LightAndDeep) {
  for (const int triangles : {968, 3162, 5200, 7590, 9612}) {
    SCOPED_TRACE(triangles);
    const PlacedScene scene = twice(scenes::torus_knot_of(triangles));
    ASSERT_EQ(scene.meshes[0].triangle_count(), static_cast<std::size_t>(triangles));
    const auto mesh = Mesh::create(scene.meshes[0].xyz, scene.meshes[0].triangles);
    ASSERT_TRUE(mesh);
    Random random(static_cast<std::uint64_t>(triangles));
    const auto light = scenes::near_first_touch(random, *mesh, *mesh, 0.03);
    ASSERT_TRUE(light);
    for (const auto& poses : {*light, scenes::centers_apart(random, *mesh, *mesh, 0.2)})
      EXPECT_FALSE(expect_exact_at(scene, poses).empty());
  }
}

TEST(FlushBoxes, TenThousandOfThem) {
  EXPECT_FALSE(expected::expect_exact(scenes::ten_thousand_flush_boxes()).empty());
}

class RealAssembly : public testing::TestWithParam<const char*> {};

TEST_P(RealAssembly, EveryTrianglePair) {
  const fs::path file = fs::path(IMPINGE_MODELS_DIR) / GetParam();
  ASSERT_TRUE(fs::exists(file)) << file << " is missing: install Debian's assimp-testmodels.";
  const io::Model model = model_of(file);
  Scene scene;
  for (const io::Object& object : model.objects) {
    const auto id = scene.add(object.mesh, object.pose);
    ASSERT_TRUE(id) << id.error().message;
  }
  const expected::Set set = expected::of_model(file, scene);
  EXPECT_FALSE(set.empty());
  for (const char* backend : {"simd", "paper"}) {
    SCOPED_TRACE(backend);
    const auto contacts = scene.collide({.backend = backend});
    ASSERT_TRUE(contacts) << contacts.error().message;
    expected::expect_same(set, expected::listed(*contacts));
  }
}

INSTANTIATE_TEST_SUITE_P(AssimpModels, RealAssembly,
                         testing::Values("glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"));

// As it was read: the oracle reads what assimp reads, and no IFC.
TEST(RealBuilding, EveryTrianglePair) {
  PlacedScene house;
  for (const io::Object& object : model_of(fs::path(IMPINGE_MODELS_DIR) / "IFC/AC14-FZK-Haus.ifc").objects) {
    house.objects.push_back({static_cast<std::uint32_t>(house.meshes.size()), object.pose});
    house.meshes.push_back(data_of(object.mesh));
  }
  ASSERT_EQ(house.objects.size(), 110u);
  const expected::Set set = expected::by_oracle(house);
  EXPECT_FALSE(set.empty());
  for (const char* backend : {"simd", "paper"}) {
    SCOPED_TRACE(backend);
    expected::expect_same(set, expected::by_scene(house, {.backend = backend}));
  }
}

}  // namespace
}  // namespace impinge
