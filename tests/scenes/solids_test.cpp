// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "scenes/plant.hpp"
#include "scenes/plant_solids.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/scenes/relation.hpp"

namespace impinge {
namespace {

/// Edges whose two directions are not there once each, vertices told apart by position.
std::size_t open_edges(const scenes::MeshData& mesh) {
  std::map<std::array<double, 3>, std::uint32_t> places;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const auto place = [&](std::uint32_t v) {
    const std::array<double, 3> p{mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]};
    return places.try_emplace(p, static_cast<std::uint32_t>(places.size())).first->second;
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{place(mesh.triangles[i + k]), place(mesh.triangles[i + (k + 1) % 3])}];
  std::size_t open = 0;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end()) ++open;
  }
  return open;
}

/// Two triangles of one mesh that meet elsewhere than in a common corner or edge.
std::size_t self_contacts(const scenes::MeshData& data) {
  const Mesh mesh = test::mesh_of(data);
  const auto triangles = test::world_triangles(mesh, {});
  const Contacts contacts = collide(mesh, {}, mesh, {}).value();
  std::size_t bad = 0;
  for (std::size_t i = 0; i < contacts.triangles.size(); ++i) {
    const auto [a, b] = contacts.triangles[i];
    if (a >= b) continue;
    int common = 0;
    for (const std::uint32_t u : mesh.triangles()[a])
      for (const std::uint32_t v : mesh.triangles()[b]) common += u == v ? 1 : 0;
    const bool shares_area = contacts.kinds[i] == Kind::coplanar && share_area(triangles[a], triangles[b]);
    if (contacts.kinds[i] == Kind::crossing || shares_area || common == 0) ++bad;
  }
  return bad;
}

TEST(Solids, EveryMeshOfAPlantIsAProperSolid) {
  const scenes::Plant plant = scenes::plant(3000, {.seed = 5});
  std::size_t inside_out = 0;
  for (std::size_t i = 0; i < plant.scene.meshes.size(); ++i) {
    SCOPED_TRACE("mesh " + std::to_string(i));
    const scenes::MeshData& mesh = plant.scene.meshes[i];
    EXPECT_EQ(open_edges(mesh), 0u);
    EXPECT_EQ(self_contacts(mesh), 0u);
    EXPECT_NE(test::volume(mesh), 0);
    if (test::volume(mesh) < 0) ++inside_out;
  }
  EXPECT_LE(inside_out, 5u);  // those that were turned inside out on purpose
}

TEST(Solids, ClosedShapesLookOutwards) {
  for (const scenes::MeshData& shape :
       {scenes::cube(), scenes::box({-3, 1, 2}, {-1, 2, 9}, 3), scenes::uv_sphere(7, 5),
        scenes::pipe(9, 3, 0.5, 4, true), scenes::torus_knot(3, -2, 40, 6), scenes::torus_knot_of(240)}) {
    EXPECT_EQ(open_edges(shape), 0u);
    EXPECT_GT(test::volume(shape), 0);
  }
}

TEST(Solids, LayersFillWhatTheyAreTold) {
  // A bolt: a square head of side 4 and height 2 on a square shank of side 2 and length 3.
  const std::array<double, 4> lines{-2, -1, 1, 2};
  const std::array<int, 9> zones{1, 1, 1, 1, 0, 1, 1, 1, 1};
  const std::array<double, 3> zs{0, 3, 5};
  const std::array<unsigned, 2> layers{1, 3};
  const scenes::MeshData bolt = scenes::layered(scenes::grid_section(lines, lines, zones), zs, layers);
  EXPECT_EQ(open_edges(bolt), 0u);
  EXPECT_EQ(self_contacts(bolt), 0u);
  EXPECT_DOUBLE_EQ(test::volume(bolt), 2 * 2 * 3 + 4 * 4 * 2);
}

TEST(Solids, OtherTrianglesFillTheSameSpace) {
  const scenes::MeshData pipe = scenes::revolved({{0, 0}, {10, 0}, {10, 20}, {0, 30}}, 12);
  const double volume = test::volume(pipe);
  EXPECT_EQ(open_edges(pipe), 0u);
  EXPECT_GT(volume, 0);
  EXPECT_DOUBLE_EQ(test::volume(scenes::subdivided(pipe)), volume);
  EXPECT_DOUBLE_EQ(test::volume(scenes::renumbered(pipe)), volume);
  EXPECT_DOUBLE_EQ(test::volume(scenes::inverted(pipe)), -volume);
  EXPECT_EQ(scenes::subdivided(pipe).triangle_count(), 4 * pipe.triangle_count());
}

}  // namespace
}  // namespace impinge
