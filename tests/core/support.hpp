// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh_data.hpp"
#include "impinge/impinge.hpp"
#include "scenes/random.hpp"
#include "scenes/scene.hpp"

/// What the stages' tests share: scenes that are hard for floating point, the answer by brute force, and comparisons
/// of whole answers.
namespace impinge::test {

/// A seeded stream that names its seed in whatever fails while it lives.
struct Seeded {
  explicit Seeded(std::uint64_t seed, const char* file = __builtin_FILE(), int line = __builtin_LINE())
      : random(seed), trace(file, line, "seed " + std::to_string(seed)) {}
  scenes::Random random;
  testing::ScopedTrace trace;
};

Mesh mesh_of(const scenes::MeshData& mesh, std::uint32_t leaf_size = 0);
/// What the stages work on, kept alive by the handle.
const MeshData& numbers_of(const Mesh& mesh);
std::vector<Mesh> meshes_of(const scenes::PlacedScene& scene, std::uint32_t leaf_size = 0);
Scene scene_of(const scenes::PlacedScene& scene, std::uint32_t leaf_size = 0);
std::vector<Triangle> world_triangles(const Mesh& mesh, const Pose& pose);
/// The distance of a point from some triangles by trying out all corners, edges, and feet within the triangle.
double plain_distance(const std::vector<Triangle>& triangles, const Vec3& p);

/// Object a, object b, triangle a, triangle b, kind.
using Contact = std::array<std::uint32_t, 5>;
/// In the answer's own order. Fails the test where the arrays do not fit together.
std::vector<Contact> listed(const Contacts& contacts);
/// Every triangle against every other by the exact predicate, in canonical order.
std::vector<Contact> brute_force(const scenes::PlacedScene& scene);
/// Whole arrays, `truncated` and hash.
void expect_same(const Contacts& expected, const Contacts& found);
/// A two-object answer with the objects exchanged, sorted anew.
std::vector<Contact> transposed(std::vector<Contact> contacts);

/// A caller's floating-point mode, and the one before when it ends. `flush`: denormals to zero.
class CallersMode {
 public:
  CallersMode(int rounding, bool flush);
  ~CallersMode();
  CallersMode(const CallersMode&) = delete;
  CallersMode& operator=(const CallersMode&) = delete;
  /// Whether the mode is still what was set.
  [[nodiscard]] bool is_untouched() const;

 private:
  unsigned before_, set_;
};
/// Told by computing, since the standard library's answer is about another register than the one that counts.
bool rounds_to_nearest_with_denormals();

struct NamedScene {
  std::string name;
  scenes::PlacedScene scene;
};
/// Two objects each, all touching or nearly: flush, coplanar, degenerate, slivers, duplicates, general; at rest, under
/// a common motion, 1e6 away, 2^-70 small, 2^60 large, and with matrices off a rotation by 9e-7.
std::vector<NamedScene> hard_scenes(scenes::Random& random, int triangles = 60);

}  // namespace impinge::test
