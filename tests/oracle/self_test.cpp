// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Self-collision against its definition in rational numbers: triangles i < j are reported if and only if they have
/// three vertices in common, or share a point outside of the convex hull of the common ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "core/shapes.hpp"
#include "impinge/collide.hpp"
#include "impinge/scene.hpp"
#include "points.hpp"
#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using oracle::Vec;
using scenes::MeshData;

bool in_hull(const Vec& x, const std::vector<Vec>& common) {
  using oracle::operator-;
  if (common.empty()) return false;
  if (common.size() == 1 || common[0] == common[1]) return x == common[0];
  const Vec along = common[1] - common[0], step = x - common[0];
  const mpq_class at = oracle::dot(step, along);
  return oracle::is_zero(oracle::cross(along, step)) && at >= 0 && at <= oracle::dot(along, along);
}

std::vector<test::Contact> truth(const Mesh& mesh, const Pose& pose, Adjacency adjacency) {
  std::vector<test::Contact> contacts;
  std::vector<Vec> world;
  for (const Point& v : mesh.vertices()) world.push_back(points::exact(world_vertex(pose, v)));
  const auto triangles = mesh.triangles();
  const auto box = [&](std::uint32_t t) {
    Triangle placed;
    for (std::size_t i = 0; i < 3; ++i) placed[i] = world_vertex(pose, mesh.vertices()[triangles[t][i]]);
    return box_of(placed);
  };
  const auto corners = [&](std::size_t t) {
    return oracle::simplified({world[triangles[t][0]], world[triangles[t][1]], world[triangles[t][2]]});
  };
  // Equal vertices by what tells them apart, as their lowest index.
  std::vector<std::uint32_t> name(world.size());
  for (std::uint32_t v = 0; v < name.size(); ++v) {
    name[v] = v;
    for (std::uint32_t other = 0; other < v && adjacency == Adjacency::by_position && name[v] == v; ++other)
      if (world[other] == world[v]) name[v] = other;
  }
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const oracle::Corners a = corners(i);
    for (std::uint32_t j = i + 1; j < triangles.size(); ++j) {
      if (!overlap(box(i), box(j))) continue;
      const oracle::Corners b = corners(j);
      const auto meeting = oracle::meeting(a, b);
      if (!meeting) continue;
      std::set<std::uint32_t> both;
      for (const std::uint32_t v : triangles[i])
        for (const std::uint32_t w : triangles[j])
          if (name[v] == name[w]) both.insert(name[v]);
      std::vector<Vec> hull;
      for (const std::uint32_t v : both) hull.push_back(world[v]);
      const oracle::Corners part = oracle::common_part(a, oracle::half_spaces(b));
      if (hull.size() == 3 || !std::all_of(part.begin(), part.end(), [&](const Vec& x) { return in_hull(x, hull); }))
        contacts.push_back({0, 0, i, j, static_cast<std::uint32_t>(*meeting)});
    }
  }
  return contacts;
}

/// Triangles of few vertices, some of which are in one place: neighbours, folds, fans, doubles and degenerate ones.
MeshData tangle(scenes::Random& random, int vertices, int triangles, int side) {
  MeshData mesh;
  const auto whole = [&](int most) { return random.integer(0, most); };
  for (int i = 0; i < vertices; ++i) mesh.add_vertex(whole(side), whole(side), whole(side));
  for (int i = 0; i < triangles; ++i) {
    std::array<std::uint32_t, 3> v{};
    for (std::uint32_t& corner : v) corner = static_cast<std::uint32_t>(whole(vertices - 1));
    mesh.add_triangle(v[0], v[1], v[2]);
  }
  return mesh;
}

/// Each triangle with vertices of its own, as STL has them.
MeshData unwelded(const MeshData& mesh) {
  MeshData result;
  for (const std::uint32_t v : mesh.triangles)
    result.triangles.push_back(result.add_vertex(mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]));
  return result;
}

/// The first half of its triangles with vertices of their own, the others as they are.
MeshData half_welded(const MeshData& mesh) {
  MeshData result = mesh;
  for (std::size_t i = 0; i < mesh.triangles.size() / 2; ++i) {
    const std::uint32_t v = mesh.triangles[i];
    result.triangles[i] = result.add_vertex(mesh.xyz[3 * v], mesh.xyz[3 * v + 1], mesh.xyz[3 * v + 2]);
  }
  return result;
}

/// Closed: about a ring that goes round the axis z so many times, with two apexes.
MeshData bipyramid(std::uint32_t corners, double rounds, const Point& apex_a, const Point& apex_b) {
  MeshData mesh;
  for (const Point& apex : {apex_a, apex_b}) mesh.add_vertex(apex.x, apex.y, apex.z);
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = rounds * 4 * std::acos(0.0) * i / corners;
    mesh.add_vertex(std::cos(angle), std::sin(angle), 0.01 * (i % 3));
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t one = 2 + i, next = 2 + (i + 1) % corners;
    mesh.add_triangle(0, one, next), mesh.add_triangle(1, next, one);
  }
  return mesh;
}

/// Closed meshes, whose vertices are inside of a surface, that meet themselves about those or just do not.
std::vector<MeshData> closed_meshes(scenes::Random& random) {
  std::vector<MeshData> meshes{bipyramid(7, 1, {0, 0, 1}, {0, 0, -1}), bipyramid(9, 2, {0, 0, 1}, {0, 0, -1}),
                               bipyramid(24, 1, {0.7, 0.7, 1e-3}, {0, 0, -1}),  // needles
                               bipyramid(8, 1, {0, 0, 0.01}, {0, 0, 0.01}),     // its two sides on each other
                               bipyramid(6, 1, {2, 0, 1}, {0, 0.5, 0})};        // an apex beside its ring
  // An apex as good as on an edge of its ring, on either side.
  for (int k = 20; k < 60; k += 10)
    for (const double side : {-1.0, 1.0})
      meshes.push_back(bipyramid(4, 1, {0.5 + std::ldexp(side, -k), 0.5, std::ldexp(1, -k)}, {0, 0, -1}));
  for (const double noise : {0.1, 0.3, 1.0}) {
    meshes.push_back(scenes::uv_sphere(8, 6));
    for (double& x : meshes.back().xyz) x += noise * random.uniform(-1, 1);
  }
  for (int side = 1; side < 6; side += 2) {
    meshes.push_back(scenes::uv_sphere(6, 5));
    for (double& x : meshes.back().xyz) x = random.integer(0, side);
  }
  const MeshData noisy = meshes[meshes.size() - 5];
  for (const double scale : {0x1p-290, 0x1p250}) meshes.push_back(scenes::scaled(noisy, scale, scale, scale));
  for (const double far : {1e4, 1e15}) meshes.push_back(scenes::shifted(noisy, far, -far, far));
  return meshes;
}

std::vector<MeshData> small_meshes(scenes::Random& random) {
  std::vector<MeshData> meshes{scenes::cube(),
                               unwelded(scenes::cube()),
                               scenes::uv_sphere(8, 6),
                               half_welded(scenes::uv_sphere(8, 6)),
                               half_welded(bipyramid(9, 2, {0, 0, 1}, {0, 0, -1})),
                               scenes::flat_grid(3, 3),
                               scenes::with_duplicates(scenes::cube(), 2),
                               scenes::torus_knot(2, 3, 24, 3),
                               {}};
  for (int i = 0; i < 8; ++i) meshes.push_back(tangle(random, 6 + i, 30, 1 + i % 4));
  // A strip of one plane, folded back upon itself; and neighbours far from the origin.
  MeshData fold = scenes::flat_grid(6, 2);
  for (std::size_t i = 0; i < fold.xyz.size(); i += 3)
    if (fold.xyz[i] > 3) fold.xyz[i] = 6 - fold.xyz[i];
  meshes.push_back(fold);
  meshes.push_back(scenes::shifted(scenes::triangle_soup(random, 60, 0.5), 1e6, -1e6, 1e6));
  meshes.push_back(scenes::scaled(tangle(random, 12, 40, 3), 0x1p-70, 0x1p-70, 0x1p-70));
  for (MeshData& closed : closed_meshes(random)) meshes.push_back(std::move(closed));
  return meshes;
}

TEST(SelfCollide, IsItsDefinition) {
  test::Seeded seeded(1);
  std::size_t reported = 0;
  double reach = 1e14;
  for (const MeshData& numbers : small_meshes(seeded.random)) {
    // Every other one so far away that vertices are rounded by about what their places differ by.
    reach = reach == 3 ? 1e14 : 3;
    for (const Pose& pose : {Pose{}, scenes::random_motion(seeded.random, reach)})
      for (const Adjacency adjacency : {Adjacency::by_position, Adjacency::by_index}) {
        const auto expected = truth(test::mesh_of(numbers), pose, adjacency);
        reported += expected.size();
        for (const char* const backend : {"simd", "paper"})
          for (const std::uint32_t leaf_size : {0u, 1u, 40u}) {
            SCOPED_TRACE(std::string(backend) + ", leaf size " + std::to_string(leaf_size));
            const auto found = self_collide(test::mesh_of(numbers, leaf_size), pose,
                                            {.threads = 1, .backend = backend, .adjacency = adjacency});
            ASSERT_TRUE(found) << found.error().message;
            ASSERT_EQ(test::listed(*found), expected);
          }
      }
  }
  EXPECT_GT(reported, 1000u);
}

/// A flat fan whose apex is inside of its ring by less than what vertices are rounded by in the world, where it is
/// outside: neighbours are folded onto each other there.
TEST(SelfCollide, SeesWhatRoundingFolds) {
  for (const int exponent : {4, 9, 20, 40}) {
    SCOPED_TRACE(exponent);
    const double half = std::ldexp(1, exponent - 53);  // of the unit in the last place there
    MeshData fan;
    fan.add_vertex(0.5 - 0.99 * half, 0.5, 0), fan.add_vertex(0, 0, -1);
    fan.add_vertex(1 - 1.01 * half, 0, 0), fan.add_vertex(0, 1, 0), fan.add_vertex(-1, 0, 0), fan.add_vertex(0, -1, 0);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t one = 2 + i, next = 2 + (i + 1) % 4;
      fan.add_triangle(0, one, next), fan.add_triangle(1, next, one);
    }
    const Mesh mesh = test::mesh_of(fan);
    Pose pose;
    pose.t[0] = std::ldexp(1, exponent);
    const auto expected = truth(mesh, pose, Adjacency::by_index);
    ASSERT_FALSE(expected.empty());
    EXPECT_EQ(test::listed(self_collide(mesh, pose).value()), expected);
    EXPECT_TRUE(self_collide(mesh)->objects.empty());
  }
}

TEST(SelfCollide, IsTheSameOnEveryInstructionSetAndByThreads) {
  MeshData knots = scenes::torus_knot_of(9612);  // two, through each other
  const MeshData other = scenes::shifted(knots, 0.3, 0.2, 0.1);
  const auto offset = static_cast<std::uint32_t>(knots.vertex_count());
  knots.xyz.insert(knots.xyz.end(), other.xyz.begin(), other.xyz.end());
  for (const std::uint32_t v : other.triangles) knots.triangles.push_back(v + offset);
  const Contacts expected = self_collide(test::mesh_of(knots), {}, {.threads = 1}).value();
  const Mesh one = test::mesh_of(scenes::torus_knot_of(9612)), two = test::mesh_of(other);
  EXPECT_TRUE(self_collide(one)->objects.empty());
  EXPECT_EQ(expected.triangles.size(), collide(one, {}, two, {})->triangles.size());
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    for (const int threads : {1, 8})
      test::expect_same(expected, self_collide(test::mesh_of(knots), {}, {.threads = threads}).value());
  }
  // By position, welding changes nothing but the key.
  EXPECT_EQ(test::listed(expected), test::listed(self_collide(test::mesh_of(unwelded(knots))).value()));
  EXPECT_EQ(test::listed(expected),
            test::listed(self_collide(test::mesh_of(knots), {}, {.adjacency = Adjacency::by_index}).value()));
}

/// Of contacts that are known: those up to a limit, the first that is found, of each kind too, and all.
void expect_options_kept(const Mesh& mesh, const Pose& pose, const std::vector<test::Contact>& all) {
  for (const int threads : {1, 4}) {
    SCOPED_TRACE(threads);
    for (const std::uint8_t kinds : {kAllKinds, kCrossing, kTouching, kCoplanar}) {
      std::vector<test::Contact> wanted;
      std::copy_if(all.begin(), all.end(), std::back_inserter(wanted),
                   [&](const test::Contact& contact) { return (kinds >> contact[4] & 1) != 0; });
      const auto first = test::listed(
          self_collide(mesh, pose, {.find = Options::Find::first, .kinds = kinds, .threads = threads}).value());
      ASSERT_EQ(first.size(), wanted.empty() ? 0u : 1u);
      if (!wanted.empty()) {
        EXPECT_NE(std::find(wanted.begin(), wanted.end(), first[0]), wanted.end());
      }
    }
    const std::size_t most = std::min<std::size_t>(7, all.size());
    const Contacts some = self_collide(mesh, pose, {.limit = 7, .threads = threads}).value();
    EXPECT_EQ(some.truncated, most < all.size());
    EXPECT_EQ(test::listed(some), std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(most)));
    EXPECT_EQ(test::listed(self_collide(mesh, pose, {.threads = threads}).value()), all);
  }
}

TEST(SelfCollide, KeepsToItsOptions) {
  test::Seeded seeded(2);
  const Mesh mesh = test::mesh_of(scenes::triangle_soup(seeded.random, 300, 0.5));
  const auto all = test::listed(self_collide(mesh).value());
  ASSERT_GT(all.size(), 100u);
  expect_options_kept(mesh, {}, all);
  // One mesh in two places, and what it is deformed to: rounding may fold in one what it leaves in the other.
  for (const MeshData& numbers : closed_meshes(seeded.random)) {
    const Mesh closed = test::mesh_of(numbers);
    const double size = *std::max_element(numbers.xyz.begin(), numbers.xyz.end());
    std::vector<double> moved = numbers.xyz;
    for (double& x : moved) x += 0.05 * size * seeded.random.uniform(-1, 1);
    const Mesh deformed = closed.deformed(moved).value();
    for (const Pose& pose : {Pose{}, scenes::random_motion(seeded.random, 1e14)})
      for (const Mesh& one : {closed, deformed})
        expect_options_kept(one, pose, truth(one, pose, Adjacency::by_position));
  }
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(self_collide(mesh, {}, {.stop = source.get_token()}).error().code, Code::cancelled);
  EXPECT_EQ(self_collide(mesh, {}, {.threads = -1}).error().code, Code::bad_option);
  Pose mirror;
  mirror.R[0] = -1;
  EXPECT_EQ(self_collide(mesh, mirror).error().code, Code::bad_pose);
}

TEST(SceneSelf, AddsTheObjectsOwnContacts) {
  test::Seeded seeded(3);
  const Mesh soup = test::mesh_of(scenes::triangle_soup(seeded.random, 200, 0.5));
  const Pose pose = scenes::random_motion(seeded.random, 0.2);
  Scene scene;
  const ObjectId a = scene.add(soup).value(), b = scene.add(soup, pose).value();
  const auto between = test::listed(scene.collide().value());
  ASSERT_TRUE(scene.self(b, true));
  auto expected = between;
  for (test::Contact contact : test::listed(self_collide(soup, pose).value())) {
    contact[0] = contact[1] = 1;
    expected.push_back(contact);
  }
  for (const char* const backend : {"simd", "paper"})
    EXPECT_EQ(test::listed(scene.collide({.backend = backend}).value()), expected);
  EXPECT_EQ(test::listed(scene.collide_with(a).value()), between) << "with others alone";
  ASSERT_TRUE(scene.set_pose(b, pose));
  ASSERT_TRUE(scene.set_mesh(b, soup, pose));
  EXPECT_EQ(test::listed(Scene(scene).collide().value()), expected);
  ASSERT_TRUE(scene.self(b, false));
  EXPECT_EQ(test::listed(scene.collide().value()), between);
  ASSERT_TRUE(scene.self(b, true));
  ASSERT_TRUE(scene.remove(b));
  ASSERT_EQ(scene.add(soup, pose)->index, b.index);
  EXPECT_EQ(test::listed(scene.collide().value()), between);
  EXPECT_EQ(scene.self(b, true).error().code, Code::unknown_id);
}

}  // namespace
}  // namespace impinge
