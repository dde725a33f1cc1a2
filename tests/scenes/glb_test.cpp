// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/glb.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "impinge/io.hpp"
#include "scenes/plant.hpp"

namespace impinge {
namespace {

TEST(Glb, IsReadBackAsItWasWritten) {
  const scenes::Plant plant = scenes::plant(1000, {.seed = 2});
  const auto path = std::filesystem::temp_directory_path() / ("impinge-glb-" + std::to_string(::getpid()) + ".glb");
  std::ofstream(path, std::ios::binary) << scenes::glb_bytes(plant.scene, plant.names);
  const Result<io::Model> model = io::read(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->objects.size(), plant.names.size());
  std::map<std::uint32_t, const MeshState*> shared;
  for (std::size_t i = 0; i < plant.names.size(); ++i) {
    const io::Object& read = model->objects[i];
    const scenes::PlacedObject& object = plant.scene.objects[i];
    const scenes::MeshData& mesh = plant.scene.meshes[object.mesh];
    ASSERT_EQ(read.name, plant.names[i]);
    for (std::size_t k = 0; k < 9; ++k) ASSERT_EQ(read.pose.R[k], static_cast<float>(object.pose.R[k]));
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(read.pose.t[k], static_cast<float>(object.pose.t[k]));
    const auto [place, is_new] = shared.try_emplace(object.mesh, &read.mesh.state());
    ASSERT_EQ(place->second, &read.mesh.state()) << "objects of one mesh do not share it";
    if (!is_new) continue;
    ASSERT_EQ(read.mesh.triangle_count(), mesh.triangle_count());
    ASSERT_EQ(read.mesh.vertex_count(), mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const Point expected{mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]};
      ASSERT_EQ(read.mesh.vertices()[v], expected);  // they are exact in single precision
    }
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(read.mesh.triangles()[t][k], mesh.triangles[3 * t + k]);
  }
}

}  // namespace
}  // namespace impinge
