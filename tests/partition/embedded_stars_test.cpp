// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "partition/embedded_stars.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/stopped.hpp"
#include "core/vec3.hpp"
#include "scenes/hard.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using partition::EmbeddedStars;
using scenes::MeshData;

/// By vertex. Fails where a vertex is one in some of its triangles alone.
std::vector<bool> embedded(const MeshData& numbers) {
  const Mesh mesh = test::mesh_of(numbers);
  const impinge::MeshData& data = test::numbers_of(mesh);
  const EmbeddedStars stars =
      partition::find_embedded_stars(data, partition::closed_vertices(data.triangles, data.vertices.size()));
  std::vector<bool> found(data.vertices.size());
  for (const bool second : {false, true}) {
    for (std::size_t t = 0; t < stars.corners.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = data.triangles[t][k], name = stars.corners[t][k];
        EXPECT_TRUE(name == v || name == EmbeddedStars::kNone);
        if (second) {
          EXPECT_EQ(found[v], name == v) << v;
        }
        if (name == v) found[v] = true;
      }
    }
  }
  return found;
}

/// A fan about the origin, which is vertex 0, whose ring goes round the axis z so many times; closed below it by a
/// second apex, vertex 1, if asked for.
MeshData fan(std::uint32_t corners, double rounds, bool is_closed) {
  MeshData mesh;
  mesh.add_vertex(0, 0, 0), mesh.add_vertex(0, 0, -5);
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 0.1 + rounds * 4 * std::acos(0.0) * i / corners;
    mesh.add_vertex(std::cos(angle), std::sin(angle), -0.1);
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t one = 2 + i, next = 2 + (i + 1) % corners;
    if (is_closed || i > 0) mesh.add_triangle(0, one, next);
    if (is_closed) mesh.add_triangle(1, next, one);
  }
  return mesh;
}

TEST(EmbeddedStars, AreThoseOfClosedVerticesThatTrianglesGoRoundOnce) {
  EXPECT_TRUE(embedded(fan(7, 1, true))[0]);
  EXPECT_FALSE(embedded(fan(9, 2, true))[0]) << "twice";
  EXPECT_FALSE(embedded(fan(7, 1, false))[0]) << "not closed";
  MeshData turned = fan(7, 1, true);
  std::swap(turned.triangles[0], turned.triangles[1]);
  EXPECT_FALSE(embedded(turned)[0]) << "a triangle turned over";
  EXPECT_FALSE(embedded(scenes::with_duplicates(fan(7, 1, true), 2))[0]) << "a triangle twice";
  MeshData folded = fan(7, 1, true);
  folded.xyz[6] *= -0.5, folded.xyz[7] *= -0.5;
  EXPECT_FALSE(embedded(folded)[0]) << "folded";
}

/// Turned, so that what was along the axis z is along the direction.
MeshData turned_along(const Vec3& direction, MeshData mesh) {
  const auto unit = [](const Vec3& v) { return 1 / norm(v) * v; };
  const Vec3 n = unit(direction), u = unit(cross({n.y, -n.z, n.x}, n)), v = cross(n, u);
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    const Vec3 turned = mesh.xyz[i] * u + mesh.xyz[i + 1] * v + mesh.xyz[i + 2] * n;
    mesh.xyz[i] = turned.x, mesh.xyz[i + 1] = turned.y, mesh.xyz[i + 2] = turned.z;
  }
  return mesh;
}

/// A cone so steep that its triangles are oriented alike along its axis, and along no other of the nine directions.
TEST(EmbeddedStars, AreSeenAlongEachDirection) {
  const MeshData once = scenes::scaled(fan(7, 1, true), 1, 1, 30), twice = scenes::scaled(fan(9, 2, true), 1, 1, 30);
  for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 1, 0}, Vec3{1, -1, 0}, Vec3{0, 1, 1},
                        Vec3{0, 1, -1}, Vec3{1, 0, 1}, Vec3{-1, 0, 1}}) {
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(testing::Message() << sign * d.x << ' ' << sign * d.y << ' ' << sign * d.z);
      EXPECT_TRUE(embedded(turned_along(sign * d, once))[0]);
      EXPECT_FALSE(embedded(turned_along(sign * d, twice))[0]);
    }
  }
  EXPECT_FALSE(embedded(turned_along({1, 1, 1}, once))[0]) << "a direction that is not looked along";
}

TEST(EmbeddedStars, AreSoughtAnewAfterAStop) {
  const Mesh mesh = test::mesh_of(scenes::uv_sphere(8, 6));
  const impinge::MeshData& data = test::numbers_of(mesh);
  partition::ClosedVertices closed;
  partition::EmbeddedStarsCache stars;
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(stars.of(data, closed, {}, source.get_token()), Stopped);
  EXPECT_EQ(stars.known(), nullptr);
  EXPECT_EQ(stars.of(data, closed, {}, {}).corners.size(), data.triangles.size());
  EXPECT_EQ(stars.known(), &stars.of(data, closed, {}, source.get_token()));
  EXPECT_GE(stars.bytes(), 12 * data.triangles.size());
  EXPECT_GE(8 * closed.bytes(), data.vertices.size());
}

TEST(EmbeddedStars, AreThoseOfSmoothSurfaces) {
  for (const bool as_is : {true, false}) {
    MeshData sphere = scenes::uv_sphere(24, 16);
    if (!as_is) sphere = scenes::scaled(scenes::shifted(sphere, 3, 2, 1), -1, 0.5, 2);
    const std::vector<bool> found = embedded(sphere);
    EXPECT_EQ(std::count(found.begin(), found.end(), true), std::ptrdiff_t(found.size()));
  }
  // A grid's inner vertices.
  const std::vector<bool> found = embedded(scenes::bumpy_grid(10, 10));
  EXPECT_EQ(std::count(found.begin(), found.end(), true), 81);
  // Beyond where the bounds hold, none.
  for (const double scale : {0x1p-310, 0x1p310})
    EXPECT_EQ(embedded(scenes::scaled(scenes::uv_sphere(8, 6), scale, scale, scale)),
              std::vector<bool>(scenes::uv_sphere(8, 6).vertex_count()));
}

}  // namespace
}  // namespace impinge
