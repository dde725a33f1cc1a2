// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "tests/core/support.hpp"

#include <algorithm>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "pipeline/mesh_state.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/placed.hpp"
#include "scenes/shapes.hpp"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace impinge::test {

Mesh mesh_of(const scenes::MeshData& mesh, std::uint32_t leaf_size) {
  auto result = Mesh::create(std::span<const double>(mesh.xyz), mesh.triangles, {leaf_size});
  if (!result) {
    ADD_FAILURE() << result.error().message;
    std::abort();
  }
  return *std::move(result);
}

const MeshData& numbers_of(const Mesh& mesh) { return mesh.state().data; }

std::vector<Mesh> meshes_of(const scenes::PlacedScene& scene, std::uint32_t leaf_size) {
  std::vector<Mesh> meshes;
  for (const scenes::MeshData& mesh : scene.meshes) meshes.push_back(mesh_of(mesh, leaf_size));
  return meshes;
}

Scene scene_of(const scenes::PlacedScene& scene, std::uint32_t leaf_size) {
  const std::vector<Mesh> meshes = meshes_of(scene, leaf_size);
  Scene result;
  for (const scenes::PlacedObject& object : scene.objects) {
    const auto id = result.add(meshes[object.mesh], object.pose, object.group);
    EXPECT_TRUE(id) << id.error().message;
  }
  return result;
}

std::vector<Triangle> world_triangles(const Mesh& mesh, const Pose& pose) {
  std::vector<Point> world;
  for (const Point& v : mesh.vertices()) world.push_back(world_vertex(pose, v));
  std::vector<Triangle> triangles;
  for (const auto& t : mesh.triangles()) triangles.push_back({world[t[0]], world[t[1]], world[t[2]]});
  return triangles;
}

std::vector<Contact> listed(const Contacts& contacts) {
  std::vector<Contact> list;
  EXPECT_EQ(contacts.offsets.size(), contacts.objects.size() + 1);
  EXPECT_EQ(contacts.offsets.front(), 0u);
  EXPECT_EQ(contacts.offsets.back(), contacts.triangles.size());
  EXPECT_EQ(contacts.kinds.size(), contacts.triangles.size());
  if (testing::Test::HasFailure()) return list;
  for (std::size_t row = 0; row < contacts.objects.size(); ++row) {
    EXPECT_LT(contacts.offsets[row], contacts.offsets[row + 1]) << "an empty row";
    for (std::uint64_t i = contacts.offsets[row]; i < contacts.offsets[row + 1]; ++i)
      list.push_back({contacts.objects[row][0], contacts.objects[row][1], contacts.triangles[i].a,
                      contacts.triangles[i].b, static_cast<std::uint32_t>(contacts.kinds[i])});
  }
  return list;
}

std::vector<Contact> brute_force(const scenes::PlacedScene& scene) {
  const std::vector<Mesh> meshes = meshes_of(scene);
  std::vector<std::vector<Triangle>> world;
  for (const auto& object : scene.objects) world.push_back(world_triangles(meshes[object.mesh], object.pose));
  std::vector<Contact> contacts;
  for (std::uint32_t a = 0; a < world.size(); ++a)
    for (std::uint32_t b = a + 1; b < world.size(); ++b) {
      const std::uint32_t group = scene.objects[a].group;
      if (group != 0 && group == scene.objects[b].group) continue;
      for (std::uint32_t i = 0; i < world[a].size(); ++i)
        for (std::uint32_t j = 0; j < world[b].size(); ++j)
          if (const auto kind = intersects(world[a][i], world[b][j]))
            contacts.push_back({a, b, i, j, static_cast<std::uint32_t>(*kind)});
    }
  return contacts;
}

void expect_same(const Contacts& expected, const Contacts& found) {
  EXPECT_EQ(expected.objects, found.objects);
  EXPECT_EQ(expected.offsets, found.offsets);
  EXPECT_TRUE(expected.triangles == found.triangles) << "the triangles differ";
  EXPECT_TRUE(expected.kinds == found.kinds) << "the kinds differ";
  EXPECT_EQ(expected.truncated, found.truncated);
  EXPECT_EQ(expected.hash, found.hash);
}

std::vector<Contact> transposed(std::vector<Contact> contacts) {
  for (Contact& contact : contacts) std::swap(contact[2], contact[3]);
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

// x86-64 keeps rounding and flushing of SSE in one register, which the C functions set but do not read.
#if defined(__x86_64__)
CallersMode::CallersMode(int rounding, bool flush) : before_(_mm_getcsr()) {
  std::fesetround(rounding);
  if (flush) _mm_setcsr(_mm_getcsr() | 0x8040);  // FTZ and DAZ
  set_ = _mm_getcsr();
}
CallersMode::~CallersMode() {
  std::fesetround(FE_TONEAREST);
  _mm_setcsr(before_);
}
bool CallersMode::is_untouched() const {
  constexpr unsigned kFlags = 0x3F;  // of exceptions that happened
  return (_mm_getcsr() & ~kFlags) == (set_ & ~kFlags);
}
#else
CallersMode::CallersMode(int rounding, bool) : before_(static_cast<unsigned>(std::fegetround())) {
  std::fesetround(rounding);
  set_ = static_cast<unsigned>(rounding);
}
CallersMode::~CallersMode() { std::fesetround(static_cast<int>(before_)); }
bool CallersMode::is_untouched() const { return static_cast<unsigned>(std::fegetround()) == set_; }
#endif

bool rounds_to_nearest_with_denormals() {
  const volatile double one = 1, tiny = 0x1p-60, smallest = 0x1p-1074;
  const volatile double above = one + tiny, below = -one - tiny, within = one - tiny, twice = smallest + smallest,
                        kept = smallest * one;
  return above == 1 && below == -1 && within == 1 && std::bit_cast<std::uint64_t>(double{twice}) == 2 &&
         std::bit_cast<std::uint64_t>(double{kept}) == 1;
}

namespace {

scenes::PlacedScene scaled(scenes::PlacedScene scene, double factor) {
  for (scenes::MeshData& mesh : scene.meshes)
    for (double& x : mesh.xyz) x *= factor;
  for (scenes::PlacedObject& object : scene.objects)
    for (double& t : object.pose.t) t *= factor;
  return scene;
}

std::vector<NamedScene> scenes_at_rest(scenes::Random& random, int n) {
  const int side = static_cast<int>(std::sqrt(n / 2.0));
  const scenes::MeshData flat = scenes::flat_grid(side, side, 1.0 / side);
  const scenes::MeshData bumpy = scenes::bumpy_grid(side, side, 1.0 / side);
  const scenes::MeshData integers = scenes::integer_soup(random, n, 4);
  const scenes::MeshData degenerate = scenes::degenerate_soup(random, n, 3);
  const scenes::MeshData slivers = scenes::sliver_soup(random, n);
  const scenes::MeshData soup = scenes::triangle_soup(random, n, 0.7);
  return {
      {"cubes face to face", scenes::cube_pair({1, 0, 0})},
      {"cubes edge to edge", scenes::cube_pair({1, 1, 0})},
      {"cubes vertex to vertex", scenes::cube_pair({1, 1, 1})},
      {"one cube twice", scenes::cube_pair({0, 0, 0})},
      {"cubes an ulp apart", scenes::cube_pair({std::nextafter(1.0, 2.0), 0, 0})},
      {"flat grids shifted by half a cell", scenes::shifted_pair(flat, {0.5 / side, 0.5 / side, 0})},
      {"bumpy grids shifted by a cell", scenes::shifted_pair(bumpy, {1.0 / side, 0, 0})},
      {"t-junctions", scenes::t_junctions(2)},
      {"integer soups", scenes::pair_scene(integers, scenes::integer_soup(random, n, 4))},
      {"degenerate and integer soup", scenes::pair_scene(degenerate, integers)},
      {"degenerate soups", scenes::pair_scene(degenerate, scenes::degenerate_soup(random, n, 3))},
      {"slivers", scenes::pair_scene(slivers, scenes::sliver_soup(random, n))},
      {"slivers and soup", scenes::pair_scene(slivers, soup)},
      {"duplicates",
       scenes::pair_scene(scenes::with_duplicates(scenes::cube(), 3), scenes::integer_soup(random, n, 1))},
      {"general position", scenes::pair_scene(soup, scenes::triangle_soup(random, n, 0.7))},
  };
}

}  // namespace

std::vector<NamedScene> hard_scenes(scenes::Random& random, int triangles) {
  std::vector<NamedScene> all;
  for (const NamedScene& rest : scenes_at_rest(random, triangles)) {
    all.push_back(rest);
    all.push_back({rest.name + ", moved", scenes::moved(rest.scene, scenes::random_motion(random, 3))});
    all.push_back({rest.name + ", far away", scenes::moved(rest.scene, scenes::random_motion(random, 1e6))});
    Pose stretched = scenes::random_motion(random, 1e6);
    stretched.R = scenes::stretched_rotation(random);
    all.push_back({rest.name + ", stretched", scenes::moved(rest.scene, stretched)});
    const auto moved = scenes::moved(rest.scene, scenes::random_motion(random, 1));
    all.push_back({rest.name + ", tiny", scaled(moved, 0x1p-70)});
    all.push_back({rest.name + ", huge", scaled(moved, 0x1p60)});
  }
  return all;
}

double plain_distance(const std::vector<Triangle>& triangles, const Vec3& p) {
  double least = kInfinity;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 along = t[(i + 1) % 3] - t[i];
      const double square = dot(along, along);
      const double s = square > 0 ? std::clamp(dot(along, p - t[i]) / square, 0.0, 1.0) : 0;
      least = std::min(least, norm(t[i] + s * along - p));
    }
    const Vec3 u = t[1] - t[0], v = t[2] - t[0], w = p - t[0], n = cross(u, v);
    const double square = dot(n, n);
    if (square == 0) continue;
    const double beta = dot(cross(w, v), n) / square, gamma = dot(cross(u, w), n) / square;
    if (beta >= 0 && gamma >= 0 && beta + gamma <= 1) least = std::min(least, std::abs(dot(n, w)) / std::sqrt(square));
  }
  return least;
}

}  // namespace impinge::test
