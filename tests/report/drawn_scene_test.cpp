// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// An assembly as it is drawn: the same vertices in the world, in single precision, and fewer of them when asked.
#include "report/drawn_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "report/encoded.hpp"
#include "scenes/shapes.hpp"

namespace impinge::report {
namespace {

io::Object object(const std::vector<double>& xyz, const std::vector<std::uint32_t>& triangles, const Pose& pose = {}) {
  return {"part", "part", {}, *Mesh::create(std::span<const double>(xyz), triangles), pose};
}

/// A sphere of 4 rings^2 triangles.
io::Object sphere(int rings) {
  const scenes::MeshData mesh = scenes::uv_sphere(2 * rings, rings + 1);
  return object(mesh.xyz, mesh.triangles);
}

Assembly assembly(std::vector<io::Object> objects) {
  Assembly all;
  all.files = {"f"};
  all.file_of.assign(objects.size(), 0);
  all.objects = std::move(objects);
  return all;
}

TEST(DrawnScene, ShowsTheVerticesWhereTheyAre) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const double far : {0.0, 1e3, 1e7}) {
    std::uniform_real_distribution<double> coordinate(far - 1, far + 1);
    std::vector<double> xyz;
    for (int i = 0; i < 30; ++i) xyz.push_back(coordinate(random));
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < 8; ++i) triangles.insert(triangles.end(), {i, i + 1, i + 2});
    Pose pose;
    pose.R = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    pose.t = {-far, 3 * far, 5};
    const Assembly all = assembly({object(xyz, triangles, pose)});
    const Result<DrawnScene> scene = draw(all, 1000, {});
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->triangles, 8U);
    EXPECT_EQ(scene->shown, 8U);
    ASSERT_EQ(scene->objects.size(), 1U);
    ASSERT_EQ(scene->objects[0].mesh, 0U);
    const DrawnMesh& mesh = scene->meshes[0];
    ASSERT_EQ(mesh.triangles.size(), 24U);
    for (std::size_t i = 0; i < 24; ++i) {
      const Point is = world_vertex(all.objects[0].pose, all.objects[0].mesh.vertices()[triangles[i]]);
      const float* at = &mesh.xyz[3 * mesh.triangles[i]];
      const Point drawn = world_vertex(scene->objects[0].pose, {at[0], at[1], at[2]});
      // Half a unit in the last place of a float of size 1, and a few of the double of the place.
      const double most = 0x1p-24 + 4 * 0x1p-52 * 4 * (far + 1);
      EXPECT_NEAR(drawn.x, is.x, most);
      EXPECT_NEAR(drawn.y, is.y, most);
      EXPECT_NEAR(drawn.z, is.z, most);
    }
  }
}

TEST(DrawnScene, InstancesShareAMeshAndEmptyObjectsHaveNone) {
  const io::Object one = sphere(4);
  io::Object other = one;
  other.pose.t = {5, 0, 0};
  const Result<DrawnScene> scene = draw(assembly({one, object({}, {}), other}), 1000, {});
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->meshes.size(), 1U);
  ASSERT_EQ(scene->objects.size(), 3U);
  EXPECT_EQ(scene->objects[0].mesh, 0U);
  EXPECT_FALSE(scene->objects[1].mesh);
  EXPECT_EQ(scene->objects[2].mesh, 0U);
  EXPECT_EQ(scene->triangles, 2 * one.mesh.triangle_count());
}

TEST(DrawnScene, SimplifiesToAboutTheLimitAndKeepsTheShape) {
  std::vector<io::Object> objects;
  for (const int rings : {40, 30, 20}) objects.push_back(sphere(rings));
  const Assembly all = assembly(objects);
  const Result<DrawnScene> whole = draw(all, 1'000'000, {});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->shown, whole->triangles);
  const Result<DrawnScene> some = draw(all, 1500, {});
  ASSERT_TRUE(some);
  EXPECT_EQ(some->triangles, whole->triangles);
  EXPECT_LE(some->shown, 2 * 1500U);
  EXPECT_GE(some->shown, 1500U / 2);
  for (const DrawnMesh& mesh : some->meshes) {
    for (const std::uint32_t corner : mesh.triangles) ASSERT_LT(3 * corner + 2, mesh.xyz.size());
    for (std::size_t i = 0; i < mesh.xyz.size(); i += 3)
      EXPECT_NEAR(std::hypot(mesh.xyz[i], mesh.xyz[i + 1], mesh.xyz[i + 2]), 1, 0.2);
  }
}

TEST(DrawnScene, AnyCoordinatesAreDrawable) {
  const double huge = 0x1p299, tiny = 0x1p-350;
  const Result<DrawnScene> scene = draw(
      assembly({object({huge, 0, 0, -huge, tiny, 0, 0, huge, huge}, {0, 1, 2}), object({0, 0, 0}, {0, 0, 0})}), 0, {});
  ASSERT_TRUE(scene);
  for (const DrawnMesh& mesh : scene->meshes)
    for (const float value : mesh.xyz) EXPECT_TRUE(std::isfinite(value));
}

TEST(DrawnScene, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  const Result<DrawnScene> scene = draw(assembly({sphere(4)}), 10, stop.get_token());
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, Code::cancelled);
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  const auto encoded = [](std::string_view text) {
    return base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
  };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xFB\xFF\xFE"), "+//+");
}

}  // namespace
}  // namespace impinge::report
