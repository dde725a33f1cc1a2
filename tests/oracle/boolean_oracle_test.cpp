// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Verdicts and volumes of solids at random places against CGAL's boolean operations on their boundaries (Polygon Mesh
/// Processing, exact constructions), which share nothing with impinge but the world vertices.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "impinge/clash.hpp"
#include "impinge/measures.hpp"
#include "scenes/motion.hpp"
#include "scenes/random.hpp"
#include "scenes/shapes.hpp"
#include "scenes/solids.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::MeshData;
using scenes::Random;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>>;

Surface surface_of(const MeshData& placed) {
  Surface surface;
  for (std::size_t i = 0; i < placed.xyz.size(); i += 3)
    surface.add_vertex({placed.xyz[i], placed.xyz[i + 1], placed.xyz[i + 2]});
  using Vertex = Surface::Vertex_index;
  for (std::size_t i = 0; i < placed.triangles.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return Vertex(placed.triangles[i + k]); };
    EXPECT_TRUE(surface.add_face(corner(0), corner(1), corner(2)).is_valid());
  }
  return surface;
}

/// How deep the vertices of `a` that are inside `b` lie there: no more than `a` reaches into `b`.
double depth_of_vertices(const Surface& a, const Surface& b) {
  const Tree tree(faces(b).begin(), faces(b).end(), b);
  const CGAL::Side_of_triangle_mesh<Surface, Kernel> side(b);
  double deepest = 0;
  for (const auto vertex : a.vertices())
    if (side(a.point(vertex)) == CGAL::ON_BOUNDED_SIDE)
      deepest = std::max(deepest, std::sqrt(CGAL::to_double(tree.squared_distance(a.point(vertex)))));
  return deepest;
}

/// A solid of about a metre: extruded, turned on a lathe, or the hull of random points.
MeshData random_solid(Random& random) {
  scenes::Outline outer, inner;
  const int corners = random.integer(3, 24);
  const double wall = random.uniform(0.02, 0.6);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.3)) / corners;
    outer.push_back({std::cos(angle), std::sin(angle)});
    inner.push_back({(1 - wall) * outer.back()[0], (1 - wall) * outer.back()[1]});
  }
  const double height = random.uniform(0.05, 3);
  switch (random.integer(0, 5)) {
    case 0:
      return scenes::prism(outer, 0, height);
    case 1:
      return scenes::ring(outer, inner, 0, height);
    case 2: {  // an I-beam
      const double web = random.uniform(0.01, 0.2), flange = random.uniform(0.02, 0.2);
      return scenes::boundary(
          {{-0.5, -web, web, 0.5}, {-0.5, -0.5 + flange, 0.5 - flange, 0.5}, {0, height}, [](int i, int j, int) {
             return i == 1 || j != 1;
           }});
    }
    case 3:
      return scenes::scaled(scenes::uv_sphere(random.integer(3, 16), random.integer(2, 9)), 0.5, random.uniform(0.1, 1),
                            random.uniform(0.1, 1));
    case 4:
      return scenes::scaled(scenes::torus_knot_of(240), 0.3, 0.3, 0.3);
    default: {
      std::vector<std::array<int, 3>> points;
      for (int i = 0; i < 20; ++i)
        points.push_back({random.integer(-9, 9), random.integer(-9, 9), random.integer(-9, 9)});
      return scenes::scaled(scenes::hull(points), 0.1, 0.1, 0.1);
    }
  }
}

Point mean_of(const std::vector<Point>& points) {
  Point sum{};
  for (const Point& p : points) sum = sum + p;
  return 1.0 / static_cast<double>(points.size()) * sum;
}

/// Brings a vertex of b to a face of a, and from there so far inwards, or else to a random place.
Pose random_place(const MeshData& a, const Pose& pose_a, const MeshData& b, Random& random) {
  Pose pose = scenes::random_motion(random, 1.5);
  if (random.integer(0, 2) == 0) return pose;
  constexpr std::array<double, 6> kInwards{-0.002, 0.0002, 0.0009, 0.0011, 0.004, 0.05};
  const auto faces = test::world_triangles(test::mesh_of(a), pose_a);
  const auto& [p, q, r] = faces[static_cast<std::size_t>(random.integer(0, static_cast<int>(faces.size()) - 1))];
  const Point face = mean_of({p, q, r}), normal = cross(q - p, r - p);
  const Point target =
      face - kInwards[static_cast<std::size_t>(random.integer(0, 5))] / std::sqrt(dot(normal, normal)) * normal;
  const std::size_t corner = static_cast<std::size_t>(random.integer(0, static_cast<int>(b.xyz.size() / 3) - 1));
  const Point there = world_vertex(pose, {b.xyz[3 * corner], b.xyz[3 * corner + 1], b.xyz[3 * corner + 2]});
  const Point way = target - there;
  for (std::size_t k = 0; k < 3; ++k) pose.t[k] += std::array{way.x, way.y, way.z}[k];
  return pose;
}

TEST(BooleanOracle, NoOverlapOfRandomSolidsIsMissedOrInvented) {
  constexpr double kMillimetre = 1e-3;
  test::Seeded seeded(2024);
  int overlapping = 0;
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    const MeshData a = random_solid(seeded.random), b = random_solid(seeded.random);
    const Pose pose_a = scenes::random_motion(seeded.random, 100);
    const Pose beside = random_place(a, {}, b, seeded.random);
    // The same two at a random place of the world.
    const MeshData placed_a = scenes::baked(a, pose_a), placed_b = scenes::baked(scenes::baked(b, beside), pose_a);
    Surface first = surface_of(placed_a), second = surface_of(placed_b), common;
    const double vertices = std::max(depth_of_vertices(first, second), depth_of_vertices(second, first));
    ASSERT_TRUE(CGAL::Polygon_mesh_processing::corefine_and_compute_intersection(first, second, common));
    const double volume = CGAL::to_double(CGAL::Polygon_mesh_processing::volume(common));
    const bool overlaps = !common.is_empty();
    overlapping += overlaps ? 1 : 0;

    const Mesh mesh_a = test::mesh_of(placed_a), mesh_b = test::mesh_of(placed_b);
    const auto exact = judge(mesh_a, {}, mesh_b, {}, {.tolerance = 0, .volumes = true});
    ASSERT_TRUE(exact) << exact.error().message;
    EXPECT_EQ(exact->verdict < Verdict::touching, overlaps);
    const auto excused = judge(mesh_a, {}, mesh_b, {}, {.tolerance = kMillimetre});
    ASSERT_TRUE(excused) << excused.error().message;
    EXPECT_LE(excused->verdict < Verdict::touching, overlaps) << "invented";
    EXPECT_GE(excused->verdict<Verdict::touching, vertices> 1.0001 * kMillimetre) << "missed " << vertices;
    if (exact->overlap_depth) {
      const double most = std::max(exact->overlap_depth->a_in_b.hi, exact->overlap_depth->b_in_a.hi);
      EXPECT_GE(most, (1 - 1e-9) * vertices);
    }
    const auto found = overlap_volume(mesh_a, {}, mesh_b, {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_LE(std::abs(found->volume - volume), found->error + 1e-12) << volume;
  }
  EXPECT_GE(overlapping, 80);
  EXPECT_LE(overlapping, 190);
}

}  // namespace
}  // namespace impinge
