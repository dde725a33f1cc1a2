// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/drawn_scene.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <unordered_map>

#include "report/vector.hpp"

namespace impinge::report {
namespace {

/// The middle of the mesh's box, where single precision is finest.
Point middle_of(const Mesh& mesh) {
  Bounds box;
  for (const Point& vertex : mesh.vertices()) box.add(vertex);
  return middle(box.lo, box.hi);
}

/// A coordinate that single precision can hold; nothing so far away can be looked at.
float drawable(double value) {
  constexpr double kFarthest = 1e30;
  return static_cast<float>(std::clamp(value, -kFarthest, kFarthest));
}

/// Vertices with the same coordinates become one, and those that no triangle uses go.
void weld(DrawnMesh& mesh) {
  constexpr std::size_t kStride = 3 * sizeof(float);
  const std::size_t count = mesh.xyz.size() / 3;
  std::vector<unsigned int> remap(count);
  const std::size_t unique = meshopt_generateVertexRemap(remap.data(), mesh.triangles.data(), mesh.triangles.size(),
                                                         mesh.xyz.data(), count, kStride);
  meshopt_remapVertexBuffer(mesh.xyz.data(), mesh.xyz.data(), count, kStride, remap.data());
  meshopt_remapIndexBuffer(mesh.triangles.data(), mesh.triangles.data(), mesh.triangles.size(), remap.data());
  mesh.xyz.resize(3 * unique);
}

DrawnMesh drawn(const Mesh& mesh, const Point& middle) {
  DrawnMesh result;
  result.xyz.reserve(3 * mesh.vertex_count());
  for (const Point& p : mesh.vertices())
    result.xyz.insert(result.xyz.end(), {drawable(p.x - middle.x), drawable(p.y - middle.y), drawable(p.z - middle.z)});
  result.triangles.reserve(3 * mesh.triangle_count());
  for (const auto& triangle : mesh.triangles())
    result.triangles.insert(result.triangles.end(), triangle.begin(), triangle.end());
  weld(result);
  return result;
}

void simplify(DrawnMesh& mesh, std::size_t triangles) {
  constexpr std::size_t kStride = 3 * sizeof(float);
  constexpr float kLargestError = 0.05F;  // of the mesh's extent
  std::vector<std::uint32_t> fewer(mesh.triangles.size());
  std::size_t count = meshopt_simplify(fewer.data(), mesh.triangles.data(), mesh.triangles.size(), mesh.xyz.data(),
                                       mesh.xyz.size() / 3, kStride, 3 * triangles, kLargestError, 0, nullptr);
  // Where its shape allows no more, or it is not connected: what keeps its looks from afar.
  if (count > 6 * triangles)
    count = meshopt_simplifySloppy(fewer.data(), mesh.triangles.data(), mesh.triangles.size(), mesh.xyz.data(),
                                   mesh.xyz.size() / 3, kStride, 3 * triangles, 1.0F, nullptr);
  if (count == 0) return;
  fewer.resize(count);
  mesh.triangles = std::move(fewer);
  mesh.xyz.resize(3 * meshopt_optimizeVertexFetch(mesh.xyz.data(), mesh.triangles.data(), mesh.triangles.size(),
                                                  mesh.xyz.data(), mesh.xyz.size() / 3, kStride));
}

Pose about(const Point& middle, Pose pose) {
  const Point at = world_vertex(pose, middle);
  pose.t = {at.x, at.y, at.z};
  return pose;
}

/// Adds the groups that a person can be shown, and says for each object which of them it is in.
void add_groups(const Assembly& assembly, DrawnScene& scene) {
  std::vector<std::optional<std::uint32_t>> shown;  // for each group of the assembly
  const auto of = [&](std::optional<std::uint32_t> group) { return group ? shown[*group] : std::nullopt; };
  for (const io::Group& group : assembly.groups) {
    const std::optional<std::uint32_t> parent = of(group.parent);
    shown.push_back(group.name.empty() ? parent : static_cast<std::uint32_t>(scene.groups.size()));
    if (!group.name.empty()) scene.groups.push_back({group.name, parent});
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i) scene.objects[i].group = of(assembly.objects[i].group);
}

}  // namespace

Affine about(const Point& middle, const Affine& map) {
  const Pose moved = about(middle, Pose{map.m, map.t});
  return {moved.R, moved.t};
}

Result<DrawnScene> draw(const Assembly& assembly, std::uint64_t most_triangles, const std::stop_token& stop) {
  constexpr std::uint64_t kFewest = 48;  // what a mesh keeps in any case: a box with holes
  DrawnScene scene;
  scene.asked = most_triangles;
  for (const io::Object& object : assembly.objects) scene.triangles += object.mesh.triangle_count();
  const double share = scene.triangles > most_triangles
                           ? static_cast<double>(most_triangles) / static_cast<double>(scene.triangles)
                           : 1.0;
  std::unordered_map<const Point*, std::uint32_t> known;
  for (const io::Object& object : assembly.objects) {
    if (stop.stop_requested()) return interrupted();
    if (object.mesh.triangle_count() == 0) {
      scene.objects.push_back({std::nullopt, object.pose});
      continue;
    }
    const auto [place, is_new] =
        known.try_emplace(object.mesh.vertices().data(), static_cast<std::uint32_t>(scene.meshes.size()));
    if (is_new) {
      scene.middles.push_back(middle_of(object.mesh));
      DrawnMesh mesh = drawn(object.mesh, scene.middles.back());
      const auto kept = static_cast<std::uint64_t>(share * static_cast<double>(object.mesh.triangle_count()));
      if (share < 1 && object.mesh.triangle_count() > kFewest) simplify(mesh, std::max(kept, kFewest));
      scene.meshes.push_back(std::move(mesh));
    }
    scene.objects.push_back({place->second, about(scene.middles[place->second], object.pose)});
    scene.shown += scene.meshes[place->second].triangles.size() / 3;
  }
  add_groups(assembly, scene);
  return scene;
}

}  // namespace impinge::report
